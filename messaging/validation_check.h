#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "messaging/validation.h"

namespace fastball::messaging {

/// Checks the fields of one message one after the other and keeps the first fault.
class Check {
 public:
  explicit Check(const char* channel) : channel_(channel) {}

  std::optional<std::string> fault() const { return fault_; }

  /// Every message has a time and a number, neither negative.
  template <class T>
  Check& stamp(const T& message) {
    return notNegative("utime", message.utime).notNegative("seq", message.seq);
  }

  Check& finite(const char* field, double value) {
    if (!fault_ && !std::isfinite(value))
      fail("{} is {}", field, value);
    return *this;
  }
  template <std::size_t N>
  Check& finite(const char* field, const double (&values)[N]) {
    return finiteArray(field, values, N);
  }
  template <std::size_t N, std::size_t M>
  Check& finite(const char* field, const double (&values)[N][M]) {
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j < M; ++j) {
        if (!fault_ && !std::isfinite(values[i][j])) {
          fail("{}[{}][{}] is {}", field, i, j, values[i][j]);
        }
      }
    }
    return *this;
  }
  Check& finite(const char* field, const std::vector<double>& values) {
    return finiteArray(field, values.data(), values.size());
  }

  /// Finite and no further from zero than `limit`.
  template <std::size_t N>
  Check& bounded(const char* field, const double (&values)[N], double limit) {
    finite(field, values);
    for (std::size_t i = 0; i < N; ++i) {
      if (!fault_ && std::abs(values[i]) > limit)
        fail("{}[{}] is {}, beyond {}", field, i, values[i], limit);
    }
    return *this;
  }

  /// For counts, identities and times.
  Check& notNegative(const char* field, int64_t value) { return atLeast(field, value, int64_t{0}); }
  Check& enumeration(const char* field, int value, int first, int last) {
    return within(field, value, first, last);
  }
  /// Not a number fails as well.
  template <class Number>
  Check& atLeast(const char* field, Number value, Number low) {
    if (!fault_ && !(value >= low))
      fail("{} is {}, below {}", field, value, low);
    return *this;
  }
  template <class Number>
  Check& within(const char* field, Number value, Number low, Number high) {
    if (!fault_ && !(value >= low && value <= high)) {
      fail("{} is {}, not in {} .. {}", field, value, low, high);
    }
    return *this;
  }
  /// Finite and not negative.
  Check& positiveOrZero(const char* field, double value) {
    return finite(field, value).atLeast(field, value, 0.0);
  }
  template <std::size_t N>
  Check& positiveOrZero(const char* field, const double (&values)[N]) {
    finite(field, values);
    for (std::size_t i = 0; i < N; ++i) {
      if (!fault_ && values[i] < 0)
        fail("{}[{}] is {}, below 0", field, i, values[i]);
    }
    return *this;
  }
  /// Finite and greater than zero.
  Check& positive(const char* field, double value) {
    finite(field, value);
    if (!fault_ && value <= 0)
      fail("{} is {}, must be above 0", field, value);
    return *this;
  }

  /// Variance, covariance, variance: a 2x2 matrix without negative variances.
  Check& covariance(const char* field, const double (&c)[3]) {
    finite(field, c);
    if (!fault_ && (c[0] < 0 || c[2] < 0))
      fail("{} has a negative variance", field);
    return *this;
  }
  Check& unit(const char* field, const double (&n)[3]) {
    finite(field, n);
    const double norm = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (!fault_ && std::abs(norm - 1) > 1e-6)
      fail("{} has length {}, must be 1", field, norm);
    return *this;
  }

  Check& name(const char* field, const std::string& text) {
    if (!fault_ && text.empty())
      fail("{} is empty", field);
    return this->text(field, text, kNameBytes);
  }
  /// A name, or nothing.
  Check& shortText(const char* field, const std::string& text) {
    return this->text(field, text, kNameBytes);
  }
  Check& sentence(const char* field, const std::string& text) {
    return this->text(field, text, kSentenceBytes);
  }

  /// A vector must be as long as the message says.
  Check& length(const char* field, std::size_t length, const char* count_field, int64_t count) {
    if (!fault_ && static_cast<int64_t>(length) != count) {
      fail("{} has {} elements but {} is {}", field, length, count_field, count);
    }
    return *this;
  }

  template <class... Values>
  void fail(const char* format, const Values&... values) {
    fault_ = fmt::format("{}: {}", channel_, fmt::format(fmt::runtime(format), values...));
  }
  bool good() const { return !fault_; }

 private:
  Check& finiteArray(const char* field, const double* values, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) {
      if (!fault_ && !std::isfinite(values[i]))
        fail("{}[{}] is {}", field, i, values[i]);
    }
    return *this;
  }
  Check& text(const char* field, const std::string& text, std::size_t limit) {
    if (!fault_ && text.size() > limit) {
      fail("{} has {} bytes, above the limit of {}", field, text.size(), limit);
    }
    // LCM writes a string up to its first zero, but sizes it by its length.
    if (!fault_ && text.find('\0') != std::string::npos)
      fail("{} contains a zero byte", field);
    return *this;
  }

  const char* channel_;
  std::optional<std::string> fault_;
};

}  // namespace fastball::messaging
