// A strip whose section has failed: what flies off on one side of the crack takes nothing along from the other.
#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "verification/elastodynamics/problems.hpp"

namespace furrow::elastodynamic_cases {

Problem parted_strip(const Parameters& input) {
  const LinearElastic material = read_elastic(input);
  const int columns = static_cast<int>(input.integer("columns", 8, 400)), rows = static_cast<int>(input.integer("rows", 2, 100));
  const double speed = input.quantity("speed", dimension::velocity, range::positive);
  const double stretch = input.number("stretch", {1.0, 2.0, false, false});
  const double slant = input.quantity("slant", dimension::none, range::not_negative);
  const double way = input.number("spacings", range::positive);
  const Scheme scheme = read_scheme(input);

  return [=](Run& run) {
    const double dx = run.resolution().spacing;
    Simulation<2> simulation;
    Body<2>& body = simulation.body;
    body = elastic_body(run, material, scheme);
    body.add(block(columns, rows, dx, {0.0, 0.0}));
    Particles<2>& p = body.particles;
    const int last = columns / 2 - 1;   // the column that has failed, behind the crack
    const auto column_of = [dx](const Particles<2>& q, std::size_t i) { return static_cast<int>(std::floor(q.reference_position[i][0] / dx)); };
    const auto is_left = [=](const Particles<2>& q, std::size_t i) { return column_of(q, i) <= last; };
    const Matrix<2> turn = Eigen::Rotation2D<double>(slant).toRotationMatrix();
    double flying = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      p.velocity[i] = is_left(p, i) ? Vector<2>(0.0, 0.0) : Vector<2>(speed, 0.0);
      if (!is_left(p, i)) flying += p.mass[i] * speed;
      if (column_of(p, i) != last) continue;
      p.damage[i] = 1.0;
      p.deformation_gradient[i] = turn * Vector<2>(stretch, 1.0).asDiagonal() * turn.transpose();
    }

    DynamicRun<2> dynamic(run, simulation);
    dynamic.probe({"passed_on", "dP/P", "1", "momentum of what should stand, over that of what flies off"}, [=](const Simulation<2>& s) {
      Vector<2> sum = Vector<2>::Zero();
      for (std::size_t i = 0; i < s.body.particles.size(); ++i)
        if (is_left(s.body.particles, i)) sum += s.body.particles.mass[i] * s.body.particles.velocity[i];
      return sum.norm() / flying;
    });
    dynamic.until(way * dx / speed, 100, 2);
    exercise(run, scheme);
    run.exercises("schemes/cracks");
    run.exercises("materials/linear_elastic");

    double passed_on = 0.0, across = 0.0, lost = 0.0;
    for (const double share : dynamic.column("passed_on")) passed_on = std::max(passed_on, share);
    const double reach = support(scheme.kernel) * body.smoothing_length();
    for (std::size_t i = 0; i < p.size(); ++i) {
      std::vector<bool> listed(p.size());
      for (const std::int32_t j : body.neighbours().row(i)) listed[static_cast<std::size_t>(j)] = true;
      for (std::size_t j = 0; j < p.size(); ++j) {
        if (i == j || (p.reference_position[i] - p.reference_position[j]).norm() >= reach) continue;
        const bool apart = is_left(p, i) != is_left(p, j);
        if (apart && listed[j]) across += 1.0;
        if (!apart && !listed[j]) lost += 1.0;
      }
    }
    run.measure("pairs_across", across);
    run.measure("pairs_lost", lost);
    run.measure("passed_on", passed_on);
    history_figure(run, dynamic, "momentum", "What the crack lets through", {"passed_on"}, {"dP/P", "1"});
  };
}

}  // namespace furrow::elastodynamic_cases
