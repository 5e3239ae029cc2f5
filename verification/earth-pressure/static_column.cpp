// A column of soil between smooth walls settles under its weight; once the damping that brought it to rest is off, it stays.
#include <cmath>

#include "verification/earth-pressure/problems.hpp"

namespace furrow::earth_pressure_cases {

Problem static_column(const Parameters& input) {
  const Soil soil = read_soil(input);
  const double H = input.quantity("height", dimension::length, range::positive);
  const double W = input.quantity("width", dimension::length, range::positive);
  const double g = input.quantity_or("gravity", dimension::acceleration, 9.81, range::positive);
  const double settled = input.quantity("settling_time", dimension::time, range::positive);
  const double watched = input.quantity("watched_time", dimension::time, range::positive);
  const double courant = input.number_or("courant", 0.4, range::positive);
  const Slip floor = input.choice("floor", {"rough", "smooth"}) == "rough" ? Slip::none : Slip::free;
  const Scheme scheme = read_scheme(input);
  return [=](Run& run) {
    const double dx = run.resolution().spacing;
    const double K = soil.law.bulk_modulus, G = soil.law.shear_modulus, M = K + 4.0 / 3.0 * G;
    const double rho = soil.law.reference_density, c = std::sqrt(M / rho);

    // Geometry and boundaries: planes of symmetry at the sides, a floor of particles. Start: free of stress, damped as the first
    // mode of the column needs it.
    Simulation<2> simulation;
    simulation.body = soil_body(run, soil.law, scheme, g);
    Body<2>& body = simulation.body;
    body.add(rectangle({0.0, 0.0}, W, H, dx));
    const std::size_t count = body.particles.size();
    add_flat_layer(body, "floor", {0.0, 0.0}, {W, 0.0}, floor);
    check_clear(body);
    body.images = Images<2>({SymmetryPlane<2>{{0.0, 0.0}, {1.0, 0.0}}, SymmetryPlane<2>{{W, 0.0}, {-1.0, 0.0}}});
    body.loads.damping = std::acos(-1.0) * c / H;
    body.loads.damping_end = settled;
    simulation.control.courant = courant;
    simulation.watch.low = {-dx, -dx};
    simulation.watch.high = {W + dx, 2.0 * H};

    DynamicRun<2> dynamic(run, simulation);
    dynamic.probe({"settlement", "u", "m", "mean settlement of the soil"}, [count](const Simulation<2>& s) {
      double sum = 0.0;
      for (std::size_t i = 0; i < s.body.particles.size(); ++i)
        if (!s.body.is_in_layer(i)) sum += s.body.particles.reference_position[i][1] - s.body.particles.position[i][1];
      return sum / static_cast<double>(count);
    });
    dynamic.probe({"floor_force", "F", "N", "force on the floor per width"},
                  [](const Simulation<2>& s) { return -s.body.layer_forces()[0][1]; });
    dynamic.until(settled + watched, 400, 4);
    exercise_soil(run, scheme);
    run.exercises("boundaries/boundary_layer");

    // Probes: stress against weight above, which settlement does not change. K0 = nu/(1 - nu) of elastic soil.
    const double k0 = (3.0 * K - 2.0 * G) / (3.0 * K + 4.0 * G);
    double off = 0.0, off_lateral = 0.0, size = 0.0;
    Series computed{.label = "vertical"}, lateral{.label = "lateral"}, truth{.label = "rho g z", .role = "reference"},
        truth_lateral{.label = "K0 rho g z", .role = "reference"};
    for (std::size_t i = 0; i < body.particles.size(); ++i) {
      if (body.is_in_layer(i)) continue;
      const double z = H - body.particles.reference_position[i][1], p = rho * g * z;
      const Tensor& s = body.particles.stress[i];
      off += std::pow(s(1, 1) + p, 2);
      off_lateral += std::pow(s(0, 0) + k0 * p, 2);
      size += p * p;
      computed.x.push_back(-s(1, 1)), computed.y.push_back(z);
      lateral.x.push_back(-s(0, 0)), lateral.y.push_back(z);
    }
    for (const double z : {0.0, H}) {
      truth.x.push_back(rho * g * z), truth.y.push_back(z);
      truth_lateral.x.push_back(k0 * rho * g * z), truth_lateral.y.push_back(z);
    }
    run.figure({.name = "stress", .title = "Stress at rest", .kind = "points", .x = {"pressure", "Pa"}, .y = {"depth", "m"},
                .series = {computed, lateral, truth, truth_lateral}});
    run.measure("vertical_stress_error", std::sqrt(off / size));
    run.measure("lateral_stress_error", std::sqrt(off_lateral / (k0 * k0 * size)));
    run.measure("floor_force", dynamic.column("floor_force").back() / W, "Pa", {rho * g * H, 0.0});

    // What moves when damping is off, against the energy that settling has set free.
    const auto &t = dynamic.column("time"), &kinetic = dynamic.column("kinetic_energy"), &u = dynamic.column("settlement");
    const double released = 0.5 * rho * g * H * W * (2.0 / 3.0 * rho * g * H * H / (2.0 * M));
    double moving = 0.0, low = u.back(), high = u.back();
    for (std::size_t k = 0; k < t.size(); ++k) {
      if (t[k] < settled) continue;
      moving = std::max(moving, kinetic[k]);
      low = std::min(low, u[k]);
      high = std::max(high, u[k]);
    }
    run.measure("kinetic_energy", moving / released);
    run.measure("settlement", u.back(), "m", {rho * g * H * H / (3.0 * M), 0.0});
    run.measure("drift", (high - low) / u.back());
    run.measure("energy_imbalance", dynamic.energy_imbalance());
    history_figure(run, dynamic, "settlement", "Mean settlement", {"settlement"}, {"u", "m"});
  };
}

}  // namespace furrow::earth_pressure_cases
