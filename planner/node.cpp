#include "planner/node.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <deque>
#include <optional>

#include "config/experiment.h"
#include "planner/aimed_plan.h"
#include "planner/atlas_file.h"
#include "planner/plan_message.h"
#include "planner/planner.h"

namespace fastball::planner {
namespace {

/// The same question: a repeated request differs in its stamps only. An experiment that starts anew counts from 1 again, and
/// must not get an answer to another question.
bool sameQuestion(plan_request_t a, plan_request_t b) {
  a.utime = b.utime = 0;
  a.seq = b.seq = 0;
  return a.request_id == b.request_id && a.seed == b.seed && a.strategy == b.strategy &&
         std::equal(a.q_arm, a.q_arm + 4, b.q_arm) &&
         std::equal(a.p_WTarget, a.p_WTarget + 3, b.p_WTarget) &&
         std::equal(a.n_WTarget, a.n_WTarget + 3, b.n_WTarget) &&
         a.target_radius == b.target_radius && std::equal(a.biases, a.biases + 6, b.biases);
}

class PlannerNode : public messaging::Node {
 public:
  PlannerNode(messaging::Endpoint& endpoint, const messaging::Clock& clock, AnswerRequest answer)
      : clock_(clock), answer_(std::move(answer)), plans_(endpoint, messaging::kSwingPlan) {
    endpoint.subscribe<plan_request_t>(messaging::kPlanRequest,
                                       [this](const plan_request_t& m) { takeRequest(m); });
  }

  std::string name() const override { return "planner"; }

  /// A request is announced (state "planning") one step before it is worked on, so that the HEARTBEAT says so meanwhile.
  void step() override {
    if (waiting_.empty())
      return;
    if (!announced_) {
      announced_ = true;
      return;
    }
    const plan_request_t request = waiting_.front();
    waiting_.pop_front();
    announced_ = !waiting_.empty();
    answer(request);
  }

  int64_t wakeUs() const override { return waiting_.empty() ? INT64_MAX : 0; }

  messaging::NodeState state() const override {
    return {waiting_.empty() ? "idle" : "planning", answered_ ? answered_->plan.message : "",
            answered_ ? answered_->plan.plan_id : 0};
  }

 private:
  struct Answered {
    plan_request_t request;
    swing_plan_t plan;
  };

  void takeRequest(const plan_request_t& request) {
    if (answered_ && sameQuestion(answered_->request, request)) {
      plans_.publish(answered_->plan);
      return;
    }
    const bool is_waiting =
        std::any_of(waiting_.begin(), waiting_.end(),
                    [&](const plan_request_t& other) { return sameQuestion(other, request); });
    if (!is_waiting)
      waiting_.push_back(request);
  }

  void answer(const plan_request_t& request) {
    const int64_t start_us = clock_.monotonicUs();
    const PlanResult result = answer_(fromMessage(request));
    answered_ = Answered{request, toMessage(result, request)};
    answered_->plan.plan_ms = 1e-3 * static_cast<double>(clock_.monotonicUs() - start_us);
    plans_.publish(answered_->plan);
  }

  const messaging::Clock& clock_;
  AnswerRequest answer_;
  messaging::Publisher<swing_plan_t> plans_;
  std::deque<plan_request_t> waiting_;
  bool announced_ = false;
  std::optional<Answered> answered_;
};

/// The atlas of the configuration, or null.
std::shared_ptr<const Atlas> foundAtlas(const PlannerConfig& config) {
  const std::filesystem::path folder = atlasFolder();
  if (folder.empty())
    return nullptr;
  FoundAtlas found = loadAtlas(config, atlasPath(config, folder));
  if (!found.fault.empty())
    spdlog::warn("each throw is planned from the start: {}", found.fault);
  return found.atlas ? std::make_shared<const Atlas>(*std::move(found.atlas)) : nullptr;
}

}  // namespace

std::unique_ptr<messaging::Node> makeNode(messaging::Endpoint& endpoint,
                                          const messaging::Clock& clock,
                                          const messaging::ProcessOptions& options) {
  const PlannerConfig config = loadConfig(config::experimentPath(options.config));
  const auto planner =
      std::make_shared<const Planner>(config, PredictDeparture(), foundAtlas(config));
  return makeAnsweringNode(endpoint, clock, [planner](const ThrowRequest& request) {
    return planAimed(*planner, request);
  });
}

std::unique_ptr<messaging::Node> makeAnsweringNode(messaging::Endpoint& endpoint,
                                                   const messaging::Clock& clock,
                                                   AnswerRequest answer) {
  return std::make_unique<PlannerNode>(endpoint, clock, std::move(answer));
}

}  // namespace fastball::planner
