// Drives a fuzz target without libFuzzer: TARGET FOLDER RUNS says every seed of the folder, and RUNS mutations of them. The same
// every time for the same seeds.
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size);
/// Where a target has its own.
extern "C" __attribute__((weak)) std::size_t LLVMFuzzerCustomMutator(uint8_t* data,
                                                                     std::size_t size,
                                                                     std::size_t max_size,
                                                                     unsigned seed);

namespace {

using Bytes = std::vector<uint8_t>;
constexpr std::size_t kLongestInput = 1 << 17;
constexpr unsigned kPatience = 60;  // [s], for one input
[[maybe_unused]] constexpr rlim_t kMemory =
    rlim_t{4} << 30;  // of addresses; what believes a length needs more
std::minstd_rand random_bytes(1);

/// The address sanitizer reserves terabytes of addresses, and has a limit of its own for one allocation.
void limitMemory() {
#ifndef __SANITIZE_ADDRESS__
  const rlimit memory{kMemory, kMemory};
  setrlimit(RLIMIT_AS, &memory);
#endif
}

std::vector<Bytes> seedsIn(const std::string& folder) {
  std::vector<std::string> paths;
  for (const auto& file : std::filesystem::directory_iterator(folder))
    paths.push_back(file.path().string());
  std::sort(paths.begin(), paths.end());
  std::vector<Bytes> seeds;
  for (const std::string& path : paths) {
    std::ifstream file(path, std::ios::binary);
    seeds.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return seeds;
}

}  // namespace

/// A few bytes changed, taken out or put in.
extern "C" std::size_t LLVMFuzzerMutate(uint8_t* data, std::size_t size, std::size_t max_size) {
  if (size == 0)
    return 0;
  uint8_t* const at = data + random_bytes() % size;
  switch (random_bytes() % 4) {
    case 0:
      std::copy(at + 1, data + size, at);
      return size - 1;
    case 1:
      if (size == max_size)
        return size;
      std::copy_backward(at, data + size, data + size + 1);
      *at = static_cast<uint8_t>(random_bytes());
      return size + 1;
    case 2:
      *at ^= static_cast<uint8_t>(1U << random_bytes() % 8);
      return size;
    default:
      *at = static_cast<uint8_t>(random_bytes());
      return size;
  }
}

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s FOLDER RUNS\n", argv[0]);
    return 2;
  }
  const std::vector<Bytes> seeds = seedsIn(argv[1]);
  if (seeds.empty()) {
    std::fprintf(stderr, "no seeds in %s\n", argv[1]);
    return 2;
  }
  limitMemory();
  for (const Bytes& seed : seeds)
    LLVMFuzzerTestOneInput(seed.data(), seed.size());
  const int runs = std::atoi(argv[2]);
  for (int i = 0; i < runs; ++i) {
    alarm(kPatience);
    Bytes input = seeds[random_bytes() % seeds.size()];
    std::size_t size = input.size();
    input.resize(std::max(kLongestInput, size));
    const auto times = 1 + random_bytes() % 4;
    for (unsigned k = 0; k < times; ++k) {
      size = LLVMFuzzerCustomMutator != nullptr
                 ? LLVMFuzzerCustomMutator(input.data(), size, input.size(), random_bytes())
                 : LLVMFuzzerMutate(input.data(), size, input.size());
    }
    LLVMFuzzerTestOneInput(input.data(), size);
  }
  std::printf("%zu seeds and %d mutations of them are outlived\n", seeds.size(), runs);
}
