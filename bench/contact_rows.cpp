#include "bench/contact_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/contact_comparison.h"
#include "bench/felt_throws.h"

namespace fastball::bench {
namespace {

constexpr double kStep = 1e-4;  // [s], the simulator's
constexpr double kMilli = 1e3;

/// The worst of all cases at the simulator's step and at half of it.
struct Worst {
  ContactError at_step, at_half;
  std::size_t cases = 0;
};

void worsen(ContactError& worst, const ContactError& error) {
  worst.rolling = std::max(worst.rolling, error.rolling);
  worst.force = std::max(worst.force, error.force);
  worst.release = std::max(worst.release, error.release);
}

/// Measured once in a run: the three rows are of the same throws.
const Worst& worst() {
  static const Worst found = [] {
    const std::string path = config::defaultExperimentPath();
    const config::Experiment experiment = config::loadExperiment(path);
    const sim_bullet::SimulationSettings settings = sim_bullet::loadSimulationSettings(path);
    Worst result;
    for (const ContactCase& contact : contactCases(experiment)) {
      worsen(result.at_step, elasticError(experiment, settings, contact, kStep));
      worsen(result.at_half, elasticError(experiment, settings, contact, kStep / 2));
      ++result.cases;
    }
    return result;
  }();
  return found;
}

Row row(const std::string& id, double ContactError::*error, double scale, const char* unit) {
  return {id,
          scale * (worst().at_step.*error),
          unit,
          "half the step",
          scale * (worst().at_half.*error),
          fmt::format("simulator at 0.1 ms against an integration with error control, worst of {} "
                      "throws, E 2e4 to 1e7 Pa",
                      worst().cases)};
}

Row departureRow(const char* id) {
  constexpr int kThrows = 100;  // of each mode
  const std::string path = config::defaultExperimentPath();
  double felt = 0, last_touch = 0;
  for (const char* strategy : {"paper", "robust"}) {
    const DepartureError error = departureError(FeltThrows(path, strategy), unknownBall(), kThrows);
    felt += error.felt * error.felt / 2;
    last_touch += error.last_touch * error.last_touch / 2;
  }
  return {id,
          kMilli * std::sqrt(felt),
          "ms",
          "last state with a touch",
          kMilli * std::sqrt(last_touch),
          fmt::format("departure as the fingers feel it against the simulator's, rms of {} throws "
                      "with E, mu, mass, offset and sensor noise drawn, abrupt and sync_retreat",
                      2 * kThrows)};
}

}  // namespace

std::vector<Benchmark> contactBenchmarks() {
  const char* const rolling = "contact.rolling_error_mm";
  const char* const force = "contact.force_error_n";
  const char* const release = "contact.release_error_ms";
  const char* const departure = "contact.departure_rms_ms";
  return {{rolling, [=] { return row(rolling, &ContactError::rolling, kMilli, "mm"); }},
          {force, [=] { return row(force, &ContactError::force, 1, "N"); }},
          {release, [=] { return row(release, &ContactError::release, kMilli, "ms"); }},
          {departure, [=] { return departureRow(departure); }}};
}

}  // namespace fastball::bench
