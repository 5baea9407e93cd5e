#include "launch/clean_text.h"

#include <boost/locale/utf.hpp>

namespace fastball::launch {

std::string cleanText(const std::string& text) {
  using Utf8 = boost::locale::utf::utf_traits<char>;
  std::string clean;
  for (auto at = text.begin(); at != text.end();) {
    const auto first = at;
    const auto c = Utf8::decode(at, text.end());
    const bool is_control = (c < 0x20 && c != '\n' && c != '\t') || (c >= 0x7F && c < 0xA0);
    if (boost::locale::utf::is_valid_codepoint(c) && !is_control)
      clean.append(first, at);
    else
      clean += "\xEF\xBF\xBD";
  }
  return clean;
}

}  // namespace fastball::launch
