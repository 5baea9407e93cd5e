// Messages taken apart by name: our own, and those of a library that the program was not compiled for.
#include "messaging/type_library.h"

#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <laboratory/whole_t.hpp>
#include <limits>
#include <random>
#include <stdexcept>

#include "messaging/command_trailer.h"
#include "tests/messaging/examples.h"

namespace fastball::messaging {
namespace {

template <class T>
std::vector<char> encoded(const T& message) {
  std::vector<char> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

laboratory::whole_t foreignMessage(int children) {
  laboratory::whole_t m{};
  m.utime = -5;
  m.rows = 2;
  m.one = {2, {0.1, std::nan("")}, "first"};
  m.pair[1] = {1, {1e300}, ""};
  m.table = {{1, 2, 3}, {-4, 5, std::numeric_limits<int32_t>::min()}};
  m.raw = {0, 255};
  m.flag = 1;
  m.ratio = 0.1F;
  m.small = -128;
  m.names = {"a", "b c"};
  m.n_children = children;
  for (int i = 0; i < children; ++i)
    m.children.push_back(foreignMessage(children - 1));
  return m;
}

/// The value called `name` in words; "(none)" if there is no such.
std::string valueOf(const std::vector<MessageField>& fields, const std::string& name) {
  for (const MessageField& field : fields) {
    if (const auto i = field.indexOf(name))
      return field.text(*i);
  }
  return "(none)";
}

TEST(OwnTypes, EveryMemberOfAMessageHasItsNameAndValue) {
  const TypeLibrary library;
  arm_state_t state{};
  state.utime = 123;
  state.seq = -1;
  state.q[2] = 0.1;
  const auto bytes = encoded(state);
  const auto fields = library.fields(bytes.data(), bytes.size());
  ASSERT_TRUE(fields);
  EXPECT_EQ(library.typeOf(bytes.data(), bytes.size())->name, "fastball_arm_state_t");
  EXPECT_EQ(valueOf(*fields, "utime"), "123");
  EXPECT_EQ(valueOf(*fields, "seq"), "-1");
  EXPECT_EQ(valueOf(*fields, "q[2]"), "0.1");
  EXPECT_EQ(valueOf(*fields, "q[4]"), "(none)");
  EXPECT_EQ(valueOf(*fields, "q"), "(none)");
}

TEST(OwnTypes, ACommandWithATrailerHasTheSameMembersAndOtherBytesBehindItAreNoMessage) {
  const TypeLibrary library;
  auto bytes = encoded(examples::example<swing_plan_t>());
  const auto bare = library.fields(bytes.data(), bytes.size());
  const std::size_t size = bytes.size();
  bytes.resize(size + kTrailerBytes, 'x');
  EXPECT_FALSE(library.fields(bytes.data(), bytes.size()));
  kTrailerMark.copy(bytes.data() + size, kTrailerMark.size());
  const auto fields = library.fields(bytes.data(), bytes.size());
  ASSERT_TRUE(bare && fields);
  EXPECT_EQ(fields->size(), bare->size());
  EXPECT_EQ(valueOf(*fields, "q[2][3]"), "0.25");
  EXPECT_FALSE(library.fields(bytes.data(), bytes.size() - 1));
  bytes.push_back('x');
  EXPECT_FALSE(library.fields(bytes.data(), bytes.size()));
}

TEST(OwnTypes, ArraysHaveTheLengthThatTheMessageSays) {
  const auto bytes = encoded(examples::example<swing_plan_t>());
  const TypeLibrary library;
  const auto fields = library.fields(bytes.data(), bytes.size());
  ASSERT_TRUE(fields);
  EXPECT_EQ(valueOf(*fields, "parameter_names[1]"), "p1");
  EXPECT_EQ(valueOf(*fields, "q[2][3]"), "0.25");
  EXPECT_EQ(valueOf(*fields, "q[3][0]"), "(none)");
}

class ForeignTypes : public testing::Test {
 protected:
  void SetUp() override { EXPECT_EQ(library_.load(TYPES_FILE), 2); }
  std::optional<std::vector<MessageField>> fields(const std::vector<char>& bytes) const {
    return library_.fields(bytes.data(), bytes.size());
  }
  TypeLibrary library_;
};

TEST_F(ForeignTypes, EveryKindOfMemberIsRead) {
  const auto bytes = encoded(foreignMessage(2));
  const auto all = fields(bytes);
  ASSERT_TRUE(all);
  const std::vector<std::pair<const char*, const char*>> expected{
      {"utime", "-5"},
      {"one.values[0]", "0.1"},
      {"one.values[1]", "nan"},
      {"one.label", "first"},
      {"pair[0].n", "0"},
      {"pair[1].values[0]", "1e+300"},
      {"pair[1].label", ""},
      {"table[1][0]", "-4"},
      {"table[1][2]", "-2147483648"},
      {"raw[1]", "255"},
      {"flag", "1"},
      {"ratio", "0.1"},
      {"small", "-128"},
      {"names[1]", "b c"},
      {"children[1].n_children", "1"},
      {"children[1].children[0].names[1]", "b c"}};
  for (const auto& [name, value] : expected)
    EXPECT_EQ(valueOf(*all, name), value) << name;
}

TEST_F(ForeignTypes, ElementNamesAndIndicesAreInverse) {
  const auto bytes = encoded(foreignMessage(1));
  const auto all = fields(bytes);
  ASSERT_TRUE(all);
  for (const MessageField& field : *all) {
    for (std::size_t i = 0; i < field.count(); ++i)
      EXPECT_EQ(field.indexOf(field.elementName(i)), i) << field.elementName(i);
  }
}

TEST_F(ForeignTypes, NoMemberIsReadFromBytesThatAreNotExactlyOneMessage) {
  const auto whole = encoded(foreignMessage(1));
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(fields({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)}))
        << size;
  auto longer = whole;
  longer.push_back(0);
  EXPECT_FALSE(fields(longer));
}

TEST_F(ForeignTypes, AnyBytesBehindAFingerprintAreSafe) {
  const auto whole = encoded(foreignMessage(1));
  std::mt19937 random(5);
  const std::vector<char> hostile{'\x00', '\x01', '\x7f', '\x80', '\xff'};
  int refused = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    auto bytes = whole;
    for (int i = 0; i < 4; ++i)
      bytes[8 + random() % (bytes.size() - 8)] = hostile[random() % hostile.size()];
    const auto all = fields(bytes);
    refused += !all;
    std::size_t values = 0;
    for (const MessageField& field : all.value_or(std::vector<MessageField>{}))
      values += field.count();
    EXPECT_LE(values, bytes.size());
  }
  EXPECT_GT(refused, 1000);
}

TEST(TypeLibraries, AMessageOfAnUnknownTypeHasNoFields) {
  const auto bytes = encoded(foreignMessage(0));
  EXPECT_EQ(TypeLibrary().typeOf(bytes.data(), bytes.size()), nullptr);
  EXPECT_FALSE(TypeLibrary().fields(bytes.data(), bytes.size()));
}

TEST(TypeLibraries, AFileThatIsNoneIsRefusedByName) {
  TypeLibrary library;
  try {
    library.load("/no/such/types.so");
    FAIL() << "loaded a file that does not exist";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("/no/such/types.so"));
  }
  Dl_info c_library{};
  ASSERT_NE(dladdr(reinterpret_cast<const void*>(&std::puts), &c_library), 0);
  EXPECT_THROW(library.load(c_library.dli_fname), std::invalid_argument);
}

}  // namespace
}  // namespace fastball::messaging
