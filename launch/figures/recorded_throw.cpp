#include "launch/figures/recorded_throw.h"

#include <stdexcept>

#include "launch/local_run.h"

namespace fastball::launch {

ThrowRecord recordedThrow(const std::string& config,
                          const std::string& strategy,
                          const std::function<void(messaging::Endpoint&)>& listen) {
  RunOptions options;
  options.throws = 1;
  options.no_network = true;
  options.strategy = strategy;
  options.config = config;
  const RunSetup setup = prepareRun(options);
  std::map<int64_t, ThrowRecord> throws;
  RunResult result;
  Progress progress(true);
  runInOneProcess(setup, progress, result, [&](messaging::Endpoint& endpoint) {
    recordThrows(endpoint, throws);
    if (listen)
      listen(endpoint);
  });
  if (!result.error.empty())
    throw std::runtime_error(result.error);
  if (throws.empty())
    throw std::runtime_error("the run told of no throw");
  return throws.begin()->second;
}

}  // namespace fastball::launch
