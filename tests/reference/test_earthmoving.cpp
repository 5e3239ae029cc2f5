// The earthmoving equation against Rankine's passive pressure, of which it is another form for a vertical blade, and against what
// an earlier evaluation of the same wedge gave.
#include "reference/exact/earthmoving.hpp"

#include <cmath>
#include <numbers>

#include "reference/exact/earth_pressure.hpp"
#include "tests/catch.hpp"

using namespace furrow::exact;

namespace {
constexpr double degree = std::numbers::pi / 180.0;
}

TEST_CASE("a smooth vertical blade that moves slowly meets passive pressure", "[earthmoving]") {
  const double phi = GENERATE(0.0, 20.0, 28.0, 35.0) * degree;
  const CutForce force =
      earthmoving({.density = 1800.0, .cohesion = 3e3, .friction_angle = phi, .rake = 90.0 * degree, .depth = 0.4, .speed = 0.0, .gravity = 9.81});
  REQUIRE(force.draft == Approx(passive_force(phi, 3e3, 1800.0 * 9.81, 0.4)).epsilon(1e-9));
  REQUIRE(force.rupture == Approx(45.0 * degree - 0.5 * phi).margin(1e-6));
  REQUIRE(force.vertical == Approx(0.0).margin(1e-9 * force.draft));
}

TEST_CASE("the paper's cut", "[earthmoving]") {
  // rho 1540, c 5 kPa, phi 28 deg, rake 70 deg, 10 mm, with gravity: draft and vertical in N/m, printed to whole newtons.
  struct Row {
    double delta, speed, draft, vertical;
  };
  const Row row = GENERATE(Row{0.0, 0.0, 98, 36}, Row{0.0, 2.0, 168, 61}, Row{14.0, 1.0, 165, 17}, Row{28.0, 2.0, 319, -45});
  const CutForce force = earthmoving({.density = 1540.0, .cohesion = 5e3, .friction_angle = 28.0 * degree, .rake = 70.0 * degree,
                                      .depth = 0.01, .speed = row.speed, .tool_friction = row.delta * degree, .gravity = 9.81});
  REQUIRE(force.draft == Approx(row.draft).margin(1.0));
  REQUIRE(-force.vertical == Approx(row.vertical).margin(1.0));
}

TEST_CASE("the plane of a blade at rest does not turn with speed", "[earthmoving]") {
  Cut cut{.density = 1540.0, .cohesion = 5e3, .friction_angle = 28.0 * degree, .rake = 70.0 * degree, .depth = 0.01, .speed = 0.0};
  const CutForce slow = earthmoving(cut, Rupture::at_rest);
  REQUIRE(slow.draft == Approx(earthmoving(cut).draft).epsilon(1e-12));
  cut.speed = 3.0;
  const CutForce fast = earthmoving(cut, Rupture::at_rest), least = earthmoving(cut);
  REQUIRE(fast.rupture == Approx(slow.rupture).epsilon(1e-12));
  REQUIRE(least.rupture < 0.8 * slow.rupture);
  REQUIRE(least.draft < fast.draft);
  // Force of inertia on a plane at beta: rho v^2 d (tan beta + cot(beta + phi)) sin(alpha)/(D (1 + tan beta cot alpha)).
  const double beta = slow.rupture, slip = 1.0 / std::tan(beta + cut.friction_angle), alpha = cut.rake;
  const double D = std::cos(alpha) + std::sin(alpha) * slip;
  const double inertia = 1540.0 * 9.0 * 0.01 * (std::tan(beta) + slip) * std::sin(alpha) / (D * (1.0 + std::tan(beta) / std::tan(alpha)));
  REQUIRE(fast.draft - slow.draft == Approx(inertia).epsilon(1e-10));
}

TEST_CASE("no plane of rupture for a blade that is too steep and too rough", "[earthmoving]") {
  REQUIRE_THROWS_AS(earthmoving({.density = 1540.0, .cohesion = 5e3, .friction_angle = 45.0 * degree, .rake = 100.0 * degree,
                                 .depth = 0.01, .speed = 0.0, .tool_friction = 40.0 * degree}),
                    std::invalid_argument);
}
