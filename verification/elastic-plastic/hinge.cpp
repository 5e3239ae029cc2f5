// Plastic hinge: a strip in pure bending, its ends turned against each other until its whole section flows.
#include <cmath>
#include <numbers>

#include "harness/material_file.hpp"
#include "reference/exact/elastic_plastic.hpp"
#include "verification/elastic-plastic/problems.hpp"
#include "verification/elastodynamics/problems.hpp"

namespace furrow::elastic_plastic_cases {

Problem plastic_hinge(const Parameters& input) {
  const double Y = input.quantity("yield_stress", dimension::stress, range::positive);
  const LinearElastic elastic = elastodynamic_cases::read_elastic(input);
  const double free_length = input.quantity("free_length", dimension::length, range::positive);
  const double t = input.quantity("thickness", dimension::length, range::positive);
  const double turn = input.number("curvature_over_yield", {1.5, 100.0});
  const double end = input.quantity("end_time", dimension::time, range::positive);
  const Scheme scheme = read_scheme(input);

  return [=](Run& run) {
    const double dx = run.resolution().spacing;
    const int across = elastodynamic_cases::cells(t, dx, "thickness");
    J2Plastic<LinearEos> material{LinearEos{elastic.reference_density, elastic.bulk_modulus}, elastic.shear_modulus, Y};

    // The right half of the strip, x = 0 its plane of symmetry. Columns that fill a support are turned as a rigid end.
    Simulation<2> simulation;
    Body<2>& body = simulation.body;
    body.material = material;
    body.scheme = scheme;
    body.scheme.smoothing_ratio = run.resolution().smoothing_ratio;
    body.spacing = dx;
    const int held = static_cast<int>(std::ceil(support(scheme.kernel) * body.scheme.smoothing_ratio));
    const int along = static_cast<int>(std::lround(0.5 * free_length / dx)) + held;
    body.add(elastodynamic_cases::block(along, across, dx, {0.0, -0.5 * t}));
    body.images = Images<2>({SymmetryPlane<2>{{0.0, 0.0}, {1.0, 0.0}}});
    simulation.watch.largest_imbalance = HUGE_VAL;   // at first all of the energy is what turning the ends gives them
    if (scheme.frame == Frame::reference) simulation.control.courant = 0.5;
    simulation.watch.low = Vector<2>::Constant(-2.0 * free_length);
    simulation.watch.high = Vector<2>::Constant(2.0 * free_length);

    // The axis of the free length l stays as long as it is and becomes an arc: at the turn phi its end is at l (sin phi/phi,
    // (1 - cos phi)/phi). The turn begins and ends smoothly.
    const double l = (along - held) * dx;
    const double E = 9.0 * material.eos.bulk_modulus * material.shear_modulus /
                     (3.0 * material.eos.bulk_modulus + material.shear_modulus);
    const double nu = E / (2.0 * material.shear_modulus) - 1.0;
    const double kappa_y = 2.0 * (2.0 * Y / std::sqrt(3.0)) * (1.0 - nu * nu) / (E * t);
    const double phi_end = turn * kappa_y * l;
    const auto phi_at = [=](double time) {
      const double s = std::clamp(time / end, 0.0, 1.0);
      return phi_end * s * s * (3.0 - 2.0 * s);
    };
    const auto place = [=](const Vector<2>& X, double phi) -> Vector<2> {
      const double sinc = phi == 0.0 ? 1.0 : std::sin(phi) / phi, versed = phi == 0.0 ? 0.0 : (1.0 - std::cos(phi)) / phi;
      const Vector<2> arm(X[0] - l, X[1]);
      return l * Vector<2>(sinc, versed) + Vector<2>(std::cos(phi) * arm[0] - std::sin(phi) * arm[1],
                                                     std::sin(phi) * arm[0] + std::cos(phi) * arm[1]);
    };
    const Particles<2>& p = body.particles;
    const double instant = 1e-4 * end;
    for (int i = (along - held) * across; i < along * across; ++i) {
      const Vector<2> X = p.position[static_cast<std::size_t>(i)];
      body.loads.motions.push_back({"end", {i}, [=](double time) -> Vector<2> {
                                      const double before = phi_at(time - instant), after = phi_at(time + instant);
                                      return (place(X, after) - place(X, before)) / (2.0 * instant);
                                    }});
    }
    // Critical damping of the first bending mode of the free length.
    const double I = t * t * t / 12.0;
    body.loads.damping = 2.0 * std::pow(1.875104068711961 / l, 2) *
                         std::sqrt(E / (1.0 - nu * nu) * I / (elastic.reference_density * t));

    DynamicRun<2> dynamic(run, simulation);
    dynamic.probe({"moment", "M", "N", "moment per width that turns the end"}, [=](const Simulation<2>& s) {
      const double phi = phi_at(s.time());
      const Vector<2> centre = place({l, 0.0}, phi);
      double M = 0.0;
      const auto& reactions = s.body.reactions();
      for (std::size_t k = 0; k < reactions.size(); ++k) {
        const Vector<2> arm = s.body.particles.position[s.body.index_of(s.body.loads.motions[k].ids.front())] - centre;
        M += arm[0] * reactions[k][1] - arm[1] * reactions[k][0];
      }
      return M;
    });
    dynamic.probe({"curvature", "kappa/kappa_y", "1", "mean curvature over that at which fibres first reach 2Y/sqrt(3)"},
                  [=](const Simulation<2>& s) { return phi_at(s.time()) / (l * kappa_y); });
    dynamic.until(end, 400, 4);
    exercise(run, scheme);
    run.exercises("boundaries/prescribed_motion");
    run.exercises("materials/j2_plastic");

    // Reaction of the body on its end is minus what turns it. Plateau: mean over the last tenth of the time.
    const auto& time = dynamic.column("time");
    const auto& moment = dynamic.column("moment");
    double sum = 0.0, n = 0.0;
    for (std::size_t k = 0; k < time.size(); ++k)
      if (time[k] > 0.9 * end) sum += moment[k], n += 1.0;
    const double M_p = exact::limit_moment(Y, t);
    run.measure("limit_moment", std::abs(sum / n), "N", {M_p, 0.0});
    // When the ends have come to rest: what they themselves carry in between is no work on the strip.
    run.measure("energy_imbalance", dynamic.column("energy_imbalance").back());

    Figure figure;
    figure.name = "moment";
    figure.title = "Moment over curvature";
    figure.x = {"kappa/kappa_y", "1"};
    figure.y = {"M/M_p", "1"};
    Series computed, exact;
    computed.label = "computed";
    exact.label = "section of fibres that yield at 2Y/sqrt(3)";
    exact.role = "reference";
    for (std::size_t k = 0; k < time.size(); ++k) {
      const double c = dynamic.column("curvature")[k];
      computed.x.push_back(c), computed.y.push_back(std::abs(moment[k]) / M_p);
      exact.x.push_back(c), exact.y.push_back(c < 1.0 ? c / 1.5 : 1.0 - 1.0 / (3.0 * c * c));
    }
    figure.add(std::move(exact));
    figure.add(std::move(computed));
    run.figure(std::move(figure));
  };
}

}  // namespace furrow::elastic_plastic_cases
