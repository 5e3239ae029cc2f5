#include "harness/material_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "tests/catch.hpp"

using namespace furrow;
namespace fs = std::filesystem;

namespace {

const fs::path materials = fs::path(FURROW_SOURCE_DIR) / "reference/materials";

Parameters shipped(const std::string& name) { return Parameters::read(materials / (name + ".toml")); }

/// The message of the error that a changed constant must raise; empty when there is none.
std::string complaint(const std::string& name, const std::vector<MaterialChange>& changes) {
  Parameters file = shipped(name);
  for (const auto& [path, value] : changes) file.assign(path, value, "the test");
  try {
    read_material(file, 0.0);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

bool says(const std::string& message, const std::string& words) { return message.find(words) != std::string::npos; }

}  // namespace

TEST_CASE("Every shipped material is read, starts sound and without stress", "[material_file]") {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(materials)) {
    INFO(entry.path());
    const NamedMaterial material = read_material(Parameters::read(entry.path()), 0.0);
    CHECK(!material.name.empty());
    CHECK(!material.why.empty());
    CHECK(!material.sources.empty());
    std::visit(
        [](const auto& law) {
          const MaterialState state = law.initial_state();
          CHECK(state.stress.norm() == 0.0);
          CHECK(std::isfinite(law.sound_speed(state)));
          CHECK(law.sound_speed(state) > 10.0);
          CHECK(law.sound_speed(state) < 2e4);
        },
        material.law);
    ++count;
  }
  CHECK(count >= 13);
}

TEST_CASE("Constants reach the law in SI", "[material_file]") {
  const auto metal = std::get<JohnsonCook<MieGrueneisen>>(read_material(shipped("6061-t6"), 0.0).law);
  CHECK(metal.strength.A == Approx(324e6));
  CHECK(metal.strength.C == 0.002);
  CHECK(metal.shear_modulus == Approx(26e9));
  CHECK(metal.specific_heat == 896.0);
  REQUIRE(metal.damage);
  CHECK(metal.damage->D3 == -0.47);
  CHECK(metal.form.stress_power);

  const auto copper = std::get<J2Plastic<LinearEos>>(read_material(shipped("benchmark-copper"), 0.0).law);
  CHECK(copper.eos.bulk_modulus == Approx(130e9));
  CHECK(copper.shear_modulus == Approx(117e9 / 2.7));

  const auto soil = std::get<DruckerPrager>(read_material(shipped("soil"), 0.0).law);
  CHECK(soil.cone.alpha == Approx(0.151041).epsilon(1e-5));
  CHECK(soil.cone.k == Approx(4261.0).epsilon(1e-4));
}

TEST_CASE("The paper's forms and another cone are a change of one key", "[material_file]") {
  Parameters file = shipped("tool");
  for (const char* equation : {"eq_9", "eq_17", "eq_19", "eq_21", "eq_24", "failure"})
    file.assign(std::string("form.") + equation, "printed", "the test");
  const auto tool = std::get<JohnsonCook<MieGrueneisen>>(read_material(file, 0.0).law);
  CHECK(!tool.form.stress_power);
  CHECK(!tool.form.root_of_j2);
  CHECK(!tool.form.plastic_rate);
  CHECK(!tool.eos.squared_denominator);
  CHECK(tool.damage->printed_rate);
  CHECK(tool.damage->keeps_tension);

  Parameters soil = shipped("soil");
  soil.assign("cone", "compression", "the test");
  soil.assign("update", "rate_printed", "the test");
  const auto law = std::get<DruckerPrager>(read_material(soil, 0.0).law);
  CHECK(law.cone.alpha == Approx(0.214224).epsilon(1e-5));
  CHECK(law.update == DruckerPragerUpdate::rate_printed);
}

TEST_CASE("What no material can be is an error that names the constant", "[material_file]") {
  const auto value = [](const std::string& number, const std::string& unit) {
    return "{ value = " + number + ", unit = \"" + unit + "\", source = \"tillage-tools-2024\" }";
  };
  struct Wrong {
    std::string file, key, value, words;
  };
  const std::vector<Wrong> cases{
      {"6061-t6", "density", value("-2700", "kg/m^3"), "positive"},
      {"6061-t6", "density", value("nan", "kg/m^3"), "finite"},
      {"6061-t6", "density", value("2700", "MPa"), "dimension kg/m^3"},
      {"6061-t6", "density", "2700", "found 2700"},
      {"benchmark-copper", "elasticity.poisson_ratio", value("0.5", "1"), "less than 0.5"},
      {"benchmark-copper", "elasticity.poisson_ratio", value("0.7", "1"), "less than 0.5"},
      {"benchmark-copper", "strength.hardening_modulus", value("-1", "MPa"), "zero or positive"},
      {"6061-t6", "strength.melting_temperature", value("290", "K"), "more than the reference temperature of 294 K"},
      {"6061-t6", "strength.A", value("0", "MPa"), "positive"},
      {"6061-t6", "heating.taylor_quinney", value("1.1", "1"), "between 0 and 1"},
      {"6061-t6", "damage.least_fracture_strain", value("0", "1"), "positive"},
      {"6061-t6", "damage.highest_triaxiality", value("-1", "1"), "more than the lowest"},
      {"6061-t6", "damage.softening_length", value("1", "mm"), "no particles"},
      {"soil", "strength.friction_angle", value("60", "deg"), "less than 60 deg"},
      {"soil", "strength.friction_angle", value("-1", "deg"), "at least 0"},
      {"soil", "strength.cohesion", value("-5", "kPa"), "zero or positive"},
      {"soil", "strength.dilation_angle", value("30", "deg"), "at most the angle of friction of 28 deg"},
      {"soil", "strength.dilation_angle", value("10", "deg"), "sqrt(J2) + 3 I1 sin(psi)"},
      {"soil", "cone", "\"plain_strain\"", "did you mean \"plane_strain\""},
      {"soil", "strength.friction_angel", value("28", "deg"), "did you mean 'friction_angle'"},
      {"6061-t6", "strength.A", "{ value = 324, unit = \"MPa\", source = \"lesuer-2011\" }", "did you mean \"lesuer-2001\""},
      {"6061-t6", "law", "\"johnson-cook\"", "did you mean \"johnson_cook\""},
      {"ofhc-copper", "form.eq_18", "\"printed\"", "unknown key"},
  };
  for (const Wrong& wrong : cases) {
    INFO(wrong.key << " = " << wrong.value);
    const std::string message = complaint(wrong.file, {{wrong.key, wrong.value}});
    INFO(message);
    CHECK(says(message, wrong.words));
    CHECK(says(message, wrong.key.substr(wrong.key.rfind('.') + 1)));
  }
  CHECK(complaint("soil", {{"cone", "plane_strain"}, {"strength.dilation_angle", value("10", "deg")}}).empty());
}

TEST_CASE("A missing constant is an error that says how one is written", "[material_file]") {
  const std::string text =
      "name = \"x\"\nlaw = \"elastic\"\ndensity = { value = 1, unit = \"kg/m^3\", source = \"mine\" }\n"
      "[sources.mine]\ntext = \"a test\"\n[elasticity]\n"
      "young_modulus = { value = 1, unit = \"Pa\", source = \"mine\" }\n";
  try {
    read_material(Parameters::parse(text, "x.toml"), 0.0);
    FAIL("found no error");
  } catch (const InputError& error) {
    CHECK(says(error.what(), "x.toml"));
    CHECK(says(error.what(), "poisson_ratio"));
    CHECK(says(error.what(), "source ="));
  }
  const std::string whole = text + "poisson_ratio = { value = 0.25, unit = \"1\", source = \"mine\" }\n";
  CHECK(std::get<LinearElastic>(read_material(Parameters::parse(whole, "x.toml"), 0.0).law).shear_modulus == Approx(0.4));
}

TEST_CASE("A case names a material beside it, or one that is shipped", "[material_file]") {
  const fs::path folder = fs::temp_directory_path() / "furrow-test-material-file";
  fs::remove_all(folder);
  fs::create_directories(folder);
  fs::copy_file(materials / "soil.toml", folder / "clay.toml");
  const auto named = [&](const std::string& text) {
    return read_material(Parameters::parse(text, (folder / "case.toml").string()), "material");
  };
  CHECK(named("material = \"clay\"").name == "Soil of the paper");
  CHECK(named("material = \"6061-t6\"").name == "6061-T6 aluminium");
  CHECK(std::get<DruckerPrager>(named("material = \"clay\"\nmaterial_set = [\"cone=plane_strain\"]").law).cone.alpha ==
        Approx(std::sin(28.0 * 3.14159265358979 / 180.0) / 3.0));
  const auto wrong = [&](const std::string& text) -> std::string {
    try {
      named(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  };
  CHECK(says(wrong("material = \"loam\""), "loam.toml"));
  CHECK(says(wrong("material = \"clay\"\nmaterial_set = [\"cone\"]"), "KEY=VALUE"));
  fs::remove_all(folder);
}
