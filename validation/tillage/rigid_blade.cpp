// A rigid blade in the paper's soil, against a second discretisation of the same equations and against the plane wedge of the
// earthmoving equation.
#include <fmt/format.h>

#include <cmath>

#include "validation/tillage/problems.hpp"
#include "validation/tillage/rigid_cut.hpp"

namespace furrow::tillage_cases {
namespace {

ContactLaw contact_alone(const Parameters& input, const Bed& bed, const Blade& blade) {
  const Interface interface = read_interface(input, bed, blade);
  if (interface.summation) input.fail("interface", "found sums over both bodies, expected contact: a rigid blade has none");
  return interface.contact;
}

constexpr double uncertainty = 0.05;   ///< of independent means, relative

void force_figure(Run& run, const Blade& blade, const CutResult& result, const std::optional<IndependentCut>& other,
                  const exact::CutForce& wedge, const exact::CutForce& at_rest) {
  Figure& figure =
      run.figure({.name = "force", .title = "Draft over travel", .x = {"travel", "m"}, .y = {"force per width", "N/m"}});
  figure.add({.label = "computed, draft", .x = result.history.travel, .y = result.history.draft});
  figure.add({.label = "computed, vertical", .x = result.history.travel, .y = result.history.vertical});
  if (other) {
    figure.add({.label = fmt::format("material points, {:g} mm, draft", 1e3 * other->cell),
                .role = "reference",
                .x = other->history.travel,
                .y = other->history.draft});
    figure.add({.label = fmt::format("material points, {:g} mm, vertical", 1e3 * other->cell),
                .role = "reference",
                .x = other->history.travel,
                .y = other->history.vertical});
  }
  figure.add({.label = "plane wedge, plane at rest", .role = "bound", .x = {0.0, blade.travel}, .y = {at_rest.draft, at_rest.draft}});
  figure.add({.label = "plane wedge, least force", .role = "bound", .x = {0.0, blade.travel}, .y = {wedge.draft, wedge.draft}});
}

}  // namespace

Problem rigid_blade(const Parameters& input) {
  const Bed bed = read_bed(input);
  const Blade blade = read_blade(input, bed);
  const ContactLaw contact = contact_alone(input, bed, blade);
  const double window_start = input.quantity("window_start", dimension::length, {0.0, blade.travel, false, true});
  // The independent blade is the standard one; whether this is that is for the case to say.
  const bool compare = input.flag("independent");
  if (compare && !independent_cut(blade.speed, blade.friction > 0.0, window_start, blade.travel))
    input.fail("independent", fmt::format("there is no independent cut at {:g} m/s with this friction", blade.speed));
  return [=](Run& run) {
    const CutResult result = cut(run, bed, blade, contact, window_start, true);
    const exact::CutForce wedge = wedge_of(bed, blade), at_rest = wedge_of(bed, blade, exact::Rupture::at_rest);
    const auto other = compare ? independent_cut(blade.speed, blade.friction > 0.0, window_start, blade.travel) : std::nullopt;
    if (other) {
      run.measure("draft", result.draft, "N/m", {other->draft, uncertainty * other->draft});
      run.measure("vertical", result.vertical, "N/m", {other->vertical, uncertainty * std::abs(other->vertical)});
    }
    run.measure("draft_wedge", result.draft, "N/m", {wedge.draft, 0.0});
    run.measure("draft_wedge_at_rest", result.draft, "N/m", {at_rest.draft, 0.0});
    run.measure("chip_direction", result.chip_direction, "rad", {wedge.rupture, 0.0});
    run.measure("scatter", result.scatter);
    run.measure("peak", result.peak, "N/m");
    run.measure("peak_travel", result.peak_travel, "m");
    run.measure("penetration", result.penetration);
    run.measure("energy_imbalance", result.energy_imbalance);
    force_figure(run, blade, result, other, wedge, at_rest);
  };
}

Problem speed_law(const Parameters& input) {
  const Bed bed = read_bed(input);
  Blade blade = read_blade(input, bed);
  const ContactLaw contact = contact_alone(input, bed, blade);
  const double window_start = input.quantity("window_start", dimension::length, {0.0, blade.travel, false, true});
  const std::vector<double> speeds = input.quantities("speeds", dimension::velocity, range::positive);
  if (speeds.size() < 3) input.fail("speeds", "found fewer than three speeds, expected three or more: two constants and a check");
  return [=](Run& run) {
    // Least squares of F = F_0 + F_2 v^2.
    struct Law {
      double F_0, F_2;
    };
    const auto fit = [](const std::vector<double>& v, const std::vector<double>& F) {
      double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
      for (std::size_t k = 0; k < v.size(); ++k) {
        const double q = v[k] * v[k];
        n += 1.0, x += q, y += F[k], xx += q * q, xy += q * F[k];
      }
      const double F_2 = (n * xy - x * y) / (n * xx - x * x);
      return Law{(y - F_2 * x) / n, F_2};
    };
    std::vector<double> drafts, wedges, other_speeds, others;
    Table& table = run.table("speeds", "Mean draft",
                             {{"speed", "m/s"}, {"computed", "N/m"}, {"material points", "N/m"}, {"plane wedge", "N/m"}});
    for (std::size_t k = 0; k < speeds.size(); ++k) {
      Blade one = blade;
      one.speed = speeds[k];
      Run inner(run.resolution(), run.folder() / fmt::format("speed-{:g}", speeds[k]), run.threads());
      drafts.push_back(cut(inner, bed, one, contact, window_start, false).draft);
      run.count(inner.steps(), inner.particles());
      for (const std::string& module : inner.modules()) run.exercises(module);
      run.progress(static_cast<double>(k + 1), static_cast<double>(speeds.size()), inner.steps());
      wedges.push_back(wedge_of(bed, one).draft);
      const auto other = independent_cut(speeds[k], blade.friction > 0.0, window_start, blade.travel);
      if (other) other_speeds.push_back(speeds[k]), others.push_back(other->draft);
      table.row({speeds[k], drafts.back(), other ? Cell(other->draft) : Cell(std::string("none")), wedges.back()});
    }
    const Law computed = fit(speeds, drafts), wedge = fit(speeds, wedges);
    if (other_speeds.size() < 2) throw std::runtime_error("there are not two independent cuts at these speeds");
    const Law other = fit(other_speeds, others);
    // Means are good to 5 % each: an uncertainty of F_2 from those of the slowest and the fastest.
    const double reach = other_speeds.back() * other_speeds.back() - other_speeds.front() * other_speeds.front();
    run.measure("f_0", computed.F_0, "N/m", {other.F_0, uncertainty * other.F_0});
    run.measure("f_2", computed.F_2, "kg/m^2", {other.F_2, uncertainty * std::hypot(others.front(), others.back()) / reach});
    run.measure("f_2_wedge", computed.F_2, "kg/m^2", {wedge.F_2, 0.0});
    Figure& figure = run.figure({.name = "speed",
                                 .title = "Mean draft over speed",
                                 .kind = "points",
                                 .x = {"speed", "m/s"},
                                 .y = {"draft per width", "N/m"}});
    figure.add({.label = "computed", .x = speeds, .y = drafts});
    figure.add({.label = "material points", .role = "reference", .x = other_speeds, .y = others});
    figure.add({.label = "plane wedge", .role = "bound", .x = speeds, .y = wedges});
  };
}

}  // namespace furrow::tillage_cases
