// Sums with quadratic gradients over pairs of the undeformed body, which never move: what kernel and fit say of a pair is looked up
// once and kept. The sums are those of quadratic_gradient.hpp and momentum.hpp, in two dimensions.
#pragma once

#include <vector>

#include "solver/schemes/quadratic_gradient.hpp"

namespace furrow {

/// Of each pair (i, j) in the order of the neighbour list, padding (zero) included; good until neighbours, volumes or h change.
struct PairGradients {
  std::vector<Vector<2>> own;     ///< g_ij = V_j W_ij C_i p(s_ij), 1/m: grad f_i = sum_j (f_j - f_i) g_ij
  std::vector<Vector<2>> others;  ///< V_j W_ij C_j p(s_ji) = V_j/V_i g_ji, 1/m
  std::vector<Vector<2>> total;   ///< of each particle, sum_j g_ij
};

/// `volume` with its images; `correction` of the particles proper.
void weigh_quadratic_pairs(const Stencil<2>& reference, std::span<const double> volume,
                           std::span<const QuadraticGradient<2>> correction, PairGradients& out);

/// F'_i = sum_j (v_j - v_i) (x) g_ij, 1/s. `velocity` with its images.
void quadratic_reference_gradient(const Stencil<2>& reference, const PairGradients& pairs, std::span<const Vector<2>> velocity,
                                  std::span<Matrix<2>> out);

/// a_i = 1/rho_0 sum_j [P_i g_ij - P_j V_j/V_i g_ji], m/s^2, P the first Piola-Kirchhoff stress: the dual of the gradient. `P` with
/// its images.
void quadratic_reference_divergence(const Stencil<2>& reference, const PairGradients& pairs, std::span<const Matrix<2>> P,
                                    double reference_density, std::span<Vector<2>> acceleration);

}  // namespace furrow
