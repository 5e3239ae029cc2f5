#include "validation/taylor-bar/rod.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

namespace furrow::taylor_bar_cases {
namespace {

struct Section {
  std::vector<Eigen::Vector2d> centre;
  std::vector<double> area;
};

/// Ring k lies between k dx and (k + 1) dx and holds the number of cells that makes them nearest to square.
Section rings(double radius, double dx) {
  const double count = radius / dx;
  if (std::abs(count - std::round(count)) > 1e-6 || count < 1.5)
    throw std::invalid_argument(fmt::format("a radius of {:.6g} m is not a whole number of spacings of {:.6g} m", radius, dx));
  Section section;
  constexpr double quarter = 0.5 * std::numbers::pi;
  for (int k = 0; k < std::lround(count); ++k) {
    const double inner = k * dx, outer = (k + 1) * dx;
    const long n = std::max(1L, std::lround(quarter * (k + 0.5)));
    for (long j = 0; j < n; ++j) {
      const double angle = quarter * (static_cast<double>(j) + 0.5) / static_cast<double>(n);
      section.centre.push_back((k + 0.5) * dx * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
      section.area.push_back(0.5 * quarter * (outer * outer - inner * inner) / static_cast<double>(n));
    }
  }
  return section;
}

/// Square cells in the order of their distance from the axis, as many as make the area nearest to the quarter circle's.
Section squares(double radius, double dx) {
  Section section;
  const int n = static_cast<int>(std::ceil(radius / dx)) + 1;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      if (Eigen::Vector2d x = dx * Eigen::Vector2d(i + 0.5, j + 0.5); x.norm() <= radius) section.centre.push_back(x);
  if (section.centre.empty()) throw std::invalid_argument("the spacing is wider than the rod");
  const auto count = static_cast<double>(section.centre.size());
  section.area.assign(section.centre.size(), 0.25 * std::numbers::pi * radius * radius / count);
  return section;
}

}  // namespace

Arrangement arrangement_by_name(const std::string& name) {
  if (name == "rings") return Arrangement::rings;
  if (name == "square") return Arrangement::square;
  throw std::invalid_argument("no arrangement is called " + name);
}

Cells quarter_rod(const Rod& rod, double spacing, Arrangement arrangement) {
  const double radius = 0.5 * rod.diameter;
  const Section section = arrangement == Arrangement::rings ? rings(radius, spacing) : squares(radius, spacing);
  const long layers = std::max(1L, std::lround(rod.length / spacing));
  Cells cells;
  cells.layer = rod.length / static_cast<double>(layers);
  cells.per_layer = section.centre.size();
  for (long k = 0; k < layers; ++k)
    for (std::size_t j = 0; j < section.centre.size(); ++j) {
      cells.centre.emplace_back((static_cast<double>(k) + 0.5) * cells.layer, section.centre[j][0], section.centre[j][1]);
      cells.volume.push_back(cells.layer * section.area[j]);
    }
  return cells;
}

Cells whole_rod(const Cells& quarter) {
  Cells whole;
  whole.layer = quarter.layer;
  whole.per_layer = 4 * quarter.per_layer;
  for (std::size_t first = 0; first < quarter.centre.size(); first += quarter.per_layer)
    for (const Vector<3>& mirror : {Vector<3>(1, 1, 1), Vector<3>(1, -1, 1), Vector<3>(1, -1, -1), Vector<3>(1, 1, -1)})
      for (std::size_t j = first; j < first + quarter.per_layer; ++j) {
        whole.centre.push_back(mirror.cwiseProduct(quarter.centre[j]));
        whole.volume.push_back(quarter.volume[j]);
      }
  return whole;
}

double reach(const Particles<3>& p, std::size_t i, const Vector<3>& n, const Vector<3>& half_edges) {
  return p.position[i].dot(n) + half_edges.cwiseProduct(p.deformation_gradient[i].transpose() * n).norm();
}

RodShape shape_of(const Body<3>& body, double layer) {
  const Particles<3>& p = body.particles;
  const Vector<3> half_edges = 0.5 * Vector<3>(layer, body.spacing, body.spacing);
  RodShape shape;
  struct Outermost {
    double height = 0.0, radius = 0.0;
  };
  std::map<long, Outermost> layers;
  for (std::size_t i = 0; i < p.size(); ++i) {
    shape.length = std::max(shape.length, reach(p, i, Vector<3>::UnitX(), half_edges));
    const Vector<3> across(0.0, p.position[i][1], p.position[i][2]);
    const double radius = reach(p, i, across.normalized(), half_edges);
    Outermost& outermost = layers[std::lround(p.reference_position[i][0] / layer - 0.5)];
    if (radius > outermost.radius) outermost = {p.position[i][0], radius};
    shape.foot_radius = std::max(shape.foot_radius, radius);
  }
  std::vector<Outermost> sorted;
  for (const auto& [number, outermost] : layers) sorted.push_back(outermost);
  std::sort(sorted.begin(), sorted.end(), [](const Outermost& a, const Outermost& b) { return a.height < b.height; });
  for (const Outermost& o : sorted) {
    shape.height.push_back(o.height);
    shape.radius.push_back(o.radius);
  }
  return shape;
}

double RodShape::radius_at(double h) const {
  const auto above = std::lower_bound(height.begin(), height.end(), h);
  if (above == height.begin()) return radius.front();
  if (above == height.end()) return radius.back();
  const auto k = static_cast<std::size_t>(above - height.begin());
  const double t = (h - height[k - 1]) / (height[k] - height[k - 1]);
  return radius[k - 1] + t * (radius[k] - radius[k - 1]);
}

double RodShape::undeformed_length(double first_radius, double tolerance) const {
  const double limit = first_radius * (1.0 + tolerance);
  for (std::size_t k = radius.size(); k-- > 0;)
    if (!(radius[k] < limit)) {
      if (k + 1 == radius.size()) return 0.0;
      const double t = (radius[k] - limit) / (radius[k] - radius[k + 1]);
      return length - (height[k] + t * (height[k + 1] - height[k]));
    }
  return length;
}

}  // namespace furrow::taylor_bar_cases
