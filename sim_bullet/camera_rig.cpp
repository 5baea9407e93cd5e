#include "sim_bullet/camera_rig.h"

#include <Eigen/Geometry>
#include <boost/asio/post.hpp>
#include <boost/asio/thread_pool.hpp>
#include <cmath>
#include <stdexcept>

namespace fastball::sim_bullet {
namespace {

/// Frames begun and not yet drawn; more would only use memory.
constexpr std::size_t kMostPending = 32;

SceneSnapshot between(const SceneSnapshot& a, const SceneSnapshot& b, double share) {
  SceneSnapshot s;
  s.p_WBall = a.p_WBall + share * (b.p_WBall - a.p_WBall);
  s.R_WBall =
      Eigen::Quaterniond(a.R_WBall).slerp(share, Eigen::Quaterniond(b.R_WBall)).toRotationMatrix();
  s.q_arm = a.q_arm + share * (b.q_arm - a.q_arm);
  s.q_hand = a.q_hand + share * (b.q_hand - a.q_hand);
  return s;
}

}  // namespace

struct CameraRig::Workers {
  explicit Workers(int count) {
    if (count > 0)
      pool = std::make_unique<boost::asio::thread_pool>(static_cast<std::size_t>(count));
  }
  ~Workers() {
    if (pool) {
      pool->stop();
      pool->join();
    }
  }
  std::future<RenderedImage> run(std::shared_ptr<const Frame> frame) {
    std::packaged_task<RenderedImage()> task(
        [frame = std::move(frame)] { return renderFrame(*frame); });
    std::future<RenderedImage> result = task.get_future();
    if (pool)
      boost::asio::post(*pool, std::move(task));
    else
      task();
    return result;
  }
  std::unique_ptr<boost::asio::thread_pool> pool;
};

CameraRig::CameraRig(const CameraRigOptions& options,
                     const model::ArmParameters& arm,
                     const model::HandParameters& hand,
                     double ball_radius)
    : options_(options),
      figure_(std::make_shared<Figure>(arm, hand)),
      ball_{ball_radius, options.blur, options.to_light_W},
      workers_(std::make_unique<Workers>(options.workers)) {
  if (options_.cameras.empty())
    throw std::invalid_argument("a camera rig needs a camera");
  // Several processes share the machine; the frames are the unit of parallel work.
  cv::setNumThreads(0);
  const model::Camera& first = options_.cameras.front().camera;
  noise_ = std::make_shared<NoiseField>(cv::Size(first.width, first.height), options_.noise);
  for (const RigCamera& rig : options_.cameras) {
    rays_.push_back(rayMap(rig.camera));
    rooms_.push_back(drawRoom(rig.camera, rays_.back()));
  }
}

CameraRig::~CameraRig() = default;

int64_t CameraRig::frameTime(int64_t index) const {
  return std::llround(static_cast<double>(index) * 1e6 / options_.cameras.front().rate);
}

void CameraRig::begin(int64_t scene_id,
                      int64_t seed,
                      int64_t start_utime,
                      int64_t end_utime,
                      const model::Target& target) {
  flush();
  pending_.clear();
  history_.clear();
  views_.clear();
  for (std::size_t i = 0; i < options_.cameras.size(); ++i) {
    const RigCamera& rig = options_.cameras[i];
    cv::Mat background = rooms_[i].clone();
    drawNet(rig.camera, target, options_.blur, background);
    views_.push_back(
        std::make_shared<View>(View{rig, rays_[i], background, ringPieces(rig.camera, target)}));
  }
  scene_id_ = scene_id;
  seed_ = seed;
  end_utime_ = end_utime;
  next_frame_ = 0;
  const double period = 1e6 / options_.cameras.front().rate;
  next_index_ = static_cast<int64_t>(std::floor(static_cast<double>(start_utime) / period));
  const double half = options_.cameras.front().exposure * 5e5;
  while (static_cast<double>(frameTime(next_index_)) - half < static_cast<double>(start_utime))
    ++next_index_;
  running_ = true;
}

SceneSnapshot CameraRig::at(double utime) const {
  std::size_t i = 1;
  while (i + 1 < history_.size() && static_cast<double>(history_[i].utime) < utime)
    ++i;
  const SceneSnapshot &a = history_[i - 1], &b = history_[i];
  return between(a, b,
                 (utime - static_cast<double>(a.utime)) / static_cast<double>(b.utime - a.utime));
}

void CameraRig::take(int64_t utime) {
  std::array<SceneSnapshot, kSubExposures> moments;
  const double exposure = options_.cameras.front().exposure * 1e6;
  for (int i = 0; i < kSubExposures; ++i)
    moments[static_cast<std::size_t>(i)] =
        at(static_cast<double>(utime) + exposure * ((i + 0.5) / kSubExposures - 0.5));
  for (std::size_t i = 0; i < views_.size(); ++i) {
    auto frame = std::make_shared<Frame>();
    *frame = {views_[i], noise_, figure_, ball_, moments, seed_, options_.jpeg_quality, {}};
    frame->image.camera = static_cast<int>(i);
    frame->image.scene_id = scene_id_;
    frame->image.frame = next_frame_;
    frame->image.utime = utime;
    pending_.push_back(workers_->run(std::move(frame)));
  }
  if (pending_.size() > kMostPending)
    pending_[pending_.size() - kMostPending].wait();
}

void CameraRig::add(const SceneSnapshot& snapshot) {
  if (!running_ || (!history_.empty() && snapshot.utime <= history_.back().utime))
    return;
  history_.push_back(snapshot);
  const double half = options_.cameras.front().exposure * 5e5;
  for (;; ++next_index_) {
    const auto utime = static_cast<double>(frameTime(next_index_));
    if (utime + half > static_cast<double>(end_utime_)) {
      running_ = false;
      return;
    }
    if (utime + half > static_cast<double>(snapshot.utime))
      break;
    // A frame whose exposure began before the first snapshot is not known in full, and not taken.
    if (history_.size() < 2 || utime - half < static_cast<double>(history_.front().utime))
      continue;
    take(frameTime(next_index_));
    ++next_frame_;
  }
  const double needed = static_cast<double>(frameTime(next_index_)) - half;
  while (history_.size() > 2 && static_cast<double>(history_[1].utime) <= needed)
    history_.pop_front();
}

bool CameraRig::nextImage(RenderedImage& image) {
  if (pending_.empty() ||
      pending_.front().wait_for(std::chrono::seconds(0)) != std::future_status::ready)
    return false;
  image = pending_.front().get();
  pending_.pop_front();
  return true;
}

void CameraRig::flush() {
  for (const std::future<RenderedImage>& image : pending_)
    image.wait();
}

}  // namespace fastball::sim_bullet
