// Outlines: the surface of a body that others touch, as a closed polygon with rounded edges. One node is a disc or a ball.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/tensor/tensor.hpp"

namespace furrow {

/// All points inside the polygon through the nodes, or within `radius` of it; nodes run anticlockwise. Polygons are there in two
/// dimensions, a single node in any.
template <int Dim>
struct Outline {
  std::vector<Vector<Dim>> position, velocity;   ///< of the nodes, m and m/s
  std::vector<Vector<Dim>> force;                ///< on the nodes, N; what touches the outline writes it
  double radius = 0.0;                           ///< m

  std::size_t size() const { return position.size(); }
  /// Nodes at these places, at rest.
  static Outline through(std::vector<Vector<Dim>> nodes, double radius);
};

/// The point of an outline nearest to a place: between the nodes `first` and `second`, nearer to the second the larger `share`.
template <int Dim>
struct NearestPoint {
  double distance;       ///< from the surface, negative inside, m
  Vector<Dim> normal;    ///< out of the surface, a unit vector
  std::size_t first, second;
  double share;          ///< 0 to 1
};
template <int Dim>
NearestPoint<Dim> nearest_point(const Outline<Dim>& outline, const Vector<Dim>& x);

/// Smallest box that holds the outline, its rounding included.
template <int Dim>
struct Bounds {
  Vector<Dim> low, high;
  bool contains(const Vector<Dim>& x, double margin) const {
    return ((x - low).array() > -margin).all() && ((high - x).array() > -margin).all();
  }
};
template <int Dim>
Bounds<Dim> bounds_of(const Outline<Dim>& outline);

/// Area inside the polygon, without the rounding, m^2; negative where nodes run clockwise.
double polygon_area(const std::vector<Vector<2>>& nodes);

}  // namespace furrow
