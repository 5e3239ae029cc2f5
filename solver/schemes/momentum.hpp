// Momentum: accelerations from stress, artificial viscosity and artificial stress, and the energy that each of them moves.
#pragma once

#include <optional>
#include <vector>

#include "solver/particles/fields.hpp"
#include "solver/schemes/artificial_stress.hpp"
#include "solver/schemes/quadratic_gradient.hpp"
#include "solver/schemes/stencil.hpp"
#include "solver/schemes/viscosity.hpp"

namespace furrow {

struct MomentumTerms {
  std::optional<ArtificialViscosity> viscosity;
  std::optional<ArtificialStress> artificial_stress;
  double spacing = 0.0;   ///< dx, m: where f = W(r)/W(dx) is one
};

/// Powers per mass, W/kg, of one particle: half of what its pairs take out of the motion.
/// Summed with the masses, `stress + viscous + artificial` is minus the power of all accelerations, to round-off.
struct MomentumPower {
  double stress, viscous, artificial;
};

/// Arrays that a momentum sum needs beside its input; kept between steps so that none is allocated in the loop.
template <int Dim>
struct MomentumWorkspace {
  std::vector<Matrix<Dim>> A, R;
  std::vector<QuadraticGradient<Dim>> Q;
  std::vector<double> weight;
};

/// a_i of every particle, m/s^2, and the powers, from positions, velocities, densities and stresses.
///
/// Without correction the paper's form (Eqs 8, 10 with the terms of Monaghan and of Gray et al. written out):
///   a_i = sum_j m_j [ sigma_i/rho_i^2 + sigma_j/rho_j^2 + f^n (R_i + R_j) - Pi_ij I ] grad_i W_ij
/// which conserves momentum exactly and angular momentum only where the stress is isotropic.
/// With correction the dual of the corrected velocity gradient (Bonet & Lok 1999):
///   a_i = 1/rho_i sum_j V_j [ sigma_i B_i^T + sigma_j B_j^T ] grad_i W_ij + the same artificial terms
/// whose power is exactly -sum V sigma:L of the corrected gradient, so that angular momentum is conserved as well.
/// With a quadratic correction likewise the dual of that gradient:
///   a_i = 1/rho_i sum_j V_j W_ij [ sigma_i C_i p(s_ij) - sigma_j C_j p(s_ji) ] + the same artificial terms
/// `none` is spelt std::monostate.
template <int Dim>
using CorrectionView = std::variant<std::monostate, std::span<const Matrix<Dim>>, std::span<const QuadraticGradient<Dim>>>;

template <int Dim>
void momentum(const Stencil<Dim>& stencil, const Particles<Dim>& particles, std::span<const Vector<Dim>> velocity,
              const CorrectionView<Dim>& correction, const MomentumTerms& terms, MomentumWorkspace<Dim>& workspace,
              std::span<Vector<Dim>> acceleration, std::span<MomentumPower> power);

}  // namespace furrow
