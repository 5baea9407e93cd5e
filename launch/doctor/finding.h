#pragma once

#include <string>
#include <vector>

namespace fastball::launch {

/// How a finding bears on the experiment.
enum class Verdict {
  kGood,
  kRemark,  ///< some uses suffer
  kBad      ///< the experiment would suffer
};

/// One thing that was looked at.
struct Finding {
  std::string what;
  Verdict verdict = Verdict::kGood;
  std::string value;  ///< what was found
  std::string mend;   ///< the command that mends it, or empty
};

using Findings = std::vector<Finding>;

}  // namespace fastball::launch
