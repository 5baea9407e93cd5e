#include "bench/campaign_rows.h"
#include "bench/contact_rows.h"
#include "bench/key_rows.h"
#include "bench/launch_rows.h"
#include "bench/logger_rows.h"
#include "bench/messaging_rows.h"
#include "bench/model_rows.h"
#include "bench/plan_rows.h"
#include "bench/reach_rows.h"
#include "bench/report_rows.h"
#include "bench/robust_rows.h"
#include "bench/row.h"
#include "bench/run_rows.h"
#include "bench/scene_rows.h"
#include "bench/spy_rows.h"
#include "bench/view_rows.h"
#include "bench/vision_rows.h"

namespace fastball::bench {

std::vector<Benchmark> allBenchmarks() {
  std::vector<Benchmark> all;
  for (const auto& some :
       {runBenchmarks(), modelBenchmarks(), messagingBenchmarks(), keyBenchmarks(),
        loggerBenchmarks(), spyBenchmarks(), viewBenchmarks(), launchBenchmarks(),
        sceneBenchmarks(), visionBenchmarks(), contactBenchmarks(), planBenchmarks(),
        reachBenchmarks(), robustBenchmarks(), campaignBenchmarks(), reportBenchmarks()}) {
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

}  // namespace fastball::bench
