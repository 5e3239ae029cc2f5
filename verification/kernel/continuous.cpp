// A kernel as a function (paper Eq. 4; Monaghan & Lattanzio 1985, Morris, Fox & Zhu 1997, Wendland 1995): it integrates to one,
// is even, has the second moment that sets the smoothing error, ends at its support, is positive and falls; and the sign of its
// Fourier transform tells whether particles pair under it (Dehnen & Aly 2012).
#include <cmath>
#include <functional>
#include <string>

#include "reference/exact/kernels.hpp"
#include "reference/exact/quadrature.hpp"
#include "solver/smoothing/kernels.hpp"
#include "verification/kernel/largest.hpp"
#include "verification/kernel/problems.hpp"

namespace furrow::kernel_cases {
namespace {

constexpr int samples = 2000;                        // of r over the support
constexpr double kh_max = 16.0, kh_step = 0.05;      // of the transform; the splines are at their lowest below kh = 9

/// The solver's kernel at one h: W(r), 1/m^d, and dW/dr, 1/m^(d+1).
struct Accused {
  std::function<double(double)> W, dW;
  double radius;
};

Accused accused(const std::string& name, int dimension, double h) {
  const auto in = [&]<int Dim>(std::integral_constant<int, Dim>) {
    return std::visit(
        [h](auto k) -> Accused {
          using K = decltype(k);
          return {.W = [h](double r) { return value<K, Dim>(r, h); },
                  .dW = [h](double r) { return derivative<K, Dim>(r, h); },
                  .radius = K::support * h};
        },
        *kernel_by_name(name));
  };
  if (dimension == 1) return in(std::integral_constant<int, 1>{});
  if (dimension == 2) return in(std::integral_constant<int, 2>{});
  return in(std::integral_constant<int, 3>{});
}

void measure_moments(Run& run, const Accused& solver, const exact::Kernel& truth, double h) {
  const exact::Moments moments = exact::moments(solver.W, solver.radius, truth.dimension());
  run.measure("unit_integral", moments.zeroth);
  run.measure("first_moment", moments.first / h);
  run.measure("second_moment", moments.second / (h * h), "1", {truth.second_moment(), 0.0});
}

/// Value and slope against the textbook polynomial, the slope also against the value that it must integrate to; sign and support.
void measure_shape(Run& run, const Accused& solver, const exact::Kernel& truth, double h) {
  const double W0 = truth.value(0.0, h), slope0 = W0 / h, to_value = std::pow(h, truth.dimension()), to_slope = to_value * h;
  Series W_solver{.label = "solver"}, W_truth{.label = "textbook polynomial", .role = "reference"};
  Series dW_solver = W_solver, dW_truth = W_truth;
  Largest value_error, slope_error, integral_error, outside;
  long not_positive = 0, not_falling = 0;
  double tail = 0.0;
  for (int i = samples - 1; i >= 0; --i) {   // inwards: the integral of the slope begins at the edge of the support
    const double dr = solver.radius / samples, r = i * dr, W = solver.W(r), dW = solver.dW(r);
    value_error.add((W - truth.value(r, h)) / W0);
    slope_error.add((dW - truth.derivative(r, h)) / slope0);
    tail -= exact::integrate(solver.dW, r, r + dr, 1e-16 * W0);
    integral_error.add((W - tail) / W0);
    if (!(W > 0.0)) ++not_positive;
    if (i > 0 && !(dW < 0.0 && W < solver.W(r - dr))) ++not_falling;
    if (i % 20 != 0) continue;
    W_solver.x.push_back(r / h), W_solver.y.push_back(W * to_value);
    dW_solver.x.push_back(r / h), dW_solver.y.push_back(dW * to_slope);
    W_truth.x.push_back(r / h), W_truth.y.push_back(truth.value(r, h) * to_value);
    dW_truth.x.push_back(r / h), dW_truth.y.push_back(truth.derivative(r, h) * to_slope);
  }
  for (int i = 0; i <= samples; ++i) {
    const double r = solver.radius * (1.0 + 1e-12 + 2.0 * i / samples);
    outside.add(solver.W(r) / W0);
    outside.add(solver.dW(r) / slope0);
  }
  run.measure("value", value_error.magnitude);
  run.measure("derivative", slope_error.magnitude);
  run.measure("derivative_integral", integral_error.magnitude);
  run.measure("outside_support", outside.magnitude);
  run.measure("not_positive", static_cast<double>(not_positive));
  run.measure("not_falling", static_cast<double>(not_falling));

  Figure& shape = run.figure({.name = "shape", .title = "Kernel", .x = {"r/h"}, .y = {"W h^d"}});
  shape.caption = "The kernel over the distance, made dimensionless with the smoothing length.";
  shape.series = {W_solver, W_truth};
  Figure& slope = run.figure({.name = "slope", .title = "Slope of the kernel", .x = {"r/h"}, .y = {"dW/dr h^(d+1)"}});
  slope.caption =
      "Its derivative: the weight of a pair in every gradient. Nearer than its steepest point, a force between two "
      "particles falls as they approach.";
  slope.series = {dW_solver, dW_truth};
}

/// What theory says: Wendland's transforms are positive, those of even-order B-splines on the line are even powers of sinc; in
/// space the B-splines' derivative form changes sign with sinc; in the plane another road of quadrature gives the number.
exact::NegativePart negative_part_in_theory(const exact::Kernel& truth, const std::string& name) {
  if (truth.dimension() == 1 || name.starts_with("wendland")) return {};
  const int order = name == "cubic_spline" ? 4 : 6;
  const auto F = [&](double k) {
    if (truth.dimension() == 3) return exact::b_spline_transform(order, 3, k);
    return exact::fourier_transform_by_projection(truth, k);
  };
  return exact::negative_part(F, kh_max, kh_step);
}

void measure_transform(Run& run, const Accused& solver, const exact::Kernel& truth, const std::string& name, double h) {
  const auto F = [&](double kh) { return exact::fourier_transform(solver.W, solver.radius, truth.dimension(), kh / h); };
  const exact::NegativePart found = exact::negative_part(F, kh_max, kh_step), theory = negative_part_in_theory(truth, name);
  run.measure("fourier_minimum", found.deepest, "1", {theory.deepest, 0.0});
  if (theory.found) run.measure("fourier_negative_from", found.begins, "1", {theory.begins, 0.0});

  Figure& figure = run.figure({.name = "transform", .title = "Fourier transform", .x = {"k h"}, .y = {"|F|"}, .log_y = true});
  figure.caption = "Where the transform is negative, particles may gain by pairing.";
  Series positive{.label = "F > 0"}, negative{.label = "F < 0"};
  for (double kh = kh_step; kh <= kh_max; kh += kh_step) {
    const double f = F(kh);
    if (std::abs(f) < 1e-12) continue;   // below the error of the quadrature the sign means nothing
    Series& side = f > 0.0 ? positive : negative;
    side.x.push_back(kh), side.y.push_back(std::abs(f));
  }
  figure.kind = "points";
  figure.series = {positive, negative};
}

}  // namespace

Problem continuous(const Parameters& input) {
  const std::string name = input.choice("kernel", kernel_names());
  const int dimension = static_cast<int>(input.integer("dimension", 1, 3));
  const double h = input.quantity("smoothing_length", dimension::length, range::positive);
  return [=](Run& run) {
    const Accused solver = accused(name, dimension, h);
    const exact::Kernel truth = exact::kernel(name, dimension);
    run.exercises("smoothing/" + name);
    measure_moments(run, solver, truth, h);
    measure_shape(run, solver, truth, h);
    measure_transform(run, solver, truth, name, h);
  };
}

}  // namespace furrow::kernel_cases
