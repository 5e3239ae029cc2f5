#pragma once

#include <algorithm>
#include <span>

#include "solver/particles/fields.hpp"

namespace furrow {

/// Rigid flat wall of any orientation that pushes and never pulls. The surface of a particle lies `reach` spacings from its
/// centre; where it is behind the wall by delta > 0, the wall answers with the pressure stiffness * delta/dx on the area
/// dx^(Dim-1): a spring, so that its work is stored and given back. Along the wall Coulomb's friction holds back what slides.
template <int Dim>
struct RigidWall {
  Vector<Dim> point = Vector<Dim>::Zero();
  Vector<Dim> normal = Vector<Dim>::Unit(0);   ///< unit vector, towards the body
  double stiffness = 0.0;                      ///< Pa; rho c^2 of the body makes it as stiff as a layer of particles
  double reach = 0.5;                          ///< spacings
  double friction = 0.0;                       ///< coefficient; 0 = smooth
  double sticking = 1e-3;                      ///< m/s: below this speed friction falls linearly to none, instead of jumping

  struct Push {
    double force = 0.0;            ///< on the wall along -normal, N; per metre of width in plane strain
    double friction_power = 0.0;   ///< W, taken out of the motion
  };

  /// Adds accelerations to the particles that `takes_part(i)`.
  template <class TakesPart>
  Push push(const Particles<Dim>& p, double spacing, std::span<const Vector<Dim>> velocity, std::span<Vector<Dim>> acceleration,
            TakesPart&& takes_part) const {
    Push sum;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double delta = penetration(p.position[i], spacing);
      if (delta <= 0.0 || !takes_part(i)) continue;
      const double f = spring(spacing) * delta;
      acceleration[i] += f / p.mass[i] * normal;
      sum.force += f;
      if (friction > 0.0) {
        const Vector<Dim> sliding = velocity[i] - velocity[i].dot(normal) * normal;
        const double speed = sliding.norm(), held = friction * f / std::max(speed, sticking);
        acceleration[i] -= held / p.mass[i] * sliding;
        sum.friction_power += held * speed * speed;
      }
    }
    return sum;
  }
  /// Energy stored in the springs, J.
  template <class TakesPart>
  double energy(const Particles<Dim>& p, double spacing, TakesPart&& takes_part) const {
    double stored = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double delta = penetration(p.position[i], spacing);
      if (delta > 0.0 && takes_part(i)) stored += 0.5 * spring(spacing) * delta * delta;
    }
    return stored;
  }
  double penetration(const Vector<Dim>& x, double spacing) const { return reach * spacing - (x - point).dot(normal); }

 private:
  double spring(double spacing) const { return stiffness * std::pow(spacing, Dim - 2); }
};

}  // namespace furrow
