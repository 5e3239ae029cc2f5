#include "solver/schemes/quadratic_gradient.hpp"

#include "solver/modules.hpp"

namespace furrow {
namespace {

/// Rows that pick the gradient out of the coefficients of a fit with the first `Terms` terms: the first Dim rows of M^-1, by
/// M = L D L^T. False where the fit is not determined. Written out: a general solver spends its time on finding out how small M is.
template <int Terms, int Dim, class Moments>
bool fit(const Moments& M, double h, QuadraticGradient<Dim>& C) {
  const double largest = M.diagonal().template head<Terms>().maxCoeff();
  double L[Terms][Terms], D[Terms];
  for (int j = 0; j < Terms; ++j) {
    D[j] = M(j, j);
    for (int k = 0; k < j; ++k) D[j] -= L[j][k] * L[j][k] * D[k];
    if (!(D[j] > 1e-8 * largest)) return false;
    for (int i = j + 1; i < Terms; ++i) {
      L[i][j] = M(i, j);
      for (int k = 0; k < j; ++k) L[i][j] -= L[i][k] * L[j][k] * D[k];
      L[i][j] /= D[j];
    }
  }
  C.setZero();
  for (int row = 0; row < Dim; ++row) {
    double x[Terms];
    for (int i = 0; i < Terms; ++i) {
      x[i] = i == row ? 1.0 : 0.0;
      for (int k = row; k < i; ++k) x[i] -= L[i][k] * x[k];
    }
    for (int i = Terms - 1; i >= 0; --i) {
      x[i] /= D[i];
      for (int k = i + 1; k < Terms; ++k) x[i] -= L[k][i] * x[k];
      C(row, i) = x[i] / h;
    }
  }
  return true;
}

}  // namespace

template <int Dim>
void quadratic_correction(const Stencil<Dim>& stencil, std::span<const double> volume, std::span<QuadraticGradient<Dim>> out) {
  has_run(Module::quadratic_gradient);
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
  has_run(Module::quadratic_gradient);
  constexpr int terms = quadratic_terms<Dim>;
  const double h = stencil.smoothing_length;
  for_each_particle(stencil, reads(volume, velocity), [&]<class K>(std::size_t i, auto&& neighbours, K) {
    std::array<LaneVector<Dim>, terms> total{};
    const LaneVector<Dim> v_i = own<1>(neighbours);
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
