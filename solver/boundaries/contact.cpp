#include "solver/boundaries/contact.hpp"

#include <cmath>

#include "solver/modules.hpp"

namespace furrow {

template <int Dim>
void Contact<Dim>::begin(std::size_t particles, double time) {
  has_run(Module::contact);
  if (stretch_.size() != particles) stretch_.resize(particles, Vector<Dim>::Zero());
  dt_ = time - time_;
  time_ = time;
}

template <int Dim>
void Contact<Dim>::remember(Memory memory) {
  time_ = memory.time;
  largest_penetration_ = memory.largest_penetration;
  slipped_ = memory.slipped;
  impulse_ = memory.impulse;
  stretch_ = std::move(memory.stretch);
}

template <int Dim>
void Contact<Dim>::touch_one(std::size_t id, const Vector<Dim>& x, double mass, double spacing, const Vector<Dim>& v, Vector<Dim>& a,
                             Outline<Dim>& outline, Touch& sum) {
  const NearestPoint<Dim> near = nearest_point(outline, x);
  Vector<Dim>& s = stretch_[id];
  if (near.distance >= range(spacing)) {
    s.setZero();
    return;
  }
  const Vector<Dim>& n = near.normal;
  const Vector<Dim> V = (1.0 - near.share) * outline.velocity[near.first] + near.share * outline.velocity[near.second];
  const Vector<Dim> sliding = v - V;
  const double approach = -sliding.dot(n), area = std::pow(spacing, Dim - 1);
  sum.penetration = std::max(sum.penetration, law.reach - near.distance / spacing);

  double f = 0.0, spring = 0.0;   // force and stiffness across the surface
  if (law.lennard_jones) {
    const LennardJones& lj = *law.lennard_jones;
    const double d_0 = lj.cut_off * spacing, d = std::max(near.distance, 1e-3 * d_0), q = d_0 / d;
    const double steep = std::pow(q, lj.steep), flat = std::pow(q, lj.flat);
    f = mass * lj.coefficient * (steep - flat) / d;
    spring = mass * lj.coefficient * ((lj.steep + 1.0) * steep - (lj.flat + 1.0) * flat) / (d * d);
    sum.stored += mass * lj.coefficient * ((steep - 1.0) / lj.steep - (flat - 1.0) / lj.flat);
  } else {
    const double delta = law.reach * spacing - near.distance;
    spring = law.stiffness * area / spacing;
    f = spring * delta;
    sum.stored += 0.5 * spring * delta * delta;
  }
  const double pressing = f;
  if (law.damping > 0.0) f = std::max(0.0, f + 2.0 * law.damping * std::sqrt(spring * mass) * approach);
  Vector<Dim> force = f * n;

  // At a sharp corner there is nothing to slide along: with friction a particle would stick to it for good, a nose on the edge.
  const bool corner = outline.size() > 1 && outline.radius == 0.0 && (near.share <= 0.0 || near.share >= 1.0);
  if (corner) s.setZero();
  if (!corner && (law.friction > 0.0 || law.adhesion > 0.0)) {
    const double k = law.sticking_stiffness * area / spacing, hold = law.friction * pressing + law.adhesion * area;
    // The surface may have turned since the last look: the stretch stays along it, and as long as it was.
    const double before = s.norm();
    s -= s.dot(n) * n;
    if (const double length = s.norm(); length > 0.0) s *= before / length;
    s += dt_ * (sliding + approach * n);
    const double stretched = s.norm();
    if (k * stretched > hold) {
      s *= hold / (k * stretched);
      sum.dissipation += hold * (stretched - hold / k);
    }
    force -= k * s;
    sum.stored += 0.5 * k * s.squaredNorm();
  }
  a += force / mass;
  sum.power -= force.dot(sliding);
  sum.surface_power += force.dot(V);
  sum.force -= force;
  ++sum.touching;
  outline.force[near.first] -= (1.0 - near.share) * force;
  outline.force[near.second] -= near.share * force;
}

template <int Dim>
void RigidBody<Dim>::move(double time) {
  const Vector<Dim> u = displacement ? displacement(time) : Vector<Dim>(Vector<Dim>::Zero());
  const Vector<Dim> v = velocity ? velocity(time) : Vector<Dim>(Vector<Dim>::Zero());
  for (std::size_t k = 0; k < start.size(); ++k) {
    outline.position[k] = start[k] + u;
    outline.velocity[k] = v;
  }
}

template class Contact<2>;
template class Contact<3>;
template struct RigidBody<2>;
template struct RigidBody<3>;

}  // namespace furrow
