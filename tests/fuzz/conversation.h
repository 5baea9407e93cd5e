#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// What a fuzzer says to a process: messages on channels, with pauses, as the bytes of one input.
namespace fastball::fuzz {

using Bytes = std::vector<uint8_t>;

struct Said {
  std::string channel;
  uint8_t pause = 0;  ///< in what unit, pauseUs() says
  Bytes message;      ///< encoded, or what a hostile peer takes for it
};

/// Time [us] that goes by behind a message: none up to 6.5 s, finer at the beginning.
int64_t pauseUs(uint8_t pause);

/// Every channel of the experiment, by name. An input names a channel by its place here.
const std::vector<std::string>& allChannels();
/// What a process hears, by the name of its target. @throw std::out_of_range for no target.
const std::vector<std::string>& channelsOf(const std::string& target);

/// An input is a row of [channel, pause, length / 256, length % 256, message ...]; the last message is as long as
/// it is. Any bytes are a conversation.
std::vector<Said> parse(const uint8_t* data, std::size_t size);
Bytes serialise(const std::vector<Said>& conversation);

}  // namespace fastball::fuzz
