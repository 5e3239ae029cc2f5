// Arrangements of given particles, for cases and tests of the sums over neighbours: lattices, whole or jittered, in a periodic
// box or as a block with free edges. Nothing here moves.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/particles/fields.hpp"
#include "solver/schemes/stencil.hpp"

namespace furrow {

/// Points of equal volume.
template <int Dim>
struct Points {
  std::vector<Vector<Dim>> position;   ///< m
  double volume = 0.0;                 ///< of one point, m^Dim
  double spacing = 0.0;                ///< between nearest neighbours of the lattice, m
  Box<Dim> box;                        ///< periodic in all directions, or open
};

/// Cells along each axis; one value fills all.
template <int Dim>
std::array<int, Dim> all_axes(int cells) {
  std::array<int, Dim> n;
  n.fill(cells);
  return n;
}

/// Points at the centres of square (1D: equal; 3D: cubic) cells that fill [0, cells dx] along each axis.
template <int Dim>
Points<Dim> square_lattice(const std::array<int, Dim>& cells, double spacing, bool periodic);
/// Rectangular cells of dx by sqrt(3) dx with two points in each: every point has six neighbours at dx.
Points<2> hexagonal_lattice(const std::array<int, 2>& cells, double spacing, bool periodic);
/// Face-centred cubic cells of edge sqrt(2) dx with four points in each: every point has twelve neighbours at dx.
Points<3> fcc_lattice(const std::array<int, 3>& cells, double spacing, bool periodic);

/// A number in [0, 1) with 53 random bits, the same on every machine for a generator of the same seed.
template <class Generator>
double uniform(Generator& generator) {
  static_assert(Generator::max() == ~std::uint64_t{0});
  return static_cast<double>(generator() >> 11) * 0x1p-53;
}

/// Moves every point along each axis by a random part of +-fraction dx, evenly distributed.
template <int Dim>
Points<Dim> jittered(Points<Dim> points, double fraction, std::uint64_t seed);

/// Particles sorted by cell, with their neighbours. `id` is the number of the point that a particle came from.
template <int Dim>
struct Arrangement {
  Particles<Dim> particles;
  NeighbourList neighbours;
  Box<Dim> box;
  double spacing = 0.0;   ///< m

  std::vector<double> volume() const;   ///< m/rho of every particle, m^Dim
  /// A view: the arrangement must stay where it is while the stencil is used. Throws std::logic_error when the kernel reaches
  /// further than the neighbours.
  Stencil<Dim> stencil(const AnyKernel& kernel, double smoothing_length) const;
};

/// Particles at rest, free of stress, on the points; `reach` is that of the neighbour lists, m.
template <int Dim>
Arrangement<Dim> arranged(const Points<Dim>& points, double density, double reach);

}  // namespace furrow
