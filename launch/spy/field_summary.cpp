#include "launch/spy/field_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace fastball::launch {
namespace {

using Field = messaging::MessageField;
using Fields = std::vector<Field>;

constexpr std::size_t kLongestText = 200;

bool isBytes(const Field& field) {
  return field.kind() == Field::Kind::kByte && field.sizes().size() == 1;
}

/// [px] width and height that stand beside the bytes of an image.
struct ImageSize {
  int64_t width, height;
};

std::optional<int64_t> sibling(const Fields& fields, const Field& of, const std::string& name) {
  const std::size_t dot = of.name().rfind('.');
  const std::string full = dot == std::string::npos ? name : of.name().substr(0, dot + 1) + name;
  for (const Field& field : fields) {
    if (field.name() == full && field.sizes().empty() && !field.isText() && !field.isReal())
      return field.integer(0);
  }
  return std::nullopt;
}

std::optional<ImageSize> imageSize(const Fields& fields, const Field& bytes) {
  const auto width = sibling(fields, bytes, "width");
  const auto height = sibling(fields, bytes, "height");
  if (!width || !height)
    return std::nullopt;
  return ImageSize{*width, *height};
}

nlohmann::json numberJson(const Field& field, std::size_t i) {
  if (field.kind() == Field::Kind::kBoolean)
    return field.integer(i) != 0;
  if (!field.isReal())
    return field.integer(i);
  const double value = field.number(i);
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
}

nlohmann::json valueJson(const Field& field, std::size_t i) {
  return field.isText() ? nlohmann::json(field.text(i).substr(0, kLongestText))
                        : numberJson(field, i);
}

nlohmann::json bytesJson(const Fields& fields, const Field& field) {
  nlohmann::json object{{"bytes", field.count()}};
  if (const auto image = imageSize(fields, field)) {
    object["width"] = image->width;
    object["height"] = image->height;
  }
  return object;
}

nlohmann::json arrayJson(const Field& field) {
  nlohmann::json object{{"n", field.count()}};
  if (!field.isText()) {
    const ArraySummary summary = summarise(field);
    const bool any = summary.count > summary.not_finite;
    object["min"] = any ? nlohmann::json(summary.min) : nlohmann::json();
    object["mean"] = any ? nlohmann::json(summary.mean) : nlohmann::json();
    object["max"] = any ? nlohmann::json(summary.max) : nlohmann::json();
    if (summary.not_finite > 0)
      object["not_finite"] = summary.not_finite;
  }
  if (field.count() <= kSpelledOut) {
    object["values"] = nlohmann::json::array();
    for (std::size_t i = 0; i < field.count(); ++i)
      object["values"].push_back(valueJson(field, i));
  }
  return object;
}

FieldLine valueLine(const Field& field, std::size_t i) {
  FieldLine line{field.elementName(i), "", std::nullopt};
  if (field.isText()) {
    line.words = '"' + printable(field.text(i).substr(0, kLongestText)) + '"';
    return line;
  }
  line.words = field.kind() == Field::Kind::kBoolean ? (field.integer(i) != 0 ? "true" : "false")
                                                     : field.text(i);
  if (std::isfinite(field.number(i)))
    line.number = field.number(i);
  return line;
}

FieldLine arrayLine(const Field& field) {
  const std::string name = field.name() + "[]";
  if (field.isText())
    return {name, fmt::format("{} texts", field.count()), std::nullopt};
  const ArraySummary summary = summarise(field);
  const bool any = summary.count > summary.not_finite;
  std::string words = fmt::format("n {}", summary.count);
  if (any)
    words += fmt::format("  min {:.6g}  mean {:.6g}  max {:.6g}", summary.min, summary.mean,
                         summary.max);
  if (summary.not_finite > 0)
    words += fmt::format("  not finite {}", summary.not_finite);
  return {name, words, any ? std::optional(summary.mean) : std::nullopt};
}

FieldLine bytesLine(const Fields& fields, const Field& field) {
  std::string words = fmt::format("{} bytes", field.count());
  if (const auto image = imageSize(fields, field))
    words += fmt::format(", {} x {}", image->width, image->height);
  return {field.name(), words, std::nullopt};
}

}  // namespace

ArraySummary summarise(const Field& field) {
  ArraySummary summary;
  summary.count = field.count();
  for (std::size_t i = 0; i < field.count(); ++i) {
    const double value = field.number(i);
    if (!std::isfinite(value)) {
      ++summary.not_finite;
    } else if (i == summary.not_finite) {
      summary.min = summary.max = value;
    } else {
      summary.min = std::min(summary.min, value);
      summary.max = std::max(summary.max, value);
    }
  }
  // Divided before they are added: their sum may be beyond the largest number.
  const auto finite = static_cast<double>(summary.count - summary.not_finite);
  for (std::size_t i = 0; i < field.count(); ++i) {
    if (std::isfinite(field.number(i)))
      summary.mean += field.number(i) / finite;
  }
  summary.mean = std::clamp(summary.mean, summary.min, summary.max);
  return summary;
}

std::vector<FieldLine> fieldLines(const Fields& fields, std::size_t max_lines) {
  std::vector<FieldLine> lines;
  for (std::size_t f = 0; f < fields.size(); ++f) {
    const Field& field = fields[f];
    if (lines.size() >= max_lines) {
      lines.push_back({"...", fmt::format("{} more members", fields.size() - f), std::nullopt});
      break;
    }
    if (isBytes(field)) {
      lines.push_back(bytesLine(fields, field));
    } else if (field.count() > kSpelledOut || field.count() == 0) {
      lines.push_back(arrayLine(field));
    } else {
      for (std::size_t i = 0; i < field.count(); ++i)
        lines.push_back(valueLine(field, i));
    }
  }
  return lines;
}

nlohmann::json fieldsJson(const Fields& fields, std::size_t max_members) {
  nlohmann::json object = nlohmann::json::object();
  for (std::size_t i = 0; i < std::min(fields.size(), max_members); ++i) {
    const Field& field = fields[i];
    if (isBytes(field))
      object[field.name()] = bytesJson(fields, field);
    else
      object[field.name()] = field.sizes().empty() ? valueJson(field, 0) : arrayJson(field);
  }
  if (fields.size() > max_members)
    object["..."] = fields.size() - max_members;
  return object;
}

std::string printable(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

}  // namespace fastball::launch
