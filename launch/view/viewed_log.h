#pragma once

#include <memory>
#include <string>
#include <vector>

#include "launch/view/timeline.h"
#include "logger/log_reader.h"

namespace fastball::view {

/// A log as viewers see it. Its images stay in the file until they are asked for.
class ViewedLog {
 public:
  /// Reads the whole log.
  /// @throw std::invalid_argument if it cannot be read or holds no LCM message.
  ViewedLog(const std::string& path, const config::Experiment& experiment, double floor);

  const Timeline& timeline() const { return *timeline_; }
  /// A picture of this log, or null if its record cannot be read any more.
  std::shared_ptr<const image_t> image(const Picture& picture);
  /// What of the file is damaged or was left out, in sentences.
  std::vector<std::string> faults() const;

 private:
  logger::LogReader reader_;
  std::unique_ptr<Timeline> timeline_;
  int keep_every_ = 1;
  std::vector<std::string> faults_;
};

}  // namespace fastball::view
