#include "solver/schemes/reference_sums.hpp"

#include "solver/modules.hpp"
#include "solver/particles/ordered_sum.hpp"

namespace furrow {
namespace {

// A vector lies in one quad, a matrix in one quad a column. Products of a neighbour's matrix with X_ij then need its columns as they
// lie in memory and single numbers of X_ij, which the machine spreads over a quad as it reads them: nothing is rearranged.

[[gnu::always_inline]] inline Quad spread(double a) { return Quad{a, a, a, a}; }

template <int Dim>
[[gnu::always_inline]] inline Quad quad(const Vector<Dim>& v, double last = 0.0) {
  Quad q{v[0], v[1], 0.0, last};
  if constexpr (Dim == 3) q[2] = v[2];
  return q;
}

template <int Dim>
[[gnu::always_inline]] inline Vector<Dim> vector(const Quad& q) {
  Vector<Dim> v;
  for (int a = 0; a < Dim; ++a) v[a] = q[a];
  return v;
}

[[gnu::always_inline]] inline double sum(const Quad& q) { return (q[0] + q[1]) + (q[2] + q[3]); }

/// Quad c of the result holds number c of each of the four.
[[gnu::always_inline]] inline std::array<Quad, 4> transposed(const Quad* q) {
  const Quad ab_even = __builtin_shufflevector(q[0], q[1], 0, 4, 2, 6), ab_odd = __builtin_shufflevector(q[0], q[1], 1, 5, 3, 7);
  const Quad cd_even = __builtin_shufflevector(q[2], q[3], 0, 4, 2, 6), cd_odd = __builtin_shufflevector(q[2], q[3], 1, 5, 3, 7);
  return {__builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5), __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5),
          __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7), __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7)};
}

template <int Dim>
[[gnu::always_inline]] inline Quad dot(const std::array<Quad, 4>& u, const std::array<Quad, 4>& v) {
  Quad s = u[0] * v[0];
  for (std::size_t a = 1; a < Dim; ++a) s += u[a] * v[a];
  return s;
}

/// Rows of `width` quads, the reference position in the first; put(i, row + 1) fills in the others.
template <int Dim, class Put>
const Quad* rows_of(std::span<const Vector<Dim>> position, int width, Put&& put) {
  std::vector<Quad>& storage = detail::row_storage();
  const std::size_t n = position.size(), w = static_cast<std::size_t>(width);
  if (storage.size() < n * w) storage.resize(n * w);
  Quad* const first = storage.data();
  for_all(n, [&](std::size_t i) {
    first[i * w] = quad<Dim>(position[i]);
    put(i, first + i * w + 1);
  });
  return first;
}

/// Columns of a matrix times X_ij, X_j read from memory number by number.
template <int Dim>
struct Offset {
  Quad own[Dim];   ///< X_i, each number over a quad
  explicit Offset(const Vector<Dim>& X_i) {
    for (int a = 0; a < Dim; ++a) own[a] = spread(X_i[a]);
  }
  [[gnu::always_inline]] std::array<Quad, Dim> to(const Quad* X_j) const {
    const auto* const number = reinterpret_cast<const double*>(X_j);
    std::array<Quad, Dim> X_ij;
    for (std::size_t a = 0; a < Dim; ++a) X_ij[a] = own[a] - spread(number[a]);
    return X_ij;
  }
};

void need_whole_space(bool periodic) {
  if (periodic) throw std::invalid_argument("sums that keep their pairs are not there for periodic boxes");
}

}  // namespace

template <int Dim>
void weigh_pairs(const Stencil<Dim>& s, std::span<const double> volume, PairWeights& out) {
  need_whole_space(s.box.any_periodic());
  out.slope.resize(s.neighbours->index.size());
  out.spread.resize(s.neighbours->index.size());
  std::visit(
      [&]<class K>(K) {
        const double h = s.smoothing_length, W_0 = scale<K, Dim>(h);
        for_all(s.size(), [&](std::size_t i) {
          for (std::int64_t k = s.neighbours->begin[i]; k < s.neighbours->begin[i + 1]; ++k) {
            const auto at = static_cast<std::size_t>(k);
            const auto j = static_cast<std::size_t>(s.neighbours->index[at]);
            const double r2 = (s.position[i] - s.position[j]).squaredNorm(), q = std::sqrt(r2) / h;
            out.slope[at] = j == i ? 0.0 : volume[j] * W_0 / (h * h) * dw_over_q<Shape<K, Dim>>(q);
            out.spread[at] = j == i ? 0.0 : volume[j] * W_0 * Shape<K, Dim>::w(q) / r2;
          }
        });
      },
      s.kernel);
}

template <int Dim>
void reference_gradient(const Stencil<Dim>& s, const PairWeights& weights, std::span<const Vector<Dim>> velocity,
                        std::span<const Matrix<Dim>> correction, std::span<Matrix<Dim>> out) {
  constexpr int width = 2;
  const Quad* const rows = rows_of<Dim>(s.position, width, [&](std::size_t i, Quad* row) { row[0] = quad<Dim>(velocity[i]); });
  const std::int32_t* const index = s.neighbours->index.data();
  const double* const slope = weights.slope.data();
  for_all(s.size(), [&](std::size_t i) {
    const Offset<Dim> X_i(s.position[i]);
    const Quad v_i = quad<Dim>(velocity[i]);
    Quad rate[2][Dim] = {};   // two sums side by side: a chain of additions would wait for itself
    for (std::int64_t k = s.neighbours->begin[i]; k < s.neighbours->begin[i + 1]; k += 2)
      for (int side = 0; side < 2; ++side) {
        const Quad* const row = rows + static_cast<std::ptrdiff_t>(index[k + side]) * width;
        const auto X_ij = X_i.to(row);
        const Quad weighted = spread(slope[k + side]) * (row[1] - v_i);
        for (std::size_t a = 0; a < Dim; ++a) rate[side][a] += weighted * X_ij[a];
      }
    Matrix<Dim> plain;
    for (int a = 0; a < Dim; ++a) plain.col(a) = vector<Dim>(rate[0][a] + rate[1][a]);
    out[i] = correction.empty() ? plain : Matrix<Dim>(plain * correction[i]);
  });
}

template <int Dim>
void reference_divergence(const Stencil<Dim>& s, const PairWeights& weights, std::span<const Matrix<Dim>> A,
                          double reference_density, std::span<Vector<Dim>> acceleration) {
  constexpr int width = 1 + Dim;
  const Quad* const rows = rows_of<Dim>(s.position, width, [&](std::size_t i, Quad* row) {
    for (int a = 0; a < Dim; ++a) row[a] = quad<Dim>(A[i].col(a));
  });
  const std::int32_t* const index = s.neighbours->index.data();
  const double* const slope = weights.slope.data();
  for_all(s.size(), [&](std::size_t i) {
    const Offset<Dim> X_i(s.position[i]);
    const Quad* const A_i = rows + i * width + 1;
    Quad total[2] = {};
    for (std::int64_t k = s.neighbours->begin[i]; k < s.neighbours->begin[i + 1]; k += 2)
      for (int side = 0; side < 2; ++side) {
        const Quad* const row = rows + static_cast<std::ptrdiff_t>(index[k + side]) * width;
        const auto X_ij = X_i.to(row);
        Quad pull{};
        for (std::size_t a = 0; a < Dim; ++a) pull += (A_i[a] + row[1 + a]) * X_ij[a];
        total[side] += spread(slope[k + side]) * pull;
      }
    acceleration[i] = vector<Dim>(total[0] + total[1]) / reference_density;
  });
}

template <int Dim>
void damped_reference_divergence(const Stencil<Dim>& s, const PairWeights& weights, std::span<const Matrix<Dim>> A,
                                 const Particles<Dim>& p, std::span<const Vector<Dim>> velocity,
                                 std::span<const Matrix<Dim>> gradient_rate, double zeta, double reference_density,
                                 std::span<Vector<Dim>> acceleration, std::span<double> power) {
  // In a row: X, (x, rho), (v, c), the columns of F'/2, the columns of A. One's own rho and c enter with their sign turned, so that
  // differences of positions carry minus the sum of densities.
  constexpr int width = 3 + 2 * Dim;
  const Quad* const rows = rows_of<Dim>(s.position, width, [&](std::size_t i, Quad* row) {
    row[0] = quad<Dim>(p.position[i], p.density[i]);
    row[1] = quad<Dim>(velocity[i], p.sound_speed[i]);
    for (int a = 0; a < Dim; ++a) {
      row[2 + a] = 0.5 * quad<Dim>(gradient_rate[i].col(a));
      row[2 + Dim + a] = quad<Dim>(A[i].col(a));
    }
  });
  const std::int32_t* const index = s.neighbours->index.data();
  const double* const slope = weights.slope.data();
  const double* const share = weights.spread.data();
  const Quad strength = spread(-0.25 * zeta * s.smoothing_length), tiny = spread(1e-300);
  for_all(s.size(), [&](std::size_t i) {
    const Offset<Dim> X_i(s.position[i]);
    const Quad x_i = quad<Dim>(p.position[i], -p.density[i]), v_i = quad<Dim>(velocity[i], -p.sound_speed[i]);
    Quad G_i[Dim], A_i[Dim];
    for (int a = 0; a < Dim; ++a) {
      G_i[a] = 0.5 * quad<Dim>(gradient_rate[i].col(a));
      A_i[a] = quad<Dim>(A[i].col(a));
    }
    Quad total[2] = {}, damped{};
    std::array<Quad, Dim> from_dampers{};
    for (std::int64_t k = s.neighbours->begin[i]; k < s.neighbours->begin[i + 1]; k += 4) {
      Quad x[4], v[4], seen[4];
      for (int l = 0; l < 4; ++l) {
        const Quad* const row = rows + static_cast<std::ptrdiff_t>(index[k + l]) * width;
        const auto X_ij = X_i.to(row);
        x[l] = x_i - row[1];
        v[l] = v_i - row[2];
        Quad stretch{}, pull{};
        for (std::size_t a = 0; a < Dim; ++a) {
          stretch += (G_i[a] + row[3 + a]) * X_ij[a];
          pull += (A_i[a] + row[3 + Dim + a]) * X_ij[a];
        }
        seen[l] = stretch;
        total[l % 2] += spread(slope[k + l]) * pull;
      }
      const std::array<Quad, 4> x_ij = transposed(x), v_ij = transposed(v), rate = transposed(seen);
      Quad weight;
      std::memcpy(&weight, share + k, sizeof weight);
      const Quad approach = dot<Dim>(x_ij, v_ij), unseen = approach - dot<Dim>(x_ij, rate);
      const Quad force = strength * weight * (x_ij[3] * v_ij[3]) * unseen / (dot<Dim>(x_ij, x_ij) + tiny);
      for (std::size_t a = 0; a < Dim; ++a) from_dampers[a] += force * x_ij[a];
      damped += force * approach;
    }
    Vector<Dim> a = vector<Dim>(total[0] + total[1]);
    for (int c = 0; c < Dim; ++c) a[c] += sum(from_dampers[static_cast<std::size_t>(c)]);
    acceleration[i] = a / reference_density;
    power[i] = -0.5 * sum(damped) / reference_density;
  });
}

#define FURROW_INSTANTIATE(Dim)                                                                                                 \
  template void weigh_pairs<Dim>(const Stencil<Dim>&, std::span<const double>, PairWeights&);                                   \
  template void reference_gradient<Dim>(const Stencil<Dim>&, const PairWeights&, std::span<const Vector<Dim>>,                  \
                                        std::span<const Matrix<Dim>>, std::span<Matrix<Dim>>);                                  \
  template void reference_divergence<Dim>(const Stencil<Dim>&, const PairWeights&, std::span<const Matrix<Dim>>, double,        \
                                          std::span<Vector<Dim>>);                                                              \
  template void damped_reference_divergence<Dim>(const Stencil<Dim>&, const PairWeights&, std::span<const Matrix<Dim>>,         \
                                                 const Particles<Dim>&, std::span<const Vector<Dim>>,                           \
                                                 std::span<const Matrix<Dim>>, double, double, std::span<Vector<Dim>>,          \
                                                 std::span<double>);
FURROW_INSTANTIATE(2)
FURROW_INSTANTIATE(3)
#undef FURROW_INSTANTIATE

}  // namespace furrow
