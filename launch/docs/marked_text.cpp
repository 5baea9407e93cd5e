#include "launch/docs/marked_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <stdexcept>

namespace fastball::launch {

std::string withBlock(const std::string& page, const std::string& name, const std::string& block) {
  const std::string begin = fmt::format("<!-- {} -->\n", name),
                    end = fmt::format("<!-- /{} -->\n", name);
  const std::size_t from = page.find(begin);
  const std::size_t to = from == std::string::npos ? from : page.find(end, from);
  if (to == std::string::npos)
    throw std::runtime_error(
        fmt::format("the page has no lines '<!-- {0} -->' and '<!-- /{0} -->'", name));
  return page.substr(0, from + begin.size()) + block + page.substr(to);
}

std::string withRow(const std::string& page,
                    const std::string& id,
                    const std::string& row,
                    bool& found) {
  const std::string start = fmt::format("| `{}` |", id);
  std::string changed;
  found = false;
  for (std::size_t at = 0; at < page.size();) {
    const std::size_t end = std::min(page.find('\n', at), page.size());
    const bool is_row = page.compare(at, start.size(), start) == 0;
    changed += (is_row ? row : page.substr(at, end - at)) + (end < page.size() ? "\n" : "");
    found = found || is_row;
    at = end + 1;
  }
  return changed;
}

std::string withBenchmark(const std::string& page, const nlohmann::json& row, bool& found) {
  const std::string id = row.at("id");
  const nlohmann::json& peer = row.at("peer_value");
  const std::string line =
      fmt::format("| `{}` | {:.4g} | {} | {} | {} | {} |", id, row.at("value").get<double>(),
                  row.at("unit").get<std::string>(), row.at("peer").get<std::string>(),
                  peer.is_null() ? "" : fmt::format("{:.4g}", peer.get<double>()),
                  row.at("note").get<std::string>());
  return withRow(page, id, line, found);
}

}  // namespace fastball::launch
