#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fastball::messaging {

/// One member of a message whose type is known at run time only: a number, a text, or an array of them. It looks into the encoded
/// message and lives no longer than those bytes.
class MessageField {
 public:
  enum class Kind { kInt8, kInt16, kInt32, kInt64, kByte, kFloat, kDouble, kBoolean, kText };

  MessageField(std::string name, Kind kind, std::vector<int64_t> sizes);

  /// Where the member stands in its message: "q", "pose.position", "joints[2].torque".
  const std::string& name() const { return name_; }
  Kind kind() const { return kind_; }
  /// The length of each dimension, none for a single value.
  const std::vector<int64_t>& sizes() const { return sizes_; }
  /// How many values: 1 for a single one.
  std::size_t count() const { return count_; }
  bool isText() const { return kind_ == Kind::kText; }
  bool isReal() const { return kind_ == Kind::kFloat || kind_ == Kind::kDouble; }

  /// "q[2]": the name with the indices of value `i`, counted with the last index running fastest.
  std::string elementName(std::size_t i) const;
  /// Which value `element_name` is, or nothing if it is none of this field.
  std::optional<std::size_t> indexOf(const std::string& element_name) const;

  /// The encoded bytes of value `i` (big endian; a text without its length and final zero). Equal bytes are equal values, also
  /// where they are not a number. `i` < count().
  std::string_view bytes(std::size_t i) const;
  /// Value `i` of any kind but text; an integer beyond 2^53 is rounded.
  double number(std::size_t i) const;
  /// Value `i` of any kind but text and real.
  int64_t integer(std::size_t i) const;
  /// Value `i` in words: the shortest digits that give the same number back, or the text itself.
  std::string text(std::size_t i) const;

 private:
  friend class MessageWalk;
  std::string name_;
  Kind kind_;
  std::vector<int64_t> sizes_;
  std::size_t count_ = 1;
  const char* data_ = nullptr;  // of everything but text
  std::vector<std::string_view> texts_;
};

/// Bytes that one value takes when encoded. Not for text.
std::size_t encodedBytes(MessageField::Kind kind);

}  // namespace fastball::messaging
