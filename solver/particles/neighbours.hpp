// Cells and neighbours: particles are sorted by cell, and each has a row of the indices of all others within reach.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/particles/box.hpp"

namespace furrow {

/// Rectangular cells of at least `reach`, numbered with the first axis fastest.
template <int Dim>
struct CellGrid {
  Vector<Dim> origin;
  Vector<Dim> cell;                            ///< edge lengths, m
  Eigen::Matrix<std::int32_t, Dim, 1> count;   ///< cells along each axis
  Box<Dim> box;

  /// Throws std::runtime_error when a position is not finite, std::invalid_argument when a periodic box is too small.
  CellGrid(std::span<const Vector<Dim>> position, double reach, const Box<Dim>& box);
  std::int32_t total() const { return count.prod(); }
  std::int32_t cell_of(const Vector<Dim>& x) const;
};

/// Order that sorts particles by cell (stable), and where each cell begins in it.
struct CellOrder {
  std::vector<std::int32_t> order;   ///< new place k holds old particle order[k]
  std::vector<std::int32_t> begin;   ///< size cells + 1
};
template <int Dim>
CellOrder order_by_cell(const CellGrid<Dim>& grid, std::span<const Vector<Dim>> position);

/// Neighbours within `reach` in compressed rows. A row is padded with its own particle to a multiple of lane_count: a pair of
/// a particle with itself adds nothing to a sum over gradients or differences.
struct NeighbourList {
  std::vector<std::int64_t> begin;   ///< size n + 1; begin[i + 1] - begin[i] is a multiple of lane_count
  std::vector<std::int32_t> index;
  std::vector<std::int32_t> count;   ///< neighbours of i without padding
  std::vector<std::vector<std::int32_t>> blocks;   ///< where threads put their rows while they search; kept for the next time
  double reach = 0.0;                ///< m

  std::size_t size() const { return count.size(); }
  std::span<const std::int32_t> row(std::size_t i) const {
    return {index.data() + begin[i], static_cast<std::size_t>(count[i])};
  }
};

/// Rows for the first `proper` positions; those behind are images, neighbours only. Both parts must be sorted by the grid's
/// cells; `cell_begin` and `image_begin` as order_by_cell gives them for each. Rows list neighbours by rising cell and index,
/// whatever the number of threads.
template <int Dim>
void build_neighbours(const CellGrid<Dim>& grid, const std::vector<std::int32_t>& cell_begin,
                      const std::vector<std::int32_t>& image_begin, std::span<const Vector<Dim>> position, std::size_t proper,
                      double reach, NeighbourList& list);

/// The same where there are no images.
template <int Dim>
void build_neighbours(const CellGrid<Dim>& grid, const std::vector<std::int32_t>& cell_begin, std::span<const Vector<Dim>> position,
                      double reach, NeighbourList& list) {
  build_neighbours<Dim>(grid, cell_begin, {}, position, position.size(), reach, list);
}

/// Empties the rows of particles that are not kept (keep[i] == 0); those of the others stay as they are.
void drop_rows(NeighbourList& list, std::span<const std::uint8_t> keep);

}  // namespace furrow
