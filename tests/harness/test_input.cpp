#include "harness/input.hpp"

#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

#include "tests/catch.hpp"

using namespace furrow;

namespace {

template <class F>
std::string message_of(F&& f) {
  try {
    f();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

Parameters sample() {
  return Parameters::parse(R"(length = { value = 25.4, unit = "mm" }
count = 3
ratio = 1.5
kernel = "cubic_spline"
spacing = { value = [4, 2, 1], unit = "mm" }
on = true
date = 2026-11-22

[material]
density = { value = 8960, unit = "kg/m^3" }

[[probe]]
name = "a"
[[probe]]
name = "b"
)",
                           "sample.toml");
}

}  // namespace

TEST_CASE("Numbers come out in SI", "[input]") {
  const Parameters p = sample();
  CHECK(p.quantity("length", dimension::length) == Approx(0.0254));
  CHECK(p.integer("count", 1, 10) == 3);
  CHECK(p.number("ratio") == 1.5);
  CHECK(p.number("count") == 3.0);
  CHECK(p.text("kernel") == "cubic_spline");
  CHECK(p.flag("on"));
  const std::vector<double> spacing = p.quantities("spacing", dimension::length, range::positive);
  REQUIRE(spacing.size() == 3);
  CHECK(spacing[0] == Approx(4e-3));
  CHECK(p.table("material").quantity("density", dimension::density) == Approx(8960));
  CHECK(p.tables("probe").at(1).text("name") == "b");
  CHECK(p.date("date") == std::chrono::year_month_day{std::chrono::year{2026}, std::chrono::month{11}, std::chrono::day{22}});
  CHECK_NOTHROW(p.number_or("absent", 7.0));
}

TEST_CASE("A mistake is named by file, line and key, with what was found and what would be right", "[input]") {
  const Parameters p = sample();
  CHECK(message_of([&] { p.quantity("length", dimension::stress); }) ==
        "sample.toml:1: length.unit: found \"mm\", which is of dimension m, expected a unit of dimension Pa, such as \"MPa\"");
  CHECK(message_of([&] { p.quantity("ratio", dimension::length, range::positive); }) ==
        "sample.toml:3: ratio: found 1.5, expected a number with unit, positive, as in { value = 2.5, unit = \"mm\" }");
  CHECK(message_of([&] { p.number("kernel"); }) == "sample.toml:4: kernel: found \"cubic_spline\", expected a number, finite");
  CHECK(message_of([&] {
          p.number("ratio", {2.0, 4.0});
        }) == "sample.toml:3: ratio: found 1.5, expected a number, between 2 and 4");
  CHECK(message_of([&] { p.integer("ratio", 1, 3); }) ==
        "sample.toml:3: ratio: found 1.5, expected a whole number between 1 and 3");
  CHECK(
      message_of([&] { p.table("material").quantity("modulus", dimension::stress); }) ==
      "sample.toml:9: material.modulus: found nothing, expected a number with unit, finite, as in "
        "{ value = 2.5, unit = \"MPa\" }");
  CHECK(
      message_of([&] {
        p.choice("kernel", {"quintic_spline", "cubic_splines"});
      }) ==
      "sample.toml:4: kernel: found \"cubic_spline\", expected one of \"quintic_spline\", \"cubic_splines\"; "
        "did you mean \"cubic_splines\"?");
}

TEST_CASE("A unit is needed, known, and the only companion of a value", "[input]") {
  const Parameters p = Parameters::parse(
      "a = { value = 1 }\nb = { value = 1, unit = \"furlong\" }\nc = { value = 1, unit = \"m\", error = 1 }\n", "u.toml");
  CHECK(message_of([&] { p.quantity("a", dimension::length); }) ==
        "u.toml:1: a: found no unit, expected a unit of dimension m, such as \"mm\"");
  CHECK(
      message_of([&] { p.quantity("b", dimension::length); }) ==
      "u.toml:2: b.unit: found \"furlong\", which is no unit that furrow knows, expected a unit of dimension m, such as \"mm\"");
  CHECK(message_of([&] { p.quantity("c", dimension::length); }) ==
        "u.toml:3: c.error: unknown key, expected value and unit only");
}

TEST_CASE("NaN and infinity are no numbers unless the range holds them", "[input]") {
  const Parameters p = Parameters::parse("a = nan\nb = inf\n", "n.toml");
  CHECK_THROWS_AS(p.number("a"), InputError);
  CHECK_THROWS_AS(p.number("b"), InputError);
  CHECK_THROWS_AS(p.number("b", range::positive), InputError);
  CHECK(p.number("b", {-range::infinity, range::infinity}) == range::infinity);
  CHECK_THROWS_AS(p.number("a", {-range::infinity, range::infinity}), InputError);
}

TEST_CASE("A key that nobody asked for is unknown, in nested tables too", "[input]") {
  const Parameters p = Parameters::parse("spacing = 1\nspacin = 2\n[material]\ndensity = 1\n[[probe]]\nnmae = 1\n", "k.toml");
  p.number("spacing");
  const Parameters material = p.table("material");
  const std::vector<Parameters> probes = p.tables("probe");
  CHECK(message_of([&] { p.check_all_used(); }) ==
        "k.toml:2: spacin: unknown key, did you mean 'spacing'?; known here: material, probe, spacing");
  p.number("spacin");
  CHECK(message_of([&] { p.check_all_used(); }) == "k.toml:4: material.density: unknown key; known here: none");
  material.number("density");
  probes[0].text_or("name", "");
  CHECK(message_of([&] { p.check_all_used(); }) ==
        "k.toml:6: probe[0].nmae: unknown key, did you mean 'name'?; known here: name");
  probes[0].number("nmae");
  CHECK_NOTHROW(p.check_all_used());
}

TEST_CASE("A file that is not TOML, or not there, is named", "[input]") {
  CHECK(message_of([] { Parameters::parse("a = 1\nb = = 2\n", "bad.toml"); }).starts_with("bad.toml:2: not TOML: "));
  CHECK(message_of([] { Parameters::read("/nowhere/case.toml"); }) ==
        "/nowhere/case.toml: found no such file, expected a TOML file");
}

TEST_CASE("Values taken over from a sweep or the command line keep the place they come from", "[input]") {
  const Parameters p = sample();
  const Parameters sweep = Parameters::parse("\n\nkernel = [\"wendland_c2\", 4]\n", "sweep.toml");
  CHECK(sweep.length("kernel") == 2);
  CHECK(sweep.word("kernel", 0) == "wendland_c2");

  Parameters changed = p.copy();
  changed.assign("kernel", sweep, "kernel", 1);
  CHECK(message_of([&] { changed.text("kernel"); }) == "sweep.toml:3: kernel: found 4, expected text in quotes");
  changed.assign("kernel", "wendland_c4", "--set");
  CHECK(changed.text("kernel") == "wendland_c4");
  changed.assign("material.density", "{ value = 1, unit = \"mm\" }", "--set");
  CHECK(message_of([&] { changed.table("material").quantity("density", dimension::density); }) ==
        "--set: material.density.unit: found \"mm\", which is of dimension m, expected a unit of dimension kg/m^3");
  CHECK_THROWS_AS(changed.assign("ratio.x", "1", "--set"), InputError);
  CHECK(p.text("kernel") == "cubic_spline");
  CHECK(p.table("material").quantity("density", dimension::density) == Approx(8960));
}

TEST_CASE("Files that a table depends on are part of what it says, wherever below it they were read", "[input]") {
  const auto file = std::filesystem::temp_directory_path() / ("furrow-depends-" + std::to_string(::getpid()) + ".csv");
  const auto written = [&](const char* text) {
    std::ofstream(file) << text;
    const Parameters p = sample();
    p.table("material").depends_on(file);
    return p.dependencies();
  };
  const std::string first = written("1, 2");
  CHECK(!first.empty());
  CHECK(written("1, 2") == first);
  CHECK(written("1, 3") != first);
  CHECK(sample().dependencies().empty());
  std::filesystem::remove(file);
  CHECK_THROWS_AS(sample().depends_on(file), InputError);
}

TEST_CASE("bounds of a quantity hold whatever its unit", "[input]") {
  const Parameters in = Parameters::parse("rake = { value = 70, unit = \"deg\" }\nway = { value = [2, 30], unit = \"mm\" }\n", "case.toml");
  REQUIRE(in.quantity("rake", dimension::none, {0.1, 2.0}) == Approx(1.2217304763960306));
  REQUIRE_THROWS_AS(in.quantity("rake", dimension::none, {0.1, 1.2}), InputError);
  REQUIRE(in.quantities("way", dimension::length, {0.0, 0.03}).back() == Approx(0.03));
  REQUIRE_THROWS_AS(in.quantities("way", dimension::length, {0.0, 0.029}), InputError);
}
