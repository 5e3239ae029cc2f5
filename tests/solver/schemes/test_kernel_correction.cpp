// Kernel-gradient correction where neighbours are few: at corners, and where they do not span space.
#include "tests/catch.hpp"

#include "solver/schemes/kernel_correction.hpp"
#include "solver/schemes/velocity_gradient.hpp"
#include "verification/lattices.hpp"

namespace furrow {
namespace {

/// Error of the corrected gradient of x + 2 y + 3 z at the first of these points; the kernel reaches just beyond all of them.
double error_at_first(const std::vector<Vector<3>>& x) {
  Points<3> points;
  points.position = x;
  points.volume = points.spacing = 1.0;
  const Arrangement<3> a = arranged(points, 1.0, 2.0);
  const auto V = a.volume();
  std::vector<Matrix<3>> B(x.size());
  kernel_correction<3>(a.stencil(WendlandC4{}, 1.0), V, B);
  const Vector<3> slope{1.0, 2.0, 3.0};
  std::vector<double> f;
  for (const Vector<3>& p : a.particles.position) f.push_back(slope.dot(p));
  std::vector<Vector<3>> found(x.size());
  gradient<3>(a.stencil(WendlandC4{}, 1.0), V, f, B, found);
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (a.particles.id[k] == 0) return (found[k] - slope).norm();
  }
  throw std::logic_error("the first point is lost");
}

}  // namespace

TEST_CASE("three distant neighbours are enough for a linear field in space", "[schemes][correction]") {
  CHECK(error_at_first({{0, 0, 0}, {1.6, 0, 0}, {0, 1.6, 0}, {0, 0, 1.6}}) < 1e-12);
}

TEST_CASE("neighbours in a plane or on a line leave the gradient uncorrected", "[schemes][correction]") {
  Points<3> points;
  points.position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  points.volume = points.spacing = 1.0;
  const Arrangement<3> a = arranged(points, 1.0, 2.0);
  std::vector<Matrix<3>> B(4);
  kernel_correction<3>(a.stencil(CubicSpline{}, 1.0), a.volume(), B);
  for (const Matrix<3>& b : B) CHECK(b == Matrix<3>::Identity());

  points.position = {{0, 0, 0}};
  const Arrangement<3> alone = arranged(points, 1.0, 2.0);
  std::vector<Matrix<3>> B_alone(1);
  kernel_correction<3>(alone.stencil(CubicSpline{}, 1.0), alone.volume(), B_alone);
  CHECK(B_alone[0] == Matrix<3>::Identity());
}

}  // namespace furrow
