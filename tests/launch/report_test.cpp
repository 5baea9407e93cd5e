// The page that `fastball report` makes of a log.
#include "launch/report/report.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <regex>

#include "launch/local_run.h"
#include "launch/results.h"
#include "logger/log_edit.h"
#include "logger/log_writer.h"
#include "tests/config/temporary_folder.h"

namespace fastball::launch {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
namespace fs = std::filesystem;

const std::string kExperiment = FASTBALL_SOURCE_DIR "/config/experiment.yaml";

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Addresses of everything that a page shows or refers to, but places within itself.
std::vector<std::string> addressesIn(const std::string& page) {
  static const std::regex pattern("(?:src|href)=\"([^#\"][^\"]*)\"");
  std::vector<std::string> addresses;
  for (std::sregex_iterator at(page.begin(), page.end(), pattern), end; at != end; ++at)
    addresses.push_back((*at)[1]);
  return addresses;
}

template <class T>
void writeTo(logger::LogWriter& log, const char* channel, const T& message, int64_t utime) {
  std::vector<char> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  log.write(channel, bytes.data(), bytes.size(), utime);
}

/// Writes all that is said in a run to a log, one message a millisecond of its receive times.
class Recording {
 public:
  explicit Recording(const std::string& path) : log_(path) {}
  void listen(messaging::Endpoint& endpoint) {
    using namespace messaging;
    record(endpoint, kArmState);
    record(endpoint, kHandState);
    record(endpoint, kArmCommand);
    record(endpoint, kHandCommand);
    record(endpoint, kControllerStatus);
    record(endpoint, kPlanRequest);
    record(endpoint, kSwingPlan);
    record(endpoint, kScene);
    record(endpoint, kThrowStart);
    record(endpoint, kRelease);
    record(endpoint, kCameraInfo);
    record(endpoint, kBallObservation);
    record(endpoint, kBallTrack);
    record(endpoint, kLanding);
    record(endpoint, kSimTruth);
    record(endpoint, kHeartbeat);
  }

 private:
  template <class T>
  void record(messaging::Endpoint& endpoint, const messaging::Channel<T>& channel) {
    endpoint.subscribe<T>(channel, [this, channel](const T& m) {
      writeTo(log_, channel.name, m, next_utime_ += 1000);
    });
  }
  logger::LogWriter log_;
  int64_t next_utime_ = 1'700'000'000'000'000;
};

/// One throw, its log, and a folder for reports.
class Report : public testing::Test {
 protected:
  const std::string& log() {
    if (log_.empty()) {
      log_ = (folder_.path() / "it's a <log>").string();
      RunOptions options;
      options.throws = 1;
      options.no_network = true;
      options.config = kExperiment;
      Recording recording(log_);
      Progress progress(true);
      runInOneProcess(prepareRun(options), progress, result_,
                      [&](messaging::Endpoint& endpoint) { recording.listen(endpoint); });
      EXPECT_EQ(result_.error, "");
    }
    return log_;
  }
  ReportOutcome report(const std::string& log_path) {
    const ReportOutcome outcome = writeReport(log_path, kExperiment, out());
    page_ = contents(out() + "/index.html");
    for (const std::string& address : addressesIn(page_))
      EXPECT_TRUE(fs::exists(fs::path(out()) / address)) << address;
    return outcome;
  }
  std::string out() const { return (folder_.path() / "out").string(); }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  config::TemporaryFolder folder_;
  RunResult result_;
  std::string page_;

 private:
  std::string log_;
};

TEST_F(Report, HasTheNumbersOfTheRunAndAllPictures) {
  log();
  const ReportOutcome outcome = report(log());
  EXPECT_TRUE(outcome.holds_messages);
  EXPECT_THAT(outcome.missing, IsEmpty());
  for (const char* name :
       {"landings", "throw-1", "motion-1", "release-1", "fingers-1", "residuals-1"}) {
    EXPECT_THAT(page_, HasSubstr(fmt::format("<img src=\"./{}.svg\"", name)));
    EXPECT_EQ(contents(fmt::format("{}/{}.png", out(), name)).substr(1, 3), "PNG");
    EXPECT_THAT(contents(fmt::format("{}/{}.svg", out(), name)), HasSubstr("</svg>"));
  }
  const auto thrown = toJson(result_).at("throws").at(0);
  const auto pair = [&](const char* name, const char* pattern) {
    return fmt::format(fmt::runtime(pattern), thrown.at(name).at(0).get<double>(),
                       thrown.at(name).at(1).get<double>());
  };
  for (const std::string& cell :
       {fmt::format("{:.2f}", thrown.at("planned_speed_mps").get<double>()),
        fmt::format("{:.2f}", thrown.at("release_speed_mps").get<double>()),
        fmt::format("{:.4f}", 1e-6 * thrown.at("release_utime").get<double>()),
        pair("landing_measured_mm", "{:+.2f}, {:+.2f}"), pair("landing_sigma_mm", "{:.2f}, {:.2f}"),
        pair("landing_true_mm", "{:+.2f}, {:+.2f}")})
    EXPECT_THAT(page_, HasSubstr("<td class=\"n\">" + cell + "</td>"));
  EXPECT_THAT(page_, HasSubstr("1 of 1 in the net"));
  EXPECT_THAT(contents(out() + "/throws.csv"),
              HasSubstr(fmt::format(",{},", thrown.at("release_utime").get<int64_t>())));
}

TEST_F(Report, OfALogWithoutTheHandShowsTheRestAndSaysWhatIsMissing) {
  logger::LogPart part;
  part.excluded = "HAND_STATE|SIM_TRUTH";
  logger::copyLog(log(), path("no-hand"), part);
  const ReportOutcome outcome = report(path("no-hand"));
  EXPECT_THAT(
      outcome.missing,
      AllOf(Contains(HasSubstr("no message on HAND_STATE")),
            Contains(HasSubstr("no picture 'release' of throw 1: the log has no HAND_STATE")),
            Contains(HasSubstr("no picture 'fingers' of throw 1: the log has no HAND_STATE"))));
  EXPECT_THAT(page_, HasSubstr("<li>The log holds no message on HAND_STATE.</li>"));
  EXPECT_THAT(page_, HasSubstr("1 of 1 in the net by what was measured"));
  EXPECT_TRUE(fs::exists(out() + "/throw-1.svg"));
  EXPECT_TRUE(fs::exists(out() + "/motion-1.svg"));
  EXPECT_FALSE(fs::exists(out() + "/release-1.svg"));
}

TEST_F(Report, OfALogCutInTheMiddleShowsWhatIsBeforeTheCut) {
  const std::string whole = contents(log());
  // In flight, behind the release and before the landing, within a record: a record begins with this word.
  const std::size_t cut = whole.find("\xED\xA1\xDA\x01", whole.rfind("RELEASE") + 2000) + 100;
  ASSERT_LT(cut, whole.rfind("LANDING"));
  std::ofstream(path("cut"), std::ios::binary) << whole.substr(0, cut);
  const ReportOutcome outcome = report(path("cut"));
  EXPECT_TRUE(outcome.holds_messages);
  EXPECT_THAT(outcome.missing, AllOf(Contains(HasSubstr("are no record")),
                                     Contains(HasSubstr("no message on LANDING"))));
  for (const char* name : {"throw-1", "motion-1", "fingers-1"})
    EXPECT_TRUE(fs::exists(fmt::format("{}/{}.svg", out(), name)))
        << testing::PrintToString(outcome.missing);
  EXPECT_THAT(page_, AllOf(HasSubstr("the log does not tell where they landed"),
                           HasSubstr(">unknown<"), HasSubstr("not measured")));
}

TEST_F(Report, OfAnEmptyFileSaysSo) {
  const ReportOutcome outcome = report(folder_.write("empty", ""));
  EXPECT_FALSE(outcome.holds_messages);
  EXPECT_THAT(outcome.missing, Contains(HasSubstr("holds no message")));
  EXPECT_THAT(page_, AllOf(HasSubstr("No throw."), HasSubstr("The log holds no message")));
  EXPECT_THROW(report(path("there is none")), std::invalid_argument);
}

TEST_F(Report, ShowsAnyTextAsText) {
  const std::string name = "<script>x'\n!touch touched\n'\xff\x01";
  const std::string sentence = "<b>\" onerror='x' &";
  {
    logger::LogWriter log(path("hostile"));
    heartbeat_t beat{};
    beat.name = beat.host = beat.version = beat.state = name;
    beat.detail = sentence;
    beat.loop_mean_us = 1;
    beat.loop_max_us = 2;
    writeTo(log, "HEARTBEAT", beat, 1);
    writeTo(log, "<b>CHANNEL", beat, 2);
    estop_t stop{};
    stop.reason = sentence;
    writeTo(log, "ESTOP", stop, 3);
    plan_request_t request{};
    request.request_id = 1;
    request.strategy = name;
    request.n_WTarget[0] = -1;
    request.p_WTarget[0] = 3;
    request.target_radius = 0.1;
    writeTo(log, "PLAN_REQUEST", request, 4);
    landing_t landing{};
    landing.request_id = 1;
    landing.message = sentence;
    writeTo(log, "LANDING", landing, 5);
  }
  folder_.write("hostile.run.json",
                nlohmann::json{{"command_line", "<i>"}, {"host", 3}, {"seed", "<b>"}}.dump());
  const fs::path before = fs::current_path();
  fs::current_path(folder_.path());
  const ReportOutcome outcome = report(path("hostile"));
  fs::current_path(before);
  EXPECT_THAT(page_, AllOf(Not(HasSubstr("<script")), Not(HasSubstr("<b>")), Not(HasSubstr("<i>")),
                           Not(HasSubstr("onerror='")), Not(HasSubstr("\xff"))));
  EXPECT_THAT(page_, AllOf(HasSubstr("&lt;script&gt;x&#39;"),
                           HasSubstr("&lt;b&gt;&quot; onerror=&#39;x&#39; &amp;"),
                           HasSubstr("<code>&lt;i&gt;</code>"), HasSubstr("&lt;b&gt;CHANNEL")));
  EXPECT_TRUE(fs::exists(out() + "/loops.svg")) << testing::PrintToString(outcome.missing);
  EXPECT_THAT(contents(out() + "/loops.svg"),
              AllOf(Not(HasSubstr("<script")), Not(HasSubstr("\xff"))));
  EXPECT_FALSE(fs::exists(path("touched"))) << "gnuplot took a name for a command";
}

}  // namespace
}  // namespace fastball::launch
