// Closed forms of bodies that yield, against printed values and against their own equations.
#include <cmath>

#include "reference/exact/elastic_plastic.hpp"
#include "tests/catch.hpp"

using namespace furrow::exact;

TEST_CASE("the piston gives the tabulated states", "[exact]") {
  // Al and Cu of Udaykumar et al. (2003), computed independently with the equations of Lieberman et al. (2019).
  const Piston al = piston({2790.0, 5330.0, 1.34, 2.0, 28.6e9, 0.26e9}, 100.0);
  CHECK(al.elastic.front_speed == Approx(6520.7).epsilon(2e-5));
  CHECK(al.elastic.density == Approx(2802.71).epsilon(2e-6));
  CHECK(al.elastic.pressure == Approx(364.66e6).epsilon(2e-4));
  CHECK(al.elastic.stress == Approx(537.99e6).epsilon(2e-4));
  CHECK(al.elastic.velocity == Approx(29.572).epsilon(2e-4));
  CHECK(al.plastic.front_speed == Approx(5505.5).epsilon(5e-5));   // the last digit of the density is worth 1e-4
  CHECK(al.plastic.density == Approx(2839.23).epsilon(2e-6));
  CHECK(al.plastic.pressure == Approx(1.44555e9).epsilon(2e-4));
  CHECK(al.plastic.stress == Approx(1.61889e9).epsilon(2e-4));
  CHECK(al.plastic.velocity == Approx(100.0).epsilon(1e-9));
  const Piston cu = piston({8930.0, 3940.0, 1.49, 2.0, 45e9, 90e6}, 20.0);
  CHECK(cu.elastic.front_speed == Approx(4722.2).epsilon(2e-5));
  CHECK(cu.plastic.front_speed == Approx(3976.96).epsilon(2e-5));
  CHECK(cu.plastic.stress == Approx(741.59e6).epsilon(2e-4));
}

TEST_CASE("behind both fronts mass, momentum and energy balance", "[exact]") {
  const PistonMetal metal{2790.0, 5330.0, 1.34, 2.0, 28.6e9, 0.26e9};
  const Piston p = piston(metal, 250.0);
  const auto& a = p.elastic;
  const auto& b = p.plastic;
  CHECK(a.density * (a.front_speed - a.velocity) == Approx(metal.density * a.front_speed).epsilon(1e-10));
  CHECK(b.density * (b.front_speed - b.velocity) == Approx(a.density * (b.front_speed - a.velocity)).epsilon(1e-8));
  CHECK(b.stress - a.stress == Approx(a.density * (b.front_speed - a.velocity) * (b.velocity - a.velocity)).epsilon(1e-8));
  const double work = b.stress * b.velocity - a.stress * a.velocity;
  const double gained = a.density * (b.front_speed - a.velocity) *
                        (b.energy - a.energy + 0.5 * (b.velocity * b.velocity - a.velocity * a.velocity));
  CHECK(work == Approx(gained).epsilon(1e-8));
}

TEST_CASE("a piston too slow to make the metal yield is refused", "[exact]") {
  CHECK_THROWS_AS(piston({2790.0, 5330.0, 1.34, 2.0, 28.6e9, 0.26e9}, 20.0), std::domain_error);
}

TEST_CASE("a collapsing cylinder starts with the tabulated speeds", "[exact]") {
  CHECK(collapsing_cylinder_speed(1845.0, 0.33e9, 0.080, 0.100, 0.050) == Approx(417.08).epsilon(2e-5));
  CHECK(collapsing_cylinder_speed(1845.0, 0.33e9, 0.080, 0.100, 0.045) == Approx(454.65).epsilon(2e-5));
  CHECK(outer_radius(0.080, 0.100, 0.050) == Approx(0.07810).epsilon(1e-4));
}

TEST_CASE("an expanding ring stops where its speed vanishes", "[exact]") {
  const ExpandingRing rigid{2790.0, 0.26e9, HUGE_VAL, 0.1, 150.0}, elastic{2790.0, 0.26e9, 85e9, 0.1, 150.0};
  for (const ExpandingRing& ring : {rigid, elastic}) {
    const double stop = expanding_ring_stop(ring);
    CHECK(expanding_ring_speed(ring, 0.1) == Approx(150.0));
    CHECK(expanding_ring_speed(ring, stop * (1.0 - 1e-9)) < 0.05);
    CHECK(expanding_ring_speed(ring, 1.0001 * stop) == 0.0);
  }
  // Energy: half rho v^2 is 2Y/sqrt(3) times the hoop strain.
  const double work = 2.0 * 0.26e9 / std::sqrt(3.0) * std::log(expanding_ring_stop(rigid) / 0.1);
  CHECK(0.5 * 2790.0 * 150.0 * 150.0 == Approx(work).epsilon(1e-12));
  // A ring too slow to yield stops as a spring does, at the strain v sqrt(rho/E').
  ExpandingRing slow = elastic;
  slow.velocity = 1.0;
  CHECK(std::log(expanding_ring_stop(slow) / 0.1) == Approx(std::sqrt(2790.0 / 85e9)).epsilon(1e-12));
}

TEST_CASE("the limit moment of the paper's strip is 210 N", "[exact]") {
  CHECK(limit_moment(324e6, 1.5e-3) == Approx(210.4).epsilon(1e-3));
}
