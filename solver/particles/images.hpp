// Images: particles mirrored across planes, so that a sum near a plane finds the other half of its support there.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "solver/particles/neighbours.hpp"

namespace furrow {

/// A plane that bounds a body; the body lies where (x - point).normal > 0.
template <int Dim>
struct MirrorPlane {
  enum class Kind {
    symmetry,   ///< the image moves as in a mirror: free slip, no motion through the plane
    no_slip     ///< the image moves against its source: the plane holds the body, as a clamp or a perfectly rough wall
  };
  Kind kind = Kind::symmetry;
  Vector<Dim> point = Vector<Dim>::Zero();
  Vector<Dim> normal = Vector<Dim>::Unit(0);   ///< unit vector into the body

  double distance(const Vector<Dim>& x) const { return (x - point).dot(normal); }
};

/// Images of the particles near some planes, behind the particles proper in every array that neighbours read. Planes must be
/// perpendicular to each other; near an edge or a corner there are images of images.
template <int Dim>
class Images {
 public:
  Images() = default;
  explicit Images(std::vector<MirrorPlane<Dim>> planes) : planes_(std::move(planes)) {
    for (std::size_t a = 0; a < planes_.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        if (std::abs(planes_[a].normal.dot(planes_[b].normal)) > 1e-12)
          throw std::invalid_argument("mirror planes must be perpendicular to each other");
    for (std::uint32_t set = 1; set < (1u << planes_.size()); ++set) maps_.push_back(map_of(set));
  }

  bool empty() const { return planes_.empty(); }
  std::size_t size() const { return source_.size(); }
  const std::vector<MirrorPlane<Dim>>& planes() const { return planes_; }

  /// Chooses the particles within reach of the planes and returns the positions of their images.
  std::vector<Vector<Dim>> choose(std::span<const Vector<Dim>> proper, double reach) {
    source_.clear();
    map_.clear();
    count_ = proper.size();
    std::vector<Vector<Dim>> images;
    for (std::uint32_t m = 0; m < maps_.size(); ++m)
      for (std::size_t i = 0; i < proper.size(); ++i) {
        bool near = true;
        for (std::size_t k = 0; k < planes_.size(); ++k)
          if (((m + 1) >> k & 1u) && planes_[k].distance(proper[i]) >= reach) near = false;
        if (!near) continue;
        source_.push_back(static_cast<std::int32_t>(i));
        map_.push_back(static_cast<std::uint8_t>(m));
        images.push_back(maps_[m].turn * proper[i] + maps_[m].shift);
      }
    return images;
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
    for (std::size_t k = 0; k < size(); ++k) scalars[count_ + k] = scalars[source(k)];
  }
  void fill_positions(std::span<Vector<Dim>> x) const {
    for (std::size_t k = 0; k < size(); ++k) x[count_ + k] = map(k).turn * x[source(k)] + map(k).shift;
  }
  void fill_velocities(std::span<Vector<Dim>> v) const {
    for (std::size_t k = 0; k < size(); ++k) v[count_ + k] = map(k).velocity_turn * v[source(k)];
  }
  /// For what is multiplied with grad W in the momentum sum. With the velocity of an image U v and its position T x + s, the sum
  /// is the dual of the velocity gradient, and so conserves energy, exactly when the image's tensor is U A T: that is the mirrored
  /// stress for a symmetry plane, and the same traction on both sides of a no-slip plane.
  void fill_tensors(std::span<Matrix<Dim>> A) const {
    for (std::size_t k = 0; k < size(); ++k) A[count_ + k] = map(k).velocity_turn * A[source(k)] * map(k).turn;
  }

 private:
  struct Map {
    Matrix<Dim> turn, velocity_turn;   ///< T and U
    Vector<Dim> shift;                 ///< s
  };
  Map map_of(std::uint32_t set) const {
    Map m{Matrix<Dim>::Identity(), Matrix<Dim>::Identity(), Vector<Dim>::Zero()};
    for (std::size_t k = 0; k < planes_.size(); ++k) {
      if (!(set >> k & 1u)) continue;
      const MirrorPlane<Dim>& plane = planes_[k];
      const Matrix<Dim> mirror = Matrix<Dim>::Identity() - 2.0 * plane.normal * plane.normal.transpose();
      const bool symmetric = plane.kind == MirrorPlane<Dim>::Kind::symmetry;
      m.turn = mirror * m.turn;
      m.shift = mirror * m.shift + 2.0 * plane.point.dot(plane.normal) * plane.normal;
      m.velocity_turn = symmetric ? Matrix<Dim>(mirror * m.velocity_turn) : Matrix<Dim>(-m.velocity_turn);
    }
    return m;
  }
  std::size_t source(std::size_t k) const { return static_cast<std::size_t>(source_[k]); }
  const Map& map(std::size_t k) const { return maps_[map_[k]]; }

  std::vector<MirrorPlane<Dim>> planes_;
  std::vector<Map> maps_;
  std::vector<std::int32_t> source_;
  std::vector<std::uint8_t> map_;
  std::size_t count_ = 0;
};

}  // namespace furrow
