// How a rod is filled with cells, and how its shape is measured: against rods deformed by hand.
#include <numbers>

#include "tests/catch.hpp"
#include "validation/taylor-bar/rod.hpp"

using namespace furrow;
using namespace furrow::taylor_bar_cases;

namespace {

constexpr double mm = 1e-3;

Body<3> body_of(const Cells& cells, double spacing) {
  Body<3> body;
  body.material = LinearElastic::from_young(1000.0, 1e9, 0.3);
  body.spacing = spacing;
  body.add(cells.centre);
  return body;
}

/// Moves every particle by a map of its reference position, with that map's gradient.
template <class Map, class Gradient>
void deform(Body<3>& body, Map&& map, Gradient&& gradient) {
  Particles<3>& p = body.particles;
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.position[i] = map(p.reference_position[i]);
    p.deformation_gradient[i] = gradient(p.reference_position[i]);
  }
}

}  // namespace

TEST_CASE("a quarter rod has the volume and the mean radius of inertia of the quarter cylinder", "[taylor]") {
  const Rod rod{30.0 * mm, 6.0 * mm};
  for (const Arrangement arrangement : {Arrangement::rings, Arrangement::square}) {
    const Cells cells = quarter_rod(rod, 0.25 * mm, arrangement);
    double volume = 0.0, inertia = 0.0;
    for (std::size_t i = 0; i < cells.centre.size(); ++i) {
      volume += cells.volume[i];
      inertia += cells.volume[i] * cells.centre[i].tail<2>().squaredNorm();
      CHECK(cells.centre[i].minCoeff() > 0.0);
    }
    const double R = 0.5 * rod.diameter;
    CHECK(volume == Approx(0.25 * std::numbers::pi * R * R * rod.length).epsilon(1e-12));
    CHECK(inertia / volume == Approx(0.5 * R * R).epsilon(0.01));
  }
}

TEST_CASE("a spacing that does not fit into the radius is refused for rings", "[taylor]") {
  CHECK_THROWS_AS(quarter_rod({30.0 * mm, 6.0 * mm}, 0.7 * mm, Arrangement::rings), std::invalid_argument);
}

TEST_CASE("a whole rod is four quarters", "[taylor]") {
  const Cells quarter = quarter_rod({10.0 * mm, 6.0 * mm}, 0.5 * mm, Arrangement::rings);
  const Cells whole = whole_rod(quarter);
  CHECK(whole.centre.size() == 4 * quarter.centre.size());
  Vector<3> centre = Vector<3>::Zero();
  for (std::size_t i = 0; i < whole.centre.size(); ++i) centre += whole.volume[i] * whole.centre[i];
  CHECK(centre.tail<2>().norm() < 1e-18);
}

TEST_CASE("an undeformed rod measures its own length and radius", "[taylor]") {
  const Cells cells = quarter_rod({10.0 * mm, 6.0 * mm}, 0.5 * mm, Arrangement::rings);
  Body<3> body = body_of(cells, 0.5 * mm);
  deform(body, [](const Vector<3>& X) { return X; }, [](const Vector<3>&) -> Matrix<3> { return Matrix<3>::Identity(); });
  const RodShape shape = shape_of(body, cells.layer);
  CHECK(shape.length == Approx(10.0 * mm).epsilon(1e-12));
  CHECK(shape.foot_radius == Approx(3.0 * mm).epsilon(1e-12));
  CHECK(shape.radius_at(4.2 * mm) == Approx(3.0 * mm).epsilon(1e-12));
  CHECK(shape.undeformed_length(3.0 * mm, 0.005) == Approx(10.0 * mm).epsilon(1e-12));
}

TEST_CASE("a rod squeezed by half measures half its length and its wider radius", "[taylor]") {
  const Cells cells = quarter_rod({10.0 * mm, 6.0 * mm}, 0.5 * mm, Arrangement::rings);
  Body<3> body = body_of(cells, 0.5 * mm);
  const double across = std::numbers::sqrt2;
  const Matrix<3> F = Vector<3>(0.5, across, across).asDiagonal();
  deform(body, [&](const Vector<3>& X) -> Vector<3> { return F * X; }, [&](const Vector<3>&) { return F; });
  const RodShape shape = shape_of(body, cells.layer);
  CHECK(shape.length == Approx(5.0 * mm).epsilon(1e-12));
  CHECK(shape.foot_radius == Approx(3.0 * across * mm).epsilon(1e-12));
  CHECK(shape.undeformed_length(3.0 * mm, 0.005) == 0.0);
}

TEST_CASE("a cone is measured at every height", "[taylor]") {
  const Cells cells = quarter_rod({10.0 * mm, 6.0 * mm}, 0.25 * mm, Arrangement::rings);
  Body<3> body = body_of(cells, 0.25 * mm);
  // The foot half is a cone: radius times 1.5 at the wall, times 1 from half of the height.
  const auto stretch = [](double x) { return 1.0 + 0.5 * std::max(0.0, 1.0 - x / (5.0 * mm)); };
  deform(
      body, [&](const Vector<3>& X) { return Vector<3>(X[0], stretch(X[0]) * X[1], stretch(X[0]) * X[2]); },
      [&](const Vector<3>& X) -> Matrix<3> { return Vector<3>(1.0, stretch(X[0]), stretch(X[0])).asDiagonal(); });
  const RodShape shape = shape_of(body, cells.layer);
  CHECK(shape.length == Approx(10.0 * mm).epsilon(1e-12));
  CHECK(shape.radius_at(2.0 * mm) == Approx(3.0 * mm * 1.3).epsilon(1e-9));
  CHECK(shape.radius_at(8.0 * mm) == Approx(3.0 * mm).epsilon(1e-12));
  CHECK(shape.undeformed_length(3.0 * mm, 0.02) == Approx(5.2 * mm).epsilon(1e-9));
}

TEST_CASE("a cell that is turned reaches as far as one that is not", "[taylor]") {
  Body<3> body = body_of(quarter_rod({10.0 * mm, 6.0 * mm}, 1.0 * mm, Arrangement::rings), 1.0 * mm);
  Particles<3>& p = body.particles;
  p.position[0].setZero();
  p.deformation_gradient[0] = rotation((Tensor() << 0, -0.7, 0.2, 0.7, 0, 0.4, -0.2, -0.4, 0).finished());
  CHECK(reach(p, 0, Vector<3>::UnitX(), Vector<3>::Constant(0.5 * mm)) == Approx(0.5 * mm).epsilon(1e-12));
}
