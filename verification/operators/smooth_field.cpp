// A manufactured field, f = sin(kx) cos(ky) in a periodic square of one wave, on ever finer particles at fixed h/dx (Quinlan, Basa &
// Lastiwka 2006). Smoothing leaves an error (1/2) <x^2> laplacian f that falls as h^2; the sum in place of the integral leaves one
// that depends on dx/h alone, so that errors fall at order two and then stand still. Corrected gradients do not stand still.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "harness/norms.hpp"
#include "reference/exact/plane_wave.hpp"
#include "solver/schemes/density.hpp"
#include "solver/schemes/kernel_correction.hpp"
#include "solver/schemes/velocity_gradient.hpp"
#include "verification/lattices.hpp"
#include "verification/operators/problems.hpp"

namespace furrow::operator_cases {
namespace {

struct Setup {
  std::string kernel;
  double length;   // of the square and of the wave, m
  double k() const { return 2.0 * std::numbers::pi / length; }
};

struct Field {
  double k;
  double value(const Vector<2>& x) const { return std::sin(k * x[0]) * std::cos(k * x[1]); }
  Vector<2> slope(const Vector<2>& x) const {
    return {k * std::cos(k * x[0]) * std::cos(k * x[1]), -k * std::sin(k * x[0]) * std::sin(k * x[1])};
  }
};

struct Errors {
  FieldNorms interpolation, gradient, corrected;   // relative to the same norm of the exact field
};

Points<2> square_of(const Setup& s, double spacing) {
  const int cells = static_cast<int>(std::lround(s.length / spacing));
  if (std::abs(cells * spacing - s.length) > 1e-9 * s.length)
    throw std::invalid_argument("the periodic square must be a whole number of spacings");
  return square_lattice<2>({cells, cells}, spacing, true);
}

Errors errors(const Arrangement<2>& a, const AnyKernel& kernel, double h, const Field& field) {
  const std::size_t n = a.particles.size();
  const Stencil<2> stencil = a.stencil(kernel, h);
  const std::vector<double> V = a.volume();
  std::vector<double> exact(n), interpolated(n), steepness(n), miss(n), corrected_miss(n);
  std::vector<Vector<2>> slope(n), corrected(n);
  std::vector<Matrix<2>> B(n);
  for (std::size_t i = 0; i < n; ++i) exact[i] = field.value(a.particles.position[i]);
  interpolate<2>(stencil, V, exact, interpolated);
  kernel_correction<2>(stencil, V, B);
  gradient<2>(stencil, V, exact, {}, slope);
  gradient<2>(stencil, V, exact, B, corrected);
  for (std::size_t i = 0; i < n; ++i) {
    const Vector<2> truth = field.slope(a.particles.position[i]);
    steepness[i] = truth.norm();
    miss[i] = (slope[i] - truth).norm();
    corrected_miss[i] = (corrected[i] - truth).norm();
  }
  const FieldNorms scale = norms(steepness, V);
  const auto relative = [&scale](FieldNorms e) { return FieldNorms{e.l1 / scale.l1, e.l2 / scale.l2, e.linf / scale.linf}; };
  return {relative_error_norms(interpolated, exact, V), relative(norms(miss, V)), relative(norms(corrected_miss, V))};
}

void show(Run& run, const Arrangement<2>& a, const Field& field) {
  Figure& figure = run.figure({.name = "field", .title = "The field on the particles", .kind = "particles", .x = {"x", "mm"}, .y = {"y", "mm"},
                               .colour = {"f"}});
  figure.caption = "f = sin(kx) cos(ky), one wave in a periodic square.";
  Series& series = figure.add({.label = "particles"});
  for (const Vector<2>& x : a.particles.position)
    series.x.push_back(1e3 * x[0]), series.y.push_back(1e3 * x[1]), series.colour.push_back(field.value(x));
}

Setup read(const Parameters& input) {
  return {input.choice("kernel", kernel_names()), input.quantity("length", dimension::length, range::positive)};
}

void exercise(Run& run, const Setup& s, const Arrangement<2>& a) {
  for (const char* module : {"density", "velocity_gradient", "kernel_correction"}) run.exercises(std::string("schemes/") + module);
  run.exercises("smoothing/" + s.kernel);
  run.count(0, static_cast<long>(a.particles.size()));
}

void measure(Run& run, const Errors& e) {
  run.measure("interpolation_l2", e.interpolation.l2);
  run.measure("interpolation_linf", e.interpolation.linf);
  run.measure("gradient_l2", e.gradient.l2);
  run.measure("gradient_linf", e.gradient.linf);
  run.measure("corrected_gradient_l2", e.corrected.l2);
  run.measure("corrected_gradient_linf", e.corrected.linf);
}

}  // namespace

Problem smooth_field(const Parameters& input) {
  const Setup setup = read(input);
  return [=](Run& run) {
    const double dx = run.resolution().spacing, ratio = run.resolution().smoothing_ratio, h = ratio * dx;
    const AnyKernel kernel = *kernel_by_name(setup.kernel);
    const Field field{setup.k()};
    const Arrangement<2> a = arranged(square_of(setup, dx), 1000.0, support(kernel) * h * (1.0 + 1e-9));
    exercise(run, setup, a);
    if (a.particles.size() <= 3000) show(run, a, field);
    const Errors e = errors(a, kernel, h, field);

    // The field is made of waves along the diagonals, so that each sum multiplies it by a number.
    const exact::Kernel truth = exact::kernel(setup.kernel, 2);
    const exact::PlaneWaveFactors f = exact::plane_wave_factors("square", truth, ratio, {setup.k() * dx, setup.k() * dx, 0.0});
    const double norm = exact::lattice_norms("square", truth, ratio).gradient;
    const double interpolation = std::abs(1.0 - f.value), gradient = std::abs(1.0 - f.gradient), corrected = std::abs(1.0 - f.gradient / norm);
    measure(run, e);
    const auto deviation = [](const FieldNorms& error, double expected) {
      return std::max(std::abs(error.l2 - expected), std::abs(error.linf - expected));
    };
    run.measure("interpolation_theory", deviation(e.interpolation, interpolation));
    run.measure("gradient_theory", deviation(e.gradient, gradient));
    run.measure("corrected_gradient_theory", deviation(e.corrected, corrected));
    run.measure("lattice_error", std::abs(norm - 1.0));

    const double smoothing = 0.5 * truth.second_moment() * 2.0 * std::pow(setup.k() * h, 2);   // (1/2) <x^2> |k|^2, |k|^2 = 2 k^2
    run.measure("smoothing_coefficient", e.corrected.l2 / smoothing, "1", {1.0, 0.0});
  };
}

Problem disordered_field(const Parameters& input) {
  const Setup setup = read(input);
  const double fraction = input.number("jitter", {0.0, 0.3, true, false});
  const auto seed = static_cast<std::uint64_t>(input.integer("seed", 0, 1'000'000));
  return [=](Run& run) {
    const double dx = run.resolution().spacing, ratio = run.resolution().smoothing_ratio, h = ratio * dx;
    const AnyKernel kernel = *kernel_by_name(setup.kernel);
    const Field field{setup.k()};
    const Arrangement<2> a = arranged(jittered(square_of(setup, dx), fraction, seed), 1000.0, support(kernel) * h * (1.0 + 1e-9));
    exercise(run, setup, a);
    if (a.particles.size() <= 3000) show(run, a, field);
    const Errors e = errors(a, kernel, h, field);
    const exact::DisorderLevels levels = exact::disorder_levels("square", exact::kernel(setup.kernel, 2), ratio, fraction);
    measure(run, e);
    run.measure("interpolation_level", e.interpolation.l2, "1", {levels.value, 0.0});
    run.measure("gradient_level", e.gradient.l2, "1", {levels.gradient, 0.0});
  };
}

}  // namespace furrow::operator_cases
