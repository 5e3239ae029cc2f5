// Density: by summation (paper Eq. 6), by Shepard's average (Eq. 7), by continuity.
#pragma once

#include "solver/schemes/stencil.hpp"

namespace furrow {

/// <f>_i = sum_j V_j f_j W_ij, the particle itself included (paper Eq. 6). volume in m^Dim; f and out in the unit of f.
template <int Dim>
void interpolate(const Stencil<Dim>& stencil, std::span<const double> volume, std::span<const double> f, std::span<double> out);

/// rho_i = sum_j m_j W_ij, kg/m^3 (Eq. 6 with f = rho). Too low within a support of a free surface.
template <int Dim>
void summation_density(const Stencil<Dim>& stencil, std::span<const double> mass, std::span<double> density);

/// rho_i = sum_j m_j W_ij / sum_j (m_j / rho_j) W_ij, kg/m^3 (Eq. 7). A uniform density is its fixed point whatever the
/// spacing, so that it is no equation of mass conservation: a re-normalisation. `before` and `density` must not overlap.
template <int Dim>
void shepard_density(const Stencil<Dim>& stencil, std::span<const double> mass, std::span<const double> before,
                     std::span<double> density);

/// d rho/dt = -rho tr L, kg/(m^3 s): continuity, rho_i sum_j V_j (v_i - v_j).grad W_ij when L is the sum of Eqs 12 and 13.
template <int Dim>
double density_rate(double density, const Matrix<Dim>& velocity_gradient) {
  return -density * velocity_gradient.trace();
}

}  // namespace furrow
