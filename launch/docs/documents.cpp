#include "launch/docs/documents.h"

#include <fmt/format.h>

#include <boost/process.hpp>
#include <boost/process/search_path.hpp>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <stdexcept>

#include "launch/docs/marked_text.h"
#include "launch/docs/message_reference.h"
#include "launch/processes.h"

namespace fastball::launch {
namespace {

namespace fs = std::filesystem;
namespace bp = boost::process;

std::string readText(const fs::path& path) {
  std::ifstream file(path);
  if (!file)
    throw std::runtime_error(fmt::format("{}: cannot be read", path.string()));
  return {std::istreambuf_iterator<char>(file), {}};
}

void writeText(const fs::path& path, const std::string& text) {
  std::ofstream file(path);
  if (!(file << text).flush())
    throw std::runtime_error(fmt::format("{}: cannot be written", path.string()));
}

/// This program with other arguments, in a folder. @return what it printed.
std::string fastball(const std::vector<std::string>& arguments, const fs::path& folder = ".") {
  bp::ipstream output;
  bp::child child(programFolder() + "/fastball", bp::args(arguments), bp::std_out > output,
                  bp::start_dir(folder.string()));
  std::string text{std::istreambuf_iterator<char>(output), {}};
  child.wait();
  if (child.exit_code() != 0)
    throw std::runtime_error(
        fmt::format("'fastball {}' ended with status {}", arguments.front(), child.exit_code()));
  return text;
}

void makeMessages(const DocumentOptions& options) {
  writeText(options.tree / "docs/messages.md", messageReference(options.tree / "lcmtypes"));
}

void makeThrow(const DocumentOptions& options) {
  const fs::path work = options.campaigns / "throw";
  fs::remove_all(work);
  fs::create_directories(work);
  const std::string said = fastball({"run", "--seed", "1"}, work);
  const std::size_t log = said.find("\nlog ") + 5;  // its second line
  fastball({"report", said.substr(log, said.find('\n', log) - log), "-o", "report"}, work);
  fs::copy_file(work / "report/throw-1.png", options.tree / "docs/throw.png",
                fs::copy_options::overwrite_existing);
  const fs::path readme = options.tree / "README.md";
  writeText(readme, withBlock(readText(readme), "run",
                              "```\n$ ./fastball run --seed 1\n" + said + "```\n"));
}

void makeBenchmarks(const DocumentOptions& options) {
  const fs::path path = options.tree / "docs/benchmarks.md";
  const fs::path measured = options.campaigns / "benchmarks.json";
  fs::create_directories(options.campaigns);
  fs::remove(measured);
  std::string page = readText(path), missing;
  try {
    fastball({"bench", "--json", measured.string()});
  } catch (const std::runtime_error& e) {
    missing = e.what();  // a row that this machine cannot measure: the others still count
  }
  const nlohmann::json results = nlohmann::json::parse(readText(measured));
  for (const nlohmann::json& row : results.at("rows")) {
    bool found = false;
    page = withBenchmark(page, row, found);
    if (!found)
      missing +=
          fmt::format("{}: its tables have no row for {}; ", path.string(), row.at("id").dump());
  }
  writeText(path, page);
  if (!missing.empty())
    throw std::runtime_error(missing);
}

/// A campaign, and which of its pictures docs/robustness.md shows under which name.
struct DocumentCampaign {
  std::string block;  ///< of docs/robustness.md whose table its cases are; several may share one
  std::vector<std::string> arguments;
  int throws = 0;
  std::vector<std::pair<std::string, std::string>> pictures;
  std::string (*table)(
      const fs::path& report);  ///< Markdown, from what `fastball report` has written
};

using Cells = std::vector<std::string>;

/// The lines of a CSV file of numbers and words, without its head.
std::vector<Cells> linesOf(const fs::path& path) {
  std::istringstream text(readText(path));
  std::vector<Cells> lines;
  for (std::string line; std::getline(text, line);) {
    Cells cells;
    std::istringstream rest(line);
    for (std::string cell; std::getline(rest, cell, ',');)
      cells.push_back(cell);
    lines.push_back(std::move(cells));
  }
  if (lines.empty())
    throw std::runtime_error(path.string() + " is empty");
  lines.erase(lines.begin());
  return lines;
}

std::string rounded(const std::string& number, const char* format) {
  return number.empty() ? "" : fmt::format(fmt::runtime(format), std::stod(number));
}

std::string causesTable(const fs::path& report) {
  std::string table =
      "| error | throws off, alone | hit % off | gain (points), 95 % interval | hit % alone | mean "
      "right, up alone (mm) | sd right, up alone (mm) |\n| --- | --- | --: | --- | --: | --- | --- "
      "|\n";
  for (const Cells& c : linesOf(report / "causes-paper.csv")) {
    const bool all = c.at(5).empty();
    table += fmt::format(
        "| {} | {} | {} | {} | {} | {}, {} | {}, {} |\n", all ? "all of them" : "`" + c.at(0) + "`",
        all ? c.at(1) : c.at(1) + ", " + c.at(8), rounded(c.at(2), "{:.1f}"),
        all ? ""
            : fmt::format("{}, {} to {}", rounded(c.at(5), "{:+.1f}"), rounded(c.at(6), "{:+.0f}"),
                          rounded(c.at(7), "{:+.0f}")),
        rounded(c.at(9), "{:.1f}"), rounded(c.at(12), "{:+.0f}"), rounded(c.at(13), "{:+.0f}"),
        rounded(c.at(14), "{:.1f}"), rounded(c.at(15), "{:.1f}"));
  }
  return table;
}

std::string studyTable(const fs::path& report) {
  const std::vector<Cells> lines = linesOf(report / "study.csv");
  std::string table = fmt::format(
      "| {} | strategy | throws | hit % | 95 % interval | clean % | sd right, up (mm) |\n"
      "| --: | --- | --: | --: | --- | --: | --- |\n",
      lines.at(0).at(0));
  for (const Cells& c : lines) {
    table += fmt::format("| {} | `{}` | {} | {} | {} to {} | {} | {}, {} |\n", c.at(1), c.at(2),
                         c.at(3), rounded(c.at(4), "{:.1f}"), rounded(c.at(5), "{:.1f}"),
                         rounded(c.at(6), "{:.1f}"), rounded(c.at(7), "{:.1f}"),
                         rounded(c.at(10), "{:.1f}"), rounded(c.at(11), "{:.1f}"));
  }
  return table;
}

/// A line for each error: hits and scatter at each of its sizes.
std::string errorsTable(const fs::path& report) {
  std::string head, rule, rows, error;
  std::set<std::string> sizes;
  for (const Cells& c : linesOf(report / "study.csv")) {
    if (c.at(0) != error) {
      error = c.at(0);
      rows += fmt::format("{}| `{}` |", rows.empty() ? "" : "\n", error.substr(0, error.find(' ')));
    }
    if (sizes.insert(c.at(1)).second) {
      head += fmt::format(" x {} |", c.at(1));
      rule += " --- |";
    }
    rows += fmt::format(" {} % ({}, {}) |", rounded(c.at(4), "{:.0f}"), rounded(c.at(10), "{:.0f}"),
                        rounded(c.at(11), "{:.0f}"));
  }
  return "| error |" + head + "\n| --- |" + rule + "\n" + rows + "\n";
}

/// The first table of the page.
std::string strategiesTable(const fs::path& report) {
  std::string table;
  std::istringstream lines(readText(report / "report.md"));
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("| ", 0) == 0)
      table += line + "\n";
    else if (!table.empty())
      break;
  }
  return table;
}

std::vector<DocumentCampaign> documentCampaigns(const DocumentOptions& options) {
  const int all = options.throws, some = options.study_throws;
  const std::string best = "robust,adaptive";
  std::vector<DocumentCampaign> campaigns = {
      {"48v",
       {"--arm", "wam4-48v"},
       all,
       {{"landings", "landings-48v"}, {"throw-numbers", "throw-numbers-48v"}},
       strategiesTable},
      {"90v", {"--arm", "wam4-90v"}, all, {{"landings", "landings-90v"}}, strategiesTable},
      {"causes",
       {"--study", "causes", "--strategy", "paper", "--set-up-throws", "2"},
       some,
       {{"causes-paper", "causes-paper"}},
       causesTable}};
  for (const char* study : {"scale", "distance", "height", "azimuth", "ball", "speed"})
    campaigns.push_back(
        {study, {"--study", study, "--strategy", best}, some, {{"study", study}}, studyTable});
  campaigns.push_back({"errors",
                       {"--study", "errors", "--strategy", "adaptive"},
                       some,
                       {{"study", "errors"}},
                       errorsTable});
  return campaigns;
}

void makeRobustness(const DocumentOptions& options) {
  const fs::path path = options.tree / "docs/robustness.md";
  for (const DocumentCampaign& campaign : documentCampaigns(options)) {
    const fs::path folder = options.campaigns / campaign.block, report = folder / "report";
    std::vector<std::string> arguments{"campaign", "--folder", folder.string(), "--throws",
                                       std::to_string(campaign.throws)};
    arguments.insert(arguments.end(), campaign.arguments.begin(), campaign.arguments.end());
    fastball(arguments);
    fastball({"report", folder.string(), "-o", report.string()});
    for (const auto& [from, to] : campaign.pictures)
      fs::copy_file(report / (from + ".png"), options.tree / "docs/robustness" / (to + ".png"),
                    fs::copy_options::overwrite_existing);
    writeText(path, withBlock(readText(path), campaign.block, campaign.table(report)));
  }
}

}  // namespace

const std::vector<DocumentPart>& documentParts() {
  static const std::vector<DocumentPart> parts = {
      {"messages", "docs/messages.md from lcmtypes/", makeMessages},
      {"throw", "three throws: the lines in README.md and docs/throw.png", makeThrow},
      {"benchmarks", "the tables of docs/benchmarks.md, on a quiet machine", makeBenchmarks},
      {"robustness", "campaigns: tables and pictures of docs/robustness.md; hours",
       makeRobustness}};
  return parts;
}

}  // namespace fastball::launch
