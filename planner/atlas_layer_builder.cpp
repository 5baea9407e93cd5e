#include "planner/atlas_layer_builder.h"

#include <algorithm>
#include <utility>

namespace fastball::planner {
namespace {

constexpr int kFirstEvery = 4;  // nodes, between those that are tried from the family's start
constexpr int kSmoothings = 3;
// Shares of the work done when its parts are.
constexpr double kSeeded = 0.3, kFlooded = 0.6, kSmoothed = 0.9;

class LayerBuilder {
 public:
  LayerBuilder(const AtlasGrid& grid,
               const ThrowSource& source,
               const std::vector<bool>& wanted,
               const std::function<void(double)>& progress)
      : grid_(grid), source_(source), wanted_(wanted), progress_(progress) {
    layer_.kind = source.kind();
    layer_.nodes.resize(grid.nodes());
  }

  AtlasLayer build() {
    std::vector<int> front;
    if (const int seed = hardest(); seed >= 0)
      front.push_back(seed);
    // From nodes with throws to their neighbours, as far as it goes.
    double reached = 0;
    const auto useful = static_cast<double>(std::count(wanted_.begin(), wanted_.end(), true));
    while (!front.empty()) {
      reached += static_cast<double>(front.size());
      progress_(kSeeded + (kFlooded - kSeeded) * reached / useful);
      std::vector<int> next;
      for (const int from : front) {
        for (const int to : neighbours(from, false)) {
          if (layer_.nodes[to] || !wanted_[to])
            continue;
          layer_.nodes[to] = source_.next(grid_.place(to), *layer_.nodes[from], false);
          if (layer_.nodes[to])
            next.push_back(to);
        }
      }
      front = std::move(next);
    }
    addRim();
    for (int sweep = 0; sweep < kSmoothings; ++sweep) {
      progress_(kFlooded + (kSmoothed - kFlooded) * sweep / kSmoothings);
      smooth();
    }
    progress_(kSmoothed);
    finish();
    progress_(1);
    return std::move(layer_);
  }

 private:
  std::vector<int> neighbours(int node, bool across) const {
    const int column = node % grid_.columns(), row = node / grid_.columns();
    std::vector<int> found;
    for (int r = std::max(row - 1, 0); r <= std::min(row + 1, grid_.rows() - 1); ++r) {
      for (int c = std::max(column - 1, 0); c <= std::min(column + 1, grid_.columns() - 1); ++c) {
        const bool beside = r == row || c == column;
        if ((beside || across) && grid_.node(c, r) != node)
          found.push_back(grid_.node(c, r));
      }
    }
    return found;
  }

  /// Of the nodes that the family's start leads to, the one with the greatest cost: from there on everything
  /// becomes easier. Negative: there is none.
  int hardest() {
    int hardest = -1;
    std::optional<AtlasThrow> best;
    for (int row = kFirstEvery / 2; row < grid_.rows(); row += kFirstEvery) {
      for (int column = 0; column < grid_.columns(); column += kFirstEvery) {
        const int node = grid_.node(column, row);
        if (!wanted_[node])
          continue;
        progress_(kSeeded * row / grid_.rows());
        auto found = source_.first(grid_.place(node));
        if (found && (!best || found->cost > best->cost)) {
          hardest = node;
          best = std::move(found);
        }
      }
    }
    if (best)
      layer_.nodes[hardest] = std::move(best);
    return hardest;
  }

  /// Beyond the last throws, so that there are nodes all around targets that can just be reached.
  void addRim() {
    std::vector<std::pair<int, AtlasThrow>> rim;
    for (int node = 0; node < grid_.nodes(); ++node) {
      if (layer_.nodes[node] || !wanted_[node])
        continue;
      for (const int from : neighbours(node, true)) {
        if (!layer_.nodes[from])
          continue;
        auto found = source_.next(grid_.place(node), *layer_.nodes[from], true);
        if (found) {
          rim.emplace_back(node, *std::move(found));
          break;
        }
      }
    }
    for (auto& [node, found] : rim)
      layer_.nodes[node] = std::move(found);
  }

  /// Each node between two others, or four, that are like it.
  void smooth() {
    for (int node = 0; node < grid_.nodes(); ++node) {
      if (!layer_.nodes[node])
        continue;
      const int column = node % grid_.columns(), row = node / grid_.columns();
      AtlasVector sum = AtlasVector::Zero(layer_.nodes[node]->x.size());
      int pairs = 0;
      const auto addPair = [&](bool between, int before, int after) {
        if (!between || !layer_.nodes[before] || !layer_.nodes[after] ||
            !alike(*layer_.nodes[before], *layer_.nodes[node]) ||
            !alike(*layer_.nodes[after], *layer_.nodes[node]))
          return;
        sum += (layer_.nodes[before]->x + layer_.nodes[after]->x) / 2;
        ++pairs;
      };
      addPair(column > 0 && column + 1 < grid_.columns(), node - 1, node + 1);
      addPair(row > 0 && row + 1 < grid_.rows(), node - grid_.columns(), node + grid_.columns());
      if (pairs == 0)
        continue;
      auto found = source_.smoothed(grid_.place(node), *layer_.nodes[node], sum / pairs);
      if (found)
        layer_.nodes[node] = std::move(found);
    }
  }

  void finish() {
    for (int node = 0; node < grid_.nodes(); ++node) {
      if (layer_.nodes[node])
        layer_.nodes[node] = source_.finished(grid_.place(node), *layer_.nodes[node]);
    }
  }

  const AtlasGrid& grid_;
  const ThrowSource& source_;
  const std::vector<bool>& wanted_;
  const std::function<void(double)>& progress_;
  AtlasLayer layer_;
};

}  // namespace

AtlasLayer buildLayer(const AtlasGrid& grid,
                      const ThrowSource& source,
                      const std::vector<bool>& wanted,
                      const std::function<void(double)>& progress) {
  return LayerBuilder(grid, source, wanted, progress).build();
}

}  // namespace fastball::planner
