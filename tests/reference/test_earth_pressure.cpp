// Limit states against printed tables and against each other.
#include "reference/exact/earth_pressure.hpp"

#include <cmath>
#include <numbers>

#include "tests/catch.hpp"

using namespace furrow::exact;

namespace {
constexpr double degree = std::numbers::pi / 180.0;
}

TEST_CASE("coefficients as tables print them", "[exact]") {
  const auto [phi, Ka, Kp, Nq, Nc] = GENERATE(table<double, double, double, double, double>({{28.0, 0.3610, 2.7698, 14.720, 25.803},
                                                                                           {25.0, 0.4059, 2.4639, 10.662, 20.721},
                                                                                           {19.8, 0.4939, 2.0245, 6.274, 14.648},
                                                                                           {30.0, 0.3333, 3.0000, 18.401, 30.140}}));
  CHECK(rankine_active(phi * degree) == Approx(Ka).margin(5e-5));
  CHECK(rankine_passive(phi * degree) == Approx(Kp).margin(5e-5));
  CHECK(bearing_surcharge(phi * degree) == Approx(Nq).margin(5e-4));
  CHECK(bearing_cohesion(phi * degree) == Approx(Nc).margin(5e-4));
}

TEST_CASE("without friction soil weighs on a wall like water, and bears 2 + pi times its cohesion", "[exact]") {
  CHECK(active_force(0.0, 0.0, 1e4, 2.0) == Approx(2e4));
  CHECK(passive_force(0.0, 0.0, 1e4, 2.0) == Approx(2e4));
  CHECK(bearing_cohesion(0.0) == Approx(5.1416).margin(5e-5));
  CHECK(bearing_cohesion(1e-5) == Approx(bearing_cohesion(0.0)).epsilon(1e-4));
}

TEST_CASE("cohesion takes from the active force and adds to the passive one; the free height carries none", "[exact]") {
  const double phi = 28.0 * degree, gamma = 1540.0 * 9.81;
  CHECK(active_force(phi, 500.0, gamma, 1.0) < active_force(phi, 0.0, gamma, 1.0));
  CHECK(passive_force(phi, 500.0, gamma, 1.0) - passive_force(phi, 0.0, gamma, 1.0) == Approx(2.0 * 500.0 * std::sqrt(2.7698)).epsilon(1e-4));
  CHECK(active_force(phi, 5e3, gamma, 1.0) == 0.0);   // it stands by itself: 2 c/(gamma sqrt(K_a)) = 1.10 m
  // Without the cut at the free height the integral is lower by 2 c^2/gamma.
  const double K = rankine_active(phi), whole = 0.5 * K * gamma - 2.0 * 500.0 * std::sqrt(K);
  CHECK(active_force(phi, 500.0, gamma, 1.0) - whole == Approx(2.0 * 500.0 * 500.0 / gamma));
}

TEST_CASE("a vertical cut: heights as tables print them", "[exact]") {
  // 2.11 m for 28 deg, 5 kPa, 1540 kg/m^3; 1.66 m for 25 deg, 1850 kg/m^3 (slip circles), 2.20 and 1.73 m (wedge).
  CHECK(vertical_cut_cohesion(28.0 * degree, 1540.0 * 9.81, 2.11) == Approx(5e3).epsilon(5e-3));
  CHECK(vertical_cut_cohesion(25.0 * degree, 1850.0 * 9.81, 1.66) == Approx(5e3).epsilon(5e-3));
  CHECK(vertical_cut_cohesion(28.0 * degree, 1540.0 * 9.81, 2.20, 4.0) == Approx(5e3).epsilon(5e-3));
}
