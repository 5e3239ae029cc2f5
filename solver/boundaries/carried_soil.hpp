// Friction of soil that artificial viscosity carries over a rough boundary layer.
#pragma once

#include "solver/boundaries/boundary_layer.hpp"
#include "solver/particles/fields.hpp"

namespace furrow {

/// Strengths of the soil's artificial viscosity (viscosity.hpp).
struct Viscous {
  double alpha, beta;
};

/// What carrying soil does to a layer.
template <int Dim>
struct Carried {
  Vector<Dim> force = Vector<Dim>::Zero();   ///< on the layer, N
  double power = 0.0;                        ///< W, taken out of sliding
};

/// Adds Coulomb's friction to the accelerations of soil that artificial viscosity carries over a rough layer. Viscosity between
/// soil and layer acts along the line between particles and sees no roughness, so that a thin sheet that stretches, and so has no
/// pressure, would be carried over a rough floor without any: it glides far ahead of its heap. The normal traction on a
/// rough surface is that of the stress and that of the viscosity together, and friction belongs to both. The stress brings its
/// own; for the other, with F_n the viscous force on a particle along the surface's normal and v_t its sliding,
///   F_t = -friction F_n v_t/max(|v_t|, v_s),   v_s = max(1 mm/s, friction |v_n|),
/// so that soil which sticks is held back no faster than viscosity holds it along the normal. `velocity` are those that the sums
/// over pairs see, lent ones included.
template <int Dim>
Carried<Dim> carried_friction(const LayerSurroundings<Dim>& around, const BoundaryLayer<Dim>& layer,
                              const Vector<Dim>& wall_velocity, const Viscous& viscosity, double friction, const Particles<Dim>& p,
                              std::span<const Vector<Dim>> velocity, std::span<Vector<Dim>> acceleration);

}  // namespace furrow
