#include "validation/column-collapse/surface.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace furrow::column_collapse_cases {

Surface surface_of(const std::vector<double>& centres, double volume, double spacing, double step) {
  if (!(spacing > 0.0 && step > 0.0)) throw std::invalid_argument("spacing and step must be positive");
  double far = 0.0;
  for (const double x : centres) far = std::max(far, x + 0.5 * spacing);
  const auto places = static_cast<std::size_t>(std::ceil(far / step + 0.5)) + 1;
  Surface s;
  for (std::size_t k = 0; k < places; ++k) {
    s.x.push_back(static_cast<double>(k) * step);
    s.h.push_back(0.0);
  }
  for (const double x : centres) {
    const double left = std::max(0.0, x - 0.5 * spacing), right = x + 0.5 * spacing;
    if (right <= left) continue;
    const auto first = static_cast<std::size_t>(left / step + 0.5);
    for (std::size_t k = first; k < places; ++k) {
      const double low = std::max(0.0, s.x[k] - 0.5 * step), high = s.x[k] + 0.5 * step;
      if (low >= right) break;
      const double overlap = std::max(0.0, std::min(high, right) - std::max(low, left));
      s.h[k] += volume * overlap / (right - left) / (high - low);
    }
  }
  return s;
}

namespace {

/// Place of the fall between k and k + 1.
double crossing(const Surface& s, std::size_t k, double height) {
  return s.x[k] + (s.x[k + 1] - s.x[k]) * (s.h[k] - height) / (s.h[k] - s.h[k + 1]);
}

}  // namespace

double position_at(const Surface& s, double height) {
  if (s.h.empty() || s.h.front() < height) return 0.0;
  for (std::size_t k = 0; k + 1 < s.x.size(); ++k)
    if (s.h[k + 1] < height) return crossing(s, k, height);
  return s.x.back();
}

double farthest_at(const Surface& s, double height) {
  if (s.h.empty()) return 0.0;
  if (s.h.back() >= height) return s.x.back();
  for (std::size_t k = s.x.size() - 1; k-- > 0;)
    if (s.h[k] >= height) return crossing(s, k, height);
  return 0.0;
}

double height_at(const Surface& s, double x) {
  for (std::size_t k = 1; k < s.x.size(); ++k)
    if (x <= s.x[k]) return s.h[k - 1] + (s.h[k] - s.h[k - 1]) * (x - s.x[k - 1]) / (s.x[k] - s.x[k - 1]);
  return 0.0;
}

double distance(const Surface& surface, const Surface& reference, double end) {
  double squares = 0.0;
  int places = 0;
  for (std::size_t k = 0; k < surface.x.size() && surface.x[k] <= end; ++k, ++places)
    squares += std::pow(surface.h[k] - height_at(reference, surface.x[k]), 2);
  if (places == 0) throw std::invalid_argument("the surface has no place within the range");
  return std::sqrt(squares / places);
}

Surface extrapolated(const Surface& fine, const Surface& coarse, double lowest) {
  const double highest = std::min(fine.h.front(), coarse.h.front());
  std::vector<std::pair<double, double>> points;
  for (int k = 0; k < 100; ++k) {
    const double h = highest - (highest - lowest) * k / 99.0;
    points.emplace_back(2.0 * position_at(fine, h) - position_at(coarse, h), h);
  }
  std::stable_sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  Surface s;
  for (const auto& [x, h] : points) {
    if (!s.x.empty() && x - s.x.back() < 1e-9) continue;
    s.x.push_back(x);
    s.h.push_back(h);
  }
  return s;
}

}  // namespace furrow::column_collapse_cases
