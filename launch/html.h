#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

/// Pages that a browser shows and prints. Text of whatever origin becomes HTML only through escaped(): every function here that
/// takes a std::string escapes it.
namespace fastball::launch {

/// A piece of HTML.
struct Html {
  std::string code;
  Html& operator+=(const Html& more) {
    code += more.code;
    return *this;
  }
};

/// Any bytes as text: the characters that mean something in HTML by their names, what is no UTF-8 and control
/// characters (but line feed and tab) as U+FFFD. Good for an element's content and for an attribute in quotes.
Html escaped(const std::string& text);

/// A file's name as the relative address of that file, to be put between quotes.
Html addressOf(const std::string& file_name);

/// What stands for a value in a piece of HTML: text is escaped, numbers and HTML stay as they are.
inline std::string htmlOf(const Html& html) {
  return html.code;
}
inline std::string htmlOf(const std::string& text) {
  return escaped(text).code;
}
inline std::string htmlOf(const char* text) {
  return escaped(text).code;
}
template <class Number, class = std::enable_if_t<std::is_arithmetic_v<Number>>>
Number htmlOf(Number number) {
  return number;
}

/// A piece of HTML with values in it, by fmt's rules. `pattern` is the program's own and not escaped.
template <class... Values>
Html html(const char* pattern, const Values&... values) {
  return {fmt::format(fmt::runtime(pattern), htmlOf(values)...)};
}

/// One column of a table.
struct HtmlColumn {
  std::string title;  ///< with its unit
  bool number = true;
  bool prose = false;  ///< long words may be broken
};

/// A table. @param rows as many cells each as there are columns. @param caption above it; may be empty.
Html htmlTable(const std::string& caption,
               const std::vector<HtmlColumn>& columns,
               const std::vector<std::vector<Html>>& rows);

/// A picture that is there as `name`.svg and `name`.png, in the folder of the page, with a caption and the
/// addresses of both and of its numbers.
/// @param with_numbers there is also `name`.csv.
Html htmlPicture(const std::string& name, const Html& caption, bool with_numbers);

/// A whole page without scripts and without anything from elsewhere but the pictures beside it: light and dark on a screen, A4 on
/// paper.
std::string htmlPage(const std::string& title, const Html& body);

}  // namespace fastball::launch
