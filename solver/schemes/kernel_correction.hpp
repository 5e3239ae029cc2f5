// Kernel-gradient correction (Bonet & Lok 1999; Randles & Libersky 1996): gradients of linear fields become exact.
#pragma once

#include <Eigen/LU>
#include <cmath>

#include "solver/schemes/stencil.hpp"

namespace furrow {

/// What the discrete kernel does to a constant and to a linear field: with a perfect kernel 1, 0 and the unit matrix.
template <int Dim>
struct KernelSums {
  double unity;              ///< sum_j V_j W_ij, the particle itself included
  Vector<Dim> constant;      ///< sum_j V_j grad_i W_ij, 1/m
  Matrix<Dim> linear;        ///< sum_j V_j (x_j - x_i) (x) grad_i W_ij
};
template <int Dim>
void kernel_sums(const Stencil<Dim>& stencil, std::span<const double> volume, std::span<KernelSums<Dim>> out);

/// M^-1 of M = sum_j V_j (x_j - x_i) (x) grad_i W_ij. A particle whose neighbours do not span space keeps the unit matrix: the
/// determinant, over that of the isotropic matrix of the same trace, is below `least_span`. How few or far the neighbours are does
/// not matter, only whether they lie on a line or in a plane.
template <int Dim>
Matrix<Dim> inverse_of_moments(const Matrix<Dim>& M, double least_span) {
  const double isotropic = std::pow(M.trace() / Dim, Dim);
  return M.determinant() > least_span * isotropic ? Matrix<Dim>(M.inverse()) : Matrix<Dim>(Matrix<Dim>::Identity());
}

/// B_i = M_i^-1, so that a plain sum times B_i is exact for linear fields.
template <int Dim>
void kernel_correction(const Stencil<Dim>& stencil, std::span<const double> volume, std::span<Matrix<Dim>> out,
                       double least_span = 1e-4);

}  // namespace furrow
