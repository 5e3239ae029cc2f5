#include "harness/units.hpp"

#include <numbers>

#include "tests/catch.hpp"

using namespace furrow;

TEST_CASE("A unit is a factor to SI and a dimension", "[units]") {
  CHECK(unit("mm").factor == Approx(1e-3));
  CHECK(unit("mm").dimension == dimension::length);
  CHECK(unit("kg/m^3").factor == Approx(1.0));
  CHECK(unit("kg/m^3").dimension == dimension::density);
  CHECK(unit("g/cm^3").factor == Approx(1000.0));
  CHECK(unit("GPa").factor == Approx(1e9));
  CHECK(unit("GPa").dimension == dimension::stress);
  CHECK(unit("deg").factor == Approx(std::numbers::pi / 180.0));
  CHECK(unit("%").factor == Approx(0.01));
  CHECK(unit("km/h").factor == Approx(1.0 / 3.6));
  CHECK(unit("s^-1").dimension == dimension::rate);
  CHECK(unit("1/s").dimension == dimension::rate);
  CHECK(unit("m/s^2").dimension == dimension::acceleration);
  CHECK(unit("N m/m").dimension == dimension::force);
  CHECK(unit("kN/m").dimension == dimension::force_per_width);
  CHECK(unit("1").dimension == dimension::none);
}

TEST_CASE("Parentheses close what stands under the stroke", "[units]") {
  const Unit heat_capacity = unit("J/(kg K)");
  CHECK(heat_capacity.dimension == Dimension{0, 2, -2, -1});
  CHECK(heat_capacity.symbol == "J/(kg K)");
  CHECK(unit("J/kg/K").dimension == heat_capacity.dimension);
}

TEST_CASE("Minutes, metres and milli are kept apart", "[units]") {
  CHECK(unit("min").factor == Approx(60.0));
  CHECK(unit("ms").dimension == dimension::time);
  CHECK(unit("m s").dimension == Dimension{0, 1, 1, 0});
  CHECK(unit("mN").factor == Approx(1e-3));
}

TEST_CASE("What is no unit is refused", "[units]") {
  for (const char* text : {"", "furlong", "m^", "kg//m", "J/(kg K", "m)", "mmm", "kmin", "2", "m^x"}) {
    INFO(text);
    CHECK_FALSE(parse_unit(text).has_value());
  }
  CHECK_THROWS_AS(unit("furlong"), std::logic_error);
}

TEST_CASE("SI symbol of a dimension reads back as the same dimension", "[units]") {
  for (const Dimension d : {dimension::none, dimension::length, dimension::density, dimension::stress, dimension::velocity,
                            dimension::rate, dimension::energy, dimension::force_per_width, Dimension{0, 2, -2, -1}}) {
    INFO(si_symbol(d));
    CHECK(unit(si_symbol(d)).dimension == d);
    CHECK(unit(si_symbol(d)).factor == Approx(1.0));
  }
}
