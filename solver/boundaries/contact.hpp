// Contact: particles that are kept out of an outline, and held back where they slide along it. The outline is that of a rigid body
// that moves as prescribed, or goes through the surface particles of another body.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "solver/boundaries/outline.hpp"
#include "solver/particles/fields.hpp"

namespace furrow {

/// Repulsion of the Lennard-Jones form that the paper takes for contact (Monaghan 1994), of a particle of mass m at the distance d
/// from the surface to its centre: f = m D [(d_0/d)^p - (d_0/d)^q]/d for d < d_0.
struct LennardJones {
  double coefficient = 0.0;      ///< D, m^2/s^2: of the order of the square of the speed that is to be stopped
  double cut_off = 1.0;          ///< d_0, spacings
  double steep = 12.0, flat = 4.0;   ///< exponents p > q
};

/// How a surface answers.
///
/// Normal: a spring. The surface of a particle lies `reach` spacings from its centre; where it overlaps by delta, the pressure
/// stiffness delta/dx acts on the area dx^(Dim-1); or the Lennard-Jones form in its place. A damper of the share `damping` of
/// critical damping of the particle on its spring takes out chatter, and never pulls.
///
/// Along the surface (sharp corners have none): Coulomb's friction and adhesion with sticking. An elastic stretch s follows sliding,
/// the traction is sticking_stiffness s/dx, and slips where it would exceed friction p + adhesion (p without the damper).
struct ContactLaw {
  double stiffness = 0.0;            ///< Pa; rho c^2 of the softer body makes it as stiff as a layer of particles
  double damping = 0.0;
  double friction = 0.0;             ///< coefficient; 0 = smooth
  double adhesion = 0.0;             ///< Pa
  double sticking_stiffness = 0.0;   ///< Pa; needed where there is friction or adhesion
  double reach = 0.5;                ///< spacings
  std::optional<LennardJones> lennard_jones;
};

/// Contact of particles with one outline. Remembers each particle's stretch.
template <int Dim>
class Contact {
 public:
  std::string name;
  ContactLaw law;

  /// What one look at the contact found.
  struct Touch {
    double power = 0.0;         ///< W: what relative motion puts into springs, friction and dampers
    double surface_power = 0.0; ///< W: what the outline's own motion puts into the particles
    double dissipation = 0.0;   ///< J since the last look: by slipping
    double stored = 0.0;        ///< J, in springs along and across the surface
    double penetration = 0.0;   ///< spacings, largest
    Vector<Dim> force = Vector<Dim>::Zero();   ///< on the outline, N
    std::int64_t touching = 0;                 ///< particles
  };

  /// Adds accelerations to the particles that `takes_part(i)` and writes the forces on the outline's nodes, equal and opposite.
  /// `time` is that of positions and velocities; stretches grow over the time since the last look. Particles are taken one by one
  /// in their order, whatever the number of threads.
  template <class TakesPart>
  Touch touch(const Particles<Dim>& p, double spacing, double time, std::span<const Vector<Dim>> velocity,
              std::span<Vector<Dim>> acceleration, Outline<Dim>& outline, TakesPart&& takes_part) {
    begin(p.size(), time);
    outline.force.assign(outline.size(), Vector<Dim>::Zero());
    const Bounds<Dim> bounds = bounds_of(outline);
    const double margin = range(spacing);
    Touch sum;
    for (std::size_t i = 0; i < p.size(); ++i)
      if (bounds.contains(p.position[i], margin) && takes_part(i))
        touch_one(static_cast<std::size_t>(p.id[i]), p.position[i], p.mass[i], spacing, velocity[i], acceleration[i], outline, sum);
      else
        stretch_[static_cast<std::size_t>(p.id[i])].setZero();
    largest_penetration_ = std::max(largest_penetration_, sum.penetration);
    slipped_ += sum.dissipation;
    impulse_ += dt_ * sum.force;
    last_ = sum;
    return sum;
  }

  /// How far from the outline a particle's centre is touched, m.
  double range(double spacing) const { return (law.lennard_jones ? law.lennard_jones->cut_off : law.reach) * spacing; }
  const Touch& last() const { return last_; }
  double largest_penetration() const { return largest_penetration_; }   ///< spacings, so far
  double slipped() const { return slipped_; }                           ///< J, dissipated by slipping so far
  /// Sum of force times step so far, N s: its differences give means that no chatter between two rows of a history escapes.
  const Vector<Dim>& impulse() const { return impulse_; }

  /// What a restart needs to go on bit for bit.
  struct Memory {
    double time = 0.0, largest_penetration = 0.0, slipped = 0.0;
    Vector<Dim> impulse = Vector<Dim>::Zero();
    std::vector<Vector<Dim>> stretch;   ///< by particle's id
  };
  Memory memory() const { return {time_, largest_penetration_, slipped_, impulse_, stretch_}; }
  void remember(Memory memory);

 private:
  void begin(std::size_t particles, double time);
  void touch_one(std::size_t id, const Vector<Dim>& x, double mass, double spacing, const Vector<Dim>& v, Vector<Dim>& a,
                 Outline<Dim>& outline, Touch& sum);

  double time_ = 0.0, dt_ = 0.0, largest_penetration_ = 0.0, slipped_ = 0.0;
  Vector<Dim> impulse_ = Vector<Dim>::Zero();
  Touch last_;
  std::vector<Vector<Dim>> stretch_;
};

/// A rigid body that moves as prescribed, without turning: a tool, a stone.
template <int Dim>
struct RigidBody {
  Contact<Dim> contact;
  Outline<Dim> outline;                                  ///< now
  std::vector<Vector<Dim>> start;                        ///< of the nodes, m
  std::function<Vector<Dim>(double time)> displacement;  ///< m; empty: it stays
  std::function<Vector<Dim>(double time)> velocity;      ///< m/s, its rate

  void move(double time);
};

}  // namespace furrow
