#include "solver/schemes/xsph.hpp"

#include "solver/modules.hpp"

namespace furrow {

template <int Dim>
void xsph_velocity(const Stencil<Dim>& stencil, const Particles<Dim>& p, std::span<const Vector<Dim>> velocity, double eps,
                   std::span<Vector<Dim>> out) {
  has_run(Module::xsph);
  const double h = stencil.smoothing_length;
  for_each_particle(stencil, reads(p.mass, p.density, velocity), [&]<class K>(std::size_t i, auto&& neighbours, K) {
    LaneVector<Dim> drift;
    const LaneVector<Dim> v_i = own<2>(neighbours);
    neighbours([&](const Pairs<Dim>& pair, const Lanes& m_j, const Lanes& rho_j, const LaneVector<Dim>& v_j) {
      const Lanes rho = 0.5 * (p.density[i] + rho_j);
      const Lanes W = scale<K, Dim>(h) * Shape<K, Dim>::w(pair.r * (1.0 / h));
      drift += (m_j / rho * W) * (v_j - v_i);
    });
    out[i] = velocity[i] + eps * sum(drift);
  });
}

#define FURROW_INSTANTIATE(Dim)                                                                                          \
  template void xsph_velocity<Dim>(const Stencil<Dim>&, const Particles<Dim>&, std::span<const Vector<Dim>>, double, \
                                   std::span<Vector<Dim>>);
FURROW_INSTANTIATE(2)
FURROW_INSTANTIATE(3)
#undef FURROW_INSTANTIATE

}  // namespace furrow
