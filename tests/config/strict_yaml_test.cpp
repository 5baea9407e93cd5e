#include "config/strict_yaml.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/config/temporary_folder.h"

namespace fastball::config {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class StrictYaml : public testing::Test {
 protected:
  Section read(const std::string& text) { return Section::fromFile(folder_.write("f.yaml", text)); }
  /// The message starts with this for a fault of `key` in `line`.
  std::string at(int line, const std::string& key) const {
    return (folder_.path() / "f.yaml").string() + ":" + std::to_string(line) + ": key '" + key +
           "': ";
  }
  TemporaryFolder folder_;
};

TEST_F(StrictYaml, ReadsEveryKindOfValue) {
  Section section = read(
      "plain: 1.5\n"
      "annotated: {value: 2.5, unit: m, source: a ruler}\n"
      "count: 3\n"
      "yes: true\n"
      "word: hello\n"
      "mode: fast\n"
      "list: [1, 2.0, 3e0]\n"
      "grid: [[1, 2], [3, 4]]\n"
      "inner: {a: 1}\n"
      "items: [{a: 1}, {a: 2}]\n"
      "words: [left, right]\n"
      "source: a book\n");
  EXPECT_EQ(section.number("plain"), 1.5);
  EXPECT_EQ(section.number("annotated", kPositive), 2.5);
  EXPECT_EQ(section.integer("count", 0, 3), 3);
  EXPECT_TRUE(section.boolean("yes"));
  EXPECT_EQ(section.text("word"), "hello");
  EXPECT_EQ(section.choice("mode", {"slow", "fast"}), "fast");
  EXPECT_EQ(section.vector("list", 3), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(section.vector("list", -1).size(), 3);
  EXPECT_EQ(section.matrix("grid", 2, 2), (Eigen::Matrix2d() << 1, 2, 3, 4).finished());
  EXPECT_EQ(section.section("inner").number("a"), 1);
  EXPECT_EQ(section.sections("items").at(1).number("a"), 2);
  EXPECT_EQ(section.texts("words"), (std::vector<std::string>{"left", "right"}));
  EXPECT_FALSE(section.has("absent"));
  EXPECT_TRUE(section.has("source"));
  section.ignore("source");
  EXPECT_THAT(faultOf([&] { section.finish(); }), IsEmpty());
}

TEST_F(StrictYaml, FinishNamesTheFirstKeyThatNobodyAskedFor) {
  Section section = read("known: 1\n\nsurprise: 2\nother: 3\n");
  section.number("known");
  EXPECT_THAT(faultOf([&] { section.finish(); }), StartsWith(at(3, "surprise")));
}

TEST_F(StrictYaml, HasDoesNotAddAKey) {
  Section section = read("known: 1\n");
  EXPECT_FALSE(section.has("absent"));
  section.ignore("known");
  EXPECT_THAT(faultOf([&] { section.finish(); }), IsEmpty());
}

TEST_F(StrictYaml, AKeyMayStandOnlyOnce) {
  EXPECT_THAT(faultOf([&] { read("a: 1\nb: 2\na: 3\n"); }), StartsWith(at(3, "a")));
  Section outer = read("inner:\n  a: 1\n  a: 2\n");
  EXPECT_THAT(faultOf([&] { outer.section("inner"); }), StartsWith(at(3, "a")));
  Section annotated = read("a: {value: 1,\n  value: 2}\n");
  EXPECT_THAT(faultOf([&] { annotated.number("a"); }), StartsWith(at(2, "value")));
}

TEST_F(StrictYaml, AMissingKeyIsNamedWithTheLineOfItsMap) {
  Section section = read("inner:\n  a: 1\n");
  EXPECT_THAT(faultOf([&] { section.number("absent"); }), StartsWith(at(1, "absent")));
  Section inner = section.section("inner");
  EXPECT_THAT(faultOf([&] { inner.text("absent"); }),
              AllOf(StartsWith(at(2, "absent")), HasSubstr("missing")));
}

TEST_F(StrictYaml, NumbersAreFiniteAndInRange) {
  Section section = read("a: 1\nb: .nan\nc: .inf\nd: -2\ne: {value: 7}\nf: 0\n");
  EXPECT_EQ(section.number("a", {1, 1}), 1);
  EXPECT_THAT(faultOf([&] { section.number("b"); }), StartsWith(at(2, "b")));
  EXPECT_THAT(faultOf([&] { section.number("c"); }), StartsWith(at(3, "c")));
  EXPECT_THAT(faultOf([&] {
                section.number("d", {-1, 1});
              }),
              AllOf(StartsWith(at(4, "d")), HasSubstr("is -2"), HasSubstr("[-1, 1]")));
  EXPECT_THAT(faultOf([&] { section.number("d", kNonNegative); }), HasSubstr("negative"));
  EXPECT_THAT(faultOf([&] { section.number("e", {0, 5}); }), StartsWith(at(5, "e")));
  EXPECT_EQ(section.number("f", kNonNegative), 0);
  EXPECT_THAT(faultOf([&] { section.number("f", kPositive); }), HasSubstr("must be positive"));
}

TEST_F(StrictYaml, AWrongTypeIsNamed) {
  Section section = read(
      "word: hello\n"
      "quoted: '1'\n"
      "list: [1, 2]\n"
      "map: {a: 1}\n"
      "none:\n"
      "half: 0.5\n"
      "big: 99999999999999999999\n"
      "huge: 1e999\n");
  EXPECT_THAT(faultOf([&] { section.number("word"); }),
              AllOf(StartsWith(at(1, "word")), HasSubstr("'hello'")));
  EXPECT_THAT(faultOf([&] { section.number("quoted"); }), StartsWith(at(2, "quoted")));
  EXPECT_THAT(faultOf([&] { section.number("list"); }), StartsWith(at(3, "list")));
  EXPECT_THAT(faultOf([&] { section.number("map"); }), StartsWith(at(4, "map")));
  EXPECT_THAT(faultOf([&] { section.number("none"); }), StartsWith(at(5, "none")));
  EXPECT_THAT(faultOf([&] { section.text("none"); }), StartsWith(at(5, "none")));
  EXPECT_THAT(faultOf([&] { section.text("list"); }), StartsWith(at(3, "list")));
  EXPECT_THAT(faultOf([&] { section.texts("word"); }), StartsWith(at(1, "word")));
  EXPECT_THAT(faultOf([&] { section.texts("none"); }), StartsWith(at(5, "none")));
  EXPECT_THAT(faultOf([&] { section.integer("half", 0, 1); }), StartsWith(at(6, "half")));
  EXPECT_THAT(faultOf([&] { section.integer("big", 0, 1); }), StartsWith(at(7, "big")));
  EXPECT_THAT(faultOf([&] { section.number("huge"); }), StartsWith(at(8, "huge")));
  EXPECT_THAT(faultOf([&] { section.boolean("half"); }), StartsWith(at(6, "half")));
  EXPECT_THAT(faultOf([&] { section.section("list"); }), StartsWith(at(3, "list")));
  EXPECT_THAT(faultOf([&] { section.section("none"); }), StartsWith(at(5, "none")));
  EXPECT_THAT(faultOf([&] { section.sections("map"); }), StartsWith(at(4, "map")));
  EXPECT_THAT(faultOf([&] { section.sections("list"); }), StartsWith(at(3, "list")));
  EXPECT_THAT(faultOf([&] { section.vector("half", 1); }), StartsWith(at(6, "half")));
}

TEST_F(StrictYaml, ListsHaveTheirSizeAndTheFaultyNumberIsNamed) {
  Section section = read("list: [1,\n  two,\n  3]\ngrid:\n  - [1, 2]\n  - [3]\n");
  EXPECT_THAT(faultOf([&] { section.vector("list", 3); }),
              AllOf(StartsWith(at(2, "list")), HasSubstr("number 2"), HasSubstr("'two'")));
  EXPECT_THAT(faultOf([&] { section.vector("list", 4); }),
              AllOf(StartsWith(at(1, "list")), HasSubstr("4 numbers"), HasSubstr("3 values")));
  EXPECT_THAT(faultOf([&] { section.matrix("grid", 2, 2); }),
              AllOf(StartsWith(at(6, "grid")), HasSubstr("row 2")));
  EXPECT_THAT(faultOf([&] { section.matrix("grid", 3, 2); }),
              AllOf(StartsWith(at(5, "grid")), HasSubstr("3 rows")));
}

TEST_F(StrictYaml, WholeNumbersAndChoicesNameWhatIsAllowed) {
  Section section = read("n: 7\nmode: fats\n");
  EXPECT_THAT(faultOf([&] { section.integer("n", 0, 5); }),
              AllOf(StartsWith(at(1, "n")), HasSubstr("is 7"), HasSubstr("[0, 5]")));
  EXPECT_THAT(faultOf([&] {
                section.choice("mode", {"slow", "fast"});
              }),
              AllOf(StartsWith(at(2, "mode")), HasSubstr("'fats'"), HasSubstr("slow, fast")));
}

TEST_F(StrictYaml, AnAnnotatedValueHasAValueAndNoOtherKeys) {
  Section section = read("a: {valeu: 1}\nb: {unit: m}\n");
  EXPECT_THAT(faultOf([&] { section.number("a"); }),
              AllOf(StartsWith(at(1, "a")), HasSubstr("'valeu'")));
  EXPECT_THAT(faultOf([&] { section.number("b"); }),
              AllOf(StartsWith(at(2, "b")), HasSubstr("'value'")));
}

TEST_F(StrictYaml, AFileThatIsNoMapIsNamed) {
  const std::string path = (folder_.path() / "f.yaml").string();
  EXPECT_THAT(faultOf([&] { read("a: 1\nb: [1, 2\nc: 3\n"); }), StartsWith(path + ":"));
  EXPECT_THAT(faultOf([&] { read("a: 1\n\tb: 2\n"); }), StartsWith(path + ":2:"));
  EXPECT_THAT(faultOf([&] { read(""); }), StartsWith(path + ":1:"));
  EXPECT_THAT(faultOf([&] { read("[1, 2]\n"); }), StartsWith(path + ":1:"));
  EXPECT_THAT(faultOf([&] { read("a: 1\n---\na: 2\n"); }), StartsWith(path + ":1:"));
  EXPECT_THAT(faultOf([&] { read("[1]: 2\n"); }), StartsWith(path + ":1:"));
  EXPECT_THAT(faultOf([&] { Section::fromFile(folder_.path() / "absent.yaml"); }),
              HasSubstr("absent.yaml"));
  EXPECT_THAT(faultOf([&] { Section::fromFile(folder_.path()); }), HasSubstr("no such file"));
}

TEST_F(StrictYaml, ANamedFileIsLookedForBesideTheFileThatNamesIt) {
  folder_.write("other.yaml", "a: 1\nb: 2\n");
  Section section = read("x: 0\nok: other.yaml\nbad: absent.yaml\n");
  Section other = section.file("ok");
  EXPECT_EQ(other.number("a"), 1);
  EXPECT_THAT(faultOf([&] { other.finish(); }), HasSubstr("other.yaml:2: key 'b'"));
  EXPECT_THAT(faultOf([&] { section.file("bad"); }),
              AllOf(StartsWith(at(3, "bad")), HasSubstr("absent.yaml")));
}

}  // namespace
}  // namespace fastball::config
