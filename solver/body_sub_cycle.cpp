// A body in the reference frame whose squeezed particles take several short steps in one of the rest.
#include <algorithm>

#include "solver/body.hpp"
#include "solver/particles/ordered_sum.hpp"
#include "solver/schemes/reference_frame.hpp"

namespace furrow {

template <int Dim>
void Body<Dim>::choose_fast_parts(double slow_ratio) {
  if (!keeps_weights()) throw std::invalid_argument("sub-cycling is there for the reference frame with the correction none or linear");
  if (!loads.motions.empty() || !loads.faces.empty() || !layers.empty() || !rigid_bodies.empty() || neighbour_body)
    throw std::invalid_argument("sub-cycling is there for bodies of which nothing is prescribed or held and that no other body is near");
  const Particles<Dim>& p = particles;
  std::vector<double> speed(p.size());
  for_all(p.size(), [&](std::size_t i) { speed[i] = reference_speed<Dim>(p.deformation_gradient[i], p.sound_speed[i]); });
  const std::vector<std::uint8_t> before = rung_;
  rung_ = worth_short_steps<Dim>(stencil(), speed, slow_ratio);
  // Whose viscosity is the fast parts', and whose is not.
  for_all(p.size(), [&](std::size_t i) {
    const bool was = !before.empty() && before[i] != 0;
    if (was != is_squeezed(i)) power_[i].viscous += was ? viscous_power(i) : -viscous_power(i);
  });
  make_fast_parts();
  std::vector<std::uint8_t> faster(p.size());
  for (std::size_t k = 0; k < fast_.size(); ++k) {
    double fastest = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      faster[i] = rung_[i] > k;
      if (!faster[i]) fastest = std::max(fastest, speed[i]);
    }
    const double omega = largest_frequency<Dim>(stencil(), weights_, p, linear(), undeformed_.density[0], faster);
    fast_[k].slower_wave_number = omega * smoothing_length() / fastest;
  }
}

template <int Dim>
void Body<Dim>::make_fast_parts() {
  const std::vector<FastPart<Dim>> before = std::move(fast_);
  fast_.clear();
  const int parts = rung_.empty() ? 0 : *std::max_element(rung_.begin(), rung_.end());
  fast_.reserve(static_cast<std::size_t>(parts));
  for (int k = 1; k <= parts; ++k) {
    fast_.emplace_back(stencil(), weights_, linear(), rung_, k, fast_.empty() ? nullptr : &fast_.back());
    pull_fast_part(fast_.back());
    if (static_cast<std::size_t>(k) <= before.size())
      fast_.back().slower_wave_number = before[static_cast<std::size_t>(k - 1)].slower_wave_number;
  }
}

template <int Dim>
void Body<Dim>::part() {
  if (fast_.empty()) return;
  for (const FastPart<Dim>& f : fast_)
    for (std::size_t l = 0; l < f.size(); ++l) particles.acceleration[static_cast<std::size_t>(f.particle[l])] -= f.acceleration[l];
  parted_ = true;
}

template <int Dim>
void Body<Dim>::join() {
  if (!parted_) return;
  for (const FastPart<Dim>& f : fast_)
    for (std::size_t l = 0; l < f.size(); ++l) particles.acceleration[static_cast<std::size_t>(f.particle[l])] += f.acceleration[l];
  parted_ = false;
}

template <int Dim>
double Body<Dim>::respond_in_sub_steps(double dt, std::span<const int> sub_steps) {
  Particles<Dim>& p = particles;
  FastPart<Dim>& f = fast_.front();
  const std::size_t n = p.size();
  const auto of = [&f](std::size_t l) { return static_cast<std::size_t>(f.particle[l]); };
  for_all(f.size(), [&](std::size_t l) { f.velocity[l] = p.velocity[of(l)]; });
  fast_viscous_work_ = fast_deposit_ = 0.0;
  advance_fast_part(0, dt, sub_steps);
  // What the rest sees of it is the mean velocity over the step, so that F stays that of the positions.
  mean_velocity_.resize(p.position.size());
  std::copy_n(p.velocity.begin(), n, mean_velocity_.begin());
  for_all(f.size(), [&](std::size_t l) {
    mean_velocity_[of(l)] = f.path[l] / dt;
    p.velocity[of(l)] = f.velocity[l];
  });
  for_all(n, [&](std::size_t i) { p.position[i] += dt * mean_velocity_[i]; });
  images.fill_velocities(mean_velocity_);
  reference_gradient<Dim>(stencil(), weights_, mean_velocity_, linear(), gradient_rate_);
  return respond_in_reference(dt);
}

template <int Dim>
void Body<Dim>::advance_fast_part(std::size_t k, double dt, std::span<const int> sub_steps) {
  Particles<Dim>& p = particles;
  FastPart<Dim>& f = fast_[k];
  FastPart<Dim>* const faster = k + 1 < fast_.size() ? &fast_[k + 1] : nullptr;
  const std::size_t size = f.size();
  const double short_dt = dt / sub_steps[k];
  const Stencil<Dim> strained = f.stencil(stencil(), f.strained);
  std::fill(f.path.begin(), f.path.end(), Vector<Dim>::Zero());
  for (int step = 0; step < sub_steps[k]; ++step) {
    // Kick, drift and strain, kick. Forces follow from F alone: positions are known again at the end.
    for_all(size, [&](std::size_t l) { f.mean_velocity[l] = f.velocity[l] += 0.5 * short_dt * f.acceleration[l]; });
    if (faster) {
      const auto there = [faster](std::size_t l) { return static_cast<std::size_t>(faster->outer[l]); };
      for_all(faster->size(), [&](std::size_t l) { faster->velocity[l] = f.velocity[there(l)]; });
      advance_fast_part(k + 1, short_dt, sub_steps);
      for_all(faster->size(), [&](std::size_t l) {
        f.mean_velocity[there(l)] = faster->path[l] / short_dt;
        f.velocity[there(l)] = faster->velocity[l];
      });
    }
    for_all(size, [&](std::size_t l) { f.path[l] += short_dt * f.mean_velocity[l]; });
    f.images.fill_velocities(f.mean_velocity);
    reference_gradient<Dim>(strained, f.weights, f.mean_velocity, f.correction, f.rate);
    strain_fast_part(f, short_dt);
    const double before = f.viscous_power;
    pull_fast_part(f);
    for_all(size, [&](std::size_t l) { f.velocity[l] += 0.5 * short_dt * f.acceleration[l]; });
    fast_viscous_work_ += 0.5 * short_dt * (before + f.viscous_power);
    fast_deposit_ += short_dt * f.viscous_power;
    if (!scheme.energy) continue;
    for_all(f.own, [&](std::size_t l) {
      const auto i = static_cast<std::size_t>(f.particle[l]);
      p.internal_energy[i] += short_dt * viscous_power(i);
    });
  }
}

template <int Dim>
void Body<Dim>::pull_fast_part(FastPart<Dim>& f) {
  for_all(f.own, [&](std::size_t l) { f.A[l] = pull(static_cast<std::size_t>(f.particle[l])); });
  f.images.fill_tensors(f.A);
  reference_divergence<Dim>(f.stencil(stencil(), f.pulled), f.weights, f.A, undeformed_.density[0], f.acceleration);
  f.viscous_power = std::get<0>(ordered_sum<1>(f.own, [&](std::size_t l, auto& sum) {
    const auto i = static_cast<std::size_t>(f.particle[l]);
    sum[0] += particles.mass[i] * viscous_power(i);
  }));
}

template <int Dim>
typename Body<Dim>::FastMemory Body<Dim>::fast_memory() const {
  FastMemory memory{rung_, {}, {}, {}};
  for (const FastPart<Dim>& f : fast_) {
    memory.slower_wave_number.push_back(f.slower_wave_number);
    memory.viscous_power.push_back(f.viscous_power);
    memory.acceleration.insert(memory.acceleration.end(), f.acceleration.begin(), f.acceleration.end());
  }
  return memory;
}

template <int Dim>
void Body<Dim>::remember(const FastMemory& memory) {
  rung_ = memory.rung;
  make_fast_parts();
  auto next = memory.acceleration.begin();
  for (std::size_t k = 0; k < fast_.size(); ++k) {
    FastPart<Dim>& f = fast_[k];
    f.slower_wave_number = memory.slower_wave_number.at(k);
    f.viscous_power = memory.viscous_power.at(k);
    if (std::distance(next, memory.acceleration.end()) < static_cast<std::ptrdiff_t>(f.size()))
      throw std::out_of_range("the fast parts to go on with have fewer particles than the body's");
    for (Vector<Dim>& a : f.acceleration) a = *next++;
  }
}

#define FURROW_INSTANTIATE(Dim)                                                                      \
  template void Body<Dim>::choose_fast_parts(double);                                                \
  template void Body<Dim>::make_fast_parts();                                                        \
  template void Body<Dim>::part();                                                                   \
  template void Body<Dim>::join();                                                                   \
  template double Body<Dim>::respond_in_sub_steps(double, std::span<const int>);                     \
  template void Body<Dim>::advance_fast_part(std::size_t, double, std::span<const int>);             \
  template void Body<Dim>::pull_fast_part(FastPart<Dim>&);                                           \
  template typename Body<Dim>::FastMemory Body<Dim>::fast_memory() const;                            \
  template void Body<Dim>::remember(const FastMemory&);
FURROW_INSTANTIATE(2)
FURROW_INSTANTIATE(3)
#undef FURROW_INSTANTIATE

}  // namespace furrow
