#include <filesystem>

#include <unistd.h>

#include "logger/node.h"
#include "tests/fuzz/node_target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace fastball;
  static const std::string path =
      std::filesystem::temp_directory_path() / ("fastball-fuzz-" + std::to_string(getpid()));
  static fuzz::NodeTarget target("logger", 2000, [](auto& endpoint, const auto& clock) {
    std::filesystem::remove(path);
    logger::LoggerOptions options;
    options.recorder.path = path;
    options.recorder.buffer_bytes = 1 << 20;
    return logger::makeNode(endpoint, clock, options);
  });
  target.hear(data, size);
  return 0;
}
