#include "solver/schemes/quadratic_sums.hpp"

#include <cstring>

#include "solver/modules.hpp"

namespace furrow {
namespace {

typedef double Pair __attribute__((vector_size(2 * sizeof(double))));

template <class T>
[[gnu::always_inline]] inline T load(const double* from) {
  T to;
  std::memcpy(&to, from, sizeof to);
  return to;
}
/// (a, a, b, b) of the vector (a, b): what multiplies the columns of a matrix as they lie in memory.
[[gnu::always_inline]] inline Quad on_columns(const Vector<2>& g) {
  const Pair p = load<Pair>(g.data());
  return __builtin_shufflevector(p, p, 0, 0, 1, 1);
}
[[gnu::always_inline]] inline Quad twice(const Vector<2>& v) {
  const Pair p = load<Pair>(v.data());
  return __builtin_shufflevector(p, p, 0, 1, 0, 1);
}
[[gnu::always_inline]] inline Quad columns_of(const Matrix<2>& m) { return load<Quad>(m.data()); }

Vector<2> weighted(const QuadraticGradient<2>& C, const Vector<2>& x_ij, double h, double weight) {
  LaneVector<2> lanes;
  for (int a = 0; a < 2; ++a) lanes[a] = broadcast(x_ij[a]);
  const auto p = quadratic_basis<2>(lanes, h);
  Vector<2> g = Vector<2>::Zero();
  for (int b = 0; b < quadratic_terms<2>; ++b) g += weight * p.c[static_cast<std::size_t>(b)][0] * C.col(b);
  return g;
}

}  // namespace

void weigh_quadratic_pairs(const Stencil<2>& s, std::span<const double> volume, std::span<const QuadraticGradient<2>> correction,
                           PairGradients& out) {
  has_run(Module::quadratic_gradient);
  if (s.box.any_periodic()) throw std::invalid_argument("sums that keep their pairs are not there for periodic boxes");
  std::vector<QuadraticGradient<2>> C(s.position.size());
  std::copy_n(correction.begin(), s.size(), C.begin());
  if (s.images) s.images->fill_quadratic(std::span(C));
  out.own.assign(s.neighbours->index.size(), Vector<2>::Zero());
  out.others.assign(s.neighbours->index.size(), Vector<2>::Zero());
  out.total.assign(s.size(), Vector<2>::Zero());
  const double h = s.smoothing_length;
  std::visit(
      [&]<class K>(K) {
        for_all(s.size(), [&](std::size_t i) {
          const auto first = static_cast<std::size_t>(s.neighbours->begin[i]);
          for (std::size_t k = first; k < first + static_cast<std::size_t>(s.neighbours->count[i]); ++k) {
            const auto j = static_cast<std::size_t>(s.neighbours->index[k]);
            const Vector<2> x_ij = s.position[i] - s.position[j];
            const double weight = volume[j] * scale<K, 2>(h) * Shape<K, 2>::w(x_ij.norm() / h);
            out.own[k] = weighted(C[i], x_ij, h, weight);
            out.others[k] = weighted(C[j], -x_ij, h, weight);
            out.total[i] += out.own[k];
          }
        });
      },
      s.kernel);
}

void quadratic_reference_gradient(const Stencil<2>& s, const PairGradients& pairs, std::span<const Vector<2>> velocity,
                                  std::span<Matrix<2>> out) {
  const std::int32_t* const index = s.neighbours->index.data();
  const Vector<2>* const v = velocity.data();
  const Vector<2>* const g = pairs.own.data();
  for_all(s.size(), [&](std::size_t i) {
    const Quad v_i = twice(v[i]);
    Quad rate[2] = {};   // two sums side by side: a chain of additions would wait for itself
    for (std::int64_t k = s.neighbours->begin[i]; k < s.neighbours->begin[i + 1]; k += 2)
      for (int side = 0; side < 2; ++side) rate[side] += (twice(v[index[k + side]]) - v_i) * on_columns(g[k + side]);
    const Quad sum = rate[0] + rate[1];
    out[i] << sum[0], sum[2], sum[1], sum[3];
  });
}

void quadratic_reference_divergence(const Stencil<2>& s, const PairGradients& pairs, std::span<const Matrix<2>> P,
                                    double reference_density, std::span<Vector<2>> acceleration) {
  const std::int32_t* const index = s.neighbours->index.data();
  const Matrix<2>* const stress = P.data();
  const Vector<2>* const g = pairs.others.data();
  for_all(s.size(), [&](std::size_t i) {
    Quad pull[2] = {};
    for (std::int64_t k = s.neighbours->begin[i]; k < s.neighbours->begin[i + 1]; k += 2)
      for (int side = 0; side < 2; ++side) pull[side] += columns_of(stress[index[k + side]]) * on_columns(g[k + side]);
    const Quad sum = pull[0] + pull[1];
    acceleration[i] = (P[i] * pairs.total[i] - Vector<2>(sum[0] + sum[2], sum[1] + sum[3])) / reference_density;
  });
}

}  // namespace furrow
