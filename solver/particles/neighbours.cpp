#include "solver/particles/neighbours.hpp"

#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "solver/modules.hpp"

namespace furrow {

template <int Dim>
CellGrid<Dim>::CellGrid(std::span<const Vector<Dim>> position, double reach, const Box<Dim>& b) : box(b) {
  Vector<Dim> low = Vector<Dim>::Zero(), high = Vector<Dim>::Zero();
  if (!position.empty()) low = high = position[0];
  for (std::size_t i = 0; i < position.size(); ++i) {
    if (!position[i].allFinite()) throw std::runtime_error("position of particle " + std::to_string(i) + " is not finite");
    low = low.cwiseMin(position[i]);
    high = high.cwiseMax(position[i]);
  }
  for (int a = 0; a < Dim; ++a) {
    if (!box.periodic(a)) continue;
    if (box.length[a] < 2.0 * reach)
      throw std::invalid_argument("a periodic box must be at least twice as long as the reach of the neighbour search");
    low[a] = box.origin[a];
    high[a] = box.origin[a] + box.length[a];
  }
  origin = low;
  // A particle that has flown far away must not make the grid larger than memory: then cells grow.
  const double most = 8.0 * static_cast<double>(position.size()) + 64.0;
  const auto cells_at = [&](double edge) {
    double cells = 1.0;
    for (int a = 0; a < Dim; ++a) cells *= std::floor((high[a] - low[a]) / edge) + 1.0;
    return cells;
  };
  double edge = reach;
  while (cells_at(edge) > most) edge *= 2.0;
  for (int a = 0; a < Dim; ++a) {
    const double extent = high[a] - low[a];
    count[a] = box.periodic(a) ? std::max(1, static_cast<std::int32_t>(extent / edge)) : static_cast<std::int32_t>(extent / edge) + 1;
    cell[a] = box.periodic(a) ? extent / count[a] : edge;
  }
}

template <int Dim>
std::int32_t CellGrid<Dim>::cell_of(const Vector<Dim>& x) const {
  std::int32_t c = 0;
  for (int a = Dim - 1; a >= 0; --a) {
    const auto k = static_cast<std::int32_t>((x[a] - origin[a]) / cell[a]);
    c = c * count[a] + std::clamp(k, 0, count[a] - 1);
  }
  return c;
}

template <int Dim>
CellOrder order_by_cell(const CellGrid<Dim>& grid, std::span<const Vector<Dim>> position) {
  const std::size_t n = position.size();
  std::vector<std::int32_t> cell(n);
  CellOrder sorted;
  sorted.begin.assign(static_cast<std::size_t>(grid.total()) + 1, 0);
  sorted.order.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    cell[i] = grid.cell_of(position[i]);
    ++sorted.begin[static_cast<std::size_t>(cell[i]) + 1];
  }
  for (std::size_t c = 1; c < sorted.begin.size(); ++c) sorted.begin[c] += sorted.begin[c - 1];
  std::vector<std::int32_t> next(sorted.begin.begin(), sorted.begin.end() - 1);
  for (std::size_t i = 0; i < n; ++i)
    sorted.order[static_cast<std::size_t>(next[static_cast<std::size_t>(cell[i])]++)] = static_cast<std::int32_t>(i);
  return sorted;
}

namespace {

/// Cells at and beside k along one axis, each once, rising, also where a periodic axis has fewer than three.
struct Beside {
  std::int32_t cell[3];
  int count = 0;
  Beside(std::int32_t k, std::int32_t cells, bool periodic) {
    for (std::int32_t at = k - 1; at <= k + 1; ++at) {
      const std::int32_t image = periodic ? (at + cells) % cells : at;
      if (image < 0 || image >= cells || std::find(cell, cell + count, image) != cell + count) continue;
      int place = count++;
      for (; place > 0 && cell[place - 1] > image; --place) cell[place] = cell[place - 1];
      cell[place] = image;
    }
  }
};

/// Contiguous runs of particles that can hold neighbours of the particles in a cell: whole rows along the first axis.
template <int Dim, class Visit>
void for_each_run(const CellGrid<Dim>& grid, const std::vector<std::int32_t>& cell_begin, std::int32_t home, Visit&& visit) {
  const auto axis = [&grid, &home](int a) {
    if (a >= Dim) return Beside(0, 1, false);
    const Beside beside(home % grid.count[a], grid.count[a], grid.box.periodic(a));
    home /= grid.count[a];
    return beside;
  };
  const Beside x = axis(0), y = axis(1), z = axis(2);
  const std::int32_t rows = Dim > 1 ? grid.count[Dim > 1 ? 1 : 0] : 1;
  for (int c = 0; c < z.count; ++c)
    for (int b = 0; b < y.count; ++b) {
      const std::int32_t row = (z.cell[c] * rows + y.cell[b]) * grid.count[0];
      for (int first = 0; first < x.count;) {
        int last = first;
        while (last + 1 < x.count && x.cell[last + 1] == x.cell[last] + 1) ++last;
        visit(cell_begin[static_cast<std::size_t>(row + x.cell[first])], cell_begin[static_cast<std::size_t>(row + x.cell[last]) + 1]);
        first = last + 1;
      }
    }
}

}  // namespace

template <int Dim>
void build_neighbours(const CellGrid<Dim>& grid, const std::vector<std::int32_t>& cell_begin,
                      const std::vector<std::int32_t>& image_begin, std::span<const Vector<Dim>> position, std::size_t proper,
                      double reach, NeighbourList& list) {
  has_run(Module::neighbours);
  const auto n = static_cast<std::int64_t>(proper);
  const double reach2 = reach * reach;
  const bool periodic = grid.box.any_periodic();
  list.reach = reach;
  list.begin.resize(static_cast<std::size_t>(n) + 1);
  list.count.resize(static_cast<std::size_t>(n));
  list.begin[0] = 0;

  // One array an axis, so that eight candidates are looked at together; room at the end to read past the last.
  std::array<std::vector<double>, static_cast<std::size_t>(Dim)> axis;
  for (int a = 0; a < Dim; ++a) {
    std::vector<double>& x = axis[static_cast<std::size_t>(a)];
    x.resize(position.size() + lane_count);
    for (std::size_t i = 0; i < position.size(); ++i) x[i] = position[i][a];
  }

  // Each thread fills a block of rows; the blocks are laid end to end, so that the list does not depend on how many there are.
  list.blocks.resize(static_cast<std::size_t>(omp_get_max_threads()));
  std::vector<std::size_t> used(list.blocks.size(), 0);
#pragma omp parallel
  {
    const auto thread = static_cast<std::size_t>(omp_get_thread_num());
    std::vector<std::int32_t>& block = list.blocks[thread];
    std::size_t end = 0;
#pragma omp for schedule(static)
    for (std::int64_t i = 0; i < n; ++i) {
      const LaneVector<Dim> x_i = broadcast<Dim>(position[static_cast<std::size_t>(i)]);
      const std::size_t first = end;
      const auto keep_near = [&](std::int32_t from, std::int32_t to) {
        const std::size_t needed = end + static_cast<std::size_t>(to - from) + 2 * lane_count;
        if (block.size() < needed) block.resize(2 * needed);
        for (std::int32_t j = from; j < to; j += lane_count) {
          LaneVector<Dim> x_ij;
          for (int a = 0; a < Dim; ++a) x_ij[a] = x_i[a] - load(axis[static_cast<std::size_t>(a)].data() + j);
          if (periodic) x_ij = nearest_image(x_ij, grid.box);
          unsigned mask = to - j < lane_count ? (1u << (to - j)) - 1u : 0xffu;
          if (i >= j && i < j + lane_count) mask &= ~(1u << (i - j));
          end += static_cast<std::size_t>(write_where_less(dot(x_ij, x_ij), reach2, mask, j, block.data() + end));
        }
      };
      const std::int32_t home = grid.cell_of(position[static_cast<std::size_t>(i)]);
      for_each_run<Dim>(grid, cell_begin, home, keep_near);
      if (!image_begin.empty())
        for_each_run<Dim>(grid, image_begin, home, [&](std::int32_t from, std::int32_t to) {
          keep_near(static_cast<std::int32_t>(n) + from, static_cast<std::int32_t>(n) + to);
        });
      list.count[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(end - first);
      if (block.size() < end + lane_count) block.resize(2 * (end + lane_count));
      while ((end - first) % lane_count != 0) block[end++] = static_cast<std::int32_t>(i);
      list.begin[static_cast<std::size_t>(i) + 1] = static_cast<std::int64_t>(end - first);
    }
    used[thread] = end;
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) list.begin[i + 1] += list.begin[i];
  list.index.resize(static_cast<std::size_t>(list.begin.back()));
  auto out = list.index.begin();
  for (std::size_t t = 0; t < used.size(); ++t) out = std::copy_n(list.blocks[t].begin(), used[t], out);
}

void drop_rows(NeighbourList& list, std::span<const std::uint8_t> keep) {
  std::int64_t end = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::int64_t first = list.begin[i], size = keep[i] ? list.begin[i + 1] - first : 0;
    // begin[i + 1] is read before it is written, and rows only move towards the front.
    std::copy_n(list.index.begin() + first, size, list.index.begin() + end);
    list.begin[i] = end;
    end += size;
    if (!keep[i]) list.count[i] = 0;
  }
  list.begin[list.size()] = end;
  list.index.resize(static_cast<std::size_t>(end));
}

#define FURROW_INSTANTIATE(Dim)                                                                              \
  template struct CellGrid<Dim>;                                                                             \
  template CellOrder order_by_cell<Dim>(const CellGrid<Dim>&, std::span<const Vector<Dim>>);                 \
  template void build_neighbours<Dim>(const CellGrid<Dim>&, const std::vector<std::int32_t>&,                \
                                      const std::vector<std::int32_t>&, std::span<const Vector<Dim>>,        \
                                      std::size_t, double, NeighbourList&);
FURROW_INSTANTIATE(1)
FURROW_INSTANTIATE(2)
FURROW_INSTANTIATE(3)
#undef FURROW_INSTANTIATE

}  // namespace furrow
