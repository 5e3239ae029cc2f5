// Stencil: all that a sum over neighbours needs to know, and the one loop that every sum is written with.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <type_traits>
#include <variant>

#include "solver/particles/images.hpp"
#include "solver/particles/neighbours.hpp"
#include "solver/schemes/rows.hpp"
#include "solver/smoothing/kernels.hpp"

namespace furrow {

/// Positions with their neighbours, and the kernel to weigh them with. A view: it owns nothing.
template <int Dim>
struct Stencil {
  AnyKernel kernel;
  double smoothing_length;   ///< h, m
  Box<Dim> box;
  std::span<const Vector<Dim>> position;   ///< images behind the particles proper
  const NeighbourList* neighbours;
  const Images<Dim>* images = nullptr;     ///< where there are any

  std::size_t size() const { return neighbours->size(); }   ///< particles that sum, without images
};

/// Pairs (i, j) of one particle i with eight neighbours j.
template <int Dim>
struct Pairs {
  LaneVector<Dim> x_ij;   ///< x_i - x_j
  Lanes r;                ///< |x_ij|
  LaneVector<Dim> grad;   ///< grad_i W_ij
};

/// The neighbours of one particle: called with f, they call f(Pairs, elements of the arrays read at j...), eight at a time.
template <int Dim, class K, class... T>
struct Neighbours {
  using Packed = Rows<Dim, T...>;
  const Packed& rows;
  const Stencil<Dim>& stencil;
  const Lanes &inverse_h, &dW;
  bool periodic;
  std::array<Lanes, 4 * Packed::quads> own_row;
  const std::int32_t *begin, *end;

  template <class F>
  [[gnu::always_inline]] void operator()(F&& f) const {
    const Lanes tiny = broadcast(1e-300);
    const LaneVector<Dim> x_i = rows.position(own_row);
    for (const std::int32_t* j = begin; j < end; j += lane_count) {
      const auto row = rows.load(j);
      Pairs<Dim> pair;
      pair.x_ij = x_i - rows.position(row);
      if (periodic) pair.x_ij = nearest_image(pair.x_ij, stencil.box);
      pair.r = square_root(dot(pair.x_ij, pair.x_ij) + tiny);
      pair.grad = (dW * dw_over_q<Shape<K, Dim>>(pair.r * inverse_h)) * pair.x_ij;
      rows.apply(row, [&](const auto&... element) { f(pair, element...); });
    }
  }
};

/// What was read of the particle itself from array k of reads(), in all lanes.
template <std::size_t k, int Dim, class K, class... T>
[[gnu::always_inline]] inline auto own(const Neighbours<Dim, K, T...>& neighbours) {
  return neighbours.rows.template element<k>(neighbours.own_row);
}

/// Particles that a sweep looks ahead: what they will read is asked for early. The machine's own prefetching starts anew at every
/// page of memory, and a sweep over more particles than caches hold would wait for it there.
inline constexpr std::int64_t sweep_ahead = 48;

/// Calls per_particle(i, neighbours) for every particle, in parallel. Each particle sums its own row, so that the number of
/// threads changes nothing.
template <int Dim, class K, class... T, class PerParticle>
void sweep(const Stencil<Dim>& s, const Reads<T...>& reads, PerParticle&& per_particle) {
  const double h = s.smoothing_length;
  const Lanes inverse_h = broadcast(1.0 / h), dW = broadcast(scale<K, Dim>(h) / (h * h));
  const std::int64_t* const begin = s.neighbours->begin.data();
  const std::int32_t* const index = s.neighbours->index.data();
  const bool periodic = s.box.any_periodic();
  const auto n = static_cast<std::int64_t>(s.size());
  const Rows<Dim, T...> rows(s.position, reads);
#pragma omp parallel for schedule(static)
  for (std::int64_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const std::int64_t ahead = begin[std::min(k + sweep_ahead, n)];
    if (ahead > 0) rows.prefetch(index[ahead - lane_count]);
    detail::prefetch_lines<2>(index + ahead + 512);   // some twenty rows further
    per_particle(i, Neighbours<Dim, K, T...>{rows, s, inverse_h, dW, periodic, rows.load_own(i), index + begin[k], index + begin[k + 1]});
  }
}

/// sweep with the stencil's own kernel: the choice is made once a sweep, never in the loop. per_particle is called with a third
/// argument, the kernel, for sums that need W itself.
template <int Dim, class... T, class PerParticle>
void for_each_particle(const Stencil<Dim>& s, const Reads<T...>& reads, PerParticle&& per_particle) {
  std::visit(
      [&](auto kernel) {
        sweep<Dim, decltype(kernel)>(s, reads, [&](std::size_t i, auto&& neighbours) { per_particle(i, neighbours, kernel); });
      },
      s.kernel);
}

}  // namespace furrow
