// Elastic-plastic piston: uniaxial strain, an elastic precursor and a plastic shock behind it.
#include <cmath>

#include "harness/material_file.hpp"
#include "reference/exact/elastic_plastic.hpp"
#include "verification/elastic-plastic/problems.hpp"
#include "verification/elastodynamics/problems.hpp"

namespace furrow::elastic_plastic_cases {
namespace {

exact::PistonMetal metal_of(const Parameters& input, const AnyMaterial& material) {
  const auto* law = std::get_if<J2Plastic<MieGrueneisen>>(&material);
  if (law == nullptr || law->hardening_modulus != 0.0)
    input.fail("material", "expected a perfectly plastic metal with a Mie-Grueneisen equation of state");
  const MieGrueneisen& eos = law->eos;
  return {eos.reference_density, eos.sound_speed, eos.slope, eos.gamma, law->shear_modulus, law->yield_stress};
}

/// One column of the strip: its place in the laboratory and its state, means over the rows.
struct Column {
  double x, velocity, density, pressure, stress;
};

std::vector<Column> columns_of(const Body<2>& body, std::size_t count, double dx, double u_p, double time) {
  std::vector<Column> columns(count, Column{});
  std::vector<double> rows(count, 0.0);
  const Particles<2>& p = body.particles;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto k = static_cast<std::size_t>(p.reference_position[i][0] / dx);
    Column& c = columns[k];
    c.x += p.position[i][0] + u_p * time;
    c.velocity += p.velocity[i][0] + u_p;
    c.density += p.density[i];
    c.pressure -= p.stress[i].trace() / 3.0;
    c.stress -= p.stress[i](0, 0);
    rows[k] += 1.0;
  }
  for (std::size_t k = 0; k < count; ++k)
    for (double* value : {&columns[k].x, &columns[k].velocity, &columns[k].density, &columns[k].pressure, &columns[k].stress})
      *value /= rows[k];
  return columns;
}

/// Where the velocity, seen from far ahead of the wave, first reaches `level`.
double front(const std::vector<Column>& columns, double level) {
  for (std::size_t k = columns.size() - 1; k-- > 0;)
    if (columns[k].velocity >= level) {
      const Column &a = columns[k], &b = columns[k + 1];
      return a.x + (b.x - a.x) * (a.velocity - level) / (a.velocity - b.velocity);
    }
  return 0.0;
}

}  // namespace

Problem piston(const Parameters& input) {
  const NamedMaterial material = read_material(input, "material");
  const exact::PistonMetal metal = metal_of(input, material.law);
  const double u_p = input.quantity("piston_velocity", dimension::velocity, range::positive);
  const double L = input.quantity("length", dimension::length, range::positive);
  const double end = input.quantity("end_time", dimension::time, range::positive);
  const Scheme scheme = read_scheme(input);
  const exact::Piston truth = exact::piston(metal, u_p);
  if (truth.elastic.front_speed * end > 0.95 * L) input.fail("end_time", "lets the precursor reach the end of the strip");

  return [=](Run& run) {
    const double dx = run.resolution().spacing;
    constexpr int rows = 4;
    const int count = elastodynamic_cases::cells(L, dx, "length");

    // Seen from the piston: the metal flies at a symmetry plane, which is a rigid piston that moves with u_p into metal at rest.
    Simulation<2> simulation;
    Body<2>& body = simulation.body;
    body.material = material.law;
    body.scheme = scheme;
    body.scheme.smoothing_ratio = run.resolution().smoothing_ratio;
    body.spacing = dx;
    body.add(elastodynamic_cases::block(count, rows, dx, {0.0, 0.0}), {-u_p, 0.0});
    body.images = Images<2>({SymmetryPlane<2>{{0.0, 0.0}, {1.0, 0.0}}, SymmetryPlane<2>{{0.0, 0.0}, {0.0, 1.0}},
                             SymmetryPlane<2>{{0.0, rows * dx}, {0.0, -1.0}}});
    simulation.watch.low = {-L, -L};
    simulation.watch.high = {2.0 * L, L};

    // Speeds between half of the time and its end, so that how a front starts does not matter.
    std::vector<Column> half;
    DynamicRun<2> dynamic(run, simulation);
    const double elastic_level = 0.5 * truth.elastic.velocity, plastic_level = 0.5 * (truth.elastic.velocity + u_p);
    const auto columns = [=](const Simulation<2>& s) {
      return columns_of(s.body, static_cast<std::size_t>(count), dx, u_p, s.time());
    };
    dynamic.probe({"elastic_front", "x_el", "m", "where the velocity reaches half of the precursor's"},
                  [=](const Simulation<2>& s) { return front(columns(s), elastic_level); });
    dynamic.probe({"plastic_front", "x_pl", "m", "where the velocity is midway between the two plateaus"},
                  [=](const Simulation<2>& s) { return front(columns(s), plastic_level); });
    dynamic.until(end, 200, 4);
    elastodynamic_cases::measure_energy(run, dynamic);
    exercise(run, scheme);
    run.exercises("particles/images");
    run.exercises("materials/j2_plastic");
    run.exercises("materials/mie_grueneisen");

    const auto& t = dynamic.column("time");
    const auto speed = [&](std::string_view name) {
      const auto& x = dynamic.column(name);
      std::size_t n = 0;
      while (t[n] < 0.5 * end) ++n;
      return (x.back() - x[n]) / (t.back() - t[n]);
    };
    run.measure("elastic_front_speed", speed("elastic_front"), "m/s", {truth.elastic.front_speed, 0.0});
    run.measure("plastic_front_speed", speed("plastic_front"), "m/s", {truth.plastic.front_speed, 0.0});

    // Plateaus: means over the middle half between the exact fronts. Errors: over the whole strip, against the exact profile.
    const std::vector<Column> profile = columns(simulation);
    const double x_el = truth.elastic.front_speed * end, x_pl = truth.plastic.front_speed * end, x_piston = u_p * end;
    const auto plateau = [&](std::string_view name, const exact::PistonState& exact, double from, double to) {
      Column mean{};
      double n = 0.0;
      for (const Column& c : profile) {
        if (c.x < from + 0.25 * (to - from) || c.x > to - 0.25 * (to - from)) continue;
        mean.velocity += c.velocity, mean.density += c.density, mean.pressure += c.pressure, mean.stress += c.stress, n += 1.0;
      }
      const std::string prefix(name);
      run.measure(prefix + "_velocity", mean.velocity / n, "m/s", {exact.velocity, 0.0});
      run.measure(prefix + "_density", mean.density / n, "kg/m^3", {exact.density, 0.0});
      run.measure(prefix + "_pressure", mean.pressure / n, "Pa", {exact.pressure, 0.0});
      run.measure(prefix + "_stress", mean.stress / n, "Pa", {exact.stress, 0.0});
    };
    plateau("elastic", truth.elastic, x_pl, x_el);
    plateau("plastic", truth.plastic, x_piston, x_pl);

    const auto exact_at = [&](double x, double ahead, double elastic, double plastic) {
      return x < x_pl ? plastic : x < x_el ? elastic : ahead;
    };
    double velocity_error = 0.0, stress_error = 0.0;
    Series computed, exact;
    for (const Column& c : profile) {
      const double u = exact_at(c.x, 0.0, truth.elastic.velocity, u_p);
      const double sigma = exact_at(c.x, 0.0, truth.elastic.stress, truth.plastic.stress);
      velocity_error += std::abs(c.velocity - u) * dx;
      stress_error += std::abs(c.stress - sigma) * dx;
      computed.x.push_back(1e3 * c.x), computed.y.push_back(1e-6 * c.stress);
      exact.x.push_back(1e3 * c.x), exact.y.push_back(1e-6 * sigma);
    }
    run.measure("velocity_l1", velocity_error / (u_p * x_el));
    run.measure("stress_l1", stress_error / (truth.plastic.stress * x_el));
    Figure figure;
    figure.name = "stress_profile";
    figure.title = "Stress along the strip at the end";
    figure.x = {"x", "mm"};
    figure.y = {"stress", "MPa"};
    computed.label = "computed";
    exact.label = "exact";
    exact.role = "reference";
    figure.add(std::move(exact));
    figure.add(std::move(computed));
    run.figure(std::move(figure));
  };
}

}  // namespace furrow::elastic_plastic_cases
