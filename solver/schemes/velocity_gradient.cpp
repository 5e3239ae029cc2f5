#include "solver/schemes/velocity_gradient.hpp"

#include "solver/modules.hpp"
#include "solver/schemes/kernel_correction.hpp"

namespace furrow {

template <int Dim>
void gradient(const Stencil<Dim>& stencil, std::span<const double> volume, std::span<const double> f,
              std::span<const Matrix<Dim>> correction, std::span<Vector<Dim>> out) {
  has_run(Module::velocity_gradient);
  for_each_particle(stencil, reads(volume, f), [&](std::size_t i, auto&& neighbours, auto) {
    LaneVector<Dim> total;
    const Lanes f_i = own<1>(neighbours);
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
    const LaneVector<Dim> v_i = own<1>(neighbours);
    neighbours([&](const Pairs<Dim>& pair, const Lanes& V_j, const LaneVector<Dim>& v_j) {
      L.add_outer(v_j - v_i, V_j * pair.grad);
    });
    const Matrix<Dim> plain = sum(L);
    out[i] = correction.empty() ? plain : Matrix<Dim>(plain * correction[i]);
  });
}

template <int Dim>
void corrected_velocity_gradient(const Stencil<Dim>& stencil, std::span<const double> volume, std::span<const Vector<Dim>> velocity,
                                 double least_span, std::span<Matrix<Dim>> correction, std::span<Matrix<Dim>> out) {
  has_run(Module::velocity_gradient);
  has_run(Module::kernel_correction);
  for_each_particle(stencil, reads(volume, velocity), [&](std::size_t i, auto&& neighbours, auto) {
    LaneMatrix<Dim> L, linear;
    const LaneVector<Dim> v_i = own<1>(neighbours);
    neighbours([&](const Pairs<Dim>& pair, const Lanes& V_j, const LaneVector<Dim>& v_j) {
      const LaneVector<Dim> weighted = V_j * pair.grad;
      L.add_outer(v_j - v_i, weighted);
      linear.add_outer(broadcast(-1.0) * pair.x_ij, weighted);
    });
    correction[i] = inverse_of_moments<Dim>(sum(linear), least_span);
    out[i] = sum(L) * correction[i];
  });
}

#define FURROW_INSTANTIATE(Dim)                                                                              \
  template void gradient<Dim>(const Stencil<Dim>&, std::span<const double>, std::span<const double>,         \
                              std::span<const Matrix<Dim>>, std::span<Vector<Dim>>);                         \
  template void velocity_gradient<Dim>(const Stencil<Dim>&, std::span<const double>, std::span<const Vector<Dim>>, \
                                       std::span<const Matrix<Dim>>, std::span<Matrix<Dim>>);                   \
  template void corrected_velocity_gradient<Dim>(const Stencil<Dim>&, std::span<const double>, std::span<const Vector<Dim>>, \
                                                 double, std::span<Matrix<Dim>>, std::span<Matrix<Dim>>);
FURROW_INSTANTIATE(2)
FURROW_INSTANTIATE(3)
#undef FURROW_INSTANTIATE

}  // namespace furrow
