#include "hand_server/node.h"
#include "tests/fuzz/node_target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace fastball;
  static bool realtime = false;
  static fuzz::NodeTarget target("hand_server", 500, [](auto& endpoint, const auto& clock) {
    messaging::ProcessOptions options;
    options.config = fuzz::experimentPath();
    options.realtime = realtime = !realtime;
    return hand_server::makeNode(endpoint, clock, options);
  });
  target.hear(data, size);
  return 0;
}
