#include "planner/atlas_builder.h"

#include <algorithm>
#include <atomic>
#include <future>
#include <memory>
#include <numeric>
#include <thread>

#include "planner/planned_throws.h"
#include "planner/window_starts.h"

namespace fastball::planner {
namespace {

constexpr double kFlatter =
    0.52;  // sine of the angle to the ring: one turned by 45 degrees is still met at 0.35

class Builder {
 public:
  Builder(const PlannerConfig& config, int threads, const AtlasProgress& progress)
      : config_(config),
        grid_{config.atlas.distance, config.atlas.height, config.atlas.step},
        threads_(threads),
        progress_(progress) {}

  Atlas build() {
    const Eigen::Vector3d facing = -Eigen::Vector3d::UnitX();
    const std::vector<bool> everywhere(grid_.nodes(), true);
    std::vector<bool> wanted = everywhere;
    for (const double length : config_.robust.window_lengths) {
      const WindowKind window{length, config_.robust.limit_share};
      std::vector<std::unique_ptr<ThrowSource>> sources;
      for (int family = 0; family < static_cast<int>(windowStarts(0, length).size()); family += 2)
        sources.push_back(windowThrows(config_, window, family, facing));
      addLayers(sources, wanted);
      wanted = unreached(ThrowKind::kWindow);
    }
    // The fastest throws with joint 2 are lobs, which do not come through a ring that does not quite face the robot.
    const double steepness = SwingTask().steepness;
    const SwingGoal fastest = SwingGoal::kFastest;
    addSwings(Shoulder::kFree, fastest, {{0, steepness}, {1, kFlatter}}, facing, everywhere);
    addSwings(Shoulder::kHeld, fastest, {{0, steepness}, {2, steepness}}, facing, everywhere);
    addSwings(Shoulder::kFree, SwingGoal::kShortestFlight, {{0, steepness}, {1, steepness}}, facing,
              everywhere);
    return Atlas(grid_, std::move(layers_));
  }

 private:
  /// A stored start, counted without mirror images, and how steeply its throws shall meet the ring.
  struct Family {
    int start;
    double steepness;
  };
  void addSwings(Shoulder shoulder,
                 SwingGoal goal,
                 const std::vector<Family>& families,
                 const Eigen::Vector3d& facing,
                 const std::vector<bool>& wanted) {
    std::vector<std::unique_ptr<ThrowSource>> sources;
    for (const Family& family : families)
      sources.push_back(
          swingThrows(config_, shoulder, goal, 2 * family.start, facing, family.steepness));
    addLayers(sources, wanted);
  }

  /// One layer each, by as many threads as may be used.
  void addLayers(const std::vector<std::unique_ptr<ThrowSource>>& sources,
                 const std::vector<bool>& wanted) {
    const std::size_t before = layers_.size();
    layers_.resize(before + sources.size());
    std::vector<std::atomic<double>> shares(sources.size());
    const std::thread::id this_thread = std::this_thread::get_id();
    const double stages = static_cast<double>(config_.robust.window_lengths.size()) + 3;
    const auto tell = [&](std::size_t source, double share) {
      shares[source] = share;
      if (!progress_ || std::this_thread::get_id() != this_thread)
        return;
      const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
      progress_((stages_done_ + sum / static_cast<double>(sources.size())) / stages);
    };
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
      for (std::size_t i = next++; i < sources.size(); i = next++)
        layers_[before + i] =
            buildLayer(grid_, *sources[i], wanted, [&](double share) { tell(i, share); });
    };
    std::vector<std::future<void>> workers;
    for (int i = 1; i < threads_; ++i)
      workers.push_back(std::async(std::launch::async, work));
    work();
    for (std::future<void>& worker : workers)
      worker.get();
    ++stages_done_;
  }

  /// Nodes to which no throw of a kind leads, and those next to them.
  std::vector<bool> unreached(ThrowKind kind) const {
    const auto reached = [&](int column, int row) {
      return std::any_of(layers_.begin(), layers_.end(), [&](const AtlasLayer& layer) {
        const auto& node = layer.nodes[grid_.node(column, row)];
        return layer.kind == kind && node && node->inside > 0;
      });
    };
    std::vector<bool> result(grid_.nodes());
    for (int row = 0; row < grid_.rows(); ++row) {
      for (int column = 0; column < grid_.columns(); ++column) {
        for (int r = std::max(row - 1, 0); r <= std::min(row + 1, grid_.rows() - 1); ++r)
          for (int c = std::max(column - 1, 0); c <= std::min(column + 1, grid_.columns() - 1); ++c)
            result[grid_.node(column, row)] = result[grid_.node(column, row)] || !reached(c, r);
      }
    }
    return result;
  }

  const PlannerConfig& config_;
  AtlasGrid grid_;
  int threads_;
  const AtlasProgress& progress_;
  std::vector<AtlasLayer> layers_;
  int stages_done_ = 0;
};

}  // namespace

Atlas buildAtlas(const PlannerConfig& config, int threads, const AtlasProgress& progress) {
  return Builder(config, threads, progress).build();
}

}  // namespace fastball::planner
