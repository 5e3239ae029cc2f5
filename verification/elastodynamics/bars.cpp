// Bars in uniaxial strain: a wave that runs along one, and one that hits a wall and leaves it.
#include <numbers>

#include "verification/elastodynamics/problems.hpp"

namespace furrow::elastodynamic_cases {
namespace {

/// A bar from x = 0 to L that nothing lets move sideways, so that waves run with c_L = sqrt((K + 4G/3)/rho): a few rows between
/// symmetry planes. `ends` closes it with such planes there as well.
Simulation<2> confined_bar(const Run& run, const LinearElastic& material, const Scheme& scheme, double L, double velocity,
                           bool ends) {
  const double dx = run.resolution().spacing;
  Simulation<2> simulation;
  simulation.body = elastic_body(run, material, scheme);
  const int rows = static_cast<int>(std::ceil(1.2 * support(scheme.kernel) * simulation.body.scheme.smoothing_ratio));
  simulation.body.add(block(cells(L, dx, "length"), rows, dx, {0.0, 0.0}), {velocity, 0.0});
  std::vector<SymmetryPlane<2>> planes{{{0.0, 0.0}, {0.0, 1.0}}, {{0.0, rows * dx}, {0.0, -1.0}}};
  if (ends) planes.insert(planes.end(), {{{0.0, 0.0}, {1.0, 0.0}}, {{L, 0.0}, {-1.0, 0.0}}});
  simulation.body.images = Images<2>(planes);
  simulation.watch.low = {-L, -L};
  simulation.watch.high = {3.0 * L, 2.0 * L};
  return simulation;
}

/// Width of a bar: that of its rows of particles.
double width_of(const Body<2>& body) { return body.images.planes()[1].point[1]; }

double longitudinal_speed(const LinearElastic& m) {
  return std::sqrt((m.bulk_modulus + 4.0 / 3.0 * m.shear_modulus) / m.reference_density);
}

}  // namespace

Problem longitudinal_wave(const Parameters& input) {
  const LinearElastic material = read_elastic(input);
  const double L = input.quantity("length", dimension::length, range::positive);
  const double v_0 = input.quantity("velocity_amplitude", dimension::velocity, range::positive);
  const Scheme scheme = read_scheme(input);

  return [=](Run& run) {
    const double c = longitudinal_speed(material), k = std::numbers::pi / L;

    // A standing wave between two symmetry planes, v_x = v_0 sin(kx) with one half wave: it returns after 2L/c.
    Simulation<2> simulation = confined_bar(run, material, scheme, L, 0.0, true);
    Body<2>& body = simulation.body;
    for (std::size_t i = 0; i < body.particles.size(); ++i)
      body.particles.velocity[i] = {v_0 * std::sin(k * body.particles.position[i][0]), 0.0};

    // Amplitude of the mode: projection of the velocity on sin(kx) at where particles were at the start.
    std::vector<double> mode(body.particles.size());
    for (std::size_t i = 0; i < mode.size(); ++i) mode[i] = std::sin(k * body.particles.position[i][0]);
    DynamicRun<2> dynamic(run, simulation);
    dynamic.probe({"mode_velocity", "v", "m/s", "amplitude of sin(kx) in the velocity"}, [mode](const Simulation<2>& s) {
      double projection = 0.0, norm = 0.0;
      for (std::size_t i = 0; i < mode.size(); ++i) {
        const double m = mode[static_cast<std::size_t>(s.body.particles.id[i])];
        projection += m * s.body.particles.velocity[i][0];
        norm += m * m;
      }
      return projection / norm;
    });
    const double end = 2.25 * 2.0 * L / c;
    dynamic.until(end, 900, 4);
    exercise(run, scheme);
    run.exercises("particles/images");

    // Speed from the zeros of cos(omega t), a quarter period apart from its extremes.
    const auto& t = dynamic.column("time");
    const auto& v = dynamic.column("mode_velocity");
    std::vector<double> zeros;
    for (std::size_t n = 1; n < t.size(); ++n)
      if (v[n - 1] * v[n] < 0.0) zeros.push_back(t[n - 1] + (t[n] - t[n - 1]) * v[n - 1] / (v[n - 1] - v[n]));
    const double period = 2.0 * (zeros.back() - zeros.front()) / static_cast<double>(zeros.size() - 1);
    run.measure("wave_speed", 2.0 * L / period, "m/s", {c, 0.0});
    double last_peak = 0.0;
    for (std::size_t n = 0; n < t.size(); ++n)
      if (t[n] > end - 0.75 * period) last_peak = std::max(last_peak, std::abs(v[n]));
    run.measure("amplitude_kept", last_peak / v_0);
    measure_energy(run, dynamic);
    history_figure(run, dynamic, "mode", "Amplitude of the standing wave", {"mode_velocity"}, {"v", "m/s"});
  };
}

Problem bar_on_wall(const Parameters& input) {
  const LinearElastic material = read_elastic(input);
  const double L = input.quantity("length", dimension::length, range::positive);
  const double v_0 = input.quantity("impact_velocity", dimension::velocity, range::positive);
  const Scheme scheme = read_scheme(input);

  return [=](Run& run) {
    const double c = longitudinal_speed(material), rho = material.reference_density;

    // The bar flies to the left and touches the wall at x = 0 from the start.
    Simulation<2> simulation = confined_bar(run, material, scheme, L, -v_0, false);
    simulation.body.walls.push_back({{0.0, 0.0}, {1.0, 0.0}, 4.0 * rho * c * c});

    DynamicRun<2> dynamic(run, simulation);
    dynamic.probe({"wall_stress", "sigma", "Pa", "force on the wall over the width of the bar"},
                  [width = width_of(simulation.body)](const Simulation<2>& s) { return s.body.wall_forces()[0] / width; });
    dynamic.probe({"mean_velocity", "v", "m/s", "velocity of the bar's centre of mass"}, [](const Simulation<2>& s) {
      double mass = 0.0;
      for (std::size_t i = 0; i < s.body.particles.size(); ++i) mass += s.body.particles.mass[i];
      return s.momentum()[0] / mass;
    });
    const double contact = 2.0 * L / c;
    dynamic.until(1.5 * contact, 1500, 6);
    exercise(run, scheme);
    run.exercises("boundaries/wall");

    // Stress: mean over the middle half of the contact. Contact: the impulse over that stress. Rebound: mean velocity at the end.
    const auto& t = dynamic.column("time");
    const auto& sigma = dynamic.column("wall_stress");
    double stress = 0.0, samples = 0.0, impulse = 0.0, last_touch = 0.0;
    for (std::size_t n = 1; n < t.size(); ++n) {
      if (t[n] > 0.25 * contact && t[n] < 0.75 * contact) stress += sigma[n], samples += 1.0;
      impulse += 0.5 * (sigma[n] + sigma[n - 1]) * (t[n] - t[n - 1]);
      if (sigma[n] > 0.5 * rho * c * v_0) last_touch = t[n];
    }
    stress /= samples;
    run.measure("impact_stress", stress, "Pa", {rho * c * v_0, 0.0});
    run.measure("contact_time", last_touch, "s", {contact, 0.0});
    run.measure("impulse", impulse, "Pa s", {2.0 * rho * L * v_0, 0.0});
    run.measure("rebound_velocity", dynamic.column("mean_velocity").back(), "m/s", {v_0, 0.0});
    measure_energy(run, dynamic);
    history_figure(run, dynamic, "stress", "Stress on the wall", {"wall_stress"}, {"sigma", "Pa"});
  };
}

}  // namespace furrow::elastodynamic_cases
