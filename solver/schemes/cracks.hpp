// Cracks in the reference frame. Kernels that stay with the undeformed body never learn that a crack opens: pairs on its two sides
// go on pulling at each other for as long as the run lasts, and a section that has failed carries on. A particle that fails opens
// a facet of a crack, and pairs whose line crosses it no longer see each other: the visibility criterion (Belytschko, Lu & Gu 1994).
#pragma once

#include <span>
#include <vector>

#include "solver/particles/fields.hpp"
#include "solver/particles/neighbours.hpp"

namespace furrow {

/// A disc, in two dimensions a line: all points within `radius` of `centre` on the plane with this unit normal.
template <int Dim>
struct CrackFacet {
  Vector<Dim> centre, normal;
  double radius;   ///< m

  bool separates(const Vector<Dim>& a, const Vector<Dim>& b) const;   ///< whether the line from a to b crosses it
};

/// Unit vector, in the undeformed body, of the fibre that F has stretched most; its largest component is positive.
template <int Dim>
Vector<Dim> most_stretched(const Matrix<Dim>& F);

/// Facets of all particles that have a crack_normal: half a spacing before the particle, so that it stays with what is behind it,
/// and a tenth longer than a spacing, so that facets of neighbours leave nothing between them.
template <int Dim>
std::vector<CrackFacet<Dim>> crack_facets(const Particles<Dim>& particles, double spacing);

/// Leaves out of the list the pairs that a facet separates; `position` are those the list was made for.
template <int Dim>
void cut_pairs(NeighbourList& list, std::span<const Vector<Dim>> position, const std::vector<CrackFacet<Dim>>& facets);

/// Failed particles that see none but failed ones are debris: too few to say what strains them. They see no one any more, nor are they
/// seen.
template <int Dim>
void drop_debris(NeighbourList& list, const Particles<Dim>& particles);

/// Both, for all failed particles in the reference frame.
template <int Dim>
void cut_cracks(NeighbourList& list, const Particles<Dim>& particles, double spacing) {
  cut_pairs<Dim>(list, particles.reference_position, crack_facets(particles, spacing));
  drop_debris<Dim>(list, particles);
}

}  // namespace furrow
