// What a body does in the reference frame alone: what it was undeformed, its cracks, its stress and its largest frequency.
#include "solver/body.hpp"
#include "solver/modules.hpp"
#include "solver/schemes/cracks.hpp"
#include "solver/schemes/reference_frame.hpp"

namespace furrow {

template <int Dim>
void Body<Dim>::build_reference() {
  has_run(Module::reference_frame);
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
  gradient_rate_.assign(p.position.size(), Matrix<Dim>::Zero());
  cut_cracks(neighbours_, p, spacing);   // those of a run that goes on
  make_correction();
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
  make_correction();
}

template <int Dim>
void Body<Dim>::accelerate_in_reference(std::span<const Vector<Dim>> velocity) {
  Particles<Dim>& p = particles;
  const auto n = static_cast<std::int64_t>(p.size());
  viscous_pressure_.assign(p.size(), 0.0);
#pragma omp parallel for schedule(static)
  for (std::int64_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double d = velocity_gradient_[i].trace();
    if (scheme.bulk_viscosity && d < 0.0) {
      // Over the distance of squeezed particles as it is now: over the first one, viscosity would be stiffer than the material.
      const double length = spacing * p.sound_speed[i] / reference_speed<Dim>(p.deformation_gradient[i], p.sound_speed[i]);
      viscous_pressure_[i] = bulk_viscosity(*scheme.bulk_viscosity, d, p.density[i], p.sound_speed[i], length);
    }
    const Matrix<Dim> sigma = p.stress[i].template topLeftCorner<Dim, Dim>() - viscous_pressure_[i] * Matrix<Dim>::Identity();
    undeformed_.stress[i].template topLeftCorner<Dim, Dim>() =
        first_piola<Dim>(sigma, p.deformation_gradient[i], undeformed_.density[i] / p.density[i]);
  }
  momentum<Dim>(stencil(), undeformed_, velocity, view_of_correction(), {}, workspace_, p.acceleration, power_);
  for_all(p.size(), [&](std::size_t i) { power_[i].viscous = -viscous_pressure_[i] * velocity_gradient_[i].trace() / p.density[i]; });
  if (scheme.hourglass > 0.0 || scheme.hourglass_damping > 0.0) {
    images.fill_tensors(std::span(p.deformation_gradient));
    images.fill_tensors(std::span(gradient_rate_));
    reference_hourglass<Dim>(stencil(), p, volume_, velocity, gradient_rate_, scheme.hourglass, scheme.hourglass_damping,
                             p.acceleration, power_);
  }
}

template <int Dim>
double Body<Dim>::largest_wave_number() {
  if (!in_reference_frame() || scheme.correction == Correction::quadratic)
    throw std::invalid_argument("the largest frequency is there for the reference frame with the correction none or linear");
  Particles<Dim>& p = particles;
  const auto n = static_cast<std::int64_t>(p.size());
  double fastest = 0.0;
#pragma omp parallel for schedule(static) reduction(max : fastest)
  for (std::int64_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    fastest = std::max(fastest, reference_speed<Dim>(p.deformation_gradient[i], p.sound_speed[i]));
  }
  return largest_frequency<Dim>(stencil(), p, volume_, linear_, undeformed_) * smoothing_length() / fastest;
}

#define FURROW_INSTANTIATE(Dim)                                                       \
  template void Body<Dim>::build_reference();                                         \
  template void Body<Dim>::open_cracks();                                             \
  template void Body<Dim>::accelerate_in_reference(std::span<const Vector<Dim>>);     \
  template double Body<Dim>::largest_wave_number();
FURROW_INSTANTIATE(2)
FURROW_INSTANTIATE(3)
#undef FURROW_INSTANTIATE

}  // namespace furrow
