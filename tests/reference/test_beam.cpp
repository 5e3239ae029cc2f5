// The cantilever's closed forms against the textbook's load cases and against each other.
#include "reference/exact/beam.hpp"

#include "tests/catch.hpp"

using namespace furrow::exact;

TEST_CASE("load cases of a cantilever", "[beam]") {
  const double L = 0.4, EI = 12.0;
  CHECK(cantilever_deflection({{L, 3.0}}, L, EI) == Approx(3.0 * L * L * L / (3.0 * EI)));
  CHECK(cantilever_deflection({{L, 0.0, 2.0}}, L, EI) == Approx(2.0 * L * L / (2.0 * EI)));
  // Uniform load q: q L^4/(8 EI) at the end, moment q L^2/2.
  std::vector<BeamLoad> uniform;
  const int n = 2000;
  for (int k = 0; k < n; ++k) uniform.push_back({L * (k + 0.5) / n, 5.0 * L / n});
  CHECK(cantilever_deflection(uniform, L, EI) == Approx(5.0 * L * L * L * L / (8.0 * EI)).epsilon(1e-5));
  CHECK(clamp_moment(uniform) == Approx(5.0 * L * L / 2.0));
}

TEST_CASE("Maxwell: what a load at a does at x is what a load at x does at a", "[beam]") {
  CHECK(cantilever_deflection({{0.1, 1.0}}, 0.3, 2.0) == Approx(cantilever_deflection({{0.3, 1.0}}, 0.1, 2.0)));
}

TEST_CASE("a load behind the clamp bends nothing", "[beam]") {
  CHECK(cantilever_deflection({{-0.1, 7.0, 3.0}}, 0.3, 2.0) == 0.0);
  CHECK(clamp_moment({{-0.1, 7.0, 3.0}}) == 0.0);
}

TEST_CASE("a plate is stiffer than a beam by 1/(1 - nu^2)", "[beam]") {
  CHECK(plate_stiffness(69e9, 0.33, 1.5e-3) == Approx(69e9 / (1.0 - 0.33 * 0.33) * 1.5e-3 * 1.5e-3 * 1.5e-3 / 12.0));
}
