#include "launch/release_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "launch/figures/style.h"
#include "launch/figures/table.h"
#include "launch/gnuplot.h"
#include "launch/release_outline.h"
#include "model/target.h"

namespace fastball::launch {
namespace {

using Eigen::Vector3d;
using model::Finger, model::kFingerA, model::kFingerB, model::kThumb;

constexpr double kStrobe = 0.1;   ///< [s], between two poses of the whole throw
constexpr double kFrame = 0.002;  ///< [s], between two frames of the release
constexpr int kFramesInRow = 10, kRows = 4;
constexpr double kFrameSize = 0.275;         ///< [m], seen in a frame
constexpr double kFramePitch = 0.0977;       ///< of the picture's width
constexpr int kWidth = 1200, kHeight = 852;  ///< [px]
constexpr Finger kFingerOrder[] = {kFingerA, kThumb, kFingerB};
constexpr const char* kFingerNames[] = {"finger A", "the thumb", "finger B"};
constexpr const char* kFingerColours[] = {"'#0072B2'", "'#D55E00'", "'#56B4E9'"};
constexpr const char *kCommandColour = "'#CC79A7'", *kDepartureColour = "'#009E73'";
constexpr const char* kBallColour = "'#F6D58A'";

/// Time [s] of the first frame: whole rows, so that the command to let go is seen where it can be.
double firstFrame(const ReleaseSequence& sequence) {
  constexpr double kRow = kFramesInRow * kFrame;
  return kRow * std::clamp(std::floor(sequence.t_command / kRow), -2.0, -1.0);
}

std::vector<const HandAndBall*> strobeTicks(const ReleaseSequence& sequence) {
  std::vector<const HandAndBall*> ticks;
  for (double t = kStrobe * std::ceil(sequence.t_swing / kStrobe); t < sequence.t_landing;
       t += kStrobe)
    ticks.push_back(&sequence.at(t));
  return ticks;
}

/// Data blocks of what is seen at each tick, an index each: the ball, the palm, and the fingers 0, 1, 2.
/// @param origin where in the plane the picture's origin is at a tick.
template <class Origin>
std::string outlineBlocks(const std::string& name,
                          const ThrowPlane& plane,
                          const std::vector<const HandAndBall*>& ticks,
                          const config::Experiment& experiment,
                          const Origin& origin) {
  std::string ball, palm, fingers[model::kFingers];
  for (const HandAndBall* tick : ticks) {
    const Eigen::Vector2d o = origin(*tick);
    ball += polygon(circleOutline(plane.at(tick->p_WBall), experiment.ball.radius), o) + "\n";
    palm += polygon(palmOutline(plane, tick->X_WH, experiment.hand), o) + "\n";
    for (const Finger finger : kFingerOrder) {
      for (const model::Segment& axis : tick->phalanges[finger]) {
        fingers[finger] += polygon(capsuleOutline(plane.at(axis.p_start), plane.at(axis.p_end),
                                                  experiment.hand.finger_radius),
                                   o);
      }
      fingers[finger] += "\n";
    }
  }
  std::string blocks = dataBlock(name + "_ball", ball) + dataBlock(name + "_palm", palm);
  for (const Finger finger : kFingerOrder)
    blocks += dataBlock(fmt::format("{}_{}", name, static_cast<int>(finger)), fingers[finger]);
  return blocks;
}

/// Plot clauses of those blocks, from behind to the front. `index`: of one tick, or empty for all.
std::string outlinePlot(const std::string& name, const std::string& index, bool a_is_behind) {
  const Finger far_finger = a_is_behind ? kFingerA : kFingerB,
               near_finger = a_is_behind ? kFingerB : kFingerA;
  std::string plot;
  const auto add = [&](const auto& block, const char* fill, const char* colour) {
    plot += fmt::format(
        "{}${}_{} {} u 1:2 w filledcurves closed fs {} border lc rgb '#303030' lc rgb {}",
        plot.empty() ? "" : ", ", name, block, index, fill, colour);
  };
  add(static_cast<int>(far_finger), "solid 1", kFingerColours[far_finger]);
  add("palm", "solid 1", "'#b0b0b0'");
  add("ball", "solid 1", kBallColour);
  add(static_cast<int>(near_finger), "transparent solid 0.6", kFingerColours[near_finger]);
  add(static_cast<int>(kThumb), "solid 1", kFingerColours[kThumb]);
  return plot;
}

/// "-20", "0", "+20": whole milliseconds from the departure.
std::string signedMs(double t) {
  const auto ms = std::lround(1e3 * t);
  return ms == 0 ? "0" : fmt::format("{:+d}", ms);
}

/// A frame of the release: the moment written into it, and a colour round it if it is a special one.
std::string framePanel(int i, double t, double t_command, const std::string& plot) {
  constexpr double kTickTolerance = 1e-4;       // [s]
  const auto first_from = [t](double moment) {  // of the frames that are not before it
    return t > moment - kTickTolerance && t < moment + kFrame - kTickTolerance;
  };
  const bool is_command = first_from(t_command), is_departure = first_from(0);
  const double left = 0.012 + kFramePitch * (i % kFramesInRow),
               top = 0.568 - kFramePitch * kWidth / kHeight * (i / kFramesInRow);
  constexpr double kShown = kFramePitch - 0.003;
  return fmt::format(
      "set lmargin at screen {:.4f}; set rmargin at screen {:.4f}\n"
      "set bmargin at screen {:.4f}; set tmargin at screen {:.4f}\n"
      "set border 31 lw {} lc rgb {}\n"
      "set label 1 '{} ms{}' font ',10' at graph 0.04,0.06 front tc rgb '#202020'\n"
      "plot {}\n",
      left, left + kShown, top - kShown * kWidth / kHeight, top,
      is_command || is_departure ? 4 : 0.5,
      is_command     ? kCommandColour
      : is_departure ? kDepartureColour
                     : "'#b0b0b0'",
      signedMs(t),
      is_command     ? ": let go"
      : is_departure ? ": leaves"
                     : "",
      plot);
}

std::string framePanels(const ReleaseSequence& sequence,
                        const std::vector<const HandAndBall*>& frames,
                        bool a_is_behind) {
  std::string panels = fmt::format(
      "unset xlabel; unset ylabel; unset title; unset grid; unset xtics; unset ytics; unset key\n"
      "unset arrow; unset label; set size noratio\n"
      "set label 2 'Around the release, every {2:.0f} ms, the place where the hand holds the ball "
      "in the "
      "middle; orange: the thumb, blue: the fingers behind the ball' at screen 0.012,0.582 font "
      "',12'\n"
      "set xrange [{0}:{1}]; set yrange [{0}:{1}]\n",
      -kFrameSize / 2, kFrameSize / 2, 1e3 * kFrame);
  for (int i = 0; i < kRows * kFramesInRow; ++i)
    panels += (i == 1 ? "unset label 2\n" : "") +
              framePanel(i, frames[i]->t, sequence.t_command,
                         outlinePlot("frame", fmt::format("index {}", i), a_is_behind));
  return panels;
}

/// A line across the panel at a moment [s].
std::string momentLine(int number, double t, const char* colour, const char* words) {
  return fmt::format(
      "set arrow {0} from {1:.2f}, graph 0 to {1:.2f}, graph 1 nohead lw 2 lc rgb {2}\n"
      "set label {0} '{3}' at {1:.2f}, graph 0.97 right rotate by 90 offset 0.9,0 tc rgb {2}\n",
      number, 1e3 * t, colour, words);
}

/// How far each finger is from the ball, over the time of the frames.
std::string gapPanel(const ReleaseSequence& sequence, double t_first) {
  const double t_last = t_first + (kRows * kFramesInRow - 1) * kFrame;
  std::string plot;
  for (const Finger finger : kFingerOrder) {
    plot += fmt::format("{}$gaps u 1:{} w l lw 3 {} lc rgb {} title '{}'", plot.empty() ? "" : ", ",
                        finger + 2, finger == kFingerB ? "dt 2" : "", kFingerColours[finger],
                        kFingerNames[finger]);
  }
  return fmt::format(
      "set lmargin at screen 0.665; set rmargin at screen 0.985\n"
      "set bmargin at screen 0.668; set tmargin at screen 0.915\n"
      "set title 'From the ball to each finger' font ',12'\n"
      "set xlabel 'time from the departure (ms)' offset 0,0.5\n"
      "set ylabel 'distance (mm)' offset 1,0\n"
      "set size noratio; set xrange [{}:{}]; set yrange [-4:30]; set key bottom right\n"
      "{}{}plot {}\n",
      1e3 * t_first, 1e3 * t_last,
      momentLine(1, sequence.t_command, kCommandColour, "told to let go"),
      momentLine(2, 0, kDepartureColour, "ball leaves"), plot);
}

/// Both in order of time, each tick once.
std::vector<const HandAndBall*> allOf(const std::vector<const HandAndBall*>& a,
                                      const std::vector<const HandAndBall*>& b) {
  std::vector<const HandAndBall*> all;
  const auto earlier = [](const HandAndBall* x, const HandAndBall* y) { return x->t < y->t; };
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all), earlier);
  return all;
}

std::string gapData(const std::vector<const HandAndBall*>& ticks) {
  std::string data;
  for (const HandAndBall* tick : ticks)
    data += fmt::format("{:.3f} {:.3f} {:.3f} {:.3f} {:.3f}\n", 1e3 * tick->t,
                        1e3 * tick->gap[kFingerA], 1e3 * tick->gap[kThumb],
                        1e3 * tick->gap[kFingerB], 1e3 * tick->palm_gap);
  return data;
}

/// Ranges of a panel of this shape (width by height) that hold all these points, to one scale.
std::string ranges(const std::vector<Eigen::Vector2d>& points, double shape) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& p : points)
    box.extend(p);
  constexpr double kRoom = 0.2;  // [m], for what is about the points
  const Eigen::Vector2d centre = box.center(),
                        needed = box.sizes() / 2 + Eigen::Vector2d(kRoom, kRoom);
  const double y = std::max(needed.y(), needed.x() / shape);
  return fmt::format("set xrange [{:.3f}:{:.3f}]; set yrange [{:.3f}:{:.3f}]\n",
                     centre.x() - shape * y, centre.x() + shape * y, centre.y() - y,
                     centre.y() + y);
}

/// The whole throw, every 100 ms.
std::string strobePanel(const std::vector<const HandAndBall*>& ticks,
                        const ThrowPlane& plane,
                        const Outline& ring,
                        bool a_is_behind) {
  constexpr double kLabelRoom = 0.15;  // [m]
  std::string labels;
  std::vector<Eigen::Vector2d> points = ring;
  Eigen::Vector2d last(-INFINITY, 0);
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    const Eigen::Vector2d p = plane.at(ticks[i]->p_WBall);
    points.insert(points.end(), {p, plane.at(ticks[i]->X_WH.translation())});
    if ((p - last).norm() < kLabelRoom)
      continue;
    last = p;
    labels += fmt::format("set label {} '{}' at {:.3f},{:.3f} center front offset 0,-1.6\n", i + 10,
                          signedMs(ticks[i]->t), p.x(), p.y());
  }
  return fmt::format(
      "set lmargin at screen 0.058; set rmargin at screen 0.615\n"
      "set bmargin at screen 0.668; set tmargin at screen 0.915\n"
      "set title 'The whole throw every {:.0f} ms (times in ms from the departure)' font ',12'\n"
      "set xlabel 'in the direction of the throw (m)' offset 0,0.5; set ylabel 'across it (m)' "
      "offset 1.2,0\n"
      "set size noratio\n{}{}"
      "plot $ballpath u 1:2 w l lw 1 dt 2 lc rgb {}, {}, $ring u 1:2 w l lw 5 lc rgb '#222222'\n"
      "unset label\n",
      1e3 * kStrobe, labels, ranges(points, 0.557 * kWidth / (0.247 * kHeight)), kGrey,
      outlinePlot("strobe", "", a_is_behind));
}

/// The net's ring, and the ball's path, in the plane.
std::string pathData(const ReleaseSequence& sequence, const ThrowPlane& plane) {
  std::string data;
  for (const HandAndBall& tick : sequence.ticks) {
    if (tick.t >= sequence.t_swing && tick.t <= sequence.t_landing) {
      const Eigen::Vector2d p = plane.at(tick.p_WBall);
      data += fmt::format("{:.4f} {:.4f}\n", p.x(), p.y());
    }
  }
  return data;
}

/// The net's ring, seen from its edge.
Outline ringOutline(const plan_request_t& request, const ThrowPlane& plane) {
  model::Target target;
  target.p_WTarget = Eigen::Map<const Vector3d>(request.p_WTarget);
  target.n_WTarget = Eigen::Map<const Vector3d>(request.n_WTarget);
  const Vector3d up = request.target_radius * target.upAxis();
  return {plane.at(target.p_WTarget - up), plane.at(target.p_WTarget + up)};
}

}  // namespace

std::string drawRelease(const ThrowRecord& record,
                        const config::Experiment& experiment,
                        const std::string& title,
                        const std::string& path_stem) {
  const ReleaseSequence sequence = releaseSequence(record, experiment);
  const ThrowPlane plane(sequence.v_WBall, sequence.at(0).X_WH);
  const double t_first = firstFrame(sequence);
  const auto strobe = strobeTicks(sequence);
  std::vector<const HandAndBall*> frames, gaps;
  for (int i = 0; i < kRows * kFramesInRow; ++i)
    frames.push_back(&sequence.at(t_first + i * kFrame));
  for (const HandAndBall& tick : sequence.ticks) {
    if (tick.t > frames.front()->t - 1e-4 && tick.t < frames.back()->t + 1e-4)
      gaps.push_back(&tick);
  }
  const Outline ring = ringOutline(*record.request, plane);
  const bool a_is_behind = plane.behind(sequence.at(0).phalanges[kFingerA][1].p_end) >
                           plane.behind(sequence.at(0).phalanges[kFingerB][1].p_end);

  writeCsv(releaseTable(allOf(strobe, gaps)), path_stem + ".csv");
  const std::string blocks =
      outlineBlocks("strobe", plane, strobe, experiment,
                    [](const HandAndBall&) { return Eigen::Vector2d(0, 0); }) +
      outlineBlocks(
          "frame", plane, frames, experiment,
          [&](const HandAndBall& tick) { return plane.at(tick.X_WH * experiment.hand.p_HBall); }) +
      dataBlock("gaps", gapData(gaps)) + dataBlock("ballpath", pathData(sequence, plane)) +
      dataBlock("ring", polygon(ring, {0, 0}));
  drawPicture(
      path_stem, kWidth, kHeight, blocks,
      kStyle +
          fmt::format("set multiplot title {} font ',15'\n",
                      quoted(title + ": hand and ball, seen square to the throw and the forearm")) +
          strobePanel(strobe, plane, ring, a_is_behind) + gapPanel(sequence, t_first) +
          framePanels(sequence, frames, a_is_behind) + "unset multiplot\n");
  return releaseCaption(sequence, experiment);
}

}  // namespace fastball::launch
