#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "launch/campaign/campaign.h"

namespace fastball::launch {

/// One throw of a campaign, judged by the truth.
struct ThrowOutcome {
  bool hit = false;                         ///< the ball's centre passed the ring
  bool clean = false;                       ///< the whole ball did
  std::optional<Eigen::Vector2d> landing;   ///< [m], true, target plane (right, up)
  std::optional<Eigen::Vector2d> measured;  ///< [m], by the tracker or the curtain
  double release_speed = 0;                 ///< [m/s], true; 0: the ball never left the hand
  std::string note;                         ///< what went wrong, or empty
};

/// A finished unit.
struct UnitResult {
  Unit unit;
  std::vector<ThrowOutcome> throws;
  double wall_s = 0;  ///< [s], wall time that they took
};

/// Finished units of a campaign's folder in the order of units, each once, whatever wrote them and however often. A last line cut
/// short by a power cut or a kill does not count.
/// @throw std::runtime_error naming file and line if a whole line makes no sense.
std::map<Unit, UnitResult> readRecord(const std::string& folder);

/// A file of the folder to which finished units are added, each by one write.
class RecordFile {
 public:
  /// @param name of the file without ending; what an earlier process left under it stays.
  /// @throw std::runtime_error if it cannot be written.
  RecordFile(const std::string& folder, const std::string& name);
  ~RecordFile();
  RecordFile(const RecordFile&) = delete;
  RecordFile& operator=(const RecordFile&) = delete;

  /// @throw std::runtime_error if it cannot be written.
  void add(const UnitResult& result);

 private:
  std::string path_;
  int file_ = -1;
};

}  // namespace fastball::launch
