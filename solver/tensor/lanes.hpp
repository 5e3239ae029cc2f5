// Lanes: eight particles at a time. Pair loops are written once over Lanes and read like the equation for one pair; the
// compiler turns each line into the vector instructions of the machine. The width is fixed so that sums have the same order
// on every machine.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#if defined(__AVX512F__)
#include <immintrin.h>
#endif

#include "solver/tensor/tensor.hpp"

namespace furrow {

inline constexpr int lane_count = 8;
typedef double Lanes __attribute__((vector_size(lane_count * sizeof(double))));

constexpr double positive_part(double a) { return a > 0.0 ? a : 0.0; }
constexpr Lanes positive_part(const Lanes& a) { return a > 0.0 ? a : Lanes{}; }

inline double square_root(double a) { return std::sqrt(a); }
inline Lanes square_root(const Lanes& a) {
#if defined(__AVX512F__)
  return reinterpret_cast<Lanes>(_mm512_maskz_sqrt_pd(0xff, reinterpret_cast<__m512d>(a)));
#else
  Lanes root;
  for (int l = 0; l < lane_count; ++l) root[l] = std::sqrt(a[l]);
  return root;
#endif
}

inline double sum(const Lanes& a) { return ((a[0] + a[1]) + (a[2] + a[3])) + ((a[4] + a[5]) + (a[6] + a[7])); }

inline Lanes load(const double* first) {
  Lanes a;
  std::memcpy(&a, first, sizeof a);
  return a;
}

/// Writes first + l for the lanes l of `mask` in which a < limit, one behind the other, and returns how many there are. `out` must
/// have room for all lanes.
inline int write_where_less(const Lanes& a, double limit, unsigned mask, std::int32_t first, std::int32_t* out) {
#if defined(__AVX512F__) && defined(__AVX512VL__)
  const __mmask8 less = _mm512_mask_cmp_pd_mask(static_cast<__mmask8>(mask), reinterpret_cast<__m512d>(a), _mm512_set1_pd(limit), _CMP_LT_OQ);
  const __m256i index = _mm256_add_epi32(_mm256_set1_epi32(first), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
  _mm256_mask_compressstoreu_epi32(out, less, index);
  return std::popcount(static_cast<unsigned>(less));
#else
  std::int32_t* end = out;
  for (int l = 0; l < lane_count; ++l) {
    *end = first + l;   // written always, kept when near: no branch to mispredict
    end += static_cast<int>(a[l] < limit) & static_cast<int>(mask >> l & 1u);
  }
  return static_cast<int>(end - out);
#endif
}

/// Four doubles that come from memory in one piece.
typedef double Quad __attribute__((vector_size(4 * sizeof(double))));

/// Rows j[0..7] of an array of rows, `Quads` quads each, turned into lanes: element 4 q + c of the result holds number c of quad q
/// of each row. Eight whole rows and some shuffles cost half of what as many gathers cost. Inlined always: lanes stay in registers.
template <int Quads>
[[gnu::always_inline]] inline std::array<Lanes, 4 * Quads> load_rows(const Quad* rows, const std::int32_t* j) {
  std::array<Lanes, 4 * Quads> lanes;
  for (int q = 0; q < Quads; ++q) {
    const auto two = [&](int l) {   // quad q of rows l and l + 4, side by side
      const auto quad = [&](int k) { return rows[static_cast<std::ptrdiff_t>(j[k]) * Quads + q]; };
      return __builtin_shufflevector(quad(l), quad(l + 4), 0, 1, 2, 3, 4, 5, 6, 7);
    };
    const Lanes a = two(0), b = two(1), c = two(2), d = two(3);
    const Lanes ab_even = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
    const Lanes ab_odd = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
    const Lanes cd_even = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14);
    const Lanes cd_odd = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
    Lanes* const out = lanes.data() + 4 * q;
    out[0] = __builtin_shufflevector(ab_even, cd_even, 0, 1, 8, 9, 4, 5, 12, 13);
    out[1] = __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 8, 9, 4, 5, 12, 13);
    out[2] = __builtin_shufflevector(ab_even, cd_even, 2, 3, 10, 11, 6, 7, 14, 15);
    out[3] = __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 10, 11, 6, 7, 14, 15);
  }
  return lanes;
}

/// N components, each of eight particles.
template <int N>
struct LaneVector {
  std::array<Lanes, N> c{};
  Lanes& operator[](int a) { return c[static_cast<std::size_t>(a)]; }
  const Lanes& operator[](int a) const { return c[static_cast<std::size_t>(a)]; }

  LaneVector& operator+=(const LaneVector& v) {
    for (int a = 0; a < N; ++a) (*this)[a] += v[a];
    return *this;
  }
  friend LaneVector operator-(LaneVector u, const LaneVector& v) {
    for (int a = 0; a < N; ++a) u[a] -= v[a];
    return u;
  }
  friend LaneVector operator*(const Lanes& f, LaneVector v) {
    for (int a = 0; a < N; ++a) v[a] *= f;
    return v;
  }
};

template <int N>
Lanes dot(const LaneVector<N>& u, const LaneVector<N>& v) {
  Lanes s = u[0] * v[0];
  for (int a = 1; a < N; ++a) s += u[a] * v[a];
  return s;
}

/// Rows x columns, each of eight particles; (a, b) = component of row a and column b, stored by columns as Eigen does.
template <int N>
struct LaneMatrix {
  std::array<Lanes, static_cast<std::size_t>(N * N)> c{};
  Lanes& operator()(int a, int b) { return c[static_cast<std::size_t>(b * N + a)]; }
  const Lanes& operator()(int a, int b) const { return c[static_cast<std::size_t>(b * N + a)]; }

  /// this += u v^T.
  void add_outer(const LaneVector<N>& u, const LaneVector<N>& v) {
    for (int b = 0; b < N; ++b)
      for (int a = 0; a < N; ++a) (*this)(a, b) += u[a] * v[b];
  }
  LaneMatrix& operator+=(const LaneMatrix& m) {
    for (std::size_t k = 0; k < c.size(); ++k) c[k] += m.c[k];
    return *this;
  }
  friend LaneMatrix operator+(LaneMatrix p, const LaneMatrix& q) { return p += q; }
  friend LaneMatrix operator*(const Lanes& f, LaneMatrix m) {
    for (Lanes& element : m.c) element *= f;
    return m;
  }
  friend LaneVector<N> operator*(const LaneMatrix& m, const LaneVector<N>& v) {
    LaneVector<N> p;
    for (int b = 0; b < N; ++b)
      for (int a = 0; a < N; ++a) p[a] += m(a, b) * v[b];
    return p;
  }
};

/// The same number, vector or matrix in all lanes.
inline Lanes broadcast(double s) { return Lanes{} + s; }
template <int N>
LaneVector<N> broadcast(const Vector<N>& v) {
  LaneVector<N> b;
  for (int a = 0; a < N; ++a) b[a] = broadcast(v[a]);
  return b;
}
template <int N>
  requires(N > 1)
LaneMatrix<N> broadcast(const Matrix<N>& m) {
  LaneMatrix<N> b;
  for (std::size_t k = 0; k < b.c.size(); ++k) b.c[k] = broadcast(m.data()[k]);
  return b;
}

/// Sums over the lanes.
template <int N>
Vector<N> sum(const LaneVector<N>& v) {
  Vector<N> s;
  for (int a = 0; a < N; ++a) s[a] = sum(v[a]);
  return s;
}
template <int N>
Matrix<N> sum(const LaneMatrix<N>& m) {
  Matrix<N> s;
  for (int k = 0; k < N * N; ++k) s.data()[k] = sum(m.c[static_cast<std::size_t>(k)]);
  return s;
}

}  // namespace furrow
