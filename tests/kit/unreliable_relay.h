#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>

namespace fastball::test_kit {

/// What a bad network does to messages: each of these befalls the given share of them, 0 to 1.
struct Mischief {
  double lost = 0;
  double duplicated = 0;
  double reordered = 0;  ///< held back until the next message has passed
  double delay = 0;      ///< [s], of every message
  uint64_t seed = 1;
};

/// Joins two LCM networks as a bad cable would: what is said on one is said on the other, but for the mischief.
/// Works on a thread of its own from construction to destruction.
class UnreliableRelay {
 public:
  UnreliableRelay(const std::string& url_a, const std::string& url_b, const Mischief& mischief);
  ~UnreliableRelay();
  UnreliableRelay(const UnreliableRelay&) = delete;
  UnreliableRelay& operator=(const UnreliableRelay&) = delete;

  /// Lets nothing pass while it is cut.
  void cut(bool is_cut) { cut_ = is_cut; }
  int64_t passed() const { return passed_; }
  int64_t lost() const { return lost_; }

 private:
  void work(const std::string& url_a, const std::string& url_b, const Mischief& mischief);

  std::atomic<bool> cut_ = false, end_ = false;
  std::atomic<int64_t> passed_ = 0, lost_ = 0;
  std::thread thread_;
};

}  // namespace fastball::test_kit
