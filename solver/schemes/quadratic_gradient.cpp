#include "solver/schemes/quadratic_gradient.hpp"

#include <Eigen/Cholesky>

namespace furrow {
namespace {

/// Rows that pick the gradient out of the coefficients of a fit with the first `terms` terms; false where it is not determined.
template <int Terms, int Dim, class Moments>
bool fit(const Moments& M, double h, QuadraticGradient<Dim>& C) {
  using Square = Eigen::Matrix<double, Terms, Terms>;
  const Eigen::LDLT<Square> factors(M.template topLeftCorner<Terms, Terms>());
  const auto pivots = factors.vectorD();
  if (!(pivots.minCoeff() > 1e-8 * pivots.maxCoeff())) return false;
  C.setZero();
  C.template leftCols<Terms>() = factors.solve(Square::Identity()).template topRows<Dim>() / h;
  return true;
}

}  // namespace

template <int Dim>
void quadratic_correction(const Stencil<Dim>& stencil, std::span<const double> volume, std::span<QuadraticGradient<Dim>> out) {
  constexpr int terms = quadratic_terms<Dim>;
  const double h = stencil.smoothing_length;
  for_each_particle(stencil, reads(volume), [&]<class K>(std::size_t i, auto&& neighbours, K) {
    std::array<Lanes, terms*(terms + 1) / 2> upper{};
    neighbours([&](const Pairs<Dim>& pair, const Lanes& V_j) {
      const Lanes weight = V_j * (scale<K, Dim>(h) * Shape<K, Dim>::w(pair.r * (1.0 / h)));
      const LaneVector<terms> p = quadratic_basis<Dim>(pair.x_ij, h);
      for (std::size_t a = 0, k = 0; a < terms; ++a) {
        const Lanes wp = weight * p.c[a];
        for (std::size_t b = a; b < terms; ++b, ++k) upper[k] += wp * p.c[b];
      }
    });
    Eigen::Matrix<double, terms, terms> M;
    for (int a = 0, k = 0; a < terms; ++a)
      for (int b = a; b < terms; ++b, ++k) M(a, b) = M(b, a) = sum(upper[static_cast<std::size_t>(k)]);
    if (!fit<terms, Dim>(M, h, out[i]) && !fit<Dim, Dim>(M, h, out[i])) out[i].setZero();
  });
}

template <int Dim>
void quadratic_velocity_gradient(const Stencil<Dim>& stencil, std::span<const double> volume, std::span<const Vector<Dim>> velocity,
                                 std::span<const QuadraticGradient<Dim>> correction, std::span<Matrix<Dim>> out) {
  constexpr int terms = quadratic_terms<Dim>;
  const double h = stencil.smoothing_length;
  for_each_particle(stencil, reads(volume, velocity), [&]<class K>(std::size_t i, auto&& neighbours, K) {
    std::array<LaneVector<Dim>, terms> total{};
    const LaneVector<Dim> v_i = broadcast<Dim>(velocity[i]);
    neighbours([&](const Pairs<Dim>& pair, const Lanes& V_j, const LaneVector<Dim>& v_j) {
      const Lanes weight = V_j * (scale<K, Dim>(h) * Shape<K, Dim>::w(pair.r * (1.0 / h)));
      const LaneVector<Dim> v_ji = v_j - v_i;
      const LaneVector<terms> p = quadratic_basis<Dim>(pair.x_ij, h);
      for (std::size_t a = 0; a < terms; ++a) total[a] += (weight * p.c[a]) * v_ji;
    });
    QuadraticGradient<Dim> moments;
    for (int a = 0; a < terms; ++a) moments.col(a) = sum(total[static_cast<std::size_t>(a)]);
    out[i] = moments * correction[i].transpose();
  });
}

template void quadratic_correction<2>(const Stencil<2>&, std::span<const double>, std::span<QuadraticGradient<2>>);
template void quadratic_velocity_gradient<2>(const Stencil<2>&, std::span<const double>, std::span<const Vector<2>>,
                                             std::span<const QuadraticGradient<2>>, std::span<Matrix<2>>);

}  // namespace furrow
