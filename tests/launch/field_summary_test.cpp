// How members of messages are put in few words, numbers and plots.
#include "launch/spy/field_summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <laboratory/whole_t.hpp>
#include <limits>
#include <nlohmann/json.hpp>

#include "launch/spy/plot.h"
#include "messaging/type_library.h"
#include "tests/messaging/examples.h"

namespace fastball::launch {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// The members of a message, with the bytes they look into.
class Decoded {
 public:
  template <class T>
  explicit Decoded(const T& message) : bytes_(static_cast<std::size_t>(message.getEncodedSize())) {
    types_.load(TYPES_FILE);
    message.encode(bytes_.data(), 0, static_cast<int>(bytes_.size()));
    fields = types_.fields(bytes_.data(), bytes_.size()).value();
  }
  Decoded(const Decoded&) = delete;
  Decoded& operator=(const Decoded&) = delete;

  nlohmann::json json() const { return fieldsJson(fields); }
  FieldLine line(const std::string& name) const {
    for (const FieldLine& line : fieldLines(fields)) {
      if (line.name == name)
        return line;
    }
    return {"", "no such line", std::nullopt};
  }
  std::vector<messaging::MessageField> fields;

 private:
  std::vector<char> bytes_;
  messaging::TypeLibrary types_;
};

laboratory::part_t part(const std::vector<double>& values) {
  laboratory::part_t message{};
  message.n = static_cast<int16_t>(values.size());
  message.values = values;
  return message;
}

TEST(Arrays, AreCountMinimumMeanAndMaximum) {
  std::vector<double> values;
  for (int i = 0; i < 101; ++i)
    values.push_back(0.5 * (i - 100));
  const Decoded decoded(part(values));
  const auto array = decoded.json().at("values");
  EXPECT_EQ(array.at("n"), 101);
  EXPECT_EQ(array.at("min"), -50);
  EXPECT_NEAR(array.at("mean").get<double>(), -25, 1e-12);
  EXPECT_EQ(array.at("max"), 0);
  EXPECT_FALSE(array.contains("values"));
  EXPECT_EQ(decoded.line("values[]").words, "n 101  min -50  mean -25  max 0");
  EXPECT_NEAR(decoded.line("values[]").number.value(), -25, 1e-12);
}

TEST(Arrays, OfFewValuesAreSpelledOut) {
  const Decoded decoded(part({1.5, -2}));
  EXPECT_EQ(decoded.json().at("values").at("values"), nlohmann::json({1.5, -2}));
  EXPECT_EQ(decoded.line("values[1]").words, "-2");
  EXPECT_EQ(decoded.line("values[1]").number, -2);
}

TEST(Arrays, LeaveOutWhatIsNotFinite) {
  const Decoded decoded(part({kNan, 2, INFINITY, 4, -INFINITY}));
  const auto array = decoded.json().at("values");
  EXPECT_EQ(array.at("not_finite"), 3);
  EXPECT_EQ(array.at("min"), 2);
  EXPECT_EQ(array.at("mean"), 3);
  EXPECT_EQ(array.at("max"), 4);
  EXPECT_EQ(array.at("values"), nlohmann::json({nullptr, 2, nullptr, 4, nullptr}));
  EXPECT_FALSE(decoded.line("values[0]").number);
}

TEST(Arrays, WithoutAFiniteValueHaveNone) {
  for (const auto& values : {std::vector<double>{}, std::vector<double>(20, kNan)}) {
    const auto array = Decoded(part(values)).json().at("values");
    EXPECT_EQ(array.at("n"), values.size());
    EXPECT_TRUE(array.at("min").is_null() && array.at("mean").is_null() &&
                array.at("max").is_null());
    EXPECT_FALSE(Decoded(part(values)).line("values[]").number);
  }
  EXPECT_EQ(Decoded(part({})).line("values[]").words, "n 0");
}

TEST(Arrays, OfTheLargestNumbersHaveAFiniteMean) {
  constexpr double kMax = std::numeric_limits<double>::max();
  EXPECT_EQ(Decoded(part({kMax, kMax, kMax})).json().at("values").at("mean"), kMax);
  const Decoded both(part({kMax, -kMax}));
  EXPECT_EQ(both.json().at("values").at("mean"), 0);
}

TEST(Images, AreTheirSizes) {
  image_t image{};
  image.width = 640;
  image.height = 480;
  image.size = 3000;
  image.data.resize(3000);
  const Decoded decoded(image);
  EXPECT_EQ(decoded.json().at("data"),
            nlohmann::json({{"bytes", 3000}, {"width", 640}, {"height", 480}}));
  EXPECT_EQ(decoded.line("data").words, "3000 bytes, 640 x 480");
}

TEST(Members, OfEveryKindAreShown) {
  laboratory::whole_t whole{};
  whole.utime = std::numeric_limits<int64_t>::max();
  whole.rows = 2;
  whole.table = {{1, 2, 3}, {4, 5, 6}};
  whole.raw = {0, 255};
  whole.flag = 1;
  whole.names = {"a\x1b[2J", "b"};
  const Decoded decoded(whole);
  const auto object = decoded.json();
  EXPECT_EQ(object.at("utime"), std::numeric_limits<int64_t>::max());
  EXPECT_EQ(object.at("table").at("mean"), 3.5);
  EXPECT_EQ(object.at("raw"), nlohmann::json({{"bytes", 2}}));
  EXPECT_EQ(object.at("flag"), true);
  EXPECT_EQ(object.at("names").at("values")[1], "b");
  EXPECT_EQ(decoded.line("names[0]").words, "\"a?[2J\"");
  EXPECT_EQ(decoded.line("table[1][2]").words, "6");
}

TEST(Members, WithoutEndAreCutOff) {
  laboratory::whole_t whole{};
  whole.n_children = 300;
  whole.children.resize(300);
  const Decoded decoded(whole);
  const auto lines = fieldLines(decoded.fields, 50);
  EXPECT_THAT(lines.back().words, HasSubstr("more members"));
  EXPECT_LE(lines.size(), 60U);
  EXPECT_EQ(fieldsJson(decoded.fields, 50).size(), 51U);
}

TEST(Plots, RiseWithTheirSamples) {
  const std::deque<double> samples{0, 1, 2, 3, 4, 5, 6, 7};
  EXPECT_THAT(plot(samples, 20, 1, {}), ElementsAre("▁▂▃▄▅▆▇█"));
  EXPECT_THAT(plot({0, 1}, 20, 2, {}), ElementsAre(" █", "▁█"));
  EXPECT_THAT(plot({0, 4}, 20, 1, {false}), ElementsAre("_#"));
}

TEST(Plots, ShowTheNewestSamplesAndGapsWhereThereIsNone) {
  EXPECT_THAT(plot({100, 0, kNan, 1}, 3, 1, {}), ElementsAre("▁ █"));
  EXPECT_THAT(plot({kNan, INFINITY}, 10, 2, {}), Each("  "));
  EXPECT_THAT(plot({}, 10, 3, {}), ElementsAre("", "", ""));
  EXPECT_THAT(plot({1, 2}, 0, 1, {}), ElementsAre(""));
}

TEST(Plots, OfAnyNumbersAreDrawn) {
  constexpr double kMax = std::numeric_limits<double>::max();
  EXPECT_THAT(plot({-kMax, kMax}, 10, 1, {}), ElementsAre("▁█"));
  EXPECT_THAT(plot({5, 5, 5}, 10, 1, {}), ElementsAre("▄▄▄"));
}

TEST(History, KeepsTheLastSamplesOfEachLine) {
  FieldHistory history(3);
  for (int i = 0; i < 5; ++i)
    history.add({{"a", "", static_cast<double>(i)}, {"b", "", std::nullopt}});
  EXPECT_THAT(history.of("a"), ElementsAre(2, 3, 4));
  EXPECT_EQ(history.of("b").size(), 3U);
  EXPECT_TRUE(std::isnan(history.of("b")[0]));
  EXPECT_TRUE(history.of("c").empty());
}

}  // namespace
}  // namespace fastball::launch
