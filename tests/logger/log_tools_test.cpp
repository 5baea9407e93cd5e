// What `fastball log` finds in a log and makes of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "logger/log_edit.h"
#include "logger/log_export.h"
#include "logger/log_summary.h"
#include "tests/logger/log_files.h"

namespace fastball::logger {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    all.push_back(line);
  return all;
}

TEST_F(LogFiles, TheSummaryCountsEachChannel) {
  {
    LogWriter writer(path("a.lcmlog"));
    for (int i = 0; i <= 10; ++i)
      writer.write("ARM_STATE", armState(i).data(), armState(i).size(), 1000 * i);
    writer.write("ARM_STATE", armState(14).data(), armState(14).size(), 15000);
    writer.write("RAW", "abc", 3, 20000);
  }
  const LogSummary summary = summarise(path("a.lcmlog"), {});
  const ChannelSummary& states = summary.channels.at("ARM_STATE");
  EXPECT_EQ(states.type, "fastball_arm_state_t");
  EXPECT_EQ(states.messages, 12);
  EXPECT_EQ(states.bytes, static_cast<int64_t>(12 * armState(0).size()));
  EXPECT_DOUBLE_EQ(states.rate(), 11 / 0.015);
  EXPECT_EQ(states.longest_pause_us, 5000);
  EXPECT_EQ(states.longest_pause_utime, 10000);
  EXPECT_EQ(states.missing, 3);
  EXPECT_EQ(summary.channels.at("RAW").type, "none");
  EXPECT_EQ(summary.last_utime, 20000);
  EXPECT_THAT(summary.faults(), ElementsAre(HasSubstr("3 messages missing in 1 gaps")));
  EXPECT_THAT(summaryText(summary), HasSubstr("fastball_arm_state_t"));
}

TEST_F(LogFiles, AWholeLogHasNoFault) {
  writeStates(path("a.lcmlog"), {0, 1, 2});
  EXPECT_THAT(summarise(path("a.lcmlog"), {}).faults(), testing::IsEmpty());
}

TEST_F(LogFiles, EveryFaultIsFound) {
  {
    LogWriter writer(path("a.lcmlog"));
    auto bytes = armState(0);
    writer.write("ARM_STATE", bytes.data(), bytes.size(), 5000);
    writer.write("ARM_STATE", bytes.data(), bytes.size() - 1, 2000);  // back by 3 ms, and cut
    writer.write("ARM_STATE", bytes.data(), bytes.size(), 6000);
  }
  const auto size = std::filesystem::file_size(path("a.lcmlog"));
  std::filesystem::resize_file(path("a.lcmlog"), size + 7);
  const LogSummary summary = summarise(path("a.lcmlog"), {});
  EXPECT_THAT(
      summary.faults(),
      ElementsAre(HasSubstr("ARM_STATE: 1 messages do not decode"), HasSubstr("up to 3.000 ms"),
                  HasSubstr("7 bytes from byte " + std::to_string(size))));
  EXPECT_EQ(summary.faults(2999).size(), 3U);
  EXPECT_EQ(summary.faults(3000).size(), 2U);
}

TEST_F(LogFiles, ARepairedLogHoldsEveryWholeRecordAndNothingElse) {
  writeStates(path("a.lcmlog"), {0, 1, 2, 3, 4});
  damage(path("a.lcmlog"), 2 * std::filesystem::file_size(path("a.lcmlog")) / 5, "\xff\xff");
  const CopyResult result = copyLog(path("a.lcmlog"), path("b.lcmlog"));
  EXPECT_EQ(result.messages, 4);
  EXPECT_EQ(result.damages, 1);
  int damaged = -1;
  EXPECT_THAT(readSeqs(path("b.lcmlog"), &damaged), ElementsAre(0, 1, 3, 4));
  EXPECT_EQ(damaged, 0);
}

TEST_F(LogFiles, ACutHoldsTheTimesAndChannelsAskedFor) {
  {
    LogWriter writer(path("a.lcmlog"));
    for (int i = 0; i < 10; ++i) {
      for (const char* channel : {"ARM_STATE", "ARM_COMMAND", "HEARTBEAT"})
        writer.write(channel, armState(i).data(), armState(i).size(), 5'000'000 + 100'000 * i);
    }
  }
  LogPart part;
  part.from = 0.2;
  part.to = 0.4;
  part.channels = "ARM_.*";
  part.excluded = ".*COMMAND";
  EXPECT_EQ(copyLog(path("a.lcmlog"), path("b.lcmlog"), part).messages, 3);
  EXPECT_THAT(readSeqs(path("b.lcmlog")), ElementsAre(2, 3, 4));
  part.channels = "[";
  EXPECT_THROW(copyLog(path("a.lcmlog"), path("c.lcmlog"), part), std::invalid_argument);
  EXPECT_FALSE(std::filesystem::exists(path("c.lcmlog")));
}

TEST_F(LogFiles, AMergeIsInOrderOfTime) {
  writeStates(path("a.lcmlog"), {0, 3, 4, 9});
  writeStates(path("b.lcmlog"), {1, 4, 5});
  writeStates(path("c.lcmlog"), {2});
  const auto result =
      mergeLogs({path("a.lcmlog"), path("b.lcmlog"), path("c.lcmlog")}, path("d.lcmlog"));
  EXPECT_EQ(result.messages, 8);
  EXPECT_THAT(readSeqs(path("d.lcmlog")), ElementsAre(0, 1, 2, 3, 4, 4, 5, 9));
}

TEST_F(LogFiles, AMergeOfNoLogIsRefused) {
  EXPECT_THROW(mergeLogs({}, path("a.lcmlog")), std::invalid_argument);
  EXPECT_FALSE(std::filesystem::exists(path("a.lcmlog")));
}

TEST_F(LogFiles, NoLogIsOverwritten) {
  writeStates(path("a.lcmlog"), {0, 1});
  EXPECT_THROW(copyLog(path("a.lcmlog"), path("a.lcmlog")), std::invalid_argument);
  EXPECT_THROW(mergeLogs({path("a.lcmlog")}, path("a.lcmlog")), std::invalid_argument);
  EXPECT_THAT(readSeqs(path("a.lcmlog")), ElementsAre(0, 1));
}

class Exports : public LogFiles {
 protected:
  void SetUp() override {
    LogFiles::SetUp();
    LogWriter writer(path("a.lcmlog"));
    for (int i = 0; i < 3; ++i) {
      swing_plan_t plan{};
      plan.seq = i;
      plan.strategy = "a \"b\", c";
      plan.plan_ms = 0.1 * i;
      plan.landing[0] = std::nan("");
      plan.n_parameters = i;
      plan.parameter_names.assign(static_cast<std::size_t>(i), "p");
      plan.parameters.assign(static_cast<std::size_t>(i), 1.5);
      write(writer, "SWING_PLAN", plan, 1000 + i);
    }
    writer.write("RAW", "abc", 3, 2000);
  }
  std::vector<std::string> table(ExportOptions options) const {
    std::ostringstream csv;
    exportCsv(path("a.lcmlog"), options, messaging::TypeLibrary(), csv);
    return lines(csv.str());
  }
};

TEST_F(Exports, NumbersComeBackExactlyAndTextsAreQuoted) {
  EXPECT_THAT(table({"SWING_PLAN", {"plan_ms", "strategy", "landing[0]"}}),
              ElementsAre("recv_utime,plan_ms,strategy,landing[0]", "1000,0,\"a \"\"b\"\", c\",nan",
                          "1001,0.1,\"a \"\"b\"\", c\",nan", "1002,0.2,\"a \"\"b\"\", c\",nan"));
}

TEST_F(Exports, AnArrayHasAsManyColumnsAsItsLongest) {
  EXPECT_THAT(table({"SWING_PLAN", {"parameters", "seq"}}),
              ElementsAre("recv_utime,parameters[0],parameters[1],seq", "1000,,,0", "1001,1.5,,1",
                          "1002,1.5,1.5,2"));
}

TEST_F(Exports, AllFieldsAreTheDefault) {
  const auto all = table({"SWING_PLAN", {}});
  EXPECT_THAT(all.at(0), testing::StartsWith("recv_utime,utime,seq,plan_id,strategy,status"));
  EXPECT_THAT(all.at(0), HasSubstr(",parameter_names[1]"));
  EXPECT_EQ(all.size(), 4U);
}

TEST_F(Exports, OnlyTheTimesAskedFor) {
  EXPECT_THAT(table({"SWING_PLAN", {"seq"}, 1e-6, 1.5e-6}),
              ElementsAre("recv_utime,seq", "1001,1"));
}

TEST_F(Exports, WhatIsNotThereIsRefusedByName) {
  const auto refusal = [&](const ExportOptions& options) {
    try {
      table(options);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(refusal({"SWING_PLAN", {"plan"}}),
              testing::AllOf(HasSubstr("'plan'"), HasSubstr("plan_ms")));
  EXPECT_THAT(refusal({"SWING_PLAN", {"landing[2]"}}), HasSubstr("'landing[2]'"));
  EXPECT_THAT(refusal({"RAW", {}}), HasSubstr("'RAW'"));
}

}  // namespace
}  // namespace fastball::logger
