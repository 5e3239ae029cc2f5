// One point of the solver's material along a path, and the independent law with the same constants.
#pragma once

#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include "harness/case.hpp"
#include "reference/exact/rate_laws.hpp"
#include "solver/materials/materials.hpp"

namespace furrow::material_point_cases {

MaterialState initial_state(const AnyMaterial& material);
MaterialState advance(const AnyMaterial& material, const MaterialState& state, const Increment& increment);

/// A step whose strain increment is known but for some components (index pairs i <= j): they are found so that `residual` of the
/// state at its end vanishes, by Newton's method. `strain` comes with a guess and goes with the answer.
/// Throws std::runtime_error when no root is found to 1e-11 of `scale`.
using Component = std::pair<int, int>;
using Residual = std::function<void(const MaterialState&, std::span<double>)>;
MaterialState solve_step(const AnyMaterial& material, const MaterialState& state, Increment& increment,
                         std::span<const Component> unknown, const Residual& residual, double scale);

/// The states at the samples of all legs; each leg in steps of strain at most `largest_step` (by the largest prescribed strain
/// rate or spin), as many as there are samples or a multiple.
std::vector<MaterialState> drive(const AnyMaterial& material, MaterialState state, const std::vector<exact::Leg>& legs,
                                 double largest_step);

/// The law in rate form with the same constants, and a state as its starting point.
exact::RateLaw twin(const AnyMaterial& material);
exact::Point point(const MaterialState& state);

exact::PressureLaw pressure_law(const LinearEos& eos);
exact::PressureLaw pressure_law(const MieGrueneisen& eos);
exact::JohnsonCookConstants constants(const JohnsonCookStrength& s, double specific_heat, double taylor_quinney);
/// Equivalent plastic strain of a point that a twin has moved.
double plastic_strain(const AnyMaterial& material, const exact::Point& p);

exact::Voigt voigt(const Tensor& a);
Tensor tensor(const exact::Voigt& a);

/// Largest magnitude that was added; NaN when one of them was NaN (std::max would lose it).
struct Largest {
  double magnitude = 0.0;
  void add(double e) {
    if (!(std::abs(e) <= magnitude) && !std::isnan(magnitude)) magnitude = std::abs(e);
  }
};

/// Errors at strain steps that halve from `coarsest` on, as a figure and as an observed order under the name `metric`: NaN, which
/// is no pass, where there is none; skipped when every error is round-off.
void measure_order(Run& run, std::string_view metric, const std::vector<double>& steps, const std::vector<double>& errors,
                   double round_off);

}  // namespace furrow::material_point_cases
