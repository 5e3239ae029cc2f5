#pragma once

#include <cmath>

namespace furrow::operator_cases {

/// The largest magnitude of what it is given; a NaN stays.
class Largest {
 public:
  void add(double e) {
    if (!(std::abs(e) <= value_) && !std::isnan(value_)) value_ = std::abs(e);
  }
  double value() const { return value_; }

 private:
  double value_ = 0.0;
};

}  // namespace furrow::operator_cases
