#include "solver/simulation.hpp"

#include <fmt/format.h>

#include "solver/modules.hpp"
#include "solver/particles/ordered_sum.hpp"
#include "solver/schemes/xsph.hpp"

namespace furrow {

template <int Dim>
void Simulation<Dim>::start() {
  Particles<Dim>& p = body.particles;
  body.refresh_neighbours(true);
  body.prescribe(0.0, p.velocity);
  body.refresh_neighbours();
  body.accelerate(0.0, p.velocity);
  energy_ = {};
  initial_internal_ = energy_scale_ = 0.0;
  powers_ = powers();
  account(0.0);
  take_stock();
  initial_internal_ = energy_.plastic;
  energy_.plastic = 0.0;
  initial_energy_ = energy_.total();
  imbalance_ = 0.0;
}

template <int Dim>
void Simulation<Dim>::step(double end) {
  has_run(Module::simulation);
  Particles<Dim>& p = body.particles;
  const std::size_t n = p.size();
  if (control.stability > 0.0 && steps_ % frequency_every == 0) wave_number_ = body.largest_wave_number();
  StepLength length = step_length(body, compression_, control, wave_number_);
  const double grown = steps_ == 0 ? control.first * length.dt : control.growth * dt_;
  if (!control.fixed && (steps_ == 0 || control.growth > 0.0) && grown < length.dt) {
    length.dt = grown;
    length.limiter = StepLimiter::growth;
  }
  const bool last = time_ + length.dt >= end;
  const double dt = last ? end - time_ : length.dt;
  limiter_ = last ? StepLimiter::end_of_run : length.limiter;

  // Kick to the middle of the step.
  const SubSteps sub_steps = sub_steps_of(dt, length);
  body.part();
  for_all(n, [&](std::size_t i) { p.velocity[i] += 0.5 * dt * p.acceleration[i]; });
  body.prescribe(time_ + 0.5 * dt, p.velocity);

  move(dt, sub_steps);

  // Viscosity and damping depend on the velocity at the end of the step: predicted with the old acceleration.
  predicted_.resize(p.position.size());
  for_all(n, [&](std::size_t i) { predicted_[i] = p.velocity[i] + 0.5 * dt * p.acceleration[i]; });
  body.prescribe(time_ + dt, predicted_);
  body.images.fill_velocities(predicted_);
  body.accelerate(time_ + dt, predicted_);

  // Kick to the end.
  for_all(n, [&](std::size_t i) { p.velocity[i] += 0.5 * dt * p.acceleration[i]; });
  body.prescribe(time_ + dt, p.velocity);
  body.join();

  time_ = last ? end : time_ + dt;
  dt_ = dt;
  ++steps_;
  std::int64_t shortest = 1;
  particle_steps_ += static_cast<std::int64_t>(n);
  for (std::size_t k = 0; k < body.fast_parts().size(); ++k) {
    shortest *= sub_steps[k];
    particle_steps_ += static_cast<std::int64_t>(body.fast_parts()[k].own) * (shortest - 1);
  }
  sub_steps_ += shortest;
  if (first_dt_ == 0.0) first_dt_ = length.dt;
  account(dt);
  if (last || steps_ % stock_every == 0) take_stock();
  if (body.scheme.sub_cycling && control.stability > 0.0 && !control.fixed && steps_ % fast_part_every == 0) {
    body.choose_fast_parts(control.slow_stability / control.stability);
    powers_ = powers();
  }
  check();
}

template <int Dim>
void Simulation<Dim>::run_until(double end, const std::function<void(const Simulation&)>& observe) {
  while (time_ < end) {
    step(end);
    if (observe) observe(*this);
  }
}

template <int Dim>
typename Simulation<Dim>::SubSteps Simulation<Dim>::sub_steps_of(double dt, const StepLength& length) const {
  SubSteps steps{};
  double outer = dt;
  for (std::size_t k = 0; k < body.fast_parts().size(); ++k) {
    steps[k] = static_cast<int>(std::ceil(outer / length.part[k]));
    outer /= steps[k];
  }
  return steps;
}

template <int Dim>
void Simulation<Dim>::move(double dt, const SubSteps& sub_steps) {
  if (!body.fast_parts().empty()) {
    compression_ = body.respond_in_sub_steps(dt, sub_steps);
    return;
  }
  // Drift to the middle, let the stress answer the motion of the whole step, drift on to its end.
  drift(0.5 * dt);
  compression_ = body.respond(dt, steps_);
  drift(0.5 * dt);
}

template <int Dim>
void Simulation<Dim>::drift(double dt) {
  Particles<Dim>& p = body.particles;
  if (body.scheme.xsph == 0.0) return body.drift(p.velocity, dt);
  body.images.fill_velocities(p.velocity);
  drift_.resize(p.size());
  xsph_velocity<Dim>(body.stencil(), p, p.velocity, body.scheme.xsph, drift_);
  body.drift(drift_, dt);
}

template <int Dim>
typename Simulation<Dim>::Powers Simulation<Dim>::powers() const {
  const Particles<Dim>& p = body.particles;
  const auto [viscous, artificial] = ordered_sum<2>(p.size(), [&](std::size_t i, auto& sum) {
    sum[0] += p.mass[i] * body.power()[i].viscous;
    sum[1] += p.mass[i] * body.power()[i].artificial;
  });
  return {viscous, artificial, body.damping_power(), body.external_power(), body.layer_power(), body.friction_power(),
          body.layer_viscous_power()};
}

template <int Dim>
void Simulation<Dim>::account(double dt) {
  Particles<Dim>& p = body.particles;
  const Powers before = powers_;
  powers_ = powers();
  energy_.viscous += 0.5 * dt * (before.viscous + powers_.viscous);
  energy_.artificial += 0.5 * dt * (before.artificial + powers_.artificial);
  energy_.damping += 0.5 * dt * (before.damping + powers_.damping);
  energy_.external += 0.5 * dt * (before.external + powers_.external);
  energy_.contact += 0.5 * dt * (before.friction + powers_.friction);
  energy_.viscous += 0.5 * dt * (before.layer_viscous + powers_.layer_viscous);
  energy_.layer += 0.5 * dt * (before.layer + powers_.layer);
  if (!body.loads.motions.empty())
    energy_.external += body.prescribed_kinetic_energy(time_) - body.prescribed_kinetic_energy(time_ - dt);
  if (!body.fast_parts().empty()) energy_.viscous += body.fast_viscous_work();
  if (!body.scheme.energy) return;
  for_all(p.size(), [&](std::size_t i) { p.internal_energy[i] += dt * body.power()[i].viscous; });
  deposited_ += dt * powers_.viscous;
  if (!body.fast_parts().empty()) deposited_ += body.fast_deposit();
}

template <int Dim>
void Simulation<Dim>::take_stock() {
  const Particles<Dim>& p = body.particles;
  const auto [kinetic, elastic, internal] = std::visit(
      [&](const auto& law) {
        return ordered_sum<3>(p.size(), [&](std::size_t i, auto& sum) {
          sum[2] += p.mass[i] * p.internal_energy[i];
          if (body.is_in_layer(i)) return;
          sum[0] += 0.5 * p.mass[i] * p.velocity[i].squaredNorm();
          sum[1] += p.mass[i] * law.stored_energy(body.state(i));
        });
      },
      body.material);
  energy_.kinetic = kinetic;
  energy_.elastic = elastic;
  energy_.wall = 0.0;
  for (const RigidWall<Dim>& wall : body.walls)
    energy_.wall += wall.energy(p, body.spacing, [this](std::size_t i) { return !body.is_in_layer(i); });
  energy_.plastic = internal - initial_internal_ - deposited_ - elastic;
  energy_scale_ = std::max({energy_scale_, energy_.kinetic + energy_.elastic, std::abs(energy_.external)});
  imbalance_ = energy_scale_ > 0.0 ? (energy_.total() - initial_energy_) / energy_scale_ : 0.0;
}

template <int Dim>
Vector<Dim> Simulation<Dim>::momentum() const {
  const Particles<Dim>& p = body.particles;
  Vector<Dim> sum = Vector<Dim>::Zero();
  for (std::size_t i = 0; i < p.size(); ++i)
    if (!body.is_in_layer(i)) sum += p.mass[i] * p.velocity[i];
  return sum;
}

template <int Dim>
double Simulation<Dim>::angular_momentum() const {
  const Particles<Dim>& p = body.particles;
  double sum = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (!body.is_in_layer(i)) sum += p.mass[i] * (p.position[i][0] * p.velocity[i][1] - p.position[i][1] * p.velocity[i][0]);
  return sum;
}

template <int Dim>
void Simulation<Dim>::check() const {
  const Particles<Dim>& p = body.particles;
  const auto inside = [&](std::size_t i) {
    return body.is_in_layer(i) || ((p.position[i].array() >= watch.low.array()) && (p.position[i].array() <= watch.high.array())).all();
  };
  const auto stop = [&](std::size_t i, std::string_view field, std::string_view what) {
    throw Divergence(fmt::format("t = {:.6g} s, step {}, body {}, particle {}: {} {}", time_, steps_, body.name, p.id[i], field, what));
  };
  // One quick look at all of them; who it is and why is asked only when one is wrong. A sum is finite only where each term is. A
  // stress that is not finite shows in the accelerations of all who see it, and that of a particle alone in the energy.
  const auto [wrong] = ordered_sum<1>(p.size(), [&](std::size_t i, auto& sum) {
    const bool good = std::isfinite(p.acceleration[i].sum() + p.velocity[i].sum()) && p.density[i] > 0.0 && inside(i);
    sum[0] += good ? 0.0 : 1.0;
  });
  const bool look = wrong > 0.0 || !std::isfinite(imbalance_);
  for (std::size_t i = 0; look && i < p.size(); ++i) {
    if (!p.acceleration[i].allFinite()) stop(i, "acceleration", "is not finite");
    if (!p.velocity[i].allFinite()) stop(i, "velocity", "is not finite");
    if (!p.stress[i].allFinite()) stop(i, "stress", "is not finite");
    if (!(p.density[i] > 0.0)) stop(i, "density", fmt::format("is {:.6g} kg/m^3", p.density[i]));
    if (!inside(i)) stop(i, "position", "has left the domain");
  }
  // Neither a step nor an energy is a particle's, but one particle stands out.
  const auto largest = [&p](const auto& array) {
    std::size_t found = 0;
    for (std::size_t i = 1; i < p.size(); ++i)
      if (array[i].squaredNorm() > array[found].squaredNorm()) found = i;
    return found;
  };
  if (limiter_ != StepLimiter::end_of_run && !(dt_ >= watch.smallest_step * first_dt_)) {
    const std::size_t i = largest(p.acceleration);
    stop(i, "acceleration",
         fmt::format("is {:.3g} m/s^2, the largest; the step has collapsed to {:.3g} s, {:.1e} of the first, limited by {}",
                     p.acceleration[i].norm(), dt_, dt_ / first_dt_, name_of(limiter_)));
  }
  if (!(energy_imbalance() <= watch.largest_imbalance)) {
    const std::size_t i = largest(p.velocity);
    stop(i, "velocity",
         fmt::format("is {:.3g} m/s, the largest; energy has grown by {:.3g} J without work, {:.0f} % of the largest so far",
                     p.velocity[i].norm(), energy_.total() - initial_energy_, 100.0 * energy_imbalance()));
  }
}

template <int Dim>
typename Simulation<Dim>::Clock Simulation<Dim>::clock() const {
  return {time_, dt_, first_dt_, compression_, initial_energy_, energy_scale_, initial_internal_, wave_number_, deposited_,
          steps_, sub_steps_, particle_steps_, limiter_, energy_, powers_};
}

template <int Dim>
void Simulation<Dim>::resume(const Clock& clock) {
  time_ = clock.time;
  dt_ = clock.dt;
  first_dt_ = clock.first_dt;
  compression_ = clock.compression;
  initial_energy_ = clock.initial_energy;
  energy_scale_ = clock.energy_scale;
  initial_internal_ = clock.initial_internal;
  wave_number_ = clock.wave_number;
  deposited_ = clock.deposited;
  steps_ = clock.steps;
  sub_steps_ = clock.sub_steps;
  particle_steps_ = clock.particle_steps;
  limiter_ = clock.limiter;
  energy_ = clock.energy;
  powers_ = clock.powers;
  body.restore_neighbours();
}

template class Simulation<2>;
template class Simulation<3>;

}  // namespace furrow
