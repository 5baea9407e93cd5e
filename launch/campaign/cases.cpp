#include "launch/campaign/cases.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>

#include "launch/campaign/region.h"

namespace fastball::launch {
namespace {

namespace fs = std::filesystem;

constexpr double kPi = 3.14159265358979323846;
constexpr int kPlaces = 50;              // of study region
constexpr double kNominalModulus = 5e5;  // [Pa], only to name a case: the files have factors

using Edit = std::function<void(YAML::Node&)>;

/// A variant of both files, and how it is called.
struct Variant {
  std::string name;
  Edit experiment, uncertainty;
  std::optional<Quantity> quantity = {};
};

YAML::Node load(const std::string& path) {
  try {
    return YAML::LoadFile(path);
  } catch (const YAML::Exception& e) {
    throw std::invalid_argument(fmt::format("{}: {}", path, e.what()));
  }
}

std::string fileName(std::string name) {
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.' && c != '-')
      c = '_';
  }
  return name;
}

/// Files named in an experiment are relative to it.
void makePathsAbsolute(YAML::Node& experiment, const std::string& path) {
  for (const char* key : {"arm", "hand", "ball"}) {
    if (experiment[key])
      experiment[key] = (fs::path(path).parent_path() / experiment[key].as<std::string>())
                            .lexically_normal()
                            .string();
  }
}

std::string written(const YAML::Node& node,
                    const std::string& origin,
                    const std::string& folder,
                    const std::string& name) {
  const fs::path path = fs::path(folder) / (fileName(name) + ".yaml");
  YAML::Emitter emitter;
  emitter << YAML::Comment(fmt::format("made from {}: {}", origin, name)) << node;
  std::ofstream(path) << emitter.c_str() << '\n';
  return fs::absolute(path).lexically_normal().string();
}

/// Names of all errors of an uncertainty file, each once.
std::vector<std::string> errorsIn(const std::string& path) {
  const YAML::Node file = load(path);
  std::vector<std::string> names;
  for (const char* part : {"set_up", "throw"}) {
    for (const auto& entry : file[part]) {
      const auto name = entry.first.as<std::string>();
      if (std::find(names.begin(), names.end(), name) == names.end())
        names.push_back(name);
    }
  }
  return names;
}

/// Multiplies the size of the errors for which `concerns` is true.
Edit times(double factor, const std::function<bool(const std::string&)>& concerns) {
  return [=](YAML::Node& file) {
    for (const char* part : {"set_up", "throw"}) {
      for (auto entry : file[part]) {
        if (!concerns(entry.first.as<std::string>()))
          continue;
        YAML::Node error = entry.second;
        error["times"] = factor * error["times"].as<double>(1.0);
      }
    }
  };
}

Edit target(const std::function<void(double& distance, double& height, double& azimuth)>& move) {
  return [=](YAML::Node& file) {
    YAML::Node position = file["target"]["position"];
    const double x = position[0].as<double>(), y = position[1].as<double>();
    double distance = std::hypot(x, y), height = position[2].as<double>(),
           azimuth = std::atan2(y, x);
    move(distance, height, azimuth);
    position[0] = distance * std::cos(azimuth);
    position[1] = distance * std::sin(azimuth);
    position[2] = height;
    file["target"]["normal"] = std::vector<double>{-std::cos(azimuth), -std::sin(azimuth), 0};
  };
}

std::vector<Variant> errorVariants(const std::string& study, const std::string& uncertainty) {
  std::vector<Variant> variants;
  for (const std::string& error : errorsIn(uncertainty)) {
    const auto is = [error](const std::string& name) { return name == error; };
    const auto others = [error](const std::string& name) { return name != error; };
    if (study == "causes") {
      variants.push_back({error + " off", {}, times(0, is)});
      variants.push_back({error + " alone", {}, times(0, others)});
      continue;
    }
    for (const double factor : {0.5, 2.0, 4.0})
      variants.push_back({fmt::format("{} x{}", error, factor),
                          {},
                          times(factor, is),
                          Quantity{error + " (times)", factor}});
  }
  return variants;
}

std::vector<Variant> regionVariants(const std::string& config, int64_t seed) {
  std::vector<Variant> variants;
  for (const Place& place : reachablePlaces(config, kPlaces, seed)) {
    const Edit there = target([=](double& distance, double& height, double& azimuth) {
      distance = place.distance;
      height = place.height;
      azimuth = place.azimuth;
    });
    variants.push_back({fmt::format("{:.2f} m, {:+.1f} deg, {:+.2f} m", place.distance,
                                    place.azimuth / kPi * 180, place.height),
                        there,
                        {},
                        {}});
  }
  return variants;
}

std::vector<Variant> variantsOf(const std::string& study, const std::string& uncertainty) {
  std::vector<Variant> variants{{"", {}, {}, {}}};
  const auto add = [&](const std::string& name, const Quantity& quantity, const Edit& experiment,
                       const Edit& errors) {
    variants.push_back({name, experiment, errors, quantity});
  };
  if (study == "causes" || study == "errors") {
    for (Variant& variant : errorVariants(study, uncertainty))
      variants.push_back(std::move(variant));
  } else if (study == "scale") {
    for (const double factor : {0.0, 0.5, 1.5, 2.0, 3.0})
      add(fmt::format("errors x{}", factor), {"all errors (times)", factor}, {},
          times(factor, [](const auto&) { return true; }));
  } else if (study == "distance") {
    for (const double wanted : {2.0, 2.5, 3.5, 4.0})
      add(fmt::format("distance {} m", wanted), {"distance (m)", wanted},
          target([=](double& distance, double&, double&) { distance = wanted; }), {});
  } else if (study == "height") {
    for (const double wanted : {-0.8, -0.2, 0.1, 0.4, 0.8})
      add(fmt::format("height {} m", wanted), {"height (m)", wanted},
          target([=](double&, double& height, double&) { height = wanted; }), {});
  } else if (study == "azimuth") {
    for (const double wanted : {-60.0, -30.0, 30.0, 60.0})
      add(fmt::format("azimuth {} deg", wanted), {"azimuth (deg)", wanted},
          target([=](double&, double&, double& azimuth) { azimuth = wanted / 180 * kPi; }), {});
  } else if (study == "ball") {
    for (const double modulus : {1e5, 2e5, 5e5, 1e6, 2e6, 1e7})
      add(fmt::format("ball {:.0e} Pa", modulus), {"Young's modulus (Pa)", modulus}, {},
          [=](YAML::Node& file) {
            const double factor = modulus / kNominalModulus;
            YAML::Node error;
            error["log_uniform"] = std::vector<double>{factor, factor};
            error["unit"] = "relative";
            error["reason"] = "the study's";
            file["set_up"]["stiffness"] = error;
          });
  } else if (study == "speed") {
    for (const double speed : {4.0, 4.5, 5.0, 5.5, 6.0})
      add(fmt::format("speed {} m/s", speed), {"wanted speed (m/s)", speed},
          [=](YAML::Node& file) { file["planner"]["robust"]["wanted_speed"] = speed; }, {});
  }
  return variants;
}

/// Where the case with nothing changed stands in a study of one quantity.
std::optional<Quantity> unchanged(const std::string& study, const std::string& config) {
  const YAML::Node file = load(config), position = file["target"]["position"];
  const auto at = [&](int axis) { return position[axis].as<double>(); };
  if (study == "scale")
    return Quantity{"all errors (times)", 1};
  if (study == "distance")
    return Quantity{"distance (m)", std::hypot(at(0), at(1))};
  if (study == "height")
    return Quantity{"height (m)", at(2)};
  if (study == "azimuth")
    return Quantity{"azimuth (deg)", std::atan2(at(1), at(0)) / kPi * 180};
  if (study == "speed")
    return Quantity{"wanted speed (m/s)", file["planner"]["robust"]["wanted_speed"].as<double>()};
  return {};
}

/// The experiment with the arm that is asked for, in a file if it is not the experiment's own.
std::string armFile(const StudyRequest& request, const std::string& folder) {
  if (request.arm.empty())
    return request.config;
  YAML::Node file = load(request.config);
  file["arm"] = fmt::format("arm/{}.yaml", request.arm);
  makePathsAbsolute(file, request.config);
  return written(file, request.config, folder, "experiment " + request.arm);
}

}  // namespace

const std::vector<std::string>& studyNames() {
  static const std::vector<std::string> kNames = {"none",     "causes", "errors",  "scale",
                                                  "distance", "height", "azimuth", "region",
                                                  "ball",     "speed"};
  return kNames;
}

std::vector<Case> casesOf(const StudyRequest& request, const std::string& folder) {
  fs::create_directories(folder);
  std::vector<Case> cases;
  const std::string experiment = armFile(request, folder);
  const std::vector<Variant> variants = request.study == "region"
                                            ? regionVariants(experiment, request.seed)
                                            : variantsOf(request.study, request.uncertainty);
  for (const Variant& variant : variants) {
    std::string config = experiment, uncertainty = request.uncertainty;
    if (variant.experiment) {
      YAML::Node file = load(config);
      makePathsAbsolute(file, config);
      variant.experiment(file);
      config = written(file, request.config, folder,
                       fmt::format("experiment {}{}", request.arm, variant.name));
    }
    if (variant.uncertainty) {
      YAML::Node file = load(uncertainty);
      variant.uncertainty(file);
      uncertainty = written(file, request.uncertainty, folder, "uncertainty " + variant.name);
    }
    for (const std::string& strategy : request.strategies)
      cases.push_back(
          {variant.name.empty() ? strategy : strategy + ", " + variant.name, strategy, config,
           uncertainty,
           variant.name.empty() ? unchanged(request.study, request.config) : variant.quantity});
  }
  return cases;
}

}  // namespace fastball::launch
