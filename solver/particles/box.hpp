#pragma once

#include "solver/tensor/lanes.hpp"

namespace furrow {

/// Space that particles live in: open, or periodic in the directions whose length is not zero.
template <int Dim>
struct Box {
  Vector<Dim> origin = Vector<Dim>::Zero();
  Vector<Dim> length = Vector<Dim>::Zero();   ///< m; 0 = open

  bool periodic(int a) const { return length[a] > 0.0; }
  bool any_periodic() const { return (length.array() > 0.0).any(); }

  /// Shortest x_i - x_j over all images.
  Vector<Dim> displacement(const Vector<Dim>& x_i, const Vector<Dim>& x_j) const {
    Vector<Dim> d = x_i - x_j;
    for (int a = 0; a < Dim; ++a)
      if (periodic(a)) d[a] -= length[a] * std::nearbyint(d[a] / length[a]);
    return d;
  }
  /// The image of x inside the box.
  Vector<Dim> wrapped(Vector<Dim> x) const {
    for (int a = 0; a < Dim; ++a)
      if (periodic(a)) x[a] -= length[a] * std::floor((x[a] - origin[a]) / length[a]);
    return x;
  }
};

/// The same for eight pairs. A difference of positions inside the box is off by at most one length.
template <int Dim>
LaneVector<Dim> nearest_image(LaneVector<Dim> d, const Box<Dim>& box) {
  for (int a = 0; a < Dim; ++a) {
    const Lanes length = broadcast(box.length[a]), half = 0.5 * length;
    d[a] = d[a] > half ? d[a] - length : d[a];
    d[a] = d[a] < -half ? d[a] + length : d[a];
  }
  return d;
}

}  // namespace furrow
