#include "reference/exact/plane_wave.hpp"

#include <cmath>
#include <stdexcept>

namespace furrow::exact {
namespace {

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

}  // namespace

PlaneWaveFactors plane_wave_factors(std::string_view name, const Kernel& kernel, double h_over_dx, const Point& k) {
  const Lattice points = lattice(name, kernel.support() * h_over_dx);
  PlaneWaveFactors factors;
  for (const Point& x : points.points) {
    const double r = std::sqrt(dot(x, x));
    factors.value += points.volume * kernel.value(r, h_over_dx) * std::cos(dot(k, x));
    if (r > 0.0) factors.gradient -= points.volume * kernel.derivative(r, h_over_dx) / r * dot(k, x) / dot(k, k) * std::sin(dot(k, x));
  }
  return factors;
}

DisorderLevels disorder_levels(std::string_view name, const Kernel& kernel, double h_over_dx, double fraction) {
  if (kernel.dimension() != 2) throw std::invalid_argument("levels of disorder are for lattices of the plane");
  const Lattice points = lattice(name, kernel.support() * h_over_dx);
  const LatticeNorms perfect = lattice_norms(name, kernel, h_over_dx);
  const double variance = fraction * fraction / 3.0;   // of a move along one axis, in squared spacings
  // The sum of x (x) grad W changes with the place of a neighbour by d(x_a dW/dx_b)/dx_c; its own move adds nothing, because
  // those slopes cancel over the lattice. A direction sees half of the squares of all four components.
  const double step = 1e-5;
  const auto term = [&](double x, double y, int a, int b) {
    const double r = std::hypot(x, y);
    return kernel.derivative(r, h_over_dx) / r * (a == 0 ? x : y) * (b == 0 ? x : y);
  };
  double value = std::pow(perfect.unity - 1.0, 2), gradient = std::pow(perfect.gradient - 1.0, 2);
  for (const Point& x : points.points) {
    const double r = std::sqrt(dot(x, x));
    if (r == 0.0) continue;
    value += variance * std::pow(points.volume * kernel.derivative(r, h_over_dx), 2);
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b) {
        const double along_x = (term(x[0] + step, x[1], a, b) - term(x[0] - step, x[1], a, b)) / (2.0 * step);
        const double along_y = (term(x[0], x[1] + step, a, b) - term(x[0], x[1] - step, a, b)) / (2.0 * step);
        gradient += 0.5 * variance * std::pow(points.volume, 2) * (along_x * along_x + along_y * along_y);
      }
  }
  return {std::sqrt(value), std::sqrt(gradient)};
}

}  // namespace furrow::exact
