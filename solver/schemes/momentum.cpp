#include "solver/schemes/momentum.hpp"

#include <cmath>
#include <stdexcept>

#include "solver/modules.hpp"

namespace furrow {
namespace {

Lanes power_of(const Lanes& f, double n) {
  if (n == 4.0) {
    const Lanes f2 = f * f;
    return f2 * f2;
  }
  Lanes result;
  for (int l = 0; l < lane_count; ++l) result[l] = std::pow(f[l], n);
  return result;
}

/// The sum itself; which terms are on is known when it is compiled, so that what is off costs nothing.
template <int Dim, bool Quadratic, bool Viscous, bool Artificial>
void sum_pairs(const Stencil<Dim>& stencil, const Particles<Dim>& p, std::span<const Vector<Dim>> velocity, bool dual,
               const MomentumTerms& terms, const MomentumWorkspace<Dim>& w, std::span<Vector<Dim>> acceleration,
               std::span<MomentumPower> power) {
  const double h = stencil.smoothing_length;
  // A_j is Q_j where the correction is quadratic; R_j is read where there is an artificial stress.
  const auto read = [&] {
    const auto& A = [&]() -> const auto& { if constexpr (Quadratic) return w.Q; else return w.A; }();
    if constexpr (Artificial)
      return reads(velocity, A, w.weight, p.density, p.sound_speed, w.R);
    else if constexpr (Viscous)
      return reads(velocity, A, w.weight, p.density, p.sound_speed);
    else
      return reads(velocity, A, w.weight);
  }();
  const double share = [&] {
    if constexpr (Artificial)
      if (terms.artificial_stress->neutral)
        return std::visit([&]<class K>(K) { return artificial_share<K, Dim>(terms.artificial_stress->n, terms.spacing, h); },
                          stencil.kernel);
    return 0.0;
  }();
  for_each_particle(stencil, read, [&]<class K>(std::size_t i, auto&& neighbours, K) {
    const LaneVector<Dim> v_i = own<0>(neighbours);
    const auto A_i = own<1>(neighbours);
    const Lanes prefactor = broadcast(dual ? 1.0 / p.density[i] : 1.0);
    const auto kernel = [h](const Pairs<Dim>& pair) { return scale<K, Dim>(h) * Shape<K, Dim>::w(pair.r * (1.0 / h)); };
    // [A_i + A_j] grad W, or W [Q_i p(s_ij) - Q_j p(s_ji)]: even terms of p change sign against odd ones when i and j swap.
    const auto stress_term = [&](const Pairs<Dim>& pair, const auto& A_j) {
      if constexpr (Quadratic) {
        constexpr int terms_of_p = quadratic_terms<Dim>;
        const LaneVector<terms_of_p> basis = quadratic_basis<Dim>(pair.x_ij, h);
        LaneVector<Dim> f;
        for (int b = 0; b < terms_of_p; ++b)
          for (int a = 0; a < Dim; ++a)
            f[a] += (b < Dim ? A_i[b * Dim + a] + A_j[b * Dim + a] : A_i[b * Dim + a] - A_j[b * Dim + a]) * basis[b];
        return kernel(pair) * f;
      } else {
        return (A_i + A_j) * pair.grad;
      }
    };
    LaneVector<Dim> a;
    Lanes stress_power{}, viscous_power{}, artificial_power{};
    const auto with_pairs = [&](const Pairs<Dim>& pair, const LaneVector<Dim>& v_j, const auto& A_j, const Lanes& weight_j,
                                const Lanes& rho_j, const Lanes& c_j, const auto&... R_j) {
      const LaneVector<Dim> v_ij = v_i - v_j;
      const LaneVector<Dim> from_stress = (prefactor * weight_j) * stress_term(pair, A_j);
      a += from_stress;
      stress_power += dot(from_stress, v_ij);
      const Lanes m_j = dual ? weight_j * rho_j : weight_j;
      if constexpr (Viscous) {
        const Lanes Pi = artificial_viscosity(*terms.viscosity, dot(v_ij, pair.x_ij), pair.r, h, 0.5 * (own<4>(neighbours) + c_j),
                                              0.5 * (own<3>(neighbours) + rho_j));
        const LaneVector<Dim> from_viscosity = (-m_j * Pi) * pair.grad;
        a += from_viscosity;
        viscous_power += dot(from_viscosity, v_ij);
      }
      if constexpr (Artificial) {
        const Lanes f = kernel(pair) * (1.0 / value<K, Dim>(terms.spacing, h));
        const LaneMatrix<Dim> R = own<5>(neighbours) + (R_j, ...);
        const LaneVector<Dim> from_artificial = (m_j * (power_of(f, terms.artificial_stress->n) - share)) * (R * pair.grad);
        a += from_artificial;
        artificial_power += dot(from_artificial, v_ij);
      }
    };
    if constexpr (Viscous || Artificial)
      neighbours(with_pairs);
    else
      neighbours([&](const Pairs<Dim>& pair, const LaneVector<Dim>& v_j, const auto& A_j, const Lanes& weight_j) {
        with_pairs(pair, v_j, A_j, weight_j, Lanes{}, Lanes{});
      });
    acceleration[i] = sum(a);
    power[i] = {-0.5 * sum(stress_power), -0.5 * sum(viscous_power), -0.5 * sum(artificial_power)};
  });
}

}  // namespace

template <int Dim>
void momentum(const Stencil<Dim>& stencil, const Particles<Dim>& p, std::span<const Vector<Dim>> velocity,
              const CorrectionView<Dim>& correction, const MomentumTerms& terms, MomentumWorkspace<Dim>& w,
              std::span<Vector<Dim>> acceleration, std::span<MomentumPower> power) {
  has_run(Module::momentum);
  if (terms.viscosity) has_run(Module::viscosity);
  if (terms.artificial_stress) has_run(Module::artificial_stress);
  const auto* linear = std::get_if<std::span<const Matrix<Dim>>>(&correction);
  const auto* quadratic = std::get_if<std::span<const QuadraticGradient<Dim>>>(&correction);
  const bool dual = linear || quadratic;
  if (quadratic && Dim != 2) throw std::invalid_argument("quadratic gradients are there for two dimensions only");
  if ((linear && linear->size() < p.size()) || (quadratic && quadratic->size() < p.size()))
    throw std::invalid_argument("a correction must have one entry a particle");
  const std::size_t extended = stencil.position.size();
  w.weight.resize(extended);
  if (quadratic)
    w.Q.resize(extended);
  else
    w.A.resize(extended);
  if (terms.artificial_stress) w.R.resize(extended);
  const auto n = static_cast<std::int64_t>(p.size());
#pragma omp parallel for schedule(static)
  for (std::int64_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const Matrix<Dim> sigma = p.stress[i].template topLeftCorner<Dim, Dim>();
    const double rho = p.density[i];
    w.weight[i] = dual ? p.volume(i) : p.mass[i];
    if (quadratic)
      w.Q[i] = sigma * (*quadratic)[i];
    else if (linear)
      w.A[i] = sigma * (*linear)[i].transpose();
    else
      w.A[i] = sigma / (rho * rho);
    if (terms.artificial_stress) w.R[i] = artificial_stress<Dim>(*terms.artificial_stress, sigma, rho);
  }
  if (stencil.images) {
    stencil.images->fill(std::span(w.weight));
    if (quadratic)
      stencil.images->fill_quadratic(std::span(w.Q));
    else
      stencil.images->fill_tensors(std::span(w.A));
    if (terms.artificial_stress) stencil.images->fill_tensors(std::span(w.R));
  }

  const auto run = [&]<bool Quadratic, bool Viscous, bool Artificial>() {
    sum_pairs<Dim, Quadratic, Viscous, Artificial>(stencil, p, velocity, dual, terms, w, acceleration, power);
  };
  const auto with_terms = [&]<bool Quadratic>() {
    if (terms.viscosity && terms.artificial_stress) run.template operator()<Quadratic, true, true>();
    else if (terms.viscosity) run.template operator()<Quadratic, true, false>();
    else if (terms.artificial_stress) run.template operator()<Quadratic, false, true>();
    else run.template operator()<Quadratic, false, false>();
  };
  if constexpr (Dim == 2)
    if (quadratic) return with_terms.template operator()<true>();
  with_terms.template operator()<false>();
}

#define FURROW_INSTANTIATE(Dim)                                                                                       \
  template void momentum<Dim>(const Stencil<Dim>&, const Particles<Dim>&, std::span<const Vector<Dim>>,               \
                              const CorrectionView<Dim>&, const MomentumTerms&, MomentumWorkspace<Dim>&,              \
                              std::span<Vector<Dim>>, std::span<MomentumPower>);
FURROW_INSTANTIATE(2)
FURROW_INSTANTIATE(3)
#undef FURROW_INSTANTIATE

}  // namespace furrow
