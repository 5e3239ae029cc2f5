#include "solver/schemes/hourglass.hpp"

#include "solver/modules.hpp"

namespace furrow {

template <int Dim>
void hourglass_control(const Stencil<Dim>& stencil, const Particles<Dim>& p, std::span<const Vector<Dim>> velocity, double chi,
                       std::span<Vector<Dim>> acceleration, std::span<MomentumPower> power) {
  has_run(Module::hourglass);
  const double h = stencil.smoothing_length, reach = support(stencil.kernel) * h, reach2 = reach * reach;
  const auto read = reads(p.reference_position, p.deformation_gradient, p.density, p.sound_speed, p.mass, velocity);
  for_each_particle(stencil, read, [&]<class K>(std::size_t i, auto&& neighbours, K) {
    const LaneVector<Dim> X_i = broadcast<Dim>(p.reference_position[i]), v_i = broadcast<Dim>(velocity[i]);
    const LaneMatrix<Dim> F_i = broadcast<Dim>(p.deformation_gradient[i]);
    const double modulus_i = p.density[i] * p.sound_speed[i] * p.sound_speed[i];
    LaneVector<Dim> a;
    Lanes taken{};
    neighbours([&](const Pairs<Dim>& pair, const LaneVector<Dim>& X_j, const LaneMatrix<Dim>& F_j, const Lanes& rho_j,
                   const Lanes& c_j, const Lanes& m_j, const LaneVector<Dim>& v_j) {
      const LaneVector<Dim> X_ij = X_i - X_j;
      const LaneVector<Dim> delta = pair.x_ij - broadcast(0.5) * ((F_i + F_j) * X_ij);
      const Lanes modulus = 0.5 * (modulus_i + rho_j * c_j * c_j);
      const Lanes W = scale<K, Dim>(h) * Shape<K, Dim>::w(pair.r * (1.0 / h));
      const Lanes X2 = dot(X_ij, X_ij);
      const Lanes stiffness = modulus * W * m_j / (rho_j * (X2 + 1e-300));
      const Lanes along = dot(delta, pair.x_ij) / (pair.r * pair.r);
      const Lanes factor = broadcast(-chi / p.density[i]) * stiffness * along;
      // Neither the padding with the particle itself, nor what came near only later: it was never one piece with the particle.
      const LaneVector<Dim> f = (((pair.r > 1e-140) & (X2 < reach2)) ? factor : Lanes{}) * pair.x_ij;
      a += f;
      taken += dot(f, v_i - v_j);
    });
    acceleration[i] += sum(a);
    power[i].artificial -= 0.5 * sum(taken);
  });
}

template void hourglass_control<2>(const Stencil<2>&, const Particles<2>&, std::span<const Vector<2>>, double, std::span<Vector<2>>,
                                   std::span<MomentumPower>);
template void hourglass_control<3>(const Stencil<3>&, const Particles<3>&, std::span<const Vector<3>>, double, std::span<Vector<3>>,
                                   std::span<MomentumPower>);

}  // namespace furrow
