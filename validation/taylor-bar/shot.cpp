#include "validation/taylor-bar/shot.hpp"

#include <fmt/format.h>

#include <cmath>

#include "harness/provenance.hpp"
#include "harness/scheme_input.hpp"

namespace furrow::taylor_bar_cases {
namespace {

template <class Law>
struct HasStrength : std::false_type {};
template <class Eos>
struct HasStrength<JohnsonCook<Eos>> : std::true_type {};

/// Calls f with the Johnson-Cook law, where it is one.
template <class Material, class F>
void with_johnson_cook(Material& material, F&& f) {
  std::visit(
      [&](auto& law) {
        if constexpr (HasStrength<std::remove_cvref_t<decltype(law)>>::value) f(law);
      },
      material);
}

}  // namespace

ReferenceData read_set(const Parameters& input, const std::string& name) {
  const std::filesystem::path beside = std::filesystem::path(input.file()).parent_path();
  const std::filesystem::path home =
      std::filesystem::exists(beside / name / "data.csv") ? beside : project_root() / "reference/data";
  for (const char* file : {"data.csv", "source.toml"}) input.depends_on(home / name / file);
  return read_reference_data(name, home);
}

Impact read_impact(const Parameters& input) {
  Impact impact;
  impact.material = read_material(input, "material").law;
  if (!input.flag_or("fracture", false)) with_johnson_cook(impact.material, [](auto& law) { law.damage.reset(); });
  impact.scheme = read_scheme(input);
  impact.arrangement = arrangement_by_name(input.choice_or("arrangement", "rings", {"rings", "square"}));
  return impact;
}

Shot read_shot(const Parameters& input, const ReferenceData& set, double speed) {
  const std::vector<double>& speeds = set.column("impact_speed");
  std::size_t row = speeds.size();
  std::string known;
  for (std::size_t k = 0; k < speeds.size(); ++k) {
    if (std::abs(speeds[k] - speed) < 1e-9 * speed) row = k;
    known += fmt::format("{}{:g}", k ? ", " : "", speeds[k]);
  }
  if (row == speeds.size())
    input.fail("shot", fmt::format("found {:g} m/s, expected a shot of set {}: {}", speed, set.set, known));
  const auto at = [&](std::string_view column) { return set.column(column)[row]; };

  Shot shot;
  shot.impact = read_impact(input);
  shot.impact.rod = {at("length"), at("diameter")};
  shot.impact.speed = speed;
  shot.impact.temperature = at("temperature");
  shot.measured = {at("final_length"), at("foot_diameter"), at("undeformed_length"), at("diameter_at_fifth")};
  return shot;
}

std::vector<std::string> warnings(const Parameters& input, std::string_view key, const Impact& impact) {
  std::vector<std::string> found;
  with_johnson_cook(impact.material, [&](const auto& law) {
    const JohnsonCookStrength& s = law.strength;
    const double T = impact.temperature.value_or(s.reference_temperature);
    if (T >= s.melting_temperature)
      input.fail(key, fmt::format("found a rod of {:g} K, expected less than the {:g} K at which its material melts", T,
                                  s.melting_temperature));
    if (T < s.reference_temperature - 5.0)
      found.push_back(fmt::format("Warning: the rod is at {:g} K before the impact, colder than the {:g} K at which the law begins; "
                                  "the law takes it to be no harder than there.",
                                  T, s.reference_temperature));
    const double pressure = law.eos.reference_density * impact.speed * impact.speed;
    if (pressure > 6.0 * (s.A + s.B))
      found.push_back(fmt::format("Warning: rho v^2 = {:.3g} GPa is {:.1f} times A + B: the foot is eroded, and its strains are "
                                  "far beyond those at which the law was measured.",
                                  pressure / 1e9, pressure / (s.A + s.B)));
  });
  return found;
}

std::vector<std::string> warnings_after(const Impact& impact, const Outcome& outcome) {
  std::vector<std::string> found;
  with_johnson_cook(impact.material, [&](const auto& law) {
    if (outcome.highest_temperature >= law.strength.melting_temperature)
      found.push_back(fmt::format("Warning: the hottest particle reaches the melting temperature of {:g} K and keeps no "
                                  "strength.",
                                  law.strength.melting_temperature));
  });
  if (outcome.strained_share > 0.05)
    found.push_back(fmt::format("Warning: {:.0f} % of the rod is strained by more than 1, beyond the strains at which laws of this "
                                "kind are measured.",
                                100.0 * outcome.strained_share));
  return found;
}

}  // namespace furrow::taylor_bar_cases
