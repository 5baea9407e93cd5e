// What `fastball docs` writes into the documents.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "launch/docs/marked_text.h"
#include "launch/docs/message_reference.h"
#include "tests/config/temporary_folder.h"

namespace fastball::launch {
namespace {

using testing::HasSubstr;

TEST(MessageReference, IsThatOfTheMessages) {
  std::ifstream file(FASTBALL_SOURCE_DIR "/docs/messages.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(page, messageReference(FASTBALL_SOURCE_DIR "/lcmtypes"))
      << "'fastball docs messages' makes it";
}

TEST(MessageReference, NamesAFileThatDoesNotSayItsChannel) {
  const config::TemporaryFolder folder;
  folder.write("a_t.lcm", "package fastball;\nstruct a_t\n{\n    int8_t x;\n}\n");
  try {
    messageReference(folder.path());
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_THAT(e.what(), HasSubstr("a_t.lcm: does not begin with a comment on its channel"));
  }
}

TEST(MarkedText, ReplacesOneBlockAndLeavesTheRest) {
  const std::string page = "a\n<!-- one -->\nold\n<!-- /one -->\n<!-- two -->\n<!-- /two -->\nb\n";
  EXPECT_EQ(withBlock(page, "one", "new\nlines\n"),
            "a\n<!-- one -->\nnew\nlines\n<!-- /one -->\n<!-- two -->\n<!-- /two -->\nb\n");
  EXPECT_EQ(withBlock(withBlock(page, "two", "x\n"), "two", ""), page);
  EXPECT_THROW(withBlock(page, "three", ""), std::runtime_error);
}

TEST(MarkedText, ReplacesTheRowOfAnId) {
  const std::string page = "| `a.b` | 1 |\n| `a.bc` | 2 |\nno row `a.b`";
  bool found = false;
  EXPECT_EQ(withRow(page, "a.b", "| `a.b` | 3 |", found),
            "| `a.b` | 3 |\n| `a.bc` | 2 |\nno row `a.b`");
  EXPECT_TRUE(found);
  EXPECT_EQ(withRow(page, "c", "x", found), page);
  EXPECT_FALSE(found);
}

TEST(MarkedText, ReplacesTheRowOfABenchmark) {
  const std::string page = "| `a.us` | 9 | us | none |  | old |\n| `b` | 1 | 1 | none |  |  |\n";
  const nlohmann::json row = {{"id", "a.us"},   {"value", 1.23456},   {"unit", "us"},
                              {"peer", "tick"}, {"peer_value", 10.0}, {"note", "new"}};
  bool found = false;
  EXPECT_EQ(withBenchmark(page, row, found),
            "| `a.us` | 1.235 | us | tick | 10 | new |\n| `b` | 1 | 1 | none |  |  |\n");
  EXPECT_TRUE(found);
}

}  // namespace
}  // namespace fastball::launch
