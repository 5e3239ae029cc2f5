#include "solver/boundaries/outline.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace furrow {
namespace {

/// Whether a ray from x along the first axis leaves the polygon an odd number of times.
bool inside_polygon(const std::vector<Vector<2>>& nodes, const Vector<2>& x) {
  bool inside = false;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const Vector<2>&a = nodes[k], &b = nodes[(k + 1) % nodes.size()];
    if ((a[1] > x[1]) != (b[1] > x[1]) && x[0] < a[0] + (x[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) inside = !inside;
  }
  return inside;
}

}  // namespace

template <int Dim>
Outline<Dim> Outline<Dim>::through(std::vector<Vector<Dim>> nodes, double radius) {
  if (nodes.empty() || nodes.size() == 2 || (Dim != 2 && nodes.size() != 1))
    throw std::invalid_argument("an outline is a single node, or in two dimensions three or more");
  if constexpr (Dim == 2)
    if (nodes.size() > 1 && !(polygon_area(nodes) > 0.0)) throw std::invalid_argument("nodes of an outline must run anticlockwise");
  if (nodes.size() == 1 && !(radius > 0.0)) throw std::invalid_argument("an outline of a single node needs a radius");
  Outline outline;
  outline.velocity.assign(nodes.size(), Vector<Dim>::Zero());
  outline.force.assign(nodes.size(), Vector<Dim>::Zero());
  outline.position = std::move(nodes);
  outline.radius = radius;
  return outline;
}

template <int Dim>
NearestPoint<Dim> nearest_point(const Outline<Dim>& outline, const Vector<Dim>& x) {
  const auto& nodes = outline.position;
  const std::size_t n = nodes.size();
  if (n == 1) {
    const Vector<Dim> away = x - nodes[0];
    const double r = away.norm();
    return {r - outline.radius, r > 0.0 ? Vector<Dim>(away / r) : Vector<Dim>(Vector<Dim>::Unit(0)), 0, 0, 0.0};
  }
  if constexpr (Dim == 2) {
    double best = HUGE_VAL;
    NearestPoint<2> found{};
    Vector<2> from = Vector<2>::Zero();
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t next = k + 1 == n ? 0 : k + 1;
      const Vector<2> edge = nodes[next] - nodes[k], away = x - nodes[k];
      const double share = std::clamp(away.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
      const Vector<2> d = away - share * edge;
      if (const double squared = d.squaredNorm(); squared < best) {
        best = squared;
        found.first = k, found.second = next, found.share = share;
        from = d;
      }
    }
    const double r = std::sqrt(best), side = inside_polygon(nodes, x) ? -1.0 : 1.0;
    const Vector<2> edge = (nodes[found.second] - nodes[found.first]).normalized();
    found.normal = r > 0.0 ? Vector<2>(side * from / r) : Vector<2>(edge[1], -edge[0]);
    found.distance = side * r - outline.radius;
    return found;
  }
  throw std::logic_error("polygons are there in two dimensions");
}

template <int Dim>
Bounds<Dim> bounds_of(const Outline<Dim>& outline) {
  Bounds<Dim> bounds{Vector<Dim>::Constant(HUGE_VAL), Vector<Dim>::Constant(-HUGE_VAL)};
  for (const Vector<Dim>& x : outline.position) {
    bounds.low = bounds.low.cwiseMin(x);
    bounds.high = bounds.high.cwiseMax(x);
  }
  bounds.low.array() -= outline.radius;
  bounds.high.array() += outline.radius;
  return bounds;
}

double polygon_area(const std::vector<Vector<2>>& nodes) {
  double twice = 0.0;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const Vector<2>&a = nodes[k], &b = nodes[(k + 1) % nodes.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return 0.5 * twice;
}

#define FURROW_INSTANTIATE(Dim)                                                          \
  template struct Outline<Dim>;                                                          \
  template NearestPoint<Dim> nearest_point<Dim>(const Outline<Dim>&, const Vector<Dim>&); \
  template Bounds<Dim> bounds_of<Dim>(const Outline<Dim>&);
FURROW_INSTANTIATE(2)
FURROW_INSTANTIATE(3)
#undef FURROW_INSTANTIATE

}  // namespace furrow
