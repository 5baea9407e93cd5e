#pragma once

#include <vector>

#include "launch/experiment_node.h"
#include "launch/judge.h"
#include "launch/progress.h"

namespace fastball::launch {

/// Joins what the experiment saw of each throw with its truth, as soon as both are there, and shows it.
class Verdicts {
 public:
  /// @param target_radius [m], inner, of the net's ring
  Verdicts(const ExperimentNode& experiment,
           Judge& judge,
           double target_radius,
           Progress& progress);
  /// Judges whatever can be judged by now.
  void update();
  /// True if every throw that the experiment has seen is judged.
  bool complete() const { return throws_.size() == experiment_.throws().size(); }
  const std::vector<JudgedThrow>& throws() const { return throws_; }

 private:
  const ExperimentNode& experiment_;
  Judge& judge_;
  double target_radius_;
  Progress& progress_;
  std::vector<JudgedThrow> throws_;
};

}  // namespace fastball::launch
