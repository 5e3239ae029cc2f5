#include "harness/material_file.hpp"

#include <algorithm>
#include <numbers>
#include <set>

#include <fmt/format.h>

#include "harness/case_file.hpp"
#include "harness/provenance.hpp"
#include "solver/materials/parts.hpp"

namespace furrow {
namespace {

constexpr Dimension specific_heat_dimension{0, 2, -2, -1};
constexpr Range poisson{-1.0, 0.5, true, true};
constexpr double degree = std::numbers::pi / 180.0;

/// A table of constants, each { value, unit, source }; remembers the sources.
class Constants {
 public:
  Constants(Parameters table, const Bibliography& bibliography, std::set<std::string>& sources)
      : table_(std::move(table)), bibliography_(&bibliography), sources_(&sources) {}

  bool has(std::string_view key) const { return table_.has(key); }

  /// In SI. `expected` are the words of the message when the number is outside the range.
  double operator()(std::string_view key, Dimension dimension = dimension::none, Range allowed = range::any,
                    std::string_view expected = {}) const {
    if (!table_.has(key))
      table_.fail(
          key, fmt::format(
                   "found nothing, expected a constant with its source, as in {{ value = 2.5, unit = \"{}\", source = \"...\" }}",
                   si_symbol(dimension)));
    const Parameters constant = table_.table(key);
    const double value = constant.number("value");
    const std::string symbol = constant.text("unit");
    const auto unit = parse_unit(symbol);
    if (!unit || unit->dimension != dimension)
      constant.fail("unit", fmt::format("found \"{}\", expected a unit of dimension {}", symbol, si_symbol(dimension)));
    const double in_si = value * unit->factor;
    if (!allowed.contains(in_si))
      constant.fail("value",
                    fmt::format("found {:g} {}, expected {}", value, symbol, expected.empty() ? allowed.words() : expected));
    const std::string source = constant.text("source");
    if (!bibliography_->contains(source)) {
      std::vector<std::string> known;
      for (const auto& [name, citation] : *bibliography_) known.push_back(name);
      const std::string nearest = nearest_word(source, known);
      constant.fail("source",
                    fmt::format("found \"{}\", expected a key of the bibliography (reference/sources.toml, or [sources] of "
                                "this file){}",
                                source, nearest.empty() ? "" : fmt::format("; did you mean \"{}\"?", nearest)));
    }
    sources_->insert(source);
    return in_si;
  }

  [[noreturn]] void fail(std::string_view key, std::string_view message) const { table_.table(key).fail("value", message); }

 private:
  Parameters table_;
  const Bibliography* bibliography_;
  std::set<std::string>* sources_;
};

class Reader {
 public:
  Reader(const Parameters& file, double spacing) : file_(file), spacing_(spacing) {
    bibliography_ = read_bibliography(project_root() / "reference/sources.toml");
    if (file.has("sources")) {
      const Parameters own = file.table("sources");
      for (const std::string& key : own.keys()) {
        const Parameters entry = own.table(key);
        bibliography_[key] = {key, entry.text("text"), entry.text_or("doi", "")};
      }
    }
  }

  NamedMaterial read() {
    NamedMaterial material;
    material.name = file_.text("name");
    material.why = file_.text_or("why", "");
    const std::string law = file_.choice("law", {"elastic", "j2", "johnson_cook", "drucker_prager"});
    density_ = constants()("density", dimension::density, range::positive);
    if (law == "drucker_prager") {
      read_elasticity(true);
      material.law = drucker_prager();
    } else {
      const Parameters eos = file_.table_or_empty("equation_of_state");
      const std::string kind = law == "elastic" ? "linear" : eos.choice_or("kind", "linear", {"linear", "mie_grueneisen"});
      read_elasticity(kind == "linear");
      if (law == "elastic")
        material.law = LinearElastic{density_, bulk_modulus_, shear_modulus_};
      else if (kind == "linear")
        material.law = metal(law, LinearEos{density_, bulk_modulus_});
      else
        material.law = metal(law, mie_grueneisen());
    }
    file_.check_all_used();
    material.sources.assign(sources_.begin(), sources_.end());
    return material;
  }

 private:
  Constants constants() { return {file_, bibliography_, sources_}; }
  Constants constants(std::string_view table) { return {file_.table(table), bibliography_, sources_}; }

  /// G, and K where the equation of state takes it from here.
  void read_elasticity(bool bulk) {
    const Constants c = constants("elasticity");
    if (c.has("young_modulus")) {
      const double E = c("young_modulus", dimension::stress, range::positive);
      const double nu = c("poisson_ratio", dimension::none, poisson, "more than -1 and less than 0.5");
      shear_modulus_ = E / (2.0 * (1.0 + nu));
      bulk_modulus_ = E / (3.0 * (1.0 - 2.0 * nu));
      return;
    }
    shear_modulus_ = c("shear_modulus", dimension::stress, range::positive);
    if (!bulk) return;
    if (c.has("poisson_ratio")) {
      const double nu = c("poisson_ratio", dimension::none, poisson, "more than -1 and less than 0.5");
      bulk_modulus_ = 2.0 * shear_modulus_ * (1.0 + nu) / (3.0 * (1.0 - 2.0 * nu));
    } else {
      bulk_modulus_ = c("bulk_modulus", dimension::stress, range::positive);
    }
  }

  MieGrueneisen mie_grueneisen() {
    const Constants c = constants("equation_of_state");
    MieGrueneisen eos{density_, c("sound_speed", dimension::velocity, range::positive),
                      c("slope", dimension::none, {1.0, range::infinity, false, true}),
                      c("gamma", dimension::none, range::not_negative)};
    eos.squared_denominator = right("eq_17");
    return eos;
  }

  template <class Eos>
  AnyMaterial metal(const std::string& law, const Eos& eos) {
    if (law == "j2") {
      const Constants c = constants("strength");
      return J2Plastic<Eos>{eos, shear_modulus_, c("yield_stress", dimension::stress, range::positive),
                            c("hardening_modulus", dimension::stress, range::not_negative)};
    }
    const Constants heat = constants("heating");
    JohnsonCook<Eos> m{eos, shear_modulus_, johnson_cook_strength(),
                       heat("specific_heat", specific_heat_dimension, range::positive),
                       heat("taylor_quinney", dimension::none, {0.0, 1.0})};
    if (file_.has("damage")) m.damage = johnson_cook_damage();
    m.form = {.stress_power = right("eq_9"), .root_of_j2 = right("eq_19"), .plastic_rate = right("eq_21")};
    return m;
  }

  JohnsonCookStrength johnson_cook_strength() {
    const Constants c = constants("strength");
    const double reference = c("reference_temperature", dimension::temperature, range::not_negative);
    const double melting = c("melting_temperature", dimension::temperature);
    if (!(melting > reference))
      c.fail("melting_temperature",
             fmt::format("found {:g} K, expected more than the reference temperature of {:g} K", melting, reference));
    return {.A = c("A", dimension::stress, range::positive),
            .B = c("B", dimension::stress, range::not_negative),
            .n = c("n", dimension::none, range::positive),
            .C = c("C", dimension::none, range::not_negative),
            .m = c("m", dimension::none, range::positive),
            .reference_rate = c("reference_rate", dimension::rate, range::positive),
            .reference_temperature = reference,
            .melting_temperature = melting};
  }

  JohnsonCookDamage johnson_cook_damage() {
    const Constants c = constants("damage");
    const double low = c("lowest_triaxiality"), high = c("highest_triaxiality");
    if (!(high > low)) c.fail("highest_triaxiality", fmt::format("found {:g}, expected more than the lowest of {:g}", high, low));
    JohnsonCookDamage d{.D1 = c("D1"),
                        .D2 = c("D2"),
                        .D3 = c("D3"),
                        .D4 = c("D4"),
                        .D5 = c("D5"),
                        .lowest_triaxiality = low,
                        .highest_triaxiality = high,
                        .least_fracture_strain = c("least_fracture_strain", dimension::none, range::positive)};
    if (c.has("softening_length")) {
      d.softening_length = c("softening_length", dimension::length, range::positive);
      if (!(spacing_ > 0.0)) c.fail("softening_length", "found a length where there are no particles, expected none");
      d.spacing = spacing_;
    }
    d.printed_rate = !right("eq_24");
    d.keeps_tension = !right("failure");
    return d;
  }

  AnyMaterial drucker_prager() {
    const Constants c = constants("strength");
    const double phi = c("friction_angle", dimension::none, {0.0, 60.0 * degree, false, true}, "at least 0 and less than 60 deg");
    const double cohesion = c("cohesion", dimension::stress, range::not_negative);
    const double psi = c("dilation_angle", dimension::none, range::not_negative);
    if (psi > phi)
      c.fail("dilation_angle", fmt::format("found {:g} deg, expected at most the angle of friction of {:g} deg: more would "
                                           "create energy",
                                           psi / degree, phi / degree));
    const std::string choice = file_.choice("cone", {"bui", "plane_strain", "compression", "extension"});
    const auto constants_of = choice == "bui"            ? &DruckerPragerCone::bui
                              : choice == "plane_strain" ? &DruckerPragerCone::plane_strain
                              : choice == "compression"  ? &DruckerPragerCone::compression
                                                         : &DruckerPragerCone::extension;
    DruckerPrager soil{density_, bulk_modulus_, shear_modulus_, constants_of(cohesion, phi, psi)};
    if (soil.cone.beta > soil.cone.alpha * (1.0 + 1e-12))
      c.fail("dilation_angle",
             fmt::format("found {:g} deg, expected 3 sin(psi) at most alpha = {:g} for the cone \"bui\", whose potential is "
                         "sqrt(J2) + 3 I1 sin(psi): more would create energy",
                         psi / degree, soil.cone.alpha));
    if (c.has("tension_limit")) soil.tension_limit = c("tension_limit", dimension::stress, range::not_negative);
    const std::string update = file_.choice_or("update", "return_map", {"return_map", "rate", "rate_printed"});
    soil.update = update == "rate"           ? DruckerPragerUpdate::rate
                  : update == "rate_printed" ? DruckerPragerUpdate::rate_printed
                                             : DruckerPragerUpdate::return_map;
    return soil;
  }

  bool right(std::string_view equation) {
    return !file_.has("form") || file_.table("form").choice_or(equation, "right", {"right", "printed"}) == "right";
  }

  const Parameters& file_;
  double spacing_;
  Bibliography bibliography_;
  std::set<std::string> sources_;
  double density_ = 0.0, shear_modulus_ = 0.0, bulk_modulus_ = 0.0;
};

}  // namespace

NamedMaterial read_material(const Parameters& file, double spacing) { return Reader(file, spacing).read(); }

NamedMaterial read_material(const Parameters& parameters, std::string_view key, double spacing,
                            const std::vector<MaterialChange>& changes) {
  namespace fs = std::filesystem;
  const std::string word = parameters.text(key);
  fs::path path = fs::path(parameters.file()).parent_path() / (word + ".toml");
  if (!fs::exists(path)) path = project_root() / "reference/materials" / (word + ".toml");
  if (!fs::exists(path))
    parameters.fail(key, fmt::format("found \"{0}\", expected {0}.toml beside this file or in reference/materials", word));

  Parameters file = Parameters::read(path);
  parameters.depends_on(path);
  const std::string list = fmt::format("{}_set", key);
  if (parameters.has(list))
    for (const std::string& change : parameters.texts(list)) {
      const std::size_t sign = change.find('=');
      if (sign == std::string::npos || sign == 0)
        parameters.fail(list, fmt::format("found \"{}\", expected \"KEY=VALUE\"", change));
      file.assign(change.substr(0, sign), change.substr(sign + 1), fmt::format("{} of {}", list, parameters.file()));
    }
  for (const MaterialChange& change : changes) file.assign(change.path, change.value, parameters.file());
  return read_material(file, spacing);
}

void exercise(Run& run, const AnyMaterial& material) {
  for_each_part(material, [&run](Module part) { run.exercises(module_names[static_cast<std::size_t>(part)]); });
}

}  // namespace furrow
