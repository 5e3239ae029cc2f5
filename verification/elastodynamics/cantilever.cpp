// Cantilever under a small load at its tip, brought to rest by damping: how soft is a strip of few particles?
#include <fmt/format.h>

#include "verification/elastodynamics/problems.hpp"

namespace furrow::elastodynamic_cases {
namespace {

/// A strip of elastic material, clamped at x = 0, with the load P at its end.
struct Strip {
  LinearElastic material;
  double L, t, P;

  static Strip read(const Parameters& input) {
    return {read_elastic(input), input.quantity("length", dimension::length, range::positive),
            input.quantity("thickness", dimension::length, range::positive),
            input.quantity("tip_load", dimension::force_per_width, range::positive)};
  }

  double stiffness() const {   ///< E' I, plane strain
    const double K = material.bulk_modulus, G = material.shear_modulus;
    const double E = 9.0 * K * G / (3.0 * K + G), nu = E / (2.0 * G) - 1.0;
    return E / (1.0 - nu * nu) * t * t * t / 12.0;
  }
  /// Deflection of beam theory with shear under the load at x.
  double deflection(double x) const { return P * x * x * x / (3.0 * stiffness()) + 1.2 * P * x / (material.shear_modulus * t); }
  double first_frequency() const {
    return std::pow(1.875104068711961 / L, 2) * std::sqrt(stiffness() / (material.reference_density * t));
  }
};

struct Deflection {
  double computed, exact, residual_motion, energy_imbalance;
};

/// The deflection of the strip's last column at the run's resolution; energies and deflection over time as figures of the run.
/// The load acts at the centres of the last column, half a spacing before the end.
Deflection deflection_at_rest(Run& run, const Strip& strip, const Scheme& scheme) {
  const double dx = run.resolution().spacing, L = strip.L;
  const int across = cells(strip.t, dx, "thickness"), along = cells(L, dx, "length");

  // Geometry and clamp: the face at x = 0 is held.
  Simulation<2> simulation;
  simulation.body = elastic_body(run, strip.material, scheme);
  Body<2>& body = simulation.body;
  body.add(block(along, across, dx, {0.0, -0.5 * strip.t}));
  std::vector<std::vector<std::int32_t>> rows(static_cast<std::size_t>(across));
  const int deep = std::min(along / 2, 2 * static_cast<int>(std::ceil(support(scheme.kernel) * body.scheme.smoothing_ratio)));
  for (int i = 0; i < deep; ++i)
    for (int j = 0; j < across; ++j) rows[static_cast<std::size_t>(j)].push_back(i * across + j);
  body.hold_face("clamp", rows);

  // Load: shared by the last column, whose centre lies half a spacing before the end.
  AppliedForce<2> load{"tip load", {}, [P = strip.P](double) { return Vector<2>(0.0, -P); }};
  for (int j = 0; j < across; ++j) load.ids.push_back((along - 1) * across + j);
  body.loads.forces.push_back(load);

  // Damping: 0.7 of the critical one for the first bending mode, with which a strip twice too soft is just critical. The mode
  // falls to exp(-0.7 omega t) = 2e-4 within the run.
  const double omega = strip.first_frequency();
  body.loads.damping = 1.4 * omega;
  simulation.control.courant = 0.4;
  simulation.watch.low = {-L, -L};
  simulation.watch.high = {2.0 * L, L};

  const std::int32_t tip = (along - 1) * across + across / 2;
  const double y_0 = body.particles.position[static_cast<std::size_t>(tip)][1];
  DynamicRun<2> dynamic(run, simulation);
  dynamic.probe({"tip_deflection", "u_y", "m", "deflection of the last column"},
                [tip, y_0](const Simulation<2>& s) { return s.body.particles.position[s.body.index_of(tip)][1] - y_0; });
  dynamic.until(12.0 / omega, 200, 2);
  exercise(run, scheme);
  run.exercises("boundaries/held_face");
  run.exercises("boundaries/applied_force");

  const std::vector<double>& u = dynamic.column("tip_deflection");
  energy_figure(run, dynamic);
  history_figure(run, dynamic, "deflection", "Deflection of the last column", {"tip_deflection"}, {"u_y", "m"});
  return {-u.back(), strip.deflection(L - 0.5 * dx), std::abs(u.back() - u[u.size() - 11]) / std::abs(u.back()),
          dynamic.energy_imbalance()};
}

}  // namespace

Problem cantilever(const Parameters& input) {
  const Strip strip = Strip::read(input);
  const Scheme scheme = read_scheme(input);

  return [=](Run& run) {
    const Deflection w = deflection_at_rest(run, strip, scheme);
    run.measure("tip_deflection", w.computed, "m", {w.exact, 0.0});
    run.measure("residual_motion", w.residual_motion);
    run.measure("energy_imbalance", w.energy_imbalance);
  };
}

Problem cantilever_ladder(const Parameters& input) {
  const Strip strip = Strip::read(input);
  const double ratio = input.number("h_over_dx", {0.8, 4.0});
  std::vector<int> across;
  for (const double n : input.numbers("across", {2.0, 64.0})) {
    if (n != std::round(n)) input.fail("across", "found a broken number of particles, expected whole ones");
    across.push_back(static_cast<int>(n));
  }
  const auto gated = static_cast<int>(input.integer("gated_across", 2, 64));
  if (std::find(across.begin(), across.end(), gated) == across.end())
    input.fail("gated_across", fmt::format("found {}, expected one of the numbers across", gated));
  const double enough = input.number("enough", range::positive);
  struct Named {
    std::string name, words;
    Scheme scheme;
  };
  std::vector<Named> schemes;
  for (const Parameters& table : input.tables("schemes"))
    schemes.push_back({table.text("name"), table.text("words"), read_scheme(table)});
  if (schemes.empty()) input.fail("schemes", "found none, expected at least one [[parameters.schemes]]");

  return [=](Run& run) {
    Table& table = run.table("ladder", "Error of the tip's deflection, in percent of beam theory with shear",
                             {{"particles across", "1"}, {"spacing", "mm"}});
    Figure figure;
    figure.name = "ladder";
    figure.title = "Error of the tip's deflection";
    figure.caption = "How many particles across a bending tool needs: positive is too soft.";
    figure.x = {"particles across", "1"};
    figure.y = {"(w - w_exact)/w_exact", "%"};
    double residual_motion = 0.0, imbalance = 0.0;
    for (const int n : across) table.row({static_cast<double>(n), 1e3 * strip.t / n});
    for (const Named& named : schemes) {
      table.columns.push_back({named.words, "%"});
      Series series{.label = named.words};
      std::size_t row = 0;
      std::optional<int> first_enough;
      for (const int n : across) {
        // Each strip is a run of its own, with files and checkpoint in a folder of its own.
        Run part({strip.t / n, ratio}, run.folder() / fmt::format("{}-{}", named.name, n), run.threads(),
                 [&run](const Run::Progress& p) { run.progress(p.simulated_time, p.end_time, p.steps); }, run.particle_order());
        const Deflection w = deflection_at_rest(part, strip, named.scheme);
        run.count(part.steps(), part.particles());
        for (const std::string& module : part.modules()) run.exercises(module);
        residual_motion = std::max(residual_motion, w.residual_motion);
        imbalance = std::max(imbalance, w.energy_imbalance);
        const double error = w.computed / w.exact - 1.0;
        if (n == gated) run.measure("error_" + named.name, error);
        table.rows[row++].push_back(100.0 * error);
        series.x.push_back(n);
        series.y.push_back(100.0 * error);
        if (std::abs(error) > enough) first_enough.reset();
        else if (!first_enough) first_enough = n;
      }
      figure.add(std::move(series));
      run.note(first_enough
                   ? fmt::format("{}: from {} particles across on, a bending tool deflects within {:g} % of beam theory.",
                                 named.words, *first_enough, 100.0 * enough)
                   : fmt::format("{}: no number of particles up to {} across is enough for {:g} %.", named.words, across.back(),
                                 100.0 * enough));
    }
    const double first = across.front(), last = across.back();
    for (const double sign : {1.0, -1.0})
      figure.add({.label = fmt::format("{:g} %", sign * 100.0 * enough), .role = "bound", .x = {first, last},
                  .y = {sign * 100.0 * enough, sign * 100.0 * enough}});
    run.figure(std::move(figure));
    run.measure("residual_motion", residual_motion);
    run.measure("energy_imbalance", imbalance);
  };
}

}  // namespace furrow::elastodynamic_cases
