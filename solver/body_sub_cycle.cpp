// A body in the reference frame whose squeezed particles take several short steps in one of the rest.
#include "solver/body.hpp"
#include "solver/particles/ordered_sum.hpp"
#include "solver/schemes/reference_frame.hpp"

namespace furrow {

template <int Dim>
double Body<Dim>::choose_fast_part(double slow_ratio) {
  if (!keeps_weights()) throw std::invalid_argument("sub-cycling is there for the reference frame with the correction none or linear");
  if (!loads.motions.empty() || !loads.faces.empty() || !layers.empty() || !rigid_bodies.empty() || neighbour_body)
    throw std::invalid_argument("sub-cycling is there for bodies of which nothing is prescribed or held and that no other body is near");
  const Particles<Dim>& p = particles;
  std::vector<double> speed(p.size());
  for_all(p.size(), [&](std::size_t i) { speed[i] = reference_speed<Dim>(p.deformation_gradient[i], p.sound_speed[i]); });
  const std::vector<std::uint8_t> before = fast_.is_squeezed;
  fast_.choose(stencil(), weights_, linear(), worth_short_steps<Dim>(stencil(), speed, slow_ratio));
  // Whose viscosity is the fast part's, and whose is not.
  for_all(p.size(), [&](std::size_t i) {
    const bool was = !before.empty() && before[i];
    if (was != is_squeezed(i)) power_[i].viscous += was ? viscous_power(i) : -viscous_power(i);
  });
  if (fast_.empty()) return 0.0;
  pull_fast_part();
  double fastest = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (!is_squeezed(i)) fastest = std::max(fastest, speed[i]);
  const double omega = largest_frequency<Dim>(stencil(), weights_, p, linear(), undeformed_.density[0], fast_.is_squeezed);
  return omega * smoothing_length() / fastest;
}

template <int Dim>
void Body<Dim>::part() {
  if (fast_.empty()) return;
  for (std::size_t l = 0; l < fast_.size(); ++l)
    particles.acceleration[static_cast<std::size_t>(fast_.particle[l])] -= fast_.acceleration[l];
  parted_ = true;
}

template <int Dim>
void Body<Dim>::join() {
  if (!parted_) return;
  for (std::size_t l = 0; l < fast_.size(); ++l)
    particles.acceleration[static_cast<std::size_t>(fast_.particle[l])] += fast_.acceleration[l];
  parted_ = false;
}

template <int Dim>
double Body<Dim>::respond_in_sub_steps(double dt, int sub_steps) {
  Particles<Dim>& p = particles;
  FastPart<Dim>& f = fast_;
  const std::size_t n = p.size(), fast = f.size();
  const double short_dt = dt / sub_steps;
  const Stencil<Dim> strained = f.stencil(stencil(), f.strained);
  const auto of = [&f](std::size_t l) { return static_cast<std::size_t>(f.particle[l]); };
  for_all(fast, [&](std::size_t l) { f.velocity[l] = p.velocity[of(l)]; });
  std::fill(f.path.begin(), f.path.end(), Vector<Dim>::Zero());
  fast_viscous_work_ = fast_deposit_ = 0.0;
  for (int step = 0; step < sub_steps; ++step) {
    // Kick, drift and strain, kick. Forces follow from F alone: positions are known again at the end.
    for_all(fast, [&](std::size_t l) {
      f.velocity[l] += 0.5 * short_dt * f.acceleration[l];
      f.path[l] += short_dt * f.velocity[l];
    });
    f.images.fill_velocities(f.velocity);
    reference_gradient<Dim>(strained, f.weights, f.velocity, f.correction, f.rate);
    strain_fast_part(short_dt);
    const double before = fast_viscous_power_;
    pull_fast_part();
    for_all(fast, [&](std::size_t l) { f.velocity[l] += 0.5 * short_dt * f.acceleration[l]; });
    const double power = fast_viscous_power_;
    fast_viscous_work_ += 0.5 * short_dt * (before + power);
    fast_deposit_ += short_dt * power;
    if (scheme.energy) for_all(f.squeezed, [&](std::size_t l) { p.internal_energy[of(l)] += short_dt * viscous_power(of(l)); });
  }
  // What the rest sees of it is the mean velocity over the step, so that F stays that of the positions.
  mean_velocity_.resize(p.position.size());
  std::copy_n(p.velocity.begin(), n, mean_velocity_.begin());
  for_all(fast, [&](std::size_t l) {
    mean_velocity_[of(l)] = f.path[l] / dt;
    p.velocity[of(l)] = f.velocity[l];
  });
  for_all(n, [&](std::size_t i) { p.position[i] += dt * mean_velocity_[i]; });
  images.fill_velocities(mean_velocity_);
  reference_gradient<Dim>(stencil(), weights_, mean_velocity_, linear(), gradient_rate_);
  return respond_in_reference(dt);
}

template <int Dim>
void Body<Dim>::pull_fast_part() {
  FastPart<Dim>& f = fast_;
  for_all(f.squeezed, [&](std::size_t l) { f.A[l] = pull(static_cast<std::size_t>(f.particle[l])); });
  f.images.fill_tensors(f.A);
  reference_divergence<Dim>(f.stencil(stencil(), f.pulled), f.weights, f.A, undeformed_.density[0], f.acceleration);
  fast_viscous_power_ = std::get<0>(ordered_sum<1>(f.squeezed, [&](std::size_t l, auto& sum) {
    const auto i = static_cast<std::size_t>(f.particle[l]);
    sum[0] += particles.mass[i] * viscous_power(i);
  }));
}

template <int Dim>
void Body<Dim>::restore_fast_part(std::vector<std::uint8_t> squeezed, std::vector<Vector<Dim>> pulls,
                                  double viscous_power) {
  fast_.choose(stencil(), weights_, linear(), std::move(squeezed));
  if (fast_.empty()) return;
  fast_.acceleration = std::move(pulls);
  fast_viscous_power_ = viscous_power;
}

#define FURROW_INSTANTIATE(Dim)                                              \
  template double Body<Dim>::choose_fast_part(double);                       \
  template void Body<Dim>::part();                                           \
  template void Body<Dim>::join();                                           \
  template double Body<Dim>::respond_in_sub_steps(double, int);              \
  template void Body<Dim>::pull_fast_part();                                 \
  template void Body<Dim>::restore_fast_part(std::vector<std::uint8_t>, std::vector<Vector<Dim>>, double);
FURROW_INSTANTIATE(2)
FURROW_INSTANTIATE(3)
#undef FURROW_INSTANTIATE

}  // namespace furrow
