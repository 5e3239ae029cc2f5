#include "solver/boundaries/carried_soil.hpp"

#include <algorithm>

namespace furrow {
namespace {

/// Pi of one approaching pair as in artificial_viscosity(), m^5/(kg s^2); c and rho are its means.
double viscous_term(const Viscous& model, double v_dot_x, double r, double h, double c, double rho) {
  const double mu = h * std::min(0.0, v_dot_x) / (r * r + 0.01 * h * h);
  return (model.beta * mu - model.alpha * c) * mu / rho;
}

}  // namespace

template <int Dim>
Carried<Dim> carried_friction(const LayerSurroundings<Dim>& around, const BoundaryLayer<Dim>& layer,
                              const Vector<Dim>& wall_velocity, const Viscous& viscosity, double friction, const Particles<Dim>& p,
                              std::span<const Vector<Dim>> velocity, std::span<Vector<Dim>> acceleration) {
  constexpr double least_sliding = 1e-3;   // m/s
  return std::visit(
      [&](auto kernel) {
        const double h = around.smoothing_length;
        Carried<Dim> sum;
        // One by one: few pairs, and a sum that does not depend on the number of threads.
        for (std::size_t k = 0; k < layer.ids.size(); ++k) {
          const auto w = static_cast<std::size_t>(around.index_of_id[static_cast<std::size_t>(layer.ids[k])]);
          const Vector<Dim>& n = layer.normal[k];
          for (const std::int32_t at : around.neighbours->row(w)) {
            const auto j = static_cast<std::size_t>(at);
            if (j >= p.size() || around.soil_volume[j] == 0.0) continue;
            const Vector<Dim> x_jw = around.box.displacement(around.position[j], around.position[w]);
            const double r = x_jw.norm(), along = x_jw.dot(n);
            if (!(along > 0.0 && r < decltype(kernel)::support * h)) continue;
            const double Pi = viscous_term(viscosity, (velocity[j] - velocity[w]).dot(x_jw), r, h,
                                           0.5 * (p.sound_speed[j] + p.sound_speed[w]), 0.5 * (p.density[j] + p.density[w]));
            if (Pi == 0.0) continue;
            const double F_n = -p.mass[j] * p.mass[w] * Pi * derivative<decltype(kernel), Dim>(r, h) * along / r;
            const Vector<Dim> v = velocity[j] - wall_velocity, sliding = v - v.dot(n) * n;
            const double speed = sliding.norm(), sticking = std::max(least_sliding, friction * std::abs(v.dot(n)));
            const Vector<Dim> F_t = -friction * F_n / std::max(speed, sticking) * sliding;
            acceleration[j] += F_t / p.mass[j];
            sum.force -= F_t;
            sum.power -= F_t.dot(sliding);
          }
        }
        return sum;
      },
      around.kernel);
}

#define FURROW_INSTANTIATE(Dim) \
  template Carried<Dim> carried_friction<Dim>(const LayerSurroundings<Dim>&, const BoundaryLayer<Dim>&, const Vector<Dim>&, \
                                              const Viscous&, double, const Particles<Dim>&, \
                                              std::span<const Vector<Dim>>, std::span<Vector<Dim>>);
FURROW_INSTANTIATE(2)
FURROW_INSTANTIATE(3)
#undef FURROW_INSTANTIATE

}  // namespace furrow
