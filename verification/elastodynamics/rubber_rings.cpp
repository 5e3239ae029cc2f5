// Two rubber rings that collide, Gray, Monaghan & Swift 2001, CMAME 190:6641, section 6. They touch through the same sums that
// hold them together: what bounces and what breaks is the scheme's own doing.
#include <fmt/format.h>

#include "verification/elastodynamics/problems.hpp"

namespace furrow::elastodynamic_cases {
namespace {

/// Centres of the cells of a square lattice that lie in the ring about the origin.
std::vector<Vector<2>> ring(double inner, double outer, double dx) {
  std::vector<Vector<2>> centres;
  const int n = static_cast<int>(std::ceil(outer / dx));
  for (int i = -n; i < n; ++i)
    for (int j = -n; j < n; ++j) {
      const Vector<2> x = dx * Vector<2>(i + 0.5, j + 0.5);
      if (x.norm() > inner && x.norm() < outer) centres.push_back(x);
    }
  return centres;
}

/// Pairs that begin as nearest neighbours in one body, by id.
std::vector<std::pair<std::int32_t, std::int32_t>> nearest_pairs(const Body<2>& body) {
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  const auto& p = body.particles;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if ((p.position[i] - p.position[j]).norm() < 1.01 * body.spacing) pairs.emplace_back(p.id[i], p.id[j]);
  return pairs;
}

}  // namespace

Problem rubber_rings(const Parameters& input) {
  const LinearElastic material = read_elastic(input);
  const double r_i = input.quantity("inner_radius", dimension::length, range::positive);
  const double r_o = input.quantity("outer_radius", dimension::length, {r_i, range::infinity, true, true});
  const double v_0 = input.quantity("impact_velocity", dimension::velocity, range::positive);
  const double end = input.quantity("end_time", dimension::time, range::positive);
  const StepControl control = read_control(input);
  // The paper's sums with artificial stress, or without it, and then with its velocity gradient or with the dual of its momentum sum;
  // or sums with corrected gradients.
  const std::string form = input.choice("form", {"paper", "paper_without_artificial_stress", "dual_without_artificial_stress", "corrected"});
  Scheme scheme = read_scheme_without_correction(input, "form");
  scheme.correction = form == "corrected" ? Correction::linear : Correction::none;
  scheme.dual_gradient = form == "dual_without_artificial_stress";
  if (form == "paper_without_artificial_stress" || scheme.dual_gradient) scheme.artificial_stress.reset();

  return [=](Run& run) {
    const double dx = run.resolution().spacing, c_0 = std::sqrt(material.bulk_modulus / material.reference_density);

    // The rings fly at each other along x; they feel each other when their gap is less than the kernel's support. The right ring
    // is the mirror image of the left one, particle by particle.
    Simulation<2> simulation;
    simulation.body = elastic_body(run, material, scheme);
    simulation.control = control;
    Body<2>& body = simulation.body;
    const double centre = r_o + 0.5 * support(scheme.kernel) * body.smoothing_length();
    std::vector<Vector<2>> left = ring(r_i, r_o, dx), right = left;
    for (std::size_t i = 0; i < left.size(); ++i) {
      left[i] += Vector<2>(-centre, 0.0);
      right[i] = Vector<2>(-left[i][0], left[i][1]);
    }
    const auto n = left.size();
    body.add(left, {v_0, 0.0});
    const auto pairs = nearest_pairs(body);   // of the left ring; those of the right one are the same, n further on
    body.add(right, {-v_0, 0.0});
    simulation.watch.low = {-4.0 * r_o, -4.0 * r_o};
    simulation.watch.high = {4.0 * r_o, 4.0 * r_o};

    const auto place = [n](const Simulation<2>& s, std::int32_t id, bool in_right_ring) -> const Vector<2>& {
      return s.body.particles.position[s.body.index_of(id + (in_right_ring ? static_cast<std::int32_t>(n) : 0))];
    };
    DynamicRun<2> dynamic(run, simulation);
    dynamic.probe({"ring_velocity", "v", "m/s", "velocity of the left ring's centre of mass"}, [n](const Simulation<2>& s) {
      double sum = 0.0;
      for (std::size_t i = 0; i < n; ++i) sum += s.body.particles.velocity[s.body.index_of(static_cast<std::int32_t>(i))][0];
      return sum / static_cast<double>(n);
    });
    dynamic.probe({"gap", "g", "m", "distance of the nearest particles of the two rings, less the spacing"},
                  [n, dx, place](const Simulation<2>& s) {
                    double leftmost = 1e30, rightmost = -1e30;
                    for (std::int32_t i = 0; i < static_cast<std::int32_t>(n); ++i) {
                      rightmost = std::max(rightmost, place(s, i, false)[0]);
                      leftmost = std::min(leftmost, place(s, i, true)[0]);
                    }
                    return leftmost - rightmost - dx;
                  });
    dynamic.probe({"widest_pair", "r/dx", "1", "largest distance of two particles that began as nearest neighbours, in spacings"},
                  [pairs, dx, place](const Simulation<2>& s) {
                    double widest = 0.0;
                    for (const auto& [i, j] : pairs)
                      for (const bool in_right_ring : {false, true})
                        widest = std::max(widest, (place(s, i, in_right_ring) - place(s, j, in_right_ring)).norm());
                    return widest / dx;
                  });
    // Further apart than the support of the kernel, two particles do not hold each other any more.
    dynamic.probe({"broken_pairs", "n", "1", "fraction of pairs that began as nearest neighbours and are out of reach"},
                  [pairs, reach = support(scheme.kernel) * body.smoothing_length(), place](const Simulation<2>& s) {
                    double broken = 0.0;
                    for (const auto& [i, j] : pairs)
                      for (const bool in_right_ring : {false, true})
                        if ((place(s, i, in_right_ring) - place(s, j, in_right_ring)).norm() > reach) broken += 1.0;
                    return 0.5 * broken / static_cast<double>(pairs.size());
                  });
    dynamic.probe({"asymmetry", "d/dx", "1", "largest distance of a particle from its counterpart's mirror image, in spacings"},
                  [n, dx, place](const Simulation<2>& s) {
                    double largest = 0.0;
                    for (std::int32_t i = 0; i < static_cast<std::int32_t>(n); ++i) {
                      const Vector<2>& a = place(s, i, false);
                      const Vector<2>& b = place(s, i, true);
                      largest = std::max(largest, (a - Vector<2>(-b[0], b[1])).norm());
                    }
                    return largest / dx;
                  });
    dynamic.until(end, 400, 8);
    exercise(run, scheme);

    const auto largest = [&](std::string_view column) {
      const auto& values = dynamic.column(column);
      return *std::max_element(values.begin(), values.end());
    };
    const double p_scale = static_cast<double>(n) * body.particles.mass[0] * v_0;
    double momentum = 0.0;
    for (std::size_t k = 0; k < dynamic.history().rows(); ++k)
      momentum = std::max({momentum, std::abs(dynamic.column("momentum_x")[k]), std::abs(dynamic.column("momentum_y")[k])});
    run.measure("rebound", -dynamic.column("ring_velocity").back() / v_0);
    run.measure("gap", dynamic.column("gap").back() / dx);
    run.measure("widest_pair", largest("widest_pair"));
    run.measure("asymmetry", largest("asymmetry"));
    run.measure("momentum", momentum / p_scale);
    run.measure("broken_pairs", largest("broken_pairs"));
    measure_energy(run, dynamic);
    run.note(fmt::format("Each ring flies at {:.3f} of the speed of sound sqrt(K/rho) = {:.1f} m/s.", v_0 / c_0, c_0));
    history_figure(run, dynamic, "velocity", "Velocity of the left ring", {"ring_velocity"}, {"v", "m/s"});
    history_figure(run, dynamic, "pairs", "Widest pair that began as nearest neighbours", {"widest_pair"}, {"r/dx", "1"});
  };
}

}  // namespace furrow::elastodynamic_cases
