#include "launch/doctor/machine_checks.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <lcm/lcm.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <opencv2/core/version.hpp>
#include <thread>
#include <vector>

#include <LinearMath/btScalar.h>

namespace fastball::launch {
namespace {

using Steady = std::chrono::steady_clock;
namespace fs = std::filesystem;

constexpr double kLogRate = 20e6;    // [bytes/s], two cameras at 240 Hz with states and commands
constexpr double kRoomForHours = 1;  // of logs
constexpr double kTick = 1e-3;       // [s]
constexpr int kTicks = 300;
constexpr std::size_t kProbe = 32 << 20;  // [bytes]

double seconds(Steady::duration time) {
  return std::chrono::duration<double>(time).count();
}

/// Writes a file that is deleted at once. @return bytes/s, 0: it cannot be written.
double writeSpeed() {
  std::string name = "fastball-probe-XXXXXX";
  const int file = mkstemp(name.data());
  if (file < 0)
    return 0;
  unlink(name.c_str());
  const std::vector<char> bytes(1 << 20, 'x');
  const auto start = Steady::now();
  std::size_t written = 0;
  for (; written < kProbe; written += bytes.size())
    if (write(file, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
      break;
  fdatasync(file);
  close(file);
  return written < kProbe ? 0 : static_cast<double>(written) / seconds(Steady::now() - start);
}

}  // namespace

Findings checkRealTime() {
  rlimit limit{};
  getrlimit(RLIMIT_RTPRIO, &limit);
  const bool root = geteuid() == 0;
  Finding allowed{"real-time priority", Verdict::kGood, "", ""};
  allowed.value = root ? "this is root, which may" : fmt::format("up to {}", limit.rlim_cur);
  if (!root && limit.rlim_cur == 0) {
    allowed.verdict = Verdict::kRemark;
    allowed.value = "not allowed; only system files with realtime_priority need it";
    allowed.mend =
        "echo \"$USER - rtprio 90\" | sudo tee /etc/security/limits.d/60-fastball.conf   # then "
        "log in again";
  }
  double worst = 0;
  auto next = Steady::now();
  for (int i = 0; i < kTicks; ++i) {
    next += std::chrono::microseconds(1000);
    std::this_thread::sleep_until(next);
    worst = std::max(worst, seconds(Steady::now() - next));
  }
  Finding late{"waking each millisecond", Verdict::kGood,
               fmt::format("{:.2f} ms late at most, of {} times", worst * 1e3, kTicks), ""};
  if (worst > 2 * kTick) {
    late.verdict = Verdict::kRemark;
    late.value += "; --realtime would miss ticks, lockstep does not mind";
  }
  return {allowed, late};
}

Findings checkDisk() {
  const fs::space_info space = fs::space(fs::current_path());
  const double hours = static_cast<double>(space.available) / kLogRate / 3600;
  Finding room{
      "room for logs", Verdict::kGood,
      fmt::format("{:.1f} GB in {}: {:.1f} h of a run in real time",
                  static_cast<double>(space.available) * 1e-9, fs::current_path().string(), hours),
      ""};
  if (hours < kRoomForHours) {
    room.verdict = Verdict::kBad;
    room.mend = "df -h .   # make room, or start elsewhere";
  }
  const double speed = writeSpeed();
  Finding fast{"speed of the disk", Verdict::kGood, fmt::format("{:.0f} MB/s", speed * 1e-6), ""};
  if (speed == 0) {
    fast.verdict = Verdict::kBad;
    fast.value = "this folder cannot be written";
    fast.mend = "cd   # to a folder of your own";
  } else if (speed < kLogRate) {
    fast.verdict = Verdict::kRemark;
    fast.value += fmt::format(", a run in real time needs {:.0f}", kLogRate * 1e-6);
  }
  return {room, fast};
}

Findings checkLibraries() {
  utsname system{};
  uname(&system);
  Finding bullet{"Bullet", Verdict::kGood, fmt::format("{} in double precision", BT_BULLET_VERSION),
                 ""};
  if (sizeof(btScalar) != sizeof(double)) {
    bullet.verdict = Verdict::kBad;
    bullet.value = fmt::format("{} in single precision", BT_BULLET_VERSION);
    bullet.mend = "sudo apt install libbullet-dev   # and build again";
  }
  return {{"kernel", Verdict::kGood, system.release, ""},
          {"LCM", Verdict::kGood,
           fmt::format("{}.{}.{}", LCM_MAJOR_VERSION, LCM_MINOR_VERSION, LCM_MICRO_VERSION), ""},
          bullet,
          {"OpenCV", Verdict::kGood, CV_VERSION, ""}};
}

}  // namespace fastball::launch
