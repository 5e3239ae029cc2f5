// Algebra of 3x3 tensors: deviators, invariants, rotations.
#include "tests/catch.hpp"

#include <numbers>

#include "solver/tensor/tensor.hpp"
#include "tests/solver/cloud.hpp"

namespace furrow {

TEST_CASE("deviator and invariants of a known stress", "[tensor]") {
  Tensor uniaxial = Tensor::Zero();
  uniaxial(1, 1) = 300.0;
  CHECK(von_mises(uniaxial) == Approx(300.0));
  CHECK(j2(deviator(uniaxial)) == Approx(300.0 * 300.0 / 3.0));
  CHECK(std::abs(deviator(uniaxial).trace()) < 1e-13);

  Tensor shear = Tensor::Zero();
  shear(0, 2) = shear(2, 0) = 5.0;
  CHECK(von_mises(shear) == Approx(5.0 * std::numbers::sqrt3));
  CHECK(von_mises(shear - 1e3 * Tensor::Identity()) == Approx(5.0 * std::numbers::sqrt3));
}

TEST_CASE("parts of a tensor and their product", "[tensor]") {
  Tensor a;
  a << 1, 2, 3, 4, 5, 6, 7, 8, 10;
  CHECK((symmetric_part(a) + skew_part(a) - a).norm() == 0.0);
  CHECK((skew_part(a) + skew_part(a).transpose()).norm() == 0.0);
  CHECK(double_contraction(symmetric_part(a), skew_part(a)) == 0.0);
  CHECK(double_contraction(a, a) == Approx(304.0));
}

TEST_CASE("plane strain is embedded with nothing out of the plane", "[tensor]") {
  Matrix<2> a;
  a << 1, 2, 3, 4;
  const Tensor full = embed<2>(a);
  CHECK(full.topLeftCorner<2, 2>() == a);
  CHECK(full.row(2).norm() == 0.0);
  CHECK(full.col(2).norm() == 0.0);
}

TEST_CASE("a rotation is orthogonal to round-off, whatever its angle", "[tensor]") {
  for (const double angle : {0.0, 1e-300, 1e-9, 1e-4, 0.3, 1.0, std::numbers::pi, 6.0, 1e3}) {
    const Tensor R = rotation(angle * cross(2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0));
    INFO("angle " << angle);
    CHECK((R * R.transpose() - Tensor::Identity()).norm() < 1e-14);
    CHECK(R.determinant() == Approx(1.0).margin(1e-14));
    CHECK(R.trace() == Approx(1.0 + 2.0 * std::cos(angle)).margin(1e-13));
  }
}

TEST_CASE("a rotation turns about its axis in the right sense", "[tensor]") {
  using std::numbers::pi;
  const Tensor quarter = rotation(cross(0.0, 0.0, pi / 2.0));   // x goes to y
  CHECK((quarter * Vector<3>(1, 0, 0) - Vector<3>(0, 1, 0)).norm() < 1e-15);
  CHECK((quarter * Vector<3>(0, 0, 1) - Vector<3>(0, 0, 1)).norm() < 1e-15);

  // Half a turn about z: shear out of the plane changes sign, the rest comes back.
  Tensor s;
  s << 1, 2, 3, 2, 4, 5, 3, 5, 6;
  Tensor turned;
  turned << 1, 2, -3, 2, 4, -5, -3, -5, 6;
  CHECK((rotated(s, rotation(cross(0.0, 0.0, pi))) - turned).norm() < 1e-14);
  // The sum of two angles about one axis is their product.
  const Tensor W = cross(0.1, -0.4, 0.2);
  CHECK((rotation(3.0 * W) - rotation(W) * rotation(2.0 * W)).norm() < 1e-15);
}

TEST_CASE("a rotation in the plane is the general one", "[tensor]") {
  const Tensor s = (Tensor() << 1, 2, 0, -3, 4, 0, 0, 0, 6).finished();   // no need to be symmetric
  for (const double angle : {1e-12, 1e-3, 0.0999, 0.1001, 2.0}) {
    INFO("angle " << angle);
    const Tensor R = rotation(cross(0.0, 0.0, angle));
    const Tensor expected =
        (Tensor() << std::cos(angle), -std::sin(angle), 0, std::sin(angle), std::cos(angle), 0, 0, 0, 1).finished();
    CHECK((R - expected).norm() < 1e-15);
    CHECK((rotated(s, R) - expected * s * expected.transpose()).norm() < 1e-14);
    // Out of the plane, a hair's breadth from it.
    CHECK((rotation(cross(1e-14, 0.0, angle)) - expected).norm() < 1e-13);
  }
}

TEST_CASE("a small rotation is the Jaumann rate", "[tensor]") {
  // d/dt of s under spin w is w s - s w (paper Eq. 11 in matrix form); central difference, error t^2/6.
  Tensor s;
  s << 1, 2, 3, 2, 4, 5, 3, 5, 6;
  const Tensor w = cross(0.3, 0.2, -0.5);
  const double t = 1e-4;
  const Tensor rate = (rotated(s, rotation(t * w)) - rotated(s, rotation(-t * w))) / (2.0 * t);
  CHECK((rate - (w * s - s * w)).norm() < 1e-7);
}

}  // namespace furrow
