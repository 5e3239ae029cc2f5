// Rows of particles that pass each other: whoever comes within reach of a kernel must be in the list of neighbours by then.
#include <algorithm>
#include <cmath>

#include "verification/elastodynamics/problems.hpp"

namespace furrow::elastodynamic_cases {
namespace {

/// Pairs within the support that the list of the first does not have, counted twice.
double missed_pairs(const Simulation<2>& simulation) {
  const Body<2>& body = simulation.body;
  const Particles<2>& p = body.particles;
  const double reach = support(body.scheme.kernel) * body.smoothing_length();
  double missed = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    std::vector<bool> listed(p.size());
    for (const std::int32_t j : body.neighbours().row(i)) listed[static_cast<std::size_t>(j)] = true;
    for (std::size_t j = 0; j < p.size(); ++j)
      if (j != i && !listed[j] && body.box.displacement(p.position[i], p.position[j]).norm() < reach) missed += 1.0;
  }
  return missed;
}

}  // namespace

Problem passing_rows(const Parameters& input) {
  const LinearElastic material = read_elastic(input);
  const double a = input.quantity("side", dimension::length, range::positive);
  const double speed = input.quantity("speed", dimension::velocity, range::positive);
  const double way = input.number("spacings", range::positive);
  const Scheme scheme = read_scheme(input);

  return [=](Run& run) {
    const double dx = run.resolution().spacing;
    const int n = cells(a, dx, "side");

    // A block, periodic along x, whose even rows move to the right and whose odd rows move to the left. Its stress plays no part.
    Simulation<2> simulation;
    simulation.body = elastic_body(run, material, scheme);
    Body<2>& body = simulation.body;
    body.add(block(n, n, dx, {0.0, 0.0}));
    body.box.length = {a, 0.0};
    for (int side = 0; side < 2; ++side) {
      const double v = side == 0 ? speed : -speed;
      PrescribedMotion<2> rows{side == 0 ? "even rows" : "odd rows", {}, [v](double) { return Vector<2>(v, 0.0); }};
      for (int i = 0; i < n; ++i)
        for (int j = side; j < n; j += 2) rows.ids.push_back(i * n + j);
      body.loads.motions.push_back(rows);
    }
    DynamicRun<2> dynamic(run, simulation);
    dynamic.probe({"missed_pairs", "n", "1", "pairs within the support that the list of neighbours does not have"}, missed_pairs);
    // Whatever the body does to its particles, they are where they were told to be, as fast as they were told to be.
    const auto told = [speed, dx](const Particles<2>& p, std::size_t i) {
      const bool even = static_cast<int>(std::floor(p.reference_position[i][1] / dx)) % 2 == 0;
      return Vector<2>(even ? speed : -speed, 0.0);
    };
    dynamic.probe({"off_way", "dx/dx_0", "1", "largest distance of a particle from where it should be, over the spacing"},
                  [told, dx](const Simulation<2>& s) {
                    const Particles<2>& p = s.body.particles;
                    double off = 0.0;
                    for (std::size_t i = 0; i < p.size(); ++i) {
                      const Vector<2> place = p.reference_position[i] + s.time() * told(p, i);
                      off = std::max(off, s.body.box.displacement(p.position[i], place).norm() / dx);
                    }
                    return off;
                  });
    dynamic.probe({"off_speed", "dv/v", "1", "largest difference of a particle's velocity from what it should be, over that"},
                  [told, speed](const Simulation<2>& s) {
                    const Particles<2>& p = s.body.particles;
                    double off = 0.0;
                    for (std::size_t i = 0; i < p.size(); ++i) off = std::max(off, (p.velocity[i] - told(p, i)).norm() / speed);
                    return off;
                  });
    dynamic.probe({"off_acceleration", "a dx/v^2", "1", "largest acceleration of a particle times spacing over speed squared"},
                  [speed, dx](const Simulation<2>& s) {
                    double off = 0.0;
                    for (const Vector<2>& a : s.body.particles.acceleration) off = std::max(off, a.norm() * dx / (speed * speed));
                    return off;
                  });
    dynamic.until(way * dx / speed, 400, 2);
    exercise(run, scheme);
    run.exercises("boundaries/prescribed_motion");
    run.exercises("particles/neighbours");
    run.exercises("materials/linear_elastic");

    for (const char* column : {"missed_pairs", "off_way", "off_speed", "off_acceleration"}) {
      const auto& values = dynamic.column(column);
      run.measure(column, *std::max_element(values.begin(), values.end()));
    }
    history_figure(run, dynamic, "missed", "Pairs that the list of neighbours does not have", {"missed_pairs"}, {"n", "1"});
  };
}

}  // namespace furrow::elastodynamic_cases
