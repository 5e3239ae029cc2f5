#include "solver/integrators/step_control.hpp"

#include "solver/modules.hpp"
#include "solver/schemes/reference_frame.hpp"

namespace furrow {

template <int Dim>
StepLength step_length(const Body<Dim>& body, double compression, const StepControl& control, double wave_number,
                       double slow_wave_number) {
  has_run(Module::step_control);
  if (control.fixed) return {control.largest, StepLimiter::courant};
  const Particles<Dim>& p = body.particles;
  const double h = body.smoothing_length();
  const auto n = static_cast<std::int64_t>(p.size());
  const bool reference = body.scheme.frame == Frame::reference;
  const std::span<const std::uint8_t> squeezed = body.squeezed();
  double c = 0.0, c_squeezed = 0.0, c_slow = 0.0, a2 = 0.0;
#pragma omp parallel for schedule(static) reduction(max : c, c_squeezed, c_slow, a2)
  for (std::int64_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    c = std::max(c, p.sound_speed[i]);
    if (reference) {
      const double c_s = reference_speed<Dim>(p.deformation_gradient[i], p.sound_speed[i]);
      c_squeezed = std::max(c_squeezed, c_s);
      if (!squeezed.empty() && !squeezed[i]) c_slow = std::max(c_slow, c_s);
    }
    a2 = std::max(a2, p.acceleration[i].squaredNorm());
  }
  StepLength step{control.courant * h / c, StepLimiter::courant};
  const auto limit = [&step](double dt, StepLimiter limiter) {
    if (dt < step.dt) step = {dt, limiter, step.part};
  };
  if (reference && wave_number > 0.0) {
    step.part = control.stability * 2.0 * h / (wave_number * c_squeezed);
    step.dt = squeezed.empty() ? step.part : std::max(step.part, control.slow_stability * 2.0 * h / (slow_wave_number * c_slow));
  }
  if (reference && wave_number == 0.0) limit(control.courant * h / c_squeezed, StepLimiter::courant);
  if (const auto& viscosity = body.scheme.viscosity; viscosity && !reference) {
    const double mu = h * compression;
    limit(control.courant * h / (c + 0.6 * (viscosity->alpha * c + viscosity->beta * mu)), StepLimiter::viscous);
  }
  if (a2 > 0.0) limit(control.force * std::sqrt(h / std::sqrt(a2)), StepLimiter::force);
  if (control.largest > 0.0) limit(control.largest, StepLimiter::courant);
  return step;
}

template StepLength step_length<2>(const Body<2>&, double, const StepControl&, double, double);
template StepLength step_length<3>(const Body<3>&, double, const StepControl&, double, double);

}  // namespace furrow
