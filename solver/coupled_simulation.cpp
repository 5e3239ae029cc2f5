#include "solver/coupled_simulation.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "solver/modules.hpp"

namespace furrow {

void CoupledSimulation::couple() {
  if (surface.ids.size() != surface.start.size()) throw std::invalid_argument("a surface has one start a node");
  outline_ = Outline<2>::through(surface.start, surface.radius);
  if (single_rate) {
    soft.control.largest = 0.9 * step_length(stiff.body, 0.0, stiff.control).dt;   // what bending squeezes makes its step shorter
    soft.control.fixed = true;
  }
  if (summation) couple_by_sums();
  node_force_.assign(node_ids().size(), Vector<2>::Zero());
  stiff.body.loads.held.ids.clear();
  for (const std::int32_t id : node_ids())
    if (id != BodySurface::rigid) stiff.body.loads.held.ids.push_back(id);
  stiff.body.loads.held.forces.assign(stiff.body.loads.held.ids.size(), Vector<2>::Zero());
  driven_.clear();
  for (const std::int32_t id : stiff.body.loads.held.ids) {
    bool driven = false;
    for (const PrescribedMotion<2>& motion : stiff.body.loads.motions)
      driven = driven || std::find(motion.ids.begin(), motion.ids.end(), id) != motion.ids.end();
    driven_.push_back(driven ? 1 : 0);
  }
  soft.body.neighbour_body = [this](double time, std::span<const Vector<2>> velocity, std::span<Vector<2>> acceleration) {
    return look(time, velocity, acceleration);
  };
}

void CoupledSimulation::couple_by_sums() {
  if (!single_rate) throw std::invalid_argument("sums over both bodies need one step for both: they cannot be sub-cycled");
  if (soft.body.scheme.frame != Frame::current || stiff.body.scheme.frame != Frame::current)
    throw std::invalid_argument("sums over both bodies see present positions: neither body may be in the reference frame");
  contact.law.stiffness = contact.law.damping = contact.law.friction = contact.law.adhesion = 0.0;
  contact.law.lennard_jones.reset();
  all_ids_.resize(stiff.body.particles.size());
  std::iota(all_ids_.begin(), all_ids_.end(), 0);
  const auto find = [this] {
    const Particles<2>& p = soft.body.particles;
    soil_.resize(p.size());
    for (std::size_t i = 0; i < p.size(); ++i) soil_[i] = soft.body.is_in_layer(i) ? 0 : 1;
    summation->find_pairs(p, stiff.body.particles, soil_);
  };
  soft.body.neighbour_strain = [this, find](std::span<Matrix<2>> gradient) {
    find();
    summation->strain_soft(soft.body.particles, stiff.body.particles, gradient);
  };
  stiff.body.neighbour_strain = [this, find](std::span<Matrix<2>> gradient) {
    find();
    summation->strain_stiff(soft.body.particles, stiff.body.particles, gradient);
  };
}

Body<2>::Exchange CoupledSimulation::exchange(double time, std::span<const Vector<2>> velocity, std::span<Vector<2>> acceleration,
                                              Vector<2>& force) {
  const auto touch = contact.touch(soft.body.particles, soft.body.spacing, time, velocity, acceleration, outline_,
                                   [this](std::size_t i) { return !soft.body.is_in_layer(i); });
  if (!summation) {
    node_force_ = outline_.force;
    force = touch.force;
    return {touch.power, touch.surface_power};
  }
  const auto pull = summation->pull(soft.body.particles, stiff.body.particles, velocity, acceleration, node_force_);
  force = pull.force;
  return {pull.repulsion_power, pull.power + pull.repulsion_power};
}

Body<2>::Exchange CoupledSimulation::look(double time, std::span<const Vector<2>> velocity, std::span<Vector<2>> acceleration) {
  if (!started_) {
    stiff.start();
    started_ = true;
    reaction_ = reaction();
    stone_force_ = stone_force();
  } else {
    advance_stiff(time);
  }
  place_outline(time);
  has_run(Module::coupled_simulation);
  Vector<2> force;
  const Body<2>::Exchange powers = exchange(time, velocity, acceleration, force);
  impulses_.soil -= 0.5 * previous_dt_ * force;
  impulses_.pending = 0.5 * previous_dt_ * force;
  return powers;
}

void CoupledSimulation::advance_stiff(double time) {
  if (stiff.steps() == 0) initial_energy_ = soft.energy().total() + stiff.energy().total();
  const double dt = time - stiff.time(), factor = 0.5 * (previous_dt_ + dt) / dt;
  Vector<2> on_particles = Vector<2>::Zero(), on_rigid = Vector<2>::Zero();
  std::size_t next = 0;
  for (std::size_t k = 0; k < node_ids().size(); ++k) {
    const Vector<2> force = factor * node_force_[k];
    if (node_ids()[k] == BodySurface::rigid) {
      on_rigid += force;
    } else {
      change_held(next++, force);
      on_particles += force;
    }
  }
  impulses_.contact += dt * on_particles;
  impulses_.rigid += dt * on_rigid;
  impulses_.soil -= 0.5 * dt / factor * (on_particles + on_rigid);
  previous_dt_ = dt;
  if (surface.velocity) actuator_work_ -= dt * on_rigid.dot(surface.velocity(time));

  stiff.run_until(time, [this](const Simulation<2>& s) {
    const Vector<2> reaction_before = reaction_, stone_before = stone_force_;
    reaction_ = reaction();
    stone_force_ = stone_force();
    impulses_.actuator -= 0.5 * s.dt() * (reaction_before + reaction_);
    impulses_.stones -= 0.5 * s.dt() * (stone_before + stone_force_);
    if (surface.velocity) actuator_work_ -= 0.5 * s.dt() * (reaction_before + reaction_).dot(surface.velocity(s.time()));
    if (observe_stiff) observe_stiff(s);
  });
}

void CoupledSimulation::change_held(std::size_t k, const Vector<2>& force) {
  HeldForces<2>& held = stiff.body.loads.held;
  // The half kick that comes first takes the acceleration of the last look: it must be that of the new force already.
  const Vector<2> change = force - held.forces[k];
  const std::size_t i = stiff.body.index_of(held.ids[k]);
  if (driven_[k])
    reaction_ += change;
  else
    stiff.body.particles.acceleration[i] += change / stiff.body.particles.mass[i];
  held.forces[k] = force;
}

void CoupledSimulation::place_outline(double time) {
  const Particles<2>& p = stiff.body.particles;
  for (std::size_t k = 0; k < surface.ids.size(); ++k) {
    if (surface.ids[k] == BodySurface::rigid) {
      outline_.position[k] = surface.start[k] + surface.displacement(time);
      outline_.velocity[k] = surface.velocity(time);
    } else {
      const std::size_t i = stiff.body.index_of(surface.ids[k]);
      outline_.position[k] = p.position[i];
      outline_.velocity[k] = p.velocity[i];
    }
  }
}

Vector<2> CoupledSimulation::reaction() const {
  Vector<2> sum = Vector<2>::Zero();
  for (const Vector<2>& r : stiff.body.reactions()) sum += r;
  return sum;
}

Vector<2> CoupledSimulation::stone_force() const {
  Vector<2> sum = Vector<2>::Zero();
  for (const RigidBody<2>& stone : stiff.body.rigid_bodies) sum += stone.contact.last().force;
  return sum;
}

Vector<2> CoupledSimulation::actuator_force() const {
  Vector<2> sum = reaction_;
  for (std::size_t k = 0; k < node_ids().size(); ++k)
    if (node_ids()[k] == BodySurface::rigid) sum += node_force_[k];
  return sum;
}

double CoupledSimulation::energy_error() const {
  return stiff.steps() == 0 ? 0.0 : soft.energy().total() + stiff.energy().total() - initial_energy_;
}

CoupledSimulation::Memory CoupledSimulation::memory() const {
  return {contact.memory(), impulses_, actuator_work_, previous_dt_, initial_energy_, reaction_, stone_force_, node_force_,
          stiff.body.loads.held.forces};
}

void CoupledSimulation::remember(const Memory& memory) {
  contact.remember(memory.contact);
  impulses_ = memory.impulses;
  actuator_work_ = memory.actuator_work;
  previous_dt_ = memory.previous_dt;
  initial_energy_ = memory.initial_energy;
  reaction_ = memory.reaction;
  stone_force_ = memory.stone_force;
  node_force_ = memory.node_force;
  stiff.body.loads.held.forces = memory.held_force;
  started_ = true;
}

}  // namespace furrow
