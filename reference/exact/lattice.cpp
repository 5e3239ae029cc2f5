#include "reference/exact/lattice.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string>

namespace furrow::exact {
namespace {

struct Basis {
  int dimension;
  std::array<Point, 3> vectors;
  double volume;
};

Basis basis(std::string_view name) {
  const double s = std::numbers::sqrt2 / 2.0, t = std::numbers::sqrt3 / 2.0;
  if (name == "line") return {1, {{{1, 0, 0}, {0, 0, 0}, {0, 0, 0}}}, 1.0};
  if (name == "square") return {2, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 0}}}, 1.0};
  if (name == "hexagonal") return {2, {{{1, 0, 0}, {0.5, t, 0}, {0, 0, 0}}}, t};
  if (name == "cubic") return {3, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, 1.0};
  if (name == "fcc") return {3, {{{s, s, 0}, {s, 0, s}, {0, s, s}}}, s};
  throw std::invalid_argument("no lattice is called \"" + std::string(name) + "\"");
}

double length(const Point& x) { return std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]); }

Lattice lattice_for(std::string_view name, const Kernel& kernel, double h_over_dx) {
  if (basis(name).dimension != kernel.dimension()) {
    throw std::invalid_argument("lattice \"" + std::string(name) + "\" and kernel differ in dimension");
  }
  return lattice(name, kernel.support() * h_over_dx);
}

}  // namespace

Lattice lattice(std::string_view name, double radius) {
  const Basis b = basis(name);
  const int reach = static_cast<int>(std::ceil(2.0 * radius)) + 1;   // the flattest basis above has a height of 1/sqrt(2)
  const std::array<int, 3> n{reach, b.dimension > 1 ? reach : 0, b.dimension > 2 ? reach : 0};
  Lattice result{{}, b.volume};
  for (int i = -n[0]; i <= n[0]; ++i) {
    for (int j = -n[1]; j <= n[1]; ++j) {
      for (int k = -n[2]; k <= n[2]; ++k) {
        Point x{};
        for (std::size_t d = 0; d < 3; ++d) x[d] = i * b.vectors[0][d] + j * b.vectors[1][d] + k * b.vectors[2][d];
        if (length(x) < radius) result.points.push_back(x);
      }
    }
  }
  return result;
}

LatticeNorms lattice_norms(std::string_view name, const Kernel& kernel, double h_over_dx) {
  const Lattice points = lattice_for(name, kernel, h_over_dx);
  LatticeNorms norms;
  for (const Point& x : points.points) {
    const double r = length(x);
    norms.unity += points.volume * kernel.value(r, h_over_dx);
    if (r > 0.0) norms.gradient -= points.volume * kernel.derivative(r, h_over_dx) * x[0] * x[0] / r;
  }
  return norms;
}

double lattice_wave_speed(std::string_view name, const Kernel& kernel, double h_over_dx, double wavelength_over_dx) {
  const Lattice points = lattice_for(name, kernel, h_over_dx);
  const double k = 2.0 * std::numbers::pi / wavelength_over_dx;
  double sum = 0.0;
  for (const Point& x : points.points) {
    const double r = length(x);
    if (r > 0.0) sum += points.volume * kernel.derivative(r, h_over_dx) * x[0] / r * std::sin(k * x[0]);
  }
  return std::abs(sum) / k;
}

PairSums pair_sums(const std::vector<Point>& x, const std::vector<double>& volume, const Kernel& kernel, double h,
                   const Point& period) {
  const std::size_t n = x.size();
  if (volume.size() != n) throw std::invalid_argument("pair sums: as many volumes as points are needed");
  const double radius = kernel.support() * h;
  for (const double p : period) {
    if (p > 0.0 && p < 2.0 * radius) throw std::invalid_argument("pair sums: the period is shorter than twice the support");
  }
  PairSums sums{std::vector<double>(n), std::vector<Point>(n), std::vector<Matrix>(n)};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      Point to_j;
      for (std::size_t d = 0; d < 3; ++d) {
        to_j[d] = x[j][d] - x[i][d];
        if (period[d] > 0.0) to_j[d] -= period[d] * std::nearbyint(to_j[d] / period[d]);
      }
      const double r = length(to_j);
      if (r >= radius) continue;
      sums.unity[i] += volume[j] * kernel.value(r, h);
      if (r == 0.0) continue;
      const double slope = volume[j] * kernel.derivative(r, h) / r;
      for (std::size_t a = 0; a < 3; ++a) {
        sums.gradient[i][a] -= slope * to_j[a];
        for (std::size_t b = 0; b < 3; ++b) sums.first[i][a][b] -= slope * to_j[a] * to_j[b];
      }
    }
  }
  return sums;
}

}  // namespace furrow::exact
