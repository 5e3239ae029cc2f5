// Bodies that nothing holds: a spinning square, and the order of the time integration seen on a swinging block.
#include "verification/elastodynamics/problems.hpp"

namespace furrow::elastodynamic_cases {

Problem spinning_square(const Parameters& input) {
  const LinearElastic material = read_elastic(input);
  const double a = input.quantity("side", dimension::length, range::positive);
  const double omega = input.quantity("spin", dimension::rate, range::positive);
  const double turns = input.number("turns", range::positive);
  const Scheme scheme = read_scheme(input);

  return [=](Run& run) {
    const double dx = run.resolution().spacing, end = 2.0 * M_PI * turns / omega;
    const int n = cells(a, dx, "side");
    Simulation<2> simulation;
    simulation.body = elastic_body(run, material, scheme);
    Body<2>& body = simulation.body;
    body.add(block(n, n, dx, {-0.5 * a, -0.5 * a}));
    for (std::size_t i = 0; i < body.particles.size(); ++i) {
      const Vector<2>& x = body.particles.position[i];
      body.particles.velocity[i] = omega * Vector<2>(-x[1], x[0]);
    }
    simulation.watch.low = {-2.0 * a, -2.0 * a};
    simulation.watch.high = {2.0 * a, 2.0 * a};
    simulation.start();
    const double L_0 = simulation.angular_momentum(), p_scale = L_0 / a;

    DynamicRun<2> dynamic(run, simulation);
    dynamic.probe({"largest_von_mises", "q", "Pa", "largest von Mises stress of the inner half"}, [a](const Simulation<2>& s) {
      double q = 0.0;
      for (std::size_t i = 0; i < s.body.particles.size(); ++i)
        if (s.body.particles.position[i].norm() < 0.25 * a) q = std::max(q, von_mises(s.body.particles.stress[i]));
      return q;
    });
    dynamic.until(end, 400, 8);
    exercise(run, scheme);

    double spin_lost = 0.0, momentum = 0.0;
    for (std::size_t k = 0; k < dynamic.history().rows(); ++k) {
      spin_lost = std::max(spin_lost, std::abs(dynamic.column("angular_momentum")[k] / L_0 - 1.0));
      momentum = std::max({momentum, std::abs(dynamic.column("momentum_x")[k]) / p_scale, std::abs(dynamic.column("momentum_y")[k]) / p_scale});
    }
    run.measure("angular_momentum_lost", spin_lost);
    run.measure("momentum", momentum);
    // Stress of a spinning body scales with rho omega^2 a^2; a spurious stress would grow with every turn.
    const double scale = material.reference_density * omega * omega * a * a;
    run.measure("largest_stress", dynamic.column("largest_von_mises").back() / scale);
    measure_energy(run, dynamic);
    history_figure(run, dynamic, "stress", "Largest von Mises stress of the inner half", {"largest_von_mises"}, {"q", "Pa"});
  };
}

Problem order_in_time(const Parameters& input) {
  const LinearElastic material = read_elastic(input);
  const double a = input.quantity("side", dimension::length, range::positive);
  const double v_0 = input.quantity("velocity_amplitude", dimension::velocity, range::positive);
  const long coarsest = input.integer("coarsest_steps", 4, 100000);
  const int rungs = static_cast<int>(input.integer("rungs", 3, 8));
  Scheme scheme = read_scheme_without_correction(input, "correction");
  scheme.correction = read_correction(input);

  return [=](Run& run) {
    const double dx = run.resolution().spacing;
    const double c = std::sqrt((material.bulk_modulus + 4.0 / 3.0 * material.shear_modulus) / material.reference_density);
    const double end = 0.5 * a / c;
    // The same block, the same start, the same time: only the step differs. Velocities and stresses at the end, by id.
    const auto final_state = [&](long steps) {
      Simulation<2> simulation;
      simulation.body = elastic_body(run, material, scheme);
      Body<2>& body = simulation.body;
      const int n = cells(a, dx, "side");
      body.add(block(n, n, dx, {0.0, 0.0}));
      for (std::size_t i = 0; i < body.particles.size(); ++i) {
        const Vector<2> x = body.particles.position[i] / a;
        body.particles.velocity[i] = v_0 * Vector<2>(std::sin(M_PI * x[0]) * x[1], std::cos(M_PI * x[1]) * x[0] - x[1]);
      }
      simulation.control.fixed = true;
      simulation.control.largest = end / static_cast<double>(steps);
      simulation.start();
      while (simulation.time() < end * (1.0 - 1e-12)) simulation.step(end);
      std::vector<double> state(3 * body.particles.size());
      const double sigma = material.reference_density * c * v_0;
      for (std::size_t i = 0; i < body.particles.size(); ++i) {
        const auto id = static_cast<std::size_t>(body.particles.id[i]);
        state[3 * id] = body.particles.velocity[i][0] / v_0;
        state[3 * id + 1] = body.particles.velocity[i][1] / v_0;
        state[3 * id + 2] = von_mises(body.particles.stress[i]) / sigma;
      }
      run.count(simulation.steps(), static_cast<long>(body.particles.size()));
      return state;
    };
    const auto distance = [](const std::vector<double>& p, const std::vector<double>& q) {
      double sum = 0.0;
      for (std::size_t k = 0; k < p.size(); ++k) sum += (p[k] - q[k]) * (p[k] - q[k]);
      return std::sqrt(sum / static_cast<double>(p.size()));
    };
    std::vector<std::vector<double>> states;
    for (int r = 0; r < rungs; ++r) states.push_back(final_state(coarsest << r));

    // Order from differences of neighbouring rungs: d_r = |u_r - u_{r+1}| falls by 2^p a rung.
    Table& table = run.table("steps", "Difference to the run with half the step", {{"steps", "1"}, {"difference", "1"}, {"order", "1"}});
    Figure figure;
    figure.name = "order";
    figure.title = "Difference to the run with half the step";
    figure.x = {"step", "s"};
    figure.y = {"L2 difference of velocity and stress", "1"};
    figure.log_x = figure.log_y = true;
    Series series;
    series.label = "difference";
    double order = 0.0;
    for (int r = 0; r + 1 < rungs; ++r) {
      const double d = distance(states[static_cast<std::size_t>(r)], states[static_cast<std::size_t>(r) + 1]);
      if (r > 0) order = std::log2(series.y.back() / d);
      table.row({static_cast<double>(coarsest << r), d, r > 0 ? Cell(order) : Cell("")});
      series.x.push_back(end / static_cast<double>(coarsest << r));
      series.y.push_back(d);
    }
    figure.add(series);
    run.figure(std::move(figure));
    run.measure("order", order);
    exercise(run, scheme);
  };
}

}  // namespace furrow::elastodynamic_cases
