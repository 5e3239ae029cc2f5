// Cantilever in plane strain: deflection and clamp moment under point loads.
#pragma once

#include <vector>

namespace furrow::exact {

/// A load at the distance `arm` from the clamp: transverse force, and a couple that bends the same way. Per width, N/m and N.
struct BeamLoad {
  double arm, force, couple = 0.0;
};

/// Deflection at the distance x from the clamp, m (Euler and Bernoulli), with EI' = E t^3/(12 (1 - nu^2)) per width, in N m:
///   force at a: F a^2 (3 x - a)/(6 EI') for x >= a, F x^2 (3 a - x)/(6 EI') before; couple at a: M a (2 x - a)/(2 EI'), M x^2/(2 EI').
/// Loads behind the clamp (arm <= 0) bend nothing.
double cantilever_deflection(const std::vector<BeamLoad>& loads, double x, double bending_stiffness);

/// Moment at the clamp, N: sum of F a + M.
double clamp_moment(const std::vector<BeamLoad>& loads);

/// E t^3/(12 (1 - nu^2)), N m.
double plate_stiffness(double young_modulus, double poisson_ratio, double thickness);

}  // namespace furrow::exact
