// First derivatives: of a scalar field, and of the velocity (paper Eqs 12, 13).
#pragma once

#include "solver/schemes/stencil.hpp"

namespace furrow {

/// (grad f)_i = sum_j V_j (f_j - f_i) grad_i W_ij; exact for constant f. With `correction` (one B_i a particle, see
/// kernel_correction.hpp) exact for linear f as well; empty for the plain sum.
template <int Dim>
void gradient(const Stencil<Dim>& stencil, std::span<const double> volume, std::span<const double> f,
              std::span<const Matrix<Dim>> correction, std::span<Vector<Dim>> out);

/// L_i = sum_j V_j (v_j - v_i) (x) grad_i W_ij, 1/s: L_ab = dv_a/dx_b, whose symmetric and skew parts are the strain rate
/// (Eq. 12) and the spin (Eq. 13). `correction` as above.
template <int Dim>
void velocity_gradient(const Stencil<Dim>& stencil, std::span<const double> volume, std::span<const Vector<Dim>> velocity,
                       std::span<const Matrix<Dim>> correction, std::span<Matrix<Dim>> out);

/// The same, with the corrections of kernel_correction.hpp made in the same pass: to the last bit what both would give, for a third
/// less than they cost.
template <int Dim>
void corrected_velocity_gradient(const Stencil<Dim>& stencil, std::span<const double> volume, std::span<const Vector<Dim>> velocity,
                                 double least_span, std::span<Matrix<Dim>> correction, std::span<Matrix<Dim>> out);

}  // namespace furrow
