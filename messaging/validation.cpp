#include "messaging/validation.h"

namespace fastball::messaging {

std::string shortened(std::string sentence, std::size_t limit) {
  constexpr std::size_t kDots = 3;
  if (sentence.size() <= limit || limit < kDots)
    return sentence;
  std::size_t end = limit - kDots;
  const auto inside_character = [&](std::size_t i) {
    return (static_cast<unsigned char>(sentence[i]) & 0xC0U) == 0x80U;
  };
  while (end > 0 && inside_character(end))
    --end;
  sentence.resize(end);
  return sentence + "...";
}

}  // namespace fastball::messaging
