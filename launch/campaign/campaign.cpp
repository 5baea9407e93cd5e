#include "launch/campaign/campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "launch/results.h"

namespace fastball::launch {
namespace {

namespace fs = std::filesystem;

std::string fileIn(const std::string& folder) {
  return (fs::path(folder) / "campaign.json").string();
}

}  // namespace

std::vector<Unit> unitsOf(const Campaign& campaign) {
  std::vector<Unit> units;
  for (int set_up = 0, begun = 0; begun < campaign.throws; ++set_up) {
    const int throws = std::min(campaign.set_up_throws, campaign.throws - begun);
    for (std::size_t i = 0; i < campaign.cases.size(); ++i)
      units.push_back({static_cast<int>(i), set_up, throws});
    begun += throws;
  }
  return units;
}

nlohmann::json toJson(const Campaign& campaign) {
  nlohmann::json cases = nlohmann::json::array();
  for (const Case& one : campaign.cases) {
    cases.push_back({{"name", one.name},
                     {"strategy", one.strategy},
                     {"config", one.config},
                     {"uncertainty", one.uncertainty}});
    if (one.quantity)
      cases.back()["quantity"] = {{"name", one.quantity->name}, {"value", one.quantity->value}};
  }
  return {{"version", campaign.version},
          {"throws", campaign.throws},
          {"set_up_throws", campaign.set_up_throws},
          {"seed", campaign.seed},
          {"images", campaign.images},
          {"cases", cases}};
}

Campaign campaignFrom(const nlohmann::json& object) {
  Campaign campaign;
  object.at("version").get_to(campaign.version);
  object.at("throws").get_to(campaign.throws);
  object.at("set_up_throws").get_to(campaign.set_up_throws);
  object.at("seed").get_to(campaign.seed);
  object.at("images").get_to(campaign.images);
  for (const nlohmann::json& one : object.at("cases")) {
    campaign.cases.push_back(
        {one.at("name"), one.at("strategy"), one.at("config"), one.at("uncertainty")});
    if (const auto quantity = one.find("quantity"); quantity != one.end())
      campaign.cases.back().quantity = Quantity{quantity->at("name"), quantity->at("value")};
  }
  return campaign;
}

Campaign readCampaign(const std::string& folder) {
  const std::string path = fileIn(folder);
  std::ifstream file(path);
  if (!file)
    throw std::invalid_argument(fmt::format("{}: there is no campaign", path));
  try {
    return campaignFrom(nlohmann::json::parse(file));
  } catch (const nlohmann::json::exception& e) {
    throw std::invalid_argument(fmt::format("{}: is not a campaign's: {}", path, e.what()));
  }
}

void beginCampaign(const std::string& folder, const Campaign& campaign) {
  fs::create_directories(folder);
  const nlohmann::json wanted = toJson(campaign);
  if (fs::exists(fileIn(folder))) {
    const nlohmann::json there = toJson(readCampaign(folder));
    for (const auto& [key, value] : wanted.items()) {
      if (there.at(key) != value)
        throw std::invalid_argument(
            fmt::format("--folder {}: holds a campaign whose {} is {}, not {}; give another folder",
                        folder, key, there.at(key).dump(), value.dump()));
    }
    return;
  }
  writeJson(wanted, fileIn(folder));
}

}  // namespace fastball::launch
