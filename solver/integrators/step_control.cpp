#include "solver/integrators/step_control.hpp"

#include <algorithm>

#include "solver/modules.hpp"
#include "solver/schemes/reference_frame.hpp"

namespace furrow {

template <int Dim>
StepLength step_length(const Body<Dim>& body, double compression, const StepControl& control, double wave_number) {
  has_run(Module::step_control);
  if (control.fixed) return {control.largest, StepLimiter::courant, {}};
  const Particles<Dim>& p = body.particles;
  const double h = body.smoothing_length();
  const auto n = static_cast<std::int64_t>(p.size());
  const bool reference = body.scheme.frame == Frame::reference;
  const std::span<const std::uint8_t> rungs = body.rungs();
  double c = 0.0, c_squeezed = 0.0, a2 = 0.0, c_rung[most_fast_parts + 1] = {};
#pragma omp parallel for schedule(static) reduction(max : c, c_squeezed, a2) reduction(max : c_rung)
  for (std::int64_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    c = std::max(c, p.sound_speed[i]);
    if (reference) {
      const double c_s = reference_speed<Dim>(p.deformation_gradient[i], p.sound_speed[i]);
      c_squeezed = std::max(c_squeezed, c_s);
      double& of_rung = c_rung[rungs.empty() ? 0 : rungs[i]];
      of_rung = std::max(of_rung, c_s);
    }
    a2 = std::max(a2, p.acceleration[i].squaredNorm());
  }
  StepLength step{control.courant * h / c, StepLimiter::courant, {}};
  double shortest = 0.0;
  const auto length_of = [&](std::size_t rung) {
    if (rung == body.fast_parts().size()) return shortest;
    const double fastest = *std::max_element(c_rung, c_rung + rung + 1);
    return std::max(shortest, control.slow_stability * 2.0 * h / (body.fast_parts()[rung].slower_wave_number * fastest));
  };
  const auto limit = [&step](double dt, StepLimiter limiter) {
    if (dt < step.dt) step = {dt, limiter, step.part};
  };
  if (reference && wave_number > 0.0) {
    shortest = control.stability * 2.0 * h / (wave_number * c_squeezed);
    step.dt = length_of(0);
    for (std::size_t k = 0; k < body.fast_parts().size(); ++k) step.part[k] = length_of(k + 1);
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

template StepLength step_length<2>(const Body<2>&, double, const StepControl&, double);
template StepLength step_length<3>(const Body<3>&, double, const StepControl&, double);

}  // namespace furrow
