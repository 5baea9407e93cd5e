#include "bench/row.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace fastball::bench {

nlohmann::json toJson(const std::vector<Row>& rows) {
  nlohmann::json list = nlohmann::json::array();
  for (const Row& row : rows) {
    nlohmann::json object = {{"id", row.id},     {"value", row.value},    {"unit", row.unit},
                             {"peer", row.peer}, {"peer_value", nullptr}, {"note", row.note}};
    if (row.peer_value)
      object["peer_value"] = *row.peer_value;
    list.push_back(object);
  }
  return {{"rows", list}};
}

std::string tableText(const std::vector<Row>& rows) {
  std::string text =
      "| id | value | unit | peer | peer's value | note |\n| --- | --- | --- | --- | --- | --- |\n";
  for (const Row& row : rows) {
    text +=
        fmt::format("| {} | {:.4g} | {} | {} | {} | {} |\n", row.id, row.value, row.unit, row.peer,
                    row.peer_value ? fmt::format("{:.4g}", *row.peer_value) : "", row.note);
  }
  return text;
}

}  // namespace fastball::bench
