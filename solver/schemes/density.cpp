#include "solver/schemes/density.hpp"

#include "solver/modules.hpp"

namespace furrow {
namespace {

/// W of a pair, zero for the particle's own padding.
template <int Dim, class K>
Lanes weight(const Pairs<Dim>& pair, const K&, double h) {
  const Lanes W = scale<K, Dim>(h) * Shape<K, Dim>::w(pair.r * (1.0 / h));
  return pair.r > 1e-140 ? W : Lanes{};
}

template <int Dim, class K>
double own_weight(const K&, double h) {
  return value<K, Dim>(0.0, h);
}

}  // namespace

template <int Dim>
void interpolate(const Stencil<Dim>& stencil, std::span<const double> volume, std::span<const double> f, std::span<double> out) {
  has_run(Module::density);
  const double h = stencil.smoothing_length;
  for_each_particle(stencil, reads(volume, f), [&](std::size_t i, auto&& neighbours, auto kernel) {
    Lanes total{};
    neighbours([&](const Pairs<Dim>& pair, const Lanes& V_j, const Lanes& f_j) { total += V_j * f_j * weight<Dim>(pair, kernel, h); });
    out[i] = sum(total) + volume[i] * f[i] * own_weight<Dim>(kernel, h);
  });
}

template <int Dim>
void summation_density(const Stencil<Dim>& stencil, std::span<const double> mass, std::span<double> density) {
  has_run(Module::density);
  const double h = stencil.smoothing_length;
  for_each_particle(stencil, reads(mass), [&](std::size_t i, auto&& neighbours, auto kernel) {
    Lanes total{};
    neighbours([&](const Pairs<Dim>& pair, const Lanes& m_j) { total += m_j * weight<Dim>(pair, kernel, h); });
    density[i] = sum(total) + mass[i] * own_weight<Dim>(kernel, h);
  });
}

template <int Dim>
void shepard_density(const Stencil<Dim>& stencil, std::span<const double> mass, std::span<const double> before,
                     std::span<double> density) {
  has_run(Module::density);
  const double h = stencil.smoothing_length;
  for_each_particle(stencil, reads(mass, before), [&](std::size_t i, auto&& neighbours, auto kernel) {
    Lanes mass_sum{}, volume_sum{};
    neighbours([&](const Pairs<Dim>& pair, const Lanes& m_j, const Lanes& rho_j) {
      const Lanes W = weight<Dim>(pair, kernel, h);
      mass_sum += m_j * W;
      volume_sum += m_j / rho_j * W;
    });
    const double W_0 = own_weight<Dim>(kernel, h);
    density[i] = (sum(mass_sum) + mass[i] * W_0) / (sum(volume_sum) + mass[i] / before[i] * W_0);
  });
}

#define FURROW_INSTANTIATE(Dim)                                                                                              \
  template void interpolate<Dim>(const Stencil<Dim>&, std::span<const double>, std::span<const double>, std::span<double>); \
  template void summation_density<Dim>(const Stencil<Dim>&, std::span<const double>, std::span<double>);                    \
  template void shepard_density<Dim>(const Stencil<Dim>&, std::span<const double>, std::span<const double>, std::span<double>);
FURROW_INSTANTIATE(2)
FURROW_INSTANTIATE(3)
#undef FURROW_INSTANTIATE

}  // namespace furrow
