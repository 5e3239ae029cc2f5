#pragma once

#include <cmath>

namespace furrow::kernel_cases {

/// Largest magnitude that was added; NaN when one of them was NaN (std::max would lose it).
struct Largest {
  double magnitude = 0.0;
  void add(double e) {
    if (!(std::abs(e) <= magnitude) && !std::isnan(magnitude)) magnitude = std::abs(e);
  }
};

}  // namespace furrow::kernel_cases
