#include "launch/html.h"

#include <gmock/gmock.h>

#include "launch/gnuplot.h"

namespace fastball::launch {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Escaped, KeepsCharactersAndNamesThoseThatMeanSomething) {
  EXPECT_EQ(escaped("").code, "");
  EXPECT_EQ(escaped("a b\n\tµ – 漢 \xF0\x9F\x8F\x80").code, "a b\n\tµ – 漢 \xF0\x9F\x8F\x80");
  EXPECT_EQ(escaped("<a href=\"x\">'&amp;").code, "&lt;a href=&quot;x&quot;&gt;&#39;&amp;amp;");
}

TEST(Escaped, ReplacesWhatIsNoText) {
  const std::string no_character = "\xEF\xBF\xBD";
  EXPECT_EQ(escaped(std::string(1, '\0')).code, no_character);
  EXPECT_EQ(escaped("\x1b[31m").code, no_character + "[31m");
  EXPECT_EQ(escaped("\xC2\x85").code, no_character) << "a control character of two bytes";
  EXPECT_EQ(escaped("a\xC3").code, "a" + no_character) << "cut short";
  EXPECT_THAT(escaped("\xC0\xBCscript>").code, Not(HasSubstr("\xC0"))) << "an overlong <";
  EXPECT_THAT(escaped("\xED\xA0\x80").code, Not(HasSubstr("\xED"))) << "half of a pair";
}

TEST(Escaped, LeavesNoByteThatMeansSomethingWhateverComes) {
  for (int first = 0; first < 256; ++first) {
    for (int second = 0; second < 256; ++second) {
      const std::string code =
          escaped({static_cast<char>(first), static_cast<char>(second), '<', '"'}).code;
      EXPECT_EQ(code.find_first_of("<>\"'"), std::string::npos) << first << ' ' << second;
      EXPECT_EQ(code.find('\0'), std::string::npos);
    }
  }
}

TEST(HtmlPattern, EscapesTextAndNothingElse) {
  EXPECT_EQ(html("<p>{} {:.1f} {}</p>", "<b>", 1.25, Html{"<i>"}).code, "<p>&lt;b&gt; 1.2 <i></p>");
  EXPECT_EQ(html("{}", std::string("{}")).code, "{}");
}

TEST(AddressOf, IsRelativeAndPlain) {
  EXPECT_EQ(addressOf("landings-paper.svg").code, "./landings-paper.svg");
  EXPECT_EQ(addressOf("javascript:a \"b\"/<é>").code, "./javascript%3Aa%20%22b%22%2F%3C%C3%A9%3E");
}

TEST(HtmlTable, HasItsCells) {
  const std::string table =
      htmlTable("a < b", {{"x (m)"}, {"name", false}}, {{html("{}", 1), escaped("<")}}).code;
  EXPECT_THAT(table, HasSubstr("<caption>a &lt; b</caption>"));
  EXPECT_THAT(table, HasSubstr("<th scope=\"col\" class=\"n\">x (m)</th>"));
  EXPECT_THAT(table, HasSubstr("<td class=\"n\">1</td><td>&lt;</td>"));
}

TEST(HtmlPage, NeedsNothingFromElsewhere) {
  const std::string page = htmlPage("<t>", html("<p>{}</p>", "x"));
  EXPECT_THAT(page, HasSubstr("<title>&lt;t&gt;</title>"));
  for (const char* foreign : {"http", "//", "@import", "<script", "url("})
    EXPECT_THAT(page, Not(HasSubstr(foreign)));
}

TEST(Quoted, LetsNoTextEndTheString) {
  EXPECT_EQ(quoted("it's"), "'it''s'");
  EXPECT_EQ(quoted("a\n!b\t\xff"), "'a !b \xEF\xBF\xBD'");
}

}  // namespace
}  // namespace fastball::launch
