#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "messaging/message_field.h"

namespace fastball::launch {

/// An array of numbers in few.
struct ArraySummary {
  std::size_t count = 0;
  std::size_t not_finite = 0;         ///< infinite or not a number; left out of the other three
  double min = 0, mean = 0, max = 0;  ///< 0 where no value is finite
};
/// `field`: any but text.
ArraySummary summarise(const messaging::MessageField& field);

/// One line of a message that is shown to people.
struct FieldLine {
  std::string name;   ///< "q[2]"
  std::string words;  ///< printable ASCII
  std::optional<double>
      number;  ///< what can be plotted: the value, or the mean of an array; none: a text, or not finite
};
/// The members in lines: arrays of up to kSpelledOut values one line a value, longer ones as count, minimum, mean and maximum;
/// bytes as their size, with that of the image if they are one. After `max_lines` one line says how many members are left out.
std::vector<FieldLine> fieldLines(const std::vector<messaging::MessageField>& fields,
                                  std::size_t max_lines = 500);
inline constexpr std::size_t kSpelledOut = 8;

/// The same as one object: numbers, texts and objects {"n", "min", "mean", "max"} with, if there are few, "values", and
/// {"bytes", "width", "height"}. A number that is not finite is null, and "not_finite" counts them.
nlohmann::json fieldsJson(const std::vector<messaging::MessageField>& fields,
                          std::size_t max_members = 500);

/// The text with every byte that is no printable ASCII as '?': what a terminal can show without obeying it.
std::string printable(std::string text);

}  // namespace fastball::launch
