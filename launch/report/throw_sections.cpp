#include "launch/report/throw_sections.h"

#include <fmt/format.h>

#include <cmath>

#include "launch/report/joint_shares.h"

namespace fastball::launch {
namespace {

Html number(double value, int digits) {
  return {fmt::format("{:.{}f}", value, digits)};
}

/// "+0.12, −1.10" [mm]
Html pairOf(const Eigen::Vector2d& v, bool is_signed) {
  return {is_signed ? fmt::format("{:+.2f}, {:+.2f}", 1e3 * v.x(), 1e3 * v.y())
                    : fmt::format("{:.2f}, {:.2f}", 1e3 * v.x(), 1e3 * v.y())};
}

Html verdict(const LoggedThrow& thrown, bool yes) {
  return {!isDecided(thrown) ? "unknown" : yes ? "yes" : "no"};
}

/// The true release in simulated time, or else the departure that the hand felt.
std::optional<int64_t> releaseUtime(const LoggedThrow& thrown) {
  if (thrown.truth.release_utime)
    return thrown.truth.release_utime;
  if (!thrown.hasTruth() && thrown.record.departed)
    return thrown.record.departed->utime;
  return {};
}

/// [m/s], the true one, or else that of the flight that the tracker has seen.
std::optional<double> releaseSpeed(const LoggedThrow& thrown) {
  return thrown.truth.release_speed;
}

/// "12.353" [s] and by how much the ball left later than planned [ms].
std::pair<Html, Html> releaseCells(const LoggedThrow& thrown) {
  const auto utime = releaseUtime(thrown);
  if (!utime)
    return {};
  std::pair<Html, Html> cells{number(1e-6 * static_cast<double>(*utime), 4), {}};
  const ThrowRecord& record = thrown.record;
  if (record.start && record.plan) {
    const double planned =
        1e-6 * static_cast<double>(record.start->start_utime) + record.plan->t_release;
    cells.second = {fmt::format("{:+.1f}", 1e3 * (1e-6 * static_cast<double>(*utime) - planned))};
  }
  return cells;
}

std::vector<Html> throwRow(int64_t throw_number,
                           const LoggedThrow& thrown,
                           const config::Experiment& experiment) {
  const JudgedThrow judged = judgedThrow(throw_number, thrown, experiment);
  const auto [release, late] = releaseCells(thrown);
  const auto speed = releaseSpeed(thrown);
  std::vector<Html> row{html("<a href=\"#t{0}\">{0}</a>", throw_number),
                        thrown.record.plan ? number(judged.seen.planned_speed, 2) : Html{},
                        speed ? number(*speed, 2) : Html{}, release, late};
  row.push_back(judged.seen.measured ? pairOf(judged.seen.landing, true) : Html{"not measured"});
  row.push_back(judged.seen.measured ? pairOf(judged.seen.landing_sigma, false) : Html{});
  row.push_back(thrown.truth.landing    ? pairOf(*thrown.truth.landing, true)
                : thrown.truth.finished ? Html{"never crossed"}
                                        : Html{});
  row.push_back(thrown.record.landing && thrown.record.landing->n_observations > 0
                    ? number(thrown.record.landing->residual_px, 3)
                    : Html{});
  row.push_back(verdict(thrown, judged.hit));
  row.push_back(verdict(thrown, isClean(thrown, experiment)));
  row.push_back(escaped(judged.seen.note));
  return row;
}

/// "The plan, the release": what a throw's section says before its pictures.
Html factsOf(int64_t throw_number,
             const LoggedThrow& thrown,
             const config::Experiment& experiment) {
  const JudgedThrow judged = judgedThrow(throw_number, thrown, experiment);
  std::string facts = !isDecided(thrown) ? "The log does not tell where it landed"
                      : judged.hit       ? "In the net"
                                         : "Not in the net";
  if (judged.hit && isClean(thrown, experiment))
    facts += ", the whole ball";
  facts += thrown.hasTruth() || !isDecided(thrown) ? "." : ", by what was measured.";
  if (thrown.record.plan && thrown.record.plan->status == swing_plan_t::REFUSED)
    facts += " The planner refused: " + thrown.record.plan->message + ".";
  else if (thrown.record.plan)
    facts +=
        fmt::format(" Strategy {}; planned in {:.1f} ms for {:.2f} m/s.",
                    thrown.record.plan->strategy, judged.seen.plan_ms, judged.seen.planned_speed);
  if (!judged.seen.note.empty())
    facts += " Note: " + judged.seen.note + ".";
  return html("<p>{}</p>\n", facts);
}

}  // namespace

Html throwTable(const LoggedRun& run, const config::Experiment& experiment) {
  std::vector<std::vector<Html>> rows;
  for (const auto& [throw_number, thrown] : run.throws)
    rows.push_back(throwRow(throw_number, thrown, experiment));
  return htmlTable(
      "Landings are in mm in the net's plane, right and up as seen from the robot; sigma is the "
      "standard deviation that the tracker "
      "states. Release: simulated time, and how much later than planned. A hit is a ball whose "
      "centre passes the ring; it is clean if "
      "the whole ball does.",
      {{"throw"},
       {"planned (m/s)"},
       {"true speed (m/s)"},
       {"release (s)"},
       {"late (ms)"},
       {"measured (mm)"},
       {"sigma (mm)"},
       {"true (mm)"},
       {"residual (px)"},
       {"hit", false},
       {"clean", false},
       {"note", false, true}},
      rows);
}

Html limitTable(const LoggedRun& run, const config::Experiment& experiment) {
  std::vector<HtmlColumn> columns{{"throw"}};
  const bool differential = experiment.arm.differential;
  for (const char* quantity : {"speed", "torque"}) {
    for (const char* name : {"J1", "J2", "J3", "J4", "J2+J3"}) {
      if (differential || name != std::string("J2+J3"))
        columns.push_back({fmt::format("{} {}", quantity, name)});
    }
  }
  std::vector<std::vector<Html>> rows;
  for (const auto& [throw_number, thrown] : run.throws) {
    if (thrown.record.arm.empty())
      continue;
    const JointPeaks peaks = peaksOf(thrown.record, experiment.arm);
    std::vector<Html> row{html("{}", throw_number)};
    for (const JointShares& shares : {peaks.speed, peaks.torque}) {
      for (std::size_t i = 0; i < shares.size() - (differential ? 0 : 1); ++i)
        row.push_back(number(100 * shares[i], 0));
    }
    rows.push_back(row);
  }
  if (rows.empty())
    return {};
  return htmlTable(fmt::format("Largest speeds and torques of each throw in % of the limits of {}.",
                               experiment.arm.profile),
                   columns, rows);
}

Html throwSections(const LoggedRun& run,
                   const config::Experiment& experiment,
                   const std::vector<DrawnPicture>& pictures) {
  Html sections;
  for (const auto& [throw_number, thrown] : run.throws) {
    sections += html("<section class=\"newpage\">\n<h2 id=\"t{0}\">Throw {0}</h2>\n", throw_number);
    sections += factsOf(throw_number, thrown, experiment);
    for (const char* kind : {"throw", "motion", "release", "fingers", "residuals"}) {
      for (const DrawnPicture& picture : pictures) {
        if (picture.task.number != throw_number || picture.task.kind != kind)
          continue;
        sections += picture.failure.empty()
                        ? htmlPicture(picture.task.name(), escaped(picture.caption),
                                      picture.task.with_numbers)
                        : html("<p>No picture \"{}\": {}.</p>\n", kind, picture.failure);
      }
    }
    sections += {"</section>\n"};
  }
  return sections;
}

}  // namespace fastball::launch
