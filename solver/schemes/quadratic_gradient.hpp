// Gradients exact for quadratic fields, by moving least squares (Lancaster & Salkauskas 1981). In bending the axial velocity
// is bilinear, and at a free face a gradient exact for linear fields only reads the strain of a layer further inside: a strip
// of a few particles becomes far too soft. This one reads it where it is. Compiled for two dimensions: in three, nine terms a
// pair cost more than the finer spacing that does the same.
#pragma once

#include "solver/schemes/stencil.hpp"

namespace furrow {

/// Terms of p(s) = (s_a, s_a s_b for a <= b), s = (x_j - x_i)/h: 5 in two dimensions, 9 in three.
template <int Dim>
inline constexpr int quadratic_terms = Dim + Dim * (Dim + 1) / 2;

/// C_i, 1/m: grad f = sum_j V_j W_ij (f_j - f_i) C_i p(s_ij).
template <int Dim>
using QuadraticGradient = Eigen::Matrix<double, Dim, quadratic_terms<Dim>>;

/// p(s) of eight pairs, from x_i - x_j.
template <int Dim>
LaneVector<quadratic_terms<Dim>> quadratic_basis(const LaneVector<Dim>& x_ij, double h) {
  LaneVector<quadratic_terms<Dim>> p;
  for (int a = 0; a < Dim; ++a) p[a] = x_ij[a] * (-1.0 / h);
  for (int a = 0, k = Dim; a < Dim; ++a)
    for (int b = a; b < Dim; ++b, ++k) p[k] = p[a] * p[b];
  return p;
}

/// C_i = (unit rows) [sum_j V_j W_ij p p^T]^-1 / h. Where neighbours do not determine a quadratic, a linear fit; where they do
/// not determine that either, zero.
template <int Dim>
void quadratic_correction(const Stencil<Dim>& stencil, std::span<const double> volume, std::span<QuadraticGradient<Dim>> out);

/// L_i = sum_j V_j W_ij (v_j - v_i) (x) C_i p(s_ij), 1/s.
template <int Dim>
void quadratic_velocity_gradient(const Stencil<Dim>& stencil, std::span<const double> volume, std::span<const Vector<Dim>> velocity,
                                 std::span<const QuadraticGradient<Dim>> correction, std::span<Matrix<Dim>> out);

}  // namespace furrow
