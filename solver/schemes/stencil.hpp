// Stencil: all that a sum over neighbours needs to know, and the one loop that every sum is written with.
#pragma once

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

/// Calls per_particle(i, loop) for every particle, in parallel; loop(f) then calls f(Pairs, elements of the arrays read at j...)
/// for all neighbours of i, eight at a time. Each particle sums its own row, so that the number of threads changes nothing.
template <int Dim, class K, class... T, class PerParticle>
void sweep(const Stencil<Dim>& s, const Reads<T...>& reads, PerParticle&& per_particle) {
  const double h = s.smoothing_length;
  const Lanes inverse_h = broadcast(1.0 / h), dW = broadcast(scale<K, Dim>(h) / (h * h)), tiny = broadcast(1e-300);
  const Vector<Dim>* const position = s.position.data();
  const std::int64_t* const begin = s.neighbours->begin.data();
  const std::int32_t* const index = s.neighbours->index.data();
  const bool periodic = s.box.any_periodic();
  const auto n = static_cast<std::int64_t>(s.size());
  const Rows<Dim, T...> rows(s.position, reads);
#pragma omp parallel for schedule(static)
  for (std::int64_t i = 0; i < n; ++i) {
    const LaneVector<Dim> x_i = broadcast<Dim>(position[i]);
    per_particle(static_cast<std::size_t>(i), [&](auto&& f) {
      for (std::int64_t k = begin[i]; k < begin[i + 1]; k += lane_count) {
        const auto row = rows.load(index + k);
        Pairs<Dim> pair;
        pair.x_ij = x_i - rows.position(row);
        if (periodic) pair.x_ij = nearest_image(pair.x_ij, s.box);
        pair.r = square_root(dot(pair.x_ij, pair.x_ij) + tiny);
        pair.grad = (dW * dw_over_q<Shape<K, Dim>>(pair.r * inverse_h)) * pair.x_ij;
        rows.apply(row, [&](const auto&... element) { f(pair, element...); });
      }
    });
  }
}

/// sweep with the stencil's own kernel: the choice is made once a sweep, never in the loop. per_particle is called with a third
/// argument, the kernel, for sums that need W itself.
template <int Dim, class... T, class PerParticle>
void for_each_particle(const Stencil<Dim>& s, const Reads<T...>& reads, PerParticle&& per_particle) {
  std::visit(
      [&](auto kernel) {
        sweep<Dim, decltype(kernel)>(s, reads, [&](std::size_t i, auto&& loop) { per_particle(i, loop, kernel); });
      },
      s.kernel);
}

}  // namespace furrow
