#include "solver/schemes/velocity_gradient.hpp"

#include "solver/modules.hpp"

namespace furrow {

template <int Dim>
void gradient(const Stencil<Dim>& stencil, std::span<const double> volume, std::span<const double> f,
              std::span<const Matrix<Dim>> correction, std::span<Vector<Dim>> out) {
  has_run(Module::velocity_gradient);
  for_each_particle(stencil, reads(volume, f), [&](std::size_t i, auto&& neighbours, auto) {
    LaneVector<Dim> total;
    const Lanes f_i = broadcast(f[i]);
    neighbours([&](const Pairs<Dim>& pair, const Lanes& V_j, const Lanes& f_j) {
      total += (V_j * (f_j - f_i)) * pair.grad;
    });
    const Vector<Dim> plain = sum(total);
    out[i] = correction.empty() ? plain : Vector<Dim>(correction[i].transpose() * plain);
  });
}

template <int Dim>
void velocity_gradient(const Stencil<Dim>& stencil, std::span<const double> volume, std::span<const Vector<Dim>> velocity,
                       std::span<const Matrix<Dim>> correction, std::span<Matrix<Dim>> out) {
  has_run(Module::velocity_gradient);
  for_each_particle(stencil, reads(volume, velocity), [&](std::size_t i, auto&& neighbours, auto) {
    LaneMatrix<Dim> L;
    const LaneVector<Dim> v_i = broadcast<Dim>(velocity[i]);
    neighbours([&](const Pairs<Dim>& pair, const Lanes& V_j, const LaneVector<Dim>& v_j) {
      L.add_outer(v_j - v_i, V_j * pair.grad);
    });
    const Matrix<Dim> plain = sum(L);
    out[i] = correction.empty() ? plain : Matrix<Dim>(plain * correction[i]);
  });
}

#define FURROW_INSTANTIATE(Dim)                                                                              \
  template void gradient<Dim>(const Stencil<Dim>&, std::span<const double>, std::span<const double>,         \
                              std::span<const Matrix<Dim>>, std::span<Vector<Dim>>);                         \
  template void velocity_gradient<Dim>(const Stencil<Dim>&, std::span<const double>, std::span<const Vector<Dim>>, \
                                       std::span<const Matrix<Dim>>, std::span<Matrix<Dim>>);
FURROW_INSTANTIATE(2)
FURROW_INSTANTIATE(3)
#undef FURROW_INSTANTIATE

}  // namespace furrow
