#pragma once

#include <span>

#include "solver/particles/fields.hpp"

namespace furrow {

/// Rigid flat wall of any orientation, free slip, that pushes and never pulls. The surface of a particle lies half a spacing
/// from its centre; where it is behind the wall by delta > 0, the wall answers with the pressure stiffness * delta/dx on the
/// area dx^(Dim-1): a spring, so that its work is stored and given back.
template <int Dim>
struct RigidWall {
  Vector<Dim> point = Vector<Dim>::Zero();
  Vector<Dim> normal = Vector<Dim>::Unit(0);   ///< unit vector, towards the body
  double stiffness = 0.0;                      ///< Pa; rho c^2 of the body makes it as stiff as a layer of particles

  /// Adds accelerations; returns the force on the wall along -normal (N, per metre of width in plane strain).
  double push(const Particles<Dim>& p, double spacing, std::span<Vector<Dim>> acceleration) const {
    double force = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double delta = penetration(p.position[i], spacing);
      if (delta <= 0.0) continue;
      const double f = spring(spacing) * delta;
      acceleration[i] += f / p.mass[i] * normal;
      force += f;
    }
    return force;
  }
  /// Energy stored in the springs, J.
  double energy(const Particles<Dim>& p, double spacing) const {
    double stored = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double delta = penetration(p.position[i], spacing);
      if (delta > 0.0) stored += 0.5 * spring(spacing) * delta * delta;
    }
    return stored;
  }
  double penetration(const Vector<Dim>& x, double spacing) const { return 0.5 * spacing - (x - point).dot(normal); }

 private:
  double spring(double spacing) const { return stiffness * std::pow(spacing, Dim - 2); }
};

}  // namespace furrow
