// The numerical choices of a case are switched on and off by name, and a wrong name says what would be right.
#include "harness/scheme_input.hpp"
#include "tests/catch.hpp"

using namespace furrow;

namespace {

Scheme scheme_of(const std::string& table) { return read_scheme(Parameters::parse("scheme = " + table, "case.toml")); }

std::string complaint_about(const std::string& table) {
  try {
    const Parameters parameters = Parameters::parse("scheme = " + table, "case.toml");
    read_scheme(parameters);
    parameters.check_all_used();
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("terms of a scheme are off where they are not named, and on by name", "[scheme]") {
  const Scheme plain = scheme_of("{}");
  CHECK_FALSE(plain.viscosity);
  CHECK_FALSE(plain.artificial_stress);
  CHECK(plain.xsph == 0.0);
  CHECK(plain.hourglass == 0.0);
  CHECK(plain.correction == Correction::linear);

  const Scheme paper = scheme_of(
      "{ kernel = 'cubic_spline', correction = 'none', density = 'shepard', viscosity = { alpha = 1, beta = 2 }, "
      "artificial_stress = { eps = 0.3, n = 4 }, xsph = 0.5, shepard_every = 20, energy = false, hourglass = 0.1 }");
  CHECK(std::holds_alternative<CubicSpline>(paper.kernel));
  CHECK(paper.correction == Correction::none);
  CHECK(paper.density == DensityEquation::shepard);
  REQUIRE(paper.viscosity);
  CHECK(paper.viscosity->beta == 2.0);
  REQUIRE(paper.artificial_stress);
  CHECK(paper.artificial_stress->eps == 0.3);
  CHECK_FALSE(paper.artificial_stress->neutral);
  CHECK(paper.xsph == 0.5);
  CHECK(paper.hourglass == 0.1);
  CHECK(paper.shepard_every == 20);
  CHECK_FALSE(paper.energy);

  CHECK_FALSE(scheme_of("{ viscosity = false, artificial_stress = false }").viscosity);
  CHECK(scheme_of("{ artificial_stress = { eps = 0.3, n = 4, neutral = true } }").artificial_stress->neutral);
}

TEST_CASE("a wrong word in a scheme is named with what would be right", "[scheme]") {
  CHECK(complaint_about("{ correction = 'linaer' }").find("quadratic") != std::string::npos);
  CHECK(complaint_about("{ kernel = 'gauss' }").find("wendland_c2") != std::string::npos);
  CHECK(complaint_about("{ viscosity = true }").find("table of its constants") != std::string::npos);
  CHECK(complaint_about("{ viscosity = { alpha = -1, beta = 0 } }").find("case.toml:1") != std::string::npos);
  CHECK(complaint_about("{ xsph = 2 }").find("xsph") != std::string::npos);
  CHECK(complaint_about("{ viscousity = { alpha = 1, beta = 2 } }").find("viscosity") != std::string::npos);
}
