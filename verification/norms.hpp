#pragma once

#include <cmath>

namespace furrow {

/// Norms of an error over points of equal weight: mean |e|, root mean square, largest |e|. A NaN anywhere is a NaN in all three.
class Norms {
 public:
  void add(double e) {
    const double magnitude = std::abs(e);
    sum_ += magnitude;
    squares_ += magnitude * magnitude;
    if (!(magnitude <= largest_) && !std::isnan(largest_)) largest_ = magnitude;
    ++count_;
  }
  double L1() const { return sum_ / count_; }
  double L2() const { return std::sqrt(squares_ / count_); }
  double Linf() const { return count_ > 0.0 ? largest_ : sum_ / count_; }

 private:
  double sum_ = 0.0, squares_ = 0.0, largest_ = 0.0, count_ = 0.0;   // of no points at all, every norm is NaN
};

}  // namespace furrow
