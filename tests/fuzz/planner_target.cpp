#include "planner/node.h"
#include "tests/fuzz/node_target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace fastball;
  static fuzz::NodeTarget target("planner", 10000, [](auto& endpoint, const auto& clock) {
    messaging::ProcessOptions options;
    options.config = fuzz::experimentPath();
    return planner::makeNode(endpoint, clock, options);
  });
  target.hear(data, size);
  return 0;
}
