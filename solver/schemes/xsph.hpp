#pragma once

#include "solver/particles/fields.hpp"
#include "solver/schemes/stencil.hpp"

namespace furrow {

/// XSPH (Monaghan 1989): the velocity that particles are moved with, v_i + eps sum_j m_j/rho_ij (v_j - v_i) W_ij with rho_ij
/// the mean of the pair, m/s. Momentum is conserved: the weights are symmetric.
template <int Dim>
void xsph_velocity(const Stencil<Dim>& stencil, const Particles<Dim>& particles, std::span<const Vector<Dim>> velocity, double eps,
                   std::span<Vector<Dim>> out);

}  // namespace furrow
