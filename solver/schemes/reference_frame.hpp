// Sums over the reference configuration (total Lagrangian): neighbours are those of the undeformed body for good. A pattern of
// particles under tension or pressure has then no way to break up by itself, as it has where the kernel moves with the particles
// (Belytschko, Guo, Liu & Xiao 2000; Rabczuk, Belytschko & Xiao 2004). For solids that stay whole.
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "solver/schemes/momentum.hpp"
#include "solver/schemes/reference_sums.hpp"
#include "solver/schemes/scheme.hpp"
#include "solver/schemes/stencil.hpp"

namespace furrow {

/// First Piola-Kirchhoff stress J sigma F^-T, per undeformed area; J = rho_0/rho.
template <int Dim>
Matrix<Dim> first_piola(const Matrix<Dim>& cauchy, const Matrix<Dim>& F, double J) {
  return J * cauchy * F.inverse().transpose();
}

/// Pressure of von Neumann and Richtmyer's bulk viscosity in compression, q = rho l (b_1 c + b_2 l |d|) |d| for d = tr L < 0, Pa.
inline double bulk_viscosity(const BulkViscosity& model, double d, double rho, double c, double length) {
  return d < 0.0 ? rho * length * (model.linear * c - model.quadratic * length * d) * -d : 0.0;
}

/// Fastest wave seen from the reference configuration, m/s: c times the largest 1/stretch (bounded by the largest row sum of
/// F^-1 F^-T). Where a body is squeezed, its particles are closer than their reference distance says.
template <int Dim>
double reference_speed(const Matrix<Dim>& F, double c) {
  const Matrix<Dim> inverse = F.inverse();
  double largest = 0.0;
  for (int a = 0; a < Dim; ++a) {
    double row = 0.0;
    for (int b = 0; b < Dim; ++b) row += std::abs(inverse.row(a).dot(inverse.row(b)));
    largest = std::max(largest, row);
  }
  return c * std::sqrt(largest);
}

/// Largest frequency of the body as it is now, 1/s, to some percent and from below: that of the waves that change volume,
///   P' = rho_0 c^2 (F' : F^-T) F^-T,  u'' = Div P' / rho_0,
/// by ten steps of the power method from displacements that are noise. An explicit step is stable up to 2/omega (Courant,
/// Friedrichs & Lewy 1928). What the sums see of a wave depends on the pattern of particles, on free faces and on how far
/// particles that are squeezed alike reach; none of it is guessed. Particles that are `left_out` (not 0) are taken to answer no
/// strain.
template <int Dim>
double largest_frequency(const Stencil<Dim>& reference, const PairWeights& weights, const Particles<Dim>& particles,
                         std::span<const Matrix<Dim>> correction, double reference_density,
                         std::span<const std::uint8_t> left_out = {});

/// Adds what resists motion that the gradients do not see. With n the direction of a pair now,
///   delta_ij = x_ij - (F_i + F_j)/2 X_ij,   d_ij = v_ij - (F'_i + F'_j)/2 X_ij,   rho c^2 of the pair's mean,
///   a_i += -1/m_i sum_j V_i V_j W(X_ij)/X_ij^2 [chi rho c^2 delta_ij.n + zeta rho c h d_ij.n] n
/// in volumes, distances and h of the reference configuration: the spring of Ganzenmueller (2015) with chi, and a damper of the
/// same form with zeta. Central forces; nothing for displacements or velocities that are quadratic in X. The spring's power goes
/// to the artificial part, the damper's to the viscous.
template <int Dim>
void reference_hourglass(const Stencil<Dim>& reference, const Particles<Dim>& particles, std::span<const double> volume,
                         std::span<const Vector<Dim>> velocity, std::span<const Matrix<Dim>> gradient_rate, double chi,
                         double zeta, std::span<Vector<Dim>> acceleration, std::span<MomentumPower> power);

}  // namespace furrow
