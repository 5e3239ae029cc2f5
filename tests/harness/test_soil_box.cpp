// Soil in a box: the ratio of stresses at rest against the cone, blocks, layers at any angle.
#include "harness/soil_box.hpp"

#include "tests/catch.hpp"

using namespace furrow;

namespace {

DruckerPrager rods() {   // Bui et al. 2008
  return {.reference_density = 2650.0, .bulk_modulus = 0.7e6, .shear_modulus = 0.3231e6, .cone = DruckerPragerCone::bui(0.0, 19.8 * 3.14159265358979 / 180.0, 0.0)};
}

}  // namespace

TEST_CASE("the active ratio lies on the cone", "[soil-box]") {
  DruckerPrager soil = rods();
  soil.cone.k = GENERATE(0.0, 300.0);
  const double p = 2000.0, K = active_ratio(soil, p);
  Tensor stress = -K * p * Tensor::Identity();
  stress(1, 1) = -p;
  CHECK(soil.yield_function(stress) == Approx(0.0).margin(1e-9 * p));
  CHECK(active_ratio(rods(), p) == Approx(0.584).margin(5e-4));
}

TEST_CASE("at rest soil is elastic where it can be, and close to yield where it cannot", "[soil-box]") {
  const RestingRatio ratio;
  CHECK(ratio(rods(), 2000.0) == Approx(1.02 * active_ratio(rods(), 2000.0)));   // 0.596; nu/(1 - nu) = 0.43 would yield
  DruckerPrager stiff = rods();
  stiff.cone.k = 5e3;
  CHECK(ratio(stiff, 2000.0) == Approx(0.3 / 0.7).epsilon(1e-3));
  CHECK(RestingRatio{0.7}(rods(), 2000.0) == 0.7);
}

TEST_CASE("a ratio outside the cone is refused", "[soil-box]") {
  const auto read = [](const char* text) { return read_resting_ratio(Parameters::parse(text, "t.toml"), rods(), 2000.0); };
  CHECK(read("k0 = 0.7").given == 0.7);
  CHECK(!read("").given);
  CHECK_THROWS_AS(read("k0 = 0.5"), InputError);
  CHECK_THROWS_AS(read("k0 = 4.0"), InputError);
  CHECK_THROWS_AS(read("k0 = -0.1"), InputError);
}

TEST_CASE("a rectangle is filled by whole cells", "[soil-box]") {
  const auto centres = rectangle({1.0, 2.0}, 0.3, 0.2, 0.1);
  REQUIRE(centres.size() == 6);
  CHECK(centres.front().isApprox(Vector<2>(1.05, 2.05)));
  CHECK(centres.back().isApprox(Vector<2>(1.25, 2.15)));
  CHECK_THROWS_AS(rectangle({0.0, 0.0}, 0.35, 0.2, 0.1), std::invalid_argument);
}

TEST_CASE("a layer lies behind its surface", "[soil-box]") {
  Body<2> body;
  body.material = rods();
  body.spacing = 0.1;
  const Vector<2> from(0.0, 0.0), to(0.6, 0.8);
  add_flat_layer(body, "slope", from, to, Slip::none);
  const BoundaryLayer<2>& layer = body.layers.front();
  REQUIRE(layer.ids.size() == 40);
  for (std::size_t k = 0; k < layer.ids.size(); ++k) {
    const Vector<2>& x = body.particles.position[static_cast<std::size_t>(layer.ids[k])];
    CHECK(layer.normal[k].isApprox(Vector<2>(-0.8, 0.6)));
    CHECK((x - from).dot(layer.normal[k]) == Approx(-layer.depth[k]));
    CHECK((x - from).dot(Vector<2>(0.6, 0.8)) > 0.0);
    CHECK((x - from).dot(Vector<2>(0.6, 0.8)) < 1.0);
  }
}
