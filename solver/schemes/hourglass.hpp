// Hourglass control: a lattice that zigzags has no gradient, so that no stress holds it. In a body that is bent or in tension
// such a pattern grows until the body is soft. Here it meets a spring of its own (Ganzenmueller 2015, with the reference
// positions and the deformation gradient that the run itself has integrated).
#pragma once

#include "solver/particles/fields.hpp"
#include "solver/schemes/momentum.hpp"
#include "solver/schemes/stencil.hpp"

namespace furrow {

/// Adds to the accelerations, with delta_ij = x_ij - (F_i + F_j)/2 X_ij what a pair's distance has beyond the mean deformation,
///   -chi/m_i sum_j V_i V_j (rho_i c_i^2 + rho_j c_j^2)/2 W_ij/X_ij^2 (delta_ij.n) n,  n = x_ij/r:
/// central forces, which conserve momentum and angular momentum. Zero for any displacement that is quadratic in X, so that
/// bending is left alone. Only pairs that began within each other's support: what meets later, as two bodies do, was never one
/// piece. Its power goes to the artificial part.
template <int Dim>
void hourglass_control(const Stencil<Dim>& stencil, const Particles<Dim>& particles, std::span<const Vector<Dim>> velocity, double chi,
                       std::span<Vector<Dim>> acceleration, std::span<MomentumPower> power);

}  // namespace furrow
