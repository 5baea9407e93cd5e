// `fastball bench`: a row that makes `fastball` run, and what cannot be asked for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/system/fastball_run.h"

namespace fastball::system_test {
namespace {

using testing::HasSubstr;

TEST(BenchProgram, MeasuresARowWithTheFastballBesideIt) {
  const Outcome outcome = fastball({"bench", "--filter", "^run.plan_ms$"});
  EXPECT_EQ(outcome.exit_status, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("| run.plan_ms | "));
}

TEST(BenchProgram, SaysThatThereIsNoSuchRow) {
  const Outcome outcome = fastball({"bench", "--filter", "nothing"});
  EXPECT_EQ(outcome.exit_status, 2);
  EXPECT_THAT(outcome.output, HasSubstr("--filter nothing: no row has such an id"));
}

}  // namespace
}  // namespace fastball::system_test
