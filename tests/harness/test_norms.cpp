#include "harness/norms.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "tests/catch.hpp"

using namespace furrow;

TEST_CASE("Norms weigh by volume", "[norms]") {
  const std::vector<double> e{3.0, -1.0}, v{1.0, 3.0};
  const FieldNorms n = norms(e, v);
  CHECK(n.l1 == Approx(1.5));
  CHECK(n.l2 == Approx(std::sqrt(3.0)));
  CHECK(n.linf == 3.0);
}

TEST_CASE("Splitting a particle in two halves changes no norm", "[norms]") {
  const std::vector<double> e{3.0, -1.0}, v{1.0, 3.0}, split_e{3.0, 3.0, -1.0}, split_v{0.5, 0.5, 3.0};
  CHECK(norms(split_e, split_v).l1 == Approx(norms(e, v).l1));
  CHECK(norms(split_e, split_v).l2 == Approx(norms(e, v).l2));
}

TEST_CASE("A relative norm is divided by the same norm of the exact field", "[norms]") {
  const std::vector<double> computed{1.1, 2.2}, exact{1.0, 2.0}, v{1.0, 1.0};
  const FieldNorms n = relative_error_norms(computed, exact, v);
  CHECK(n.l1 == Approx(0.1));
  CHECK(n.l2 == Approx(0.1));
  CHECK(n.linf == Approx(0.1));
  CHECK(error_norms(computed, exact, v).linf == Approx(0.2));
}

TEST_CASE("A NaN anywhere makes every norm NaN", "[norms]") {
  const std::vector<double> e{1.0, std::numeric_limits<double>::quiet_NaN(), 2.0}, v{1.0, 1.0, 1.0};
  const FieldNorms n = norms(e, v);
  CHECK(std::isnan(n.l1));
  CHECK(std::isnan(n.l2));
  CHECK(std::isnan(n.linf));
  const std::vector<double> zero{0.0, 0.0, 0.0}, one{1.0, 1.0, 1.0};
  CHECK(std::isnan(relative_error_norms(one, zero, v).l2));
}

TEST_CASE("A norm of nothing, or without volumes, is refused", "[norms]") {
  const std::vector<double> none, e{1.0}, zero{0.0}, two{1.0, 1.0};
  CHECK_THROWS_AS(norms(none, none), std::invalid_argument);
  CHECK_THROWS_AS(norms(e, two), std::invalid_argument);
  CHECK_THROWS_AS(norms(e, zero), std::invalid_argument);
}
