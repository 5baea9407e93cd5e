#include "launch/report/run_page.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <set>

#include "launch/campaign/statistics.h"
#include "launch/html.h"
#include "launch/report/loop_times.h"
#include "launch/report/throw_sections.h"

namespace fastball::launch {
namespace {

std::string date(int64_t utime) {
  const std::time_t seconds = utime / 1'000'000;
  std::tm local{};
  localtime_r(&seconds, &local);
  return fmt::format("{:%Y-%m-%d %H:%M:%S %z}", local);
}

template <class Range, class Text>
std::string joined(const Range& all, const Text& text) {
  std::set<std::string> words;
  for (const auto& one : all) {
    if (const std::string word = text(one); !word.empty())
      words.insert(word);
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string strategiesOf(const LoggedRun& run) {
  return joined(run.throws, [](const auto& entry) {
    const ThrowRecord& record = entry.second.record;
    return record.request ? record.request->strategy : "";
  });
}

/// "10 of 10 in the net (95 % interval by Wilson: 72.2 to 100.0 %), 10 clean"
std::string hitWords(const LoggedRun& run, const config::Experiment& experiment) {
  Rate hits;
  int cleans = 0;
  bool any_truth = false;
  for (const auto& [number, thrown] : run.throws) {
    if (!isDecided(thrown))
      continue;
    ++hits.of;
    hits.count += judgedThrow(number, thrown, experiment).hit;
    cleans += isClean(thrown, experiment);
    any_truth = any_truth || thrown.hasTruth();
  }
  const auto unknown = static_cast<int>(run.throws.size()) - hits.of;
  const std::string rest = unknown > 0 ? fmt::format("; of {} the log does not tell", unknown) : "";
  if (hits.of == 0)
    return "the log does not tell where they landed";
  return fmt::format(
      "{} of {} in the net{} (95 % interval by Wilson: {:.1f} to {:.1f} %), {} clean{}", hits.count,
      hits.of, any_truth ? "" : " by what was measured", 100 * hits.low(), 100 * hits.high(),
      cleans, rest);
}

Html head(const LoggedRun& run, const config::Experiment& experiment) {
  const std::string name = std::filesystem::path(run.path).filename().string();
  Html text = html("<h1>Throws of {}</h1>\n", name);
  if (run.throws.empty())
    return text += html("<p class=\"lead\">No throw.</p>\n");
  return text += html("<p class=\"lead\">{} throw{} with strategy {}, arm {}: {}.</p>\n",
                      run.throws.size(), run.throws.size() == 1 ? "" : "s", strategiesOf(run),
                      experiment.arm.profile, hitWords(run, experiment));
}

Html navigation(const LoggedRun& run) {
  Html text{"<nav><a href=\"#net\">Landings</a>\n<a href=\"#run\">What ran</a>"};
  for (const auto& [number, thrown] : run.throws)
    text += html("\n<a href=\"#t{0}\">Throw {0}</a>", number);
  text += {"\n<a href=\"#loops-and-losses\">Loops and losses</a></nav>\n"};
  return text;
}

Html missingSection(const Missing& missing) {
  if (missing.faults.empty() && missing.notes.empty())
    return {};
  Html text{missing.faults.empty()
                ? "<section>\n<h2>What this log does not hold</h2>\n<ul>\n"
                : "<section class=\"missing\">\n<h2>What is missing</h2>\n<ul>\n"};
  for (const auto* sentences : {&missing.faults, &missing.notes}) {
    for (const std::string& sentence : *sentences)
      text += html("<li>{}</li>\n", sentence);
  }
  text += {"</ul>\n</section>\n"};
  return text;
}

Html factTable(const std::vector<std::pair<std::string, Html>>& facts) {
  Html table{"<div class=\"wide\"><table>\n"};
  for (const auto& [name, value] : facts) {
    if (!value.code.empty())
      table += html("<tr><th scope=\"row\">{}</th><td class=\"p\">{}</td></tr>\n", name, value);
  }
  table += {"</table></div>\n"};
  return table;
}

std::string versionOf(const LoggedRun& run) {
  if (run.record && !run.record->version.empty())
    return run.record->version;
  return joined(run.processes, [](const LoggedProcess& p) { return p.last().version; });
}

std::string targetWords(const LoggedRun& run, const config::Experiment& experiment) {
  return joined(run.throws, [&](const auto& entry) {
    const model::Target target = targetOf(entry.second, experiment);
    return fmt::format("ring of radius {:.0f} mm at ({:.2f}, {:.2f}, {:.2f}) m",
                       1e3 * target.radius, target.p_WTarget.x(), target.p_WTarget.y(),
                       target.p_WTarget.z());
  });
}

Html whatRan(const LoggedRun& run,
             const config::Experiment& experiment,
             const std::string& experiment_words) {
  std::vector<std::pair<std::string, Html>> facts{{"Version", escaped(versionOf(run))}};
  if (run.record) {
    facts.insert(facts.end(), {{"Command", html("<code>{}</code>", run.record->command_line)},
                               {"Seed", html("{}", run.record->seed)},
                               {"Started on", escaped(run.record->host)}});
  }
  facts.insert(facts.end(),
               {{"Strategy", escaped(strategiesOf(run))},
                {"Experiment", escaped(experiment_words)},
                {"Arm", escaped(experiment.arm.profile)},
                {"Ball", html("radius {:.0f} mm, mass {:.0f} g", 1e3 * experiment.ball.radius,
                              1e3 * experiment.ball.mass)},
                {"Target", escaped(targetWords(run, experiment))},
                {"Log", html("<code>{}</code>", run.path)}});
  if (run.summary) {
    const logger::LogSummary& log = *run.summary;
    facts.insert(
        facts.end(),
        {{"Recorded", html("{} to {}, {:.1f} s", date(log.first_utime), date(log.last_utime),
                           1e-6 * static_cast<double>(log.last_utime - log.first_utime))},
         {"Size", html("{} messages on {} channels, {:.1f} MB", log.messages, log.channels.size(),
                       1e-6 * static_cast<double>(log.file_bytes))}});
  }
  if (!run.stops.empty())
    facts.emplace_back("ESTOP", escaped(fmt::format("{}", fmt::join(run.stops, "; "))));
  return html("<h2 id=\"run\">What ran</h2>\n{}", factTable(facts));
}

Html processTable(const LoggedRun& run) {
  if (run.processes.empty())
    return {};
  std::vector<std::vector<Html>> rows;
  for (const LoggedProcess& process : run.processes) {
    const heartbeat_t& last = process.last();
    const LoopTimes loops = loopTimesOf(process);
    std::vector<Html> row{
        escaped(last.name),        escaped(last.host),    html("{}", last.pid),
        escaped(last.version),     escaped(last.state),   html("{}", process.heartbeats.size()),
        html("{}", last.received), html("{}", last.lost), html("{}", last.invalid)};
    for (const double us : {loops.median_mean_us, loops.worst_us})
      row.push_back(loops.beats > 0 ? html("{:.0f}", us) : Html{});
    row.push_back(escaped(last.detail));
    rows.push_back(row);
  }
  return htmlTable("Processes, by their HEARTBEATs: as they were at the last one.",
                   {{"process", false},
                    {"host", false},
                    {"pid"},
                    {"version", false},
                    {"state", false},
                    {"heartbeats"},
                    {"received"},
                    {"lost"},
                    {"refused"},
                    {"loop, mean (µs)"},
                    {"longest (µs)"},
                    {"says", false, true}},
                   rows);
}

Html channelTable(const LoggedRun& run) {
  if (!run.summary)
    return {};
  std::vector<std::vector<Html>> rows;
  for (const auto& [name, channel] : run.summary->channels) {
    rows.push_back({escaped(name), escaped(channel.type), html("{}", channel.messages),
                    html("{:.1f}", channel.rate()),
                    html("{:.0f}", 1e-3 * static_cast<double>(channel.bytes)),
                    html("{:.0f}", 1e-3 * static_cast<double>(channel.longest_pause_us)),
                    html("{}", channel.missing), html("{}", channel.undecodable)});
  }
  return htmlTable(
      "Channels of the log. Rates and pauses are of wall time; lost are messages whose numbers are "
      "missing (0 also where several say "
      "a channel, each with numbers of its own).",
      {{"channel", false},
       {"type", false},
       {"messages"},
       {"rate (1/s)"},
       {"data (kB)"},
       {"longest pause (ms)"},
       {"lost"},
       {"no decoding"}},
      rows);
}

Html pictureOfRun(const std::vector<DrawnPicture>& pictures, const std::string& kind) {
  for (const DrawnPicture& picture : pictures) {
    if (picture.task.kind == kind && picture.failure.empty())
      return htmlPicture(picture.task.name(), escaped(picture.caption), picture.task.with_numbers);
  }
  return {};
}

}  // namespace

std::string runPage(const LoggedRun& run,
                    const config::Experiment& experiment,
                    const RunPageParts& parts) {
  Html body = head(run, experiment);
  body += navigation(run);
  body += missingSection(parts.missing);
  body += {"<h2 id=\"net\">Landings</h2>\n"};
  body += pictureOfRun(parts.pictures, "landings");
  if (!run.throws.empty())
    body += throwTable(run, experiment);
  body += whatRan(run, experiment, parts.experiment);
  body += processTable(run);
  body += limitTable(run, experiment);
  body += throwSections(run, experiment, parts.pictures);
  body += {"<section class=\"newpage\">\n<h2 id=\"loops-and-losses\">Loops and losses</h2>\n"};
  body += pictureOfRun(parts.pictures, "loops");
  body += channelTable(run);
  body += {"</section>\n"};
  return htmlPage("Report of " + std::filesystem::path(run.path).filename().string(), body);
}

std::string throwsCsv(const LoggedRun& run, const config::Experiment& experiment) {
  std::string csv =
      "throw,strategy,planned_speed_mps,true_release_speed_mps,true_release_utime,departure_utime,"
      "measured_right_mm,measured_up_mm,sigma_right_mm,sigma_up_mm,observations,residual_px,"
      "true_right_mm,true_up_mm,hit,clean\n";
  for (const auto& [number, thrown] : run.throws) {
    const JudgedThrow judged = judgedThrow(number, thrown, experiment);
    const ThrowRecord& record = thrown.record;
    csv += fmt::format("{}", number);
    csv += record.plan ? fmt::format(",{},{:.4f}", record.plan->strategy, judged.seen.planned_speed)
                       : ",,";
    csv += thrown.truth.release_speed ? fmt::format(",{:.4f}", *thrown.truth.release_speed) : ",";
    csv += thrown.truth.release_utime ? fmt::format(",{}", *thrown.truth.release_utime) : ",";
    csv += record.departed ? fmt::format(",{}", record.departed->utime) : ",";
    csv +=
        judged.seen.measured
            ? fmt::format(",{:.3f},{:.3f},{:.3f},{:.3f},{},{:.3f}", 1e3 * judged.seen.landing.x(),
                          1e3 * judged.seen.landing.y(), 1e3 * judged.seen.landing_sigma.x(),
                          1e3 * judged.seen.landing_sigma.y(), record.landing->n_observations,
                          record.landing->residual_px)
            : ",,,,,,";
    csv += thrown.truth.landing ? fmt::format(",{:.3f},{:.3f}", 1e3 * thrown.truth.landing->x(),
                                              1e3 * thrown.truth.landing->y())
                                : ",,";
    csv += isDecided(thrown) ? fmt::format(",{:d},{:d}\n", judged.hit, isClean(thrown, experiment))
                             : ",,\n";
  }
  return csv;
}

}  // namespace fastball::launch
