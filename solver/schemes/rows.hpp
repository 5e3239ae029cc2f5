// Rows: what a sum reads of its neighbours, packed so that a neighbour is one or a few lines of memory instead of a touch of
// every array. Packing costs one pass over the particles; every pair after that is cheaper.
#pragma once

#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "solver/tensor/lanes.hpp"

namespace furrow {

/// An element of an array in a row: doubles it takes, and what eight of them are in a pair loop.
template <class T>
struct RowEntry;
template <>
struct RowEntry<double> {
  static constexpr int width = 1;
  using lanes = Lanes;
};
template <int R, int C>
struct RowEntry<Eigen::Matrix<double, R, C>> {
  static constexpr int width = R * C;
  using lanes = std::conditional_t<C != 1 && R == C, LaneMatrix<R>, LaneVector<R * C>>;   ///< other matrices column by column
};

/// The arrays that a sum reads of its neighbours, beside their position.
template <class... T>
struct Reads {
  std::tuple<std::span<const T>...> arrays;
  static constexpr int width = (0 + ... + RowEntry<T>::width);
};
/// reads(volume, velocity): anything that converts to a span.
template <class... Array>
auto reads(const Array&... arrays) {
  return Reads<std::remove_cvref_t<decltype(arrays[0])>...>{{std::span(arrays)...}};
}

namespace detail {

/// One sum is on its way at a time in a thread that starts sums; its rows are kept so that nothing is allocated a sweep.
inline std::vector<Quad>& row_storage() {
  static thread_local std::vector<Quad> storage;
  return storage;
}

/// Asks for `lines` lines of 64 bytes before they are read. An address outside of any array does no harm.
template <int lines>
[[gnu::always_inline]] inline void prefetch_lines(const void* first) {
  for (int k = 0; k < lines; ++k) __builtin_prefetch(static_cast<const char*>(first) + 64 * k);
}

template <class T>
double* put(const T& element, double* out) {
  if constexpr (std::is_same_v<T, double>) {
    *out = element;
    return out + 1;
  } else {
    for (int k = 0; k < RowEntry<T>::width; ++k) out[k] = element.data()[k];
    return out + RowEntry<T>::width;
  }
}

template <class T, std::size_t N>
[[gnu::always_inline]] inline typename RowEntry<T>::lanes take(const std::array<Lanes, N>& row, std::size_t first) {
  if constexpr (std::is_same_v<T, double>) {
    return row[first];
  } else {
    typename RowEntry<T>::lanes element;
    for (std::size_t k = 0; k < element.c.size(); ++k) element.c[k] = row[first + k];
    return element;
  }
}

}  // namespace detail

/// Position first, then the arrays, in rows of whole quads.
template <int Dim, class... T>
class Rows {
 public:
  static constexpr int quads = (Dim + Reads<T...>::width + 3) / 4;

  Rows(std::span<const Vector<Dim>> position, const Reads<T...>& reads) {
    std::vector<Quad>& storage = detail::row_storage();
    const std::size_t n = position.size();
    if (storage.size() < n * quads) storage.resize(n * quads);
    first_ = storage.data();
    const auto rows = static_cast<std::int64_t>(n);
#pragma omp parallel for schedule(static)
    for (std::int64_t k = 0; k < rows; ++k) {
      const auto i = static_cast<std::size_t>(k);
      for (int q = 0; q < quads; q += 2) __builtin_prefetch(first_ + (i + 32) * quads + static_cast<std::size_t>(q), 1);   // to be written
      double* out = detail::put(position[i], reinterpret_cast<double*>(first_ + i * quads));
      std::apply([&](const auto&... array) { ((out = detail::put(array[i], out)), ...); }, reads.arrays);
    }
  }

  [[gnu::always_inline]] std::array<Lanes, 4 * quads> load(const std::int32_t* j) const { return load_rows<quads>(first_, j); }
  /// Row i in every lane. Its neighbours have just had it in their hands: it is nearer than the arrays it was packed from.
  [[gnu::always_inline]] std::array<Lanes, 4 * quads> load_own(std::size_t i) const {
    const auto* row = reinterpret_cast<const double*>(first_ + i * quads);
    std::array<Lanes, 4 * quads> lanes;
    for (std::size_t k = 0; k < lanes.size(); ++k) lanes[k] = broadcast(row[k]);
    return lanes;
  }

  /// Asks for row j before it is read.
  [[gnu::always_inline]] void prefetch(std::int32_t j) const {
    detail::prefetch_lines<(quads + 1) / 2>(first_ + static_cast<std::ptrdiff_t>(j) * quads);
  }

  static LaneVector<Dim> position(const std::array<Lanes, 4 * quads>& row) { return detail::take<Vector<Dim>>(row, 0); }
  /// f(elements...): the arrays' elements of a loaded row, in the order of reads().
  template <class F>
  [[gnu::always_inline]] static void apply(const std::array<Lanes, 4 * quads>& row, F&& f) {
    [&]<std::size_t... k>(std::index_sequence<k...>) __attribute__((always_inline)) {
      f(detail::take<T>(row, offset(k))...);
    }(std::index_sequence_for<T...>{});
  }
  /// Element k alone.
  template <std::size_t k>
  [[gnu::always_inline]] static auto element(const std::array<Lanes, 4 * quads>& row) {
    return detail::take<std::tuple_element_t<k, std::tuple<T...>>>(row, offset(k));
  }

 private:
  static constexpr std::size_t offset(std::size_t k) {
    const int widths[] = {RowEntry<T>::width..., 0};
    int sum = Dim;
    for (std::size_t e = 0; e < k; ++e) sum += widths[e];
    return static_cast<std::size_t>(sum);
  }

  Quad* first_;
};

}  // namespace furrow
