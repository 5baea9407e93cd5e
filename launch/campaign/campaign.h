#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace fastball::launch {

/// What an ordered study varies: where a case stands on the axis of its picture.
struct Quantity {
  std::string name;  ///< with its unit: "distance (m)"; "(times)": of the size in the other cases
  double value = 0;
};

/// One way of throwing that a campaign counts the hits of. All cases of a campaign get the same draws.
struct Case {
  std::string name;  ///< of the strategy alone, or of what is changed: "paper", "robust, drag off"
  std::string strategy;     ///< of the planner
  std::string config;       ///< experiment file, absolute
  std::string uncertainty;  ///< file of errors, absolute; empty: none
  std::optional<Quantity> quantity = {};
};

/// What a campaign does. Set-up number i throws as `fastball run --seed (seed + i)` does: its errors that are
/// fixed, and those drawn anew for each of its throws, follow from that seed.
struct Campaign {
  std::string version;    ///< of the program that began it
  int throws = 0;         ///< of each case
  int set_up_throws = 0;  ///< one after the other in a set-up; the last one has fewer if need be
  int64_t seed = 1;
  bool images = false;  ///< cameras and tracker; else the light curtain
  std::vector<Case> cases;
};

/// Throws of one case in one set-up: what is done, recorded and repeated as a whole.
struct Unit {
  int case_index = 0;
  int set_up = 0;  ///< 0, 1, ...
  int throws = 0;

  bool operator<(const Unit& other) const {
    return set_up != other.set_up ? set_up < other.set_up : case_index < other.case_index;
  }
};

/// All units: set-up by set-up, the cases in turn, so that a part of them compares the cases fairly.
std::vector<Unit> unitsOf(const Campaign& campaign);

nlohmann::json toJson(const Campaign& campaign);
/// @throw nlohmann::json::exception
Campaign campaignFrom(const nlohmann::json& object);

/// The campaign in a folder. @throw std::invalid_argument with a sentence if there is none, or a broken one.
Campaign readCampaign(const std::string& folder);
/// Begins a campaign in a folder (made if absent), or goes on with the one there.
/// @throw std::invalid_argument if that is another one, naming the first difference.
void beginCampaign(const std::string& folder, const Campaign& campaign);

}  // namespace fastball::launch
