// Images: particles mirrored across planes, so that a sum near a plane finds the other half of its support there.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "solver/particles/neighbours.hpp"
#include "solver/particles/ordered_sum.hpp"

namespace furrow {

/// A plane of symmetry; the body lies where (x - point).normal > 0. Nothing moves through it, along it everything slips.
template <int Dim>
struct SymmetryPlane {
  Vector<Dim> point = Vector<Dim>::Zero();
  Vector<Dim> normal = Vector<Dim>::Unit(0);   ///< unit vector into the body

  double distance(const Vector<Dim>& x) const { return (x - point).dot(normal); }
};

/// Images of the particles near some planes, behind the particles proper in every array that neighbours read. Planes must be
/// perpendicular to each other, or face each other further apart than a particle reaches; near an edge or a corner there are
/// images of images.
template <int Dim>
class Images {
 public:
  Images() = default;
  explicit Images(std::vector<SymmetryPlane<Dim>> planes) : planes_(std::move(planes)) {
    for (std::size_t a = 0; a < planes_.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        if (!perpendicular(a, b) && planes_[a].normal.dot(planes_[b].normal) > -1.0 + 1e-12)
          throw std::invalid_argument("symmetry planes must be perpendicular to each other, or face each other");
    for (std::uint32_t set = 1; set < (1u << planes_.size()); ++set)
      if (all_perpendicular(set)) maps_.push_back(map_of(set));
  }

  bool empty() const { return planes_.empty(); }
  std::size_t size() const { return source_.size(); }
  const std::vector<SymmetryPlane<Dim>>& planes() const { return planes_; }

  /// Chooses the particles within reach of the planes and returns the positions of their images.
  std::vector<Vector<Dim>> choose(std::span<const Vector<Dim>> proper, double reach) {
    source_.clear();
    map_.clear();
    count_ = proper.size();
    std::vector<Vector<Dim>> images;
    for (std::size_t a = 0; a < planes_.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        if (!perpendicular(a, b) && planes_[a].distance(planes_[b].point) < reach)
          throw std::invalid_argument("symmetry planes that face each other must be further apart than the reach of a particle");
    for (std::size_t m = 0; m < maps_.size(); ++m)
      for (std::size_t i = 0; i < proper.size(); ++i) {
        bool near = true;
        for (std::size_t k = 0; k < planes_.size(); ++k)
          if ((maps_[m].set >> k & 1u) && planes_[k].distance(proper[i]) >= reach) near = false;
        if (!near) continue;
        source_.push_back(static_cast<std::int32_t>(i));
        map_.push_back(static_cast<std::uint8_t>(m));
        images.push_back(maps_[m].turn * proper[i] + maps_[m].shift);
      }
    return images;
  }
  /// The particle that neighbour j, an image, is an image of.
  std::size_t source_of(std::size_t j) const { return source(j - count_); }
  /// Images of some particles alone: particle i is now number local[i] of `count`, or not there where that is -1. `local_image` says
  /// the same of images.
  Images of_some(std::span<const std::int32_t> local, std::size_t count, std::vector<std::int32_t>& local_image) const {
    Images some = *this;
    some.count_ = count;
    some.source_.clear();
    some.map_.clear();
    local_image.assign(size(), -1);
    for (std::size_t k = 0; k < size(); ++k) {
      if (local[source(k)] < 0) continue;
      local_image[k] = static_cast<std::int32_t>(count + some.source_.size());
      some.source_.push_back(local[source(k)]);
      some.map_.push_back(map_[k]);
    }
    return some;
  }
  /// Widens a box of displacements until it holds those of all images as well.
  void include_images(Vector<Dim>& low, Vector<Dim>& high) const {
    const Vector<Dim> centre = 0.5 * (low + high), half = 0.5 * (high - low);
    for (const Map& m : maps_) {
      const Vector<Dim> c = m.turn * centre, e = m.turn.cwiseAbs() * half;
      low = low.cwiseMin(c - e);
      high = high.cwiseMax(c + e);
    }
  }
  /// New image k is old image order[k].
  void permute(const std::vector<std::int32_t>& order) {
    auto source = source_;
    auto map = map_;
    for (std::size_t k = 0; k < order.size(); ++k) {
      source_[k] = source[static_cast<std::size_t>(order[k])];
      map_[k] = map[static_cast<std::size_t>(order[k])];
    }
  }

  /// Each fill sets the images behind the particles proper from their sources.
  void fill(std::span<double> scalars) const {
    for_all(size(), [&](std::size_t k) { scalars[count_ + k] = scalars[source(k)]; });
  }
  void fill_positions(std::span<Vector<Dim>> x) const {
    for_all(size(), [&](std::size_t k) { x[count_ + k] = map(k).turn * x[source(k)] + map(k).shift; });
  }
  void fill_velocities(std::span<Vector<Dim>> v) const {
    for_all(size(), [&](std::size_t k) { v[count_ + k] = map(k).turn * v[source(k)]; });
  }
  /// For what is multiplied with grad W in the momentum sum: T A T, the stress seen in the mirror. It makes that sum the dual
  /// of the velocity gradient with images, so that energy is conserved.
  void fill_tensors(std::span<Matrix<Dim>> A) const {
    for_all(size(), [&](std::size_t k) { A[count_ + k] = map(k).turn * A[source(k)] * map(k).turn; });
  }
  /// The same for tensors that act on (s_a, s_a s_b for a <= b): T A T_p, where T_p is what T does to those terms.
  template <int Terms>
  void fill_quadratic(std::span<Eigen::Matrix<double, Dim, Terms>> A) const {
    std::vector<Eigen::Matrix<double, Terms, Terms>> turns;
    for (const Map& m : maps_) turns.push_back(turn_of_terms<Terms>(m.turn));
    for (std::size_t k = 0; k < size(); ++k) A[count_ + k] = map(k).turn * A[source(k)] * turns[map_[k]];
  }

 private:
  /// T_p with p(T s) = T_p p(s).
  template <int Terms>
  static Eigen::Matrix<double, Terms, Terms> turn_of_terms(const Matrix<Dim>& T) {
    Eigen::Matrix<double, Terms, Terms> turn = Eigen::Matrix<double, Terms, Terms>::Zero();
    turn.template topLeftCorner<Dim, Dim>() = T;
    int row = Dim;
    for (int a = 0; a < Dim; ++a)
      for (int b = a; b < Dim; ++b, ++row) {
        int column = Dim;
        for (int c = 0; c < Dim; ++c)
          for (int d = c; d < Dim; ++d, ++column) turn(row, column) = T(a, c) * T(b, d) + (c == d ? 0.0 : T(a, d) * T(b, c));
      }
    return turn;
  }
  bool perpendicular(std::size_t a, std::size_t b) const { return std::abs(planes_[a].normal.dot(planes_[b].normal)) < 1e-12; }
  bool all_perpendicular(std::uint32_t set) const {
    for (std::size_t a = 0; a < planes_.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        if ((set >> a & 1u) && (set >> b & 1u) && !perpendicular(a, b)) return false;
    return true;
  }
  struct Map {
    std::uint32_t set;    ///< planes that it goes across, one bit each
    Matrix<Dim> turn;     ///< T
    Vector<Dim> shift;    ///< s: the image of x is T x + s
  };
  Map map_of(std::uint32_t set) const {
    Map m{set, Matrix<Dim>::Identity(), Vector<Dim>::Zero()};
    for (std::size_t k = 0; k < planes_.size(); ++k) {
      if (!(set >> k & 1u)) continue;
      const Vector<Dim>& n = planes_[k].normal;
      const Matrix<Dim> mirror = Matrix<Dim>::Identity() - 2.0 * n * n.transpose();
      m.turn = mirror * m.turn;
      m.shift = mirror * m.shift + 2.0 * planes_[k].point.dot(n) * n;
    }
    return m;
  }
  std::size_t source(std::size_t k) const { return static_cast<std::size_t>(source_[k]); }
  const Map& map(std::size_t k) const { return maps_[map_[k]]; }

  std::vector<SymmetryPlane<Dim>> planes_;
  std::vector<Map> maps_;
  std::vector<std::int32_t> source_;
  std::vector<std::uint8_t> map_;
  std::size_t count_ = 0;
};

}  // namespace furrow
