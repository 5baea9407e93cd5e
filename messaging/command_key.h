#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace fastball::messaging {

/// The secret that all processes of one experiment share: 32 random bytes in a file that only its owner can read.
class CommandKey {
 public:
  static constexpr std::size_t kBytes = 32;

  /// Reads a key file: 32 bytes in hexadecimal or base64, white space around them.
  /// @throw std::invalid_argument with one sentence that names the file: it cannot be read, others can read it, it holds no key.
  static CommandKey read(const std::string& path);
  /// Draws a key and writes its file, with mode 0600.
  /// @throw std::invalid_argument if there is something at `path` already, std::runtime_error if it cannot be written.
  static CommandKey make(const std::string& path);

  /// @throw std::runtime_error, as the two above, if libsodium cannot be started.
  explicit CommandKey(const std::array<uint8_t, kBytes>& bytes);
  ~CommandKey();
  CommandKey(const CommandKey&) = default;
  CommandKey& operator=(const CommandKey&) = default;

  /// Eight hexadecimal digits that tell this key from another one, and nothing about it.
  const std::string& id() const { return id_; }
  /// Keyed BLAKE2b (RFC 7693) of the channel's name, a zero, and the bytes: kTagBytes
  /// (command_trailer.h) at `tag`. Allocates nothing.
  void tag(std::string_view channel, const void* data, std::size_t size, uint8_t* tag) const;
  /// True if `tag` is that of the bytes; takes the same time wherever they differ.
  bool isTag(std::string_view channel,
             const void* data,
             std::size_t size,
             const uint8_t* tag) const;

 private:
  std::array<uint8_t, kBytes> bytes_;
  std::string id_;
};

}  // namespace fastball::messaging
