#include "tests/fuzz/node_target.h"
#include "vision_tracker/node.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace fastball;
  static fuzz::NodeTarget target("vision_tracker", 500, [](auto& endpoint, const auto& clock) {
    messaging::ProcessOptions options;
    options.config = fuzz::experimentPath();
    return vision_tracker::makeNode(endpoint, clock, options);
  });
  target.hear(data, size);
  return 0;
}
