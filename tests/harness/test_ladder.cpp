#include "harness/ladder.hpp"

#include <cmath>
#include <random>

#include "tests/catch.hpp"

using namespace furrow;

namespace {

const std::vector<double> halved{8e-3, 4e-3, 2e-3, 1e-3, 0.5e-3};

template <class F>
std::vector<double> over(const std::vector<double>& spacing, F f) {
  std::vector<double> result;
  for (const double dx : spacing) result.push_back(f(dx));
  return result;
}

}  // namespace

TEST_CASE("An error that falls as dx^p has the order p", "[ladder]") {
  for (const double p : {0.5, 1.0, 2.0, 4.0}) {
    const Ladder l = error_ladder(halved, over(halved, [p](double dx) { return -3.0 * std::pow(dx, p); }), 1e-15);
    CHECK(l.order == Approx(p));
    CHECK(l.order_stderr < 1e-10);
    CHECK(l.state == LadderState::asymptotic);
  }
}

TEST_CASE("Noise of a few per cent moves the order by about its standard error", "[ladder]") {
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0.0, 0.02);
  int inside = 0;
  constexpr int trials = 200;
  for (int k = 0; k < trials; ++k) {
    const Ladder l = error_ladder(halved, over(halved, [&](double dx) { return dx * dx * std::exp(noise(random)); }), 1e-15);
    CHECK(l.state == LadderState::asymptotic);
    // Student's t with 3 degrees of freedom: 95 % lie within 3.18 standard errors.
    inside += std::abs(l.order - 2.0) < 3.18 * l.order_stderr ? 1 : 0;
  }
  CHECK(inside > 0.90 * trials);
}

TEST_CASE("An error that falls as h^2 and then stands still is a plateau, with the order of the falling part", "[ladder]") {
  const std::vector<double> spacing{32e-3, 16e-3, 8e-3, 4e-3, 2e-3, 1e-3, 0.5e-3};
  const Ladder l = error_ladder(spacing, over(spacing, [](double dx) { return dx * dx + 1e-6; }), 1e-15);
  CHECK(l.state == LadderState::plateau);
  CHECK(l.order == Approx(2.0).margin(0.2));

  // The plain SPH gradient on disordered particles: falls a little, then stands.
  CHECK(error_ladder({8, 4, 2, 1}, {5.93e-2, 4.59e-2, 4.53e-2, 4.47e-2}, 1e-15).state == LadderState::plateau);

  const Ladder flat = error_ladder(halved, {1.0e-3, 1.02e-3, 0.99e-3, 1.01e-3, 1.0e-3}, 1e-15);
  CHECK(flat.state == LadderState::plateau);
  CHECK(std::abs(flat.order) < 0.1);
}

TEST_CASE("Errors that go up and down, or only up, are not an order", "[ladder]") {
  CHECK(error_ladder(halved, {1.0, 0.1, 0.4, 0.05, 0.2}, 1e-15).state == LadderState::oscillatory);
  CHECK(error_ladder(halved, {0.1, 0.2, 0.4, 0.8, 1.6}, 1e-15).state == LadderState::diverging);
  // A lucky zero crossing on the way: orders of 2, 5 and -4.
  CHECK(error_ladder({4, 2, 1, 0.5}, {1.0, 0.25, 0.0078, 0.12}, 1e-15).state == LadderState::oscillatory);
}

TEST_CASE("An order that still changes is undetermined", "[ladder]") {
  CHECK(error_ladder({4, 2, 1, 0.5}, {1.0, 0.8, 0.3, 0.05}, 1e-15).state == LadderState::undetermined);
  // A second-order error that gives way to a first-order one: local orders of 1.8, 1.5 and 1.2.
  CHECK(error_ladder({8, 4, 2, 1}, {3.16e-2, 8.95e-3, 3.08e-3, 1.30e-3}, 1e-15).state == LadderState::undetermined);
}

TEST_CASE("Two rungs, NaN, and round-off give no order", "[ladder]") {
  CHECK(error_ladder({2, 1}, {1.0, 0.25}, 1e-15).state == LadderState::undetermined);
  CHECK(std::isnan(error_ladder({2, 1}, {1.0, 0.25}, 1e-15).order));
  const Ladder nan = error_ladder({4, 2, 1}, {1.0, std::nan(""), 0.1}, 1e-15);
  CHECK(nan.state == LadderState::undetermined);
  CHECK(std::isnan(nan.order));
  const Ladder exact = error_ladder({4, 2, 1}, {3e-16, 2e-16, 0.0}, 1e-14);
  CHECK(exact.state == LadderState::round_off);
  CHECK(std::isnan(exact.order));
  CHECK(error_ladder({4, 2, 1}, {1e-3, 1e-16, 1e-5}, 1e-14).state == LadderState::undetermined);
}

TEST_CASE("A ladder goes from coarse to fine, one value a rung", "[ladder]") {
  CHECK_THROWS_AS(error_ladder({1, 2, 4}, {1, 2, 3}, 0.0), std::invalid_argument);
  CHECK_THROWS_AS(value_ladder({4, 2, 1}, {1, 2}, 0.0), std::invalid_argument);
}

TEST_CASE("Three values give Roache's order, limit and GCI", "[ladder]") {
  // f = 1 + 0.02 dx^2 at dx = 4, 2, 1: p = ln((f1 - f2)/(f2 - f3))/ln 2 = 2, GCI = 1.25 (f2 - f3)/f3/(2^p - 1).
  const Ladder l = value_ladder({4, 2, 1}, {1.32, 1.08, 1.02}, 1e-15);
  CHECK(l.state == LadderState::asymptotic);
  CHECK(l.order == Approx(2.0).epsilon(1e-6));
  CHECK(l.extrapolated == Approx(1.0).epsilon(1e-6));
  CHECK(l.gci == Approx(1.25 * 0.06 / 1.02 / 3.0).epsilon(1e-5));
  CHECK(std::isnan(l.order_stderr));
}

TEST_CASE("Uneven ratios and orders up to four are found", "[ladder]") {
  const std::vector<double> spacing{5.0, 3.0, 2.0, 1.5, 1.0};
  for (const double p : {0.7, 1.0, 1.5, 2.0, 3.5}) {
    const Ladder l = value_ladder(spacing, over(spacing, [p](double dx) { return 7.0 - 0.01 * std::pow(dx, p); }), 1e-15);
    CHECK(l.order == Approx(p).epsilon(1e-4));
    CHECK(l.extrapolated == Approx(7.0).epsilon(1e-6));
    CHECK(l.state == LadderState::asymptotic);
    const double safety = p <= 2.1 ? 1.25 : 3.0;
    CHECK(l.gci == Approx(safety * 0.01 / 6.99).epsilon(1e-3));
  }
}

TEST_CASE("The limit under noise lies within the GCI", "[ladder]") {
  std::mt19937_64 random(11);
  std::normal_distribution<double> noise(0.0, 2e-4);
  int covered = 0, asymptotic = 0;
  constexpr int trials = 200;
  for (int k = 0; k < trials; ++k) {
    const std::vector<double> spacing{4, 3, 2, 1.5, 1};
    const Ladder l = value_ladder(spacing, over(spacing, [&](double dx) { return 1.0 + 0.01 * dx * dx + noise(random); }), 1e-15);
    if (l.state != LadderState::asymptotic) continue;
    ++asymptotic;
    covered += std::abs(l.value.back() - 1.0) <= l.gci * l.value.back() ? 1 : 0;
    CHECK(l.order_stderr > 0.0);
  }
  CHECK(asymptotic > 0.9 * trials);
  CHECK(covered > 0.90 * asymptotic);
}

TEST_CASE("Values that swing, run away or stand still are told apart", "[ladder]") {
  const Ladder swing = value_ladder({4, 2, 1}, {1.0, 1.2, 1.1}, 1e-15);
  CHECK(swing.state == LadderState::oscillatory);
  CHECK(std::isnan(swing.extrapolated));
  CHECK(swing.gci == Approx(3.0 * 0.2 / 1.1));
  CHECK(value_ladder({4, 2, 1}, {1.0, 2.0, 4.0}, 1e-15).state == LadderState::diverging);
  CHECK(value_ladder({4, 2, 1}, {1.0, 2.0, 3.0}, 1e-15).state != LadderState::asymptotic);   // logarithmic growth, p = 0
  CHECK(value_ladder({4, 2, 1}, {1.0, 1.0, 1.0}, 1e-15).state == LadderState::round_off);
  CHECK(value_ladder({2, 1}, {1.0, 1.1}, 1e-15).state == LadderState::undetermined);
}
