#include "solver/schemes/kernel_correction.hpp"

#include "solver/modules.hpp"

namespace furrow {

template <int Dim>
void kernel_sums(const Stencil<Dim>& stencil, std::span<const double> volume, std::span<KernelSums<Dim>> out) {
  has_run(Module::kernel_correction);
  const double h = stencil.smoothing_length;
  for_each_particle(stencil, reads(volume), [&]<class K>(std::size_t i, auto&& neighbours, K) {
    Lanes unity{};
    LaneVector<Dim> constant;
    LaneMatrix<Dim> linear;
    neighbours([&](const Pairs<Dim>& pair, const Lanes& V_j) {
      const Lanes W = scale<K, Dim>(h) * Shape<K, Dim>::w(pair.r * (1.0 / h));
      unity += pair.r > 1e-140 ? V_j * W : Lanes{};   // not the padding with the particle itself
      constant += V_j * pair.grad;
      linear.add_outer(broadcast(-1.0) * pair.x_ij, V_j * pair.grad);
    });
    out[i] = {sum(unity) + volume[i] * value<K, Dim>(0.0, h), sum(constant), sum(linear)};
  });
}

template <int Dim>
void kernel_correction(const Stencil<Dim>& stencil, std::span<const double> volume, std::span<Matrix<Dim>> out, double least_span) {
  has_run(Module::kernel_correction);
  for_each_particle(stencil, reads(volume), [&](std::size_t i, auto&& neighbours, auto) {
    LaneMatrix<Dim> linear;
    neighbours([&](const Pairs<Dim>& pair, const Lanes& V_j) {
      linear.add_outer(pair.x_ij, (-V_j) * pair.grad);
    });
    out[i] = inverse_of_moments<Dim>(sum(linear), least_span);
  });
}

#define FURROW_INSTANTIATE(Dim)                                                                              \
  template void kernel_sums<Dim>(const Stencil<Dim>&, std::span<const double>, std::span<KernelSums<Dim>>);  \
  template void kernel_correction<Dim>(const Stencil<Dim>&, std::span<const double>, std::span<Matrix<Dim>>, double);
FURROW_INSTANTIATE(2)
FURROW_INSTANTIATE(3)
#undef FURROW_INSTANTIATE

}  // namespace furrow
