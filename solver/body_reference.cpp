// What a body does in the reference frame alone: what it was undeformed, its cracks, its stress and its largest frequency.
#include "solver/body.hpp"
#include "solver/materials/parts.hpp"
#include "solver/modules.hpp"
#include "solver/particles/ordered_sum.hpp"
#include "solver/schemes/cracks.hpp"
#include "solver/schemes/reference_frame.hpp"

namespace furrow {

template <int Dim>
void Body<Dim>::build_reference() {
  has_run(Module::reference_frame);
  if (scheme.density != DensityEquation::continuity || scheme.shepard_every > 0)
    throw std::invalid_argument("in the reference frame the density follows the continuity equation");
  Particles<Dim>& p = particles;
  const std::size_t n = p.size();
  const double rho_0 = std::visit([](const auto& law) { return law.initial_state().density; }, material);
  images.fill(p.mass);
  images.fill_positions(p.reference_position);
  undeformed_.id.assign(n, 0);
  undeformed_.mass = p.mass;
  undeformed_.density.assign(p.position.size(), rho_0);
  undeformed_.sound_speed.assign(p.position.size(), 0.0);   // nothing viscous is summed over pairs here
  undeformed_.stress.assign(n, Tensor::Zero());
  for (std::size_t i = 0; i < p.position.size(); ++i) volume_[i] = p.mass[i] / rho_0;
  velocity_gradient_.assign(n, Matrix<Dim>::Zero());
  viscous_pressure_.assign(n, 0.0);
  gradient_rate_.assign(p.position.size(), Matrix<Dim>::Zero());
  cut_cracks(neighbours_, p, spacing);   // those of a run that goes on
  look_at_pairs();
  rung_.clear();
  make_fast_parts();
}

template <int Dim>
void Body<Dim>::look_at_pairs() {
  make_correction();
  if (keeps_weights()) weigh_pairs<Dim>(stencil(), volume_, weights_);
  if constexpr (Dim == 2)
    if (keeps_pairs() && !keeps_weights()) weigh_quadratic_pairs(stencil(), volume_, quadratic_, pair_gradients_);
}

template <int Dim>
void Body<Dim>::open_cracks() {
  Particles<Dim>& p = particles;
  bool opened = false;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.damage[i] >= 1.0 && p.crack_normal[i].isZero(0.0)) {
      p.crack_normal[i] = most_stretched<Dim>(p.deformation_gradient[i]);
      opened = true;
    }
  if (!opened) return;
  cut_cracks(neighbours_, p, spacing);
  look_at_pairs();
  make_fast_parts();
}

template <int Dim>
template <class Law>
double Body<Dim>::strain(const Law& law, std::size_t i, const Matrix<Dim>& rate, double dt) {
  Particles<Dim>& p = particles;
  Matrix<Dim>& F = p.deformation_gradient[i];
  velocity_gradient_[i] = rate * (F + 0.5 * dt * rate).inverse();
  const double divergence = velocity_gradient_[i].trace(), before = p.density[i];
  p.density[i] *= std::exp(-divergence * dt);
  p.density_rate[i] = (p.density[i] - before) / dt;
  const Tensor L = embed<Dim>(velocity_gradient_[i]);
  const MaterialState next = turn_and_respond(law, state(i), {symmetric_part(L) * dt, skew_part(L) * dt, dt});
  set_state(i, next);
  F += dt * rate;
  p.sound_speed[i] = law.sound_speed(next);
  return divergence;
}

template <int Dim>
void Body<Dim>::strain_fast_part(const FastPart<Dim>& part, double dt) {
  std::visit(
      [&](const auto& law) {
        for_all(part.own, [&](std::size_t l) { strain(law, static_cast<std::size_t>(part.particle[l]), part.rate[l], dt); });
      },
      material);
}

template <int Dim>
double Body<Dim>::respond_in_reference(double dt) {
  const auto n = static_cast<std::int64_t>(particles.size());
  has_run(Module::jaumann_rate);
  for_each_part(material, has_run);
  double compression = 0.0;
  std::visit(
      [&](const auto& law) {
        // In pieces: particles that flow lie together and cost more than those that do not.
#pragma omp parallel for schedule(static, 64) reduction(max : compression)
        for (std::int64_t k = 0; k < n; ++k) {
          const auto i = static_cast<std::size_t>(k);
          if (!is_squeezed(i)) compression = std::max(compression, -strain(law, i, gradient_rate_[i], dt));
        }
      },
      material);
  if (scheme.cracks) open_cracks();
  return compression;
}

template <int Dim>
Matrix<Dim> Body<Dim>::pull(std::size_t i) {
  const Particles<Dim>& p = particles;
  const double d = velocity_gradient_[i].trace();
  double q = 0.0;
  if (scheme.bulk_viscosity && d < 0.0) {
    // Over the distance of squeezed particles as it is now: over the first one, viscosity would be stiffer than the material.
    const double length = spacing * p.sound_speed[i] / reference_speed<Dim>(p.deformation_gradient[i], p.sound_speed[i]);
    q = bulk_viscosity(*scheme.bulk_viscosity, d, p.density[i], p.sound_speed[i], length);
  }
  viscous_pressure_[i] = q;
  const Matrix<Dim> sigma = p.stress[i].template topLeftCorner<Dim, Dim>() - q * Matrix<Dim>::Identity();
  const Matrix<Dim> P = first_piola<Dim>(sigma, p.deformation_gradient[i], undeformed_.density[i] / p.density[i]);
  return keeps_weights() && scheme.correction == Correction::linear ? Matrix<Dim>(P * linear_[i].transpose()) : P;
}

template <int Dim>
void Body<Dim>::accelerate_in_reference(std::span<Vector<Dim>> velocity) {
  Particles<Dim>& p = particles;
  if (keeps_pairs()) workspace_.A.resize(p.position.size());
  for_all(p.size(), [&](std::size_t i) {
    if (!keeps_pairs())
      undeformed_.stress[i].template topLeftCorner<Dim, Dim>() = pull(i);
    else
      workspace_.A[i] = parted_ && is_squeezed(i) ? Matrix<Dim>(Matrix<Dim>::Zero()) : pull(i);
  });
  const bool springs = scheme.hourglass > 0.0, dampers = scheme.hourglass_damping > 0.0;
  const bool damped_at_once = dampers && !springs && keeps_weights();
  if (springs || dampers) {
    images.fill_tensors(std::span(gradient_rate_));
    images.fill_positions(p.position);
    images.fill_velocities(velocity);
    images.fill(p.density);
    images.fill(p.sound_speed);
  }
  if (keeps_pairs()) {
    has_run(Module::reference_frame);
    images.fill_tensors(std::span(workspace_.A));
    damper_power_.assign(p.size(), 0.0);
    if (damped_at_once) {
      has_run(Module::hourglass);
      damped_reference_divergence<Dim>(stencil(), weights_, workspace_.A, p, velocity, gradient_rate_, scheme.hourglass_damping,
                                       undeformed_.density[0], p.acceleration, damper_power_);
    } else if (keeps_weights()) {
      reference_divergence<Dim>(stencil(), weights_, workspace_.A, undeformed_.density[0], p.acceleration);
    } else if constexpr (Dim == 2) {
      quadratic_reference_divergence(stencil(), pair_gradients_, workspace_.A, undeformed_.density[0], p.acceleration);
    }
    for_all(p.size(), [&](std::size_t i) { power_[i] = {0.0, damper_power_[i], 0.0}; });
  } else {
    momentum<Dim>(stencil(), undeformed_, velocity, view_of_correction(), {}, workspace_, p.acceleration, power_);
    for_all(p.size(), [&](std::size_t i) { power_[i].viscous = 0.0; });
  }
  for_all(p.size(), [&](std::size_t i) {
    if (!(parted_ && is_squeezed(i))) power_[i].viscous += viscous_power(i);
  });
  if (springs || (dampers && !damped_at_once)) {
    images.fill_tensors(std::span(p.deformation_gradient));
    reference_hourglass<Dim>(stencil(), p, volume_, velocity, gradient_rate_, scheme.hourglass, scheme.hourglass_damping,
                             p.acceleration, power_);
  }
}

template <int Dim>
double Body<Dim>::largest_wave_number() {
  if (!keeps_weights())
    throw std::invalid_argument("the largest frequency is there for the reference frame with the correction none or linear, and no periodic box");
  Particles<Dim>& p = particles;
  const auto n = static_cast<std::int64_t>(p.size());
  double fastest = 0.0;
#pragma omp parallel for schedule(static) reduction(max : fastest)
  for (std::int64_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    fastest = std::max(fastest, reference_speed<Dim>(p.deformation_gradient[i], p.sound_speed[i]));
  }
  return largest_frequency<Dim>(stencil(), weights_, p, linear(), undeformed_.density[0]) * smoothing_length() / fastest;
}

#define FURROW_INSTANTIATE(Dim)                                                       \
  template void Body<Dim>::build_reference();                                         \
  template void Body<Dim>::open_cracks();                                             \
  template void Body<Dim>::accelerate_in_reference(std::span<Vector<Dim>>);     \
  template double Body<Dim>::largest_wave_number();                                   \
  template double Body<Dim>::respond_in_reference(double);                            \
  template Matrix<Dim> Body<Dim>::pull(std::size_t);                                  \
  template void Body<Dim>::strain_fast_part(const FastPart<Dim>&, double);            \
  template void Body<Dim>::look_at_pairs();
FURROW_INSTANTIATE(2)
FURROW_INSTANTIATE(3)
#undef FURROW_INSTANTIATE

}  // namespace furrow
