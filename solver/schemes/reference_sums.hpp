// Sums over pairs of the undeformed body, which never move: what the kernel says of a pair is looked up once and kept, so that a sum
// evaluates no kernel and no root. The sums are those of velocity_gradient.hpp, momentum.hpp and reference_hourglass.
#pragma once

#include <vector>

#include "solver/schemes/momentum.hpp"
#include "solver/schemes/stencil.hpp"

namespace furrow {

/// Of each pair (i, j) in the order of the neighbour list, padding included; good until neighbours, volumes or h change.
struct PairWeights {
  std::vector<double> slope;    ///< V_j W'(r)/r, so that V_j grad_i W_ij = slope X_ij
  std::vector<double> spread;   ///< V_j W(r)/r^2; 0 for padding
};

template <int Dim>
void weigh_pairs(const Stencil<Dim>& reference, std::span<const double> volume, PairWeights& out);

/// F'_i = [sum_j V_j (v_j - v_i) (x) grad_i W_ij] B_i, 1/s; `correction` empty for B = I. `velocity` with its images.
template <int Dim>
void reference_gradient(const Stencil<Dim>& reference, const PairWeights& weights, std::span<const Vector<Dim>> velocity,
                        std::span<const Matrix<Dim>> correction, std::span<Matrix<Dim>> out);

/// a_i = 1/rho_0 sum_j V_j [A_i + A_j] grad_i W_ij with A = P B^T, P the first Piola-Kirchhoff stress: the dual of reference_gradient.
/// `A` with its images.
template <int Dim>
void reference_divergence(const Stencil<Dim>& reference, const PairWeights& weights, std::span<const Matrix<Dim>> A,
                          double reference_density, std::span<Vector<Dim>> acceleration);

/// The same and, in one pass, the dampers of reference_hourglass; their power per mass, W/kg, in `power`. Positions, densities and
/// speeds of sound, velocities and F' with their images.
template <int Dim>
void damped_reference_divergence(const Stencil<Dim>& reference, const PairWeights& weights, std::span<const Matrix<Dim>> A,
                                 const Particles<Dim>& particles, std::span<const Vector<Dim>> velocity,
                                 std::span<const Matrix<Dim>> gradient_rate, double zeta, double reference_density,
                                 std::span<Vector<Dim>> acceleration, std::span<double> power);

}  // namespace furrow
