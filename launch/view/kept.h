#pragma once

#include <cstdint>
#include <deque>
#include <utility>

namespace fastball::view {

/// Things in the order in which they came, numbered 0, 1, 2, ...; of more than `limit` the oldest are forgotten.
template <class T>
class Kept {
 public:
  explicit Kept(std::size_t limit) : limit_(limit) {}

  void push(T thing) {
    things_.push_back(std::move(thing));
    while (things_.size() > limit_)
      dropFirst();
  }
  void dropFirst() {
    things_.pop_front();
    ++first_;
  }
  /// Number of the oldest that is kept.
  int64_t first() const { return first_; }
  /// Number that the next one will have.
  int64_t end() const { return first_ + static_cast<int64_t>(things_.size()); }
  bool empty() const { return things_.empty(); }
  const T& back() const { return things_.back(); }
  /// The thing numbered `i`, or null if it is not kept.
  const T* at(int64_t i) const {
    return i < first_ || i >= end() ? nullptr : &things_[static_cast<std::size_t>(i - first_)];
  }

 private:
  std::deque<T> things_;
  std::size_t limit_;
  int64_t first_ = 0;
};

}  // namespace fastball::view
