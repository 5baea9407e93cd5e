#include <fmt/format.h>

#include <cmath>

#include "launch/release_drawing.h"

namespace fastball::launch {

Table releaseTable(const std::vector<const HandAndBall*>& ticks) {
  Table table{{"t from departure (ms)"}, {}};
  const auto point = [&](const std::string& name) {
    for (const char axis : {'x', 'y', 'z'})
      table.columns.push_back(fmt::format("{} {} (m)", name, axis));
  };
  point("ball");
  point("hand");
  for (const char* const finger : {"finger A", "thumb", "finger B"}) {
    for (const char* const place : {"base", "knuckle", "tip"})
      point(fmt::format("{} {}", finger, place));
    table.columns.push_back(fmt::format("{} from ball (mm)", finger));
  }
  table.columns.insert(table.columns.end(), {"palm from ball (mm)", "thumb proximal (deg)"});
  for (const HandAndBall* tick : ticks) {
    std::vector<double> row{1e3 * tick->t};
    const auto add = [&row](const Eigen::Vector3d& p) {
      row.insert(row.end(), p.data(), p.data() + 3);
    };
    add(tick->p_WBall);
    add(tick->X_WH.translation());
    for (const model::Finger finger : {model::kFingerA, model::kThumb, model::kFingerB}) {
      const auto& [proximal, distal] = tick->phalanges[finger];
      add(proximal.p_start);
      add(distal.p_start);
      add(distal.p_end);
      row.push_back(1e3 * tick->gap[finger]);
    }
    row.push_back(1e3 * tick->palm_gap);
    row.push_back(tick->q[model::kProximalThumb] * 180 / M_PI);
    table.rows.push_back(row);
  }
  return table;
}

}  // namespace fastball::launch
