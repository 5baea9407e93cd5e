#include "launch/local_run.h"

#include <algorithm>
#include <memory>
#include <vector>

#include "controller/node.h"
#include "hand_server/node.h"
#include "launch/experiment_node.h"
#include "launch/verdicts.h"
#include "messaging/local_network.h"
#include "messaging/stop_signals.h"
#include "planner/node.h"
#include "sim_bullet/node.h"
#include "vision_tracker/node.h"

namespace fastball::launch {
namespace {

/// The system's clock, put forward whenever all nodes wait: nothing can come from outside, so there is no need to sit out a
/// timeout.
class SkippingClock : public messaging::Clock {
 public:
  int64_t monotonicUs() const override { return clock_.monotonicUs() + skipped_us_; }
  int64_t wallUs() const override { return clock_.wallUs() + skipped_us_; }
  void skipTo(int64_t monotonic_us) {
    skipped_us_ += std::max<int64_t>(0, monotonic_us - monotonicUs());
  }

 private:
  messaging::SystemClock clock_;
  int64_t skipped_us_ = 0;
};

}  // namespace

void runInOneProcess(const RunSetup& setup,
                     Progress& progress,
                     RunResult& result,
                     const std::function<void(messaging::Endpoint&)>& listen) {
  const messaging::StopSignals signals;
  SkippingClock clock;
  messaging::LocalNetwork network(clock);
  std::vector<std::unique_ptr<messaging::Node>> nodes;
  std::vector makers = {planner::makeNode, controller::makeNode, hand_server::makeNode,
                        sim_bullet::makeNode};
  if (setup.options.images)
    makers.push_back(vision_tracker::makeNode);
  for (const auto make : makers) {
    messaging::Endpoint& endpoint = network.addEndpoint();
    nodes.push_back(make(endpoint, clock, setup.options));
    network.addNode(*nodes.back(), endpoint);
  }
  messaging::Endpoint& endpoint = network.addEndpoint();
  const Roster roster(endpoint);
  ExperimentNode experiment(endpoint, clock, roster, setup.settings);
  network.addNode(experiment, endpoint);
  Judge judge(network.addEndpoint());
  if (listen)
    listen(network.addEndpoint());
  Verdicts verdicts(experiment, judge, setup.settings.target.radius, progress);

  const auto done = [&] {
    verdicts.update();
    progress.status(experiment.progress(), clock.monotonicUs());
    return signals.received() || experiment.phase() == ExperimentNode::Phase::kFailed ||
           (experiment.finished() && verdicts.complete());
  };
  while (!network.run(done) && network.nextWakeUs() != INT64_MAX)
    clock.skipTo(network.nextWakeUs());

  result.throws = verdicts.throws();
  result.throw_wall_s = experiment.throwWallTimes();
  result.error = experiment.error();
  if (signals.received())
    result.error = "interrupted";
  if (result.error.empty() && !done())
    result.error = "the simulator did not tell the truth of a throw";
}

}  // namespace fastball::launch
