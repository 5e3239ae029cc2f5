// Rings in plane strain that turn all of their kinetic energy into plastic work: one collapses, one expands.
#include <cmath>
#include <numbers>

#include "harness/material_file.hpp"
#include "reference/exact/elastic_plastic.hpp"
#include "verification/elastic-plastic/problems.hpp"
#include "verification/elastodynamics/problems.hpp"

namespace furrow::elastic_plastic_cases {
namespace {

struct Ring {
  double inner, outer;   ///< m
};

/// Concentric layers of cells, dx thick and as near to dx long as a whole number of cells allows; volumes are exact.
Body<2> ring_of(const Run& run, const Ring& ring, const AnyMaterial& material, const Scheme& scheme,
                const std::function<double(double)>& radial_velocity) {
  const double dx = run.resolution().spacing;
  Body<2> body;
  body.material = material;
  body.scheme = scheme;
  body.scheme.smoothing_ratio = run.resolution().smoothing_ratio;
  body.spacing = dx;
  const int layers = elastodynamic_cases::cells(ring.outer - ring.inner, dx, "thickness");
  const long around = std::lround(std::numbers::pi * (ring.inner + ring.outer) / dx);
  std::vector<Vector<2>> centres;
  std::vector<double> areas;
  for (int k = 0; k < layers; ++k) {
    const double r = ring.inner + (k + 0.5) * dx;
    for (long j = 0; j < around; ++j) {
      const double angle = 2.0 * std::numbers::pi * (static_cast<double>(j) + 0.5) / static_cast<double>(around);
      centres.push_back(r * Vector<2>(std::cos(angle), std::sin(angle)));
      areas.push_back(2.0 * std::numbers::pi * r * dx / static_cast<double>(around));
    }
  }
  body.add(centres);
  Particles<2>& p = body.particles;
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.mass[i] = p.density[i] * areas[i];
    p.velocity[i] = radial_velocity(p.position[i].norm()) * p.position[i].normalized();
  }
  return body;
}

/// Inner surface: centres of the innermost layer less half their deformed thickness along the radius. mean, and (max - min)/mean.
struct Surface {
  double mean, out_of_round;
};
Surface inner_surface(const Body<2>& body, const Ring& ring) {
  const Particles<2>& p = body.particles;
  double sum = 0.0, n = 0.0, least = HUGE_VAL, most = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.reference_position[i].norm() > ring.inner + body.spacing) continue;
    const Vector<2> out = p.position[i].normalized();
    const double r = p.position[i].norm() - 0.5 * body.spacing * (p.deformation_gradient[i].transpose() * out).norm();
    sum += r, n += 1.0;
    least = std::min(least, r), most = std::max(most, r);
  }
  return {sum / n, (most - least) * n / sum};
}

double yield_stress_of(const Parameters& input, const AnyMaterial& material) {
  double yield = -1.0;
  std::visit(
      [&](const auto& law) {
        if constexpr (requires { law.hardening_modulus; })
          if (law.hardening_modulus == 0.0) yield = law.yield_stress;
      },
      material);
  if (yield < 0.0) input.fail("material", "expected a perfectly plastic metal");
  return yield;
}

double density_of(const AnyMaterial& material) {
  return std::visit([](const auto& law) { return law.initial_state().density; }, material);
}

/// E/(1 - nu^2) at small strain, from the speeds of sound of the undeformed metal.
double hoop_modulus(const AnyMaterial& material) {
  return std::visit(
      [](const auto& law) {
        const MaterialState start = law.initial_state();
        double G = 0.0;
        if constexpr (requires { law.shear_modulus; }) G = law.shear_modulus;
        const double K = start.density * std::pow(law.sound_speed(start), 2) - 4.0 / 3.0 * G;
        const double E = 9.0 * K * G / (3.0 * K + G), nu = E / (2.0 * G) - 1.0;
        return E / (1.0 - nu * nu);
      },
      material);
}

void watch_ring(Simulation<2>& simulation, double size) {
  simulation.watch.low = Vector<2>::Constant(-size);
  simulation.watch.high = Vector<2>::Constant(size);
  if (simulation.body.scheme.frame == Frame::reference) simulation.control.courant = 0.5;
}

/// Radius of the inner surface and share of the kinetic energy, along the run.
void probe_ring(DynamicRun<2>& dynamic, const Ring& ring) {
  dynamic.probe({"inner_radius", "r_i", "m", "mean radius of the inner surface"},
                [ring](const Simulation<2>& s) { return inner_surface(s.body, ring).mean; });
  dynamic.probe({"out_of_round", "dr/r", "1", "largest less smallest radius of the inner surface, over the mean"},
                [ring](const Simulation<2>& s) { return inner_surface(s.body, ring).out_of_round; });
}

/// Ends a run when the kinetic energy has passed its least and grown from there by a thousandth of its first.
bool has_turned(const DynamicRun<2>& d) {
  const auto& kinetic = d.column("kinetic_energy");
  return kinetic.back() > *std::min_element(kinetic.begin(), kinetic.end()) + 1e-3 * kinetic.front();
}

std::size_t row_of_least(const std::vector<double>& values) {
  return static_cast<std::size_t>(std::min_element(values.begin(), values.end()) - values.begin());
}

void exercise_ring(Run& run, const Scheme& scheme) {
  exercise(run, scheme);
  run.exercises("materials/j2_plastic");
}

}  // namespace

Problem collapsing_cylinder(const Parameters& input) {
  const NamedMaterial material = read_material(input, "material");
  const double Y = yield_stress_of(input, material.law), rho = density_of(material.law);
  const Ring ring{input.quantity("inner_radius", dimension::length, range::positive),
                  input.quantity("outer_radius", dimension::length, range::positive)};
  const double r_stop = input.quantity("stop_radius", dimension::length, range::positive);
  if (!(ring.inner < ring.outer)) input.fail("outer_radius", "expected more than the inner radius");
  if (!(r_stop < ring.inner)) input.fail("stop_radius", "expected less than the inner radius");
  const Scheme scheme = read_scheme(input);
  const double u_0 = exact::collapsing_cylinder_speed(rho, Y, ring.inner, ring.outer, r_stop);

  return [=](Run& run) {
    Simulation<2> simulation;
    simulation.body = ring_of(run, ring, material.law, scheme, [&](double r) { return -u_0 * ring.inner / r; });
    watch_ring(simulation, 2.0 * ring.outer);
    DynamicRun<2> dynamic(run, simulation);
    probe_ring(dynamic, ring);
    dynamic.until(4.0 * (ring.inner - r_stop) / u_0, 600, 6, has_turned);
    exercise_ring(run, scheme);

    const std::size_t rest = row_of_least(dynamic.column("kinetic_energy"));
    const double kinetic = dynamic.column("kinetic_energy").front();
    const double least = *std::min_element(dynamic.column("inner_radius").begin(), dynamic.column("inner_radius").end());
    run.measure("stop_radius", least, "m", {r_stop, 0.0});
    run.measure("out_of_round", dynamic.column("out_of_round")[rest]);
    run.measure("plastic_share", dynamic.column("plastic_work")[rest] / kinetic);
    run.measure("viscous_share", dynamic.column("viscous_dissipation")[rest] / kinetic);
    elastodynamic_cases::measure_energy(run, dynamic);
    elastodynamic_cases::history_figure(run, dynamic, "radius", "Radius of the inner surface", {"inner_radius"}, {"r", "m"});
  };
}

Problem expanding_ring(const Parameters& input) {
  const NamedMaterial material = read_material(input, "material");
  const double Y = yield_stress_of(input, material.law), rho = density_of(material.law);
  const double r_0 = input.quantity("radius", dimension::length, range::positive);
  const double t = input.quantity("thickness", dimension::length, range::positive);
  const double v_0 = input.quantity("velocity", dimension::velocity, range::positive);
  const Ring ring{r_0 - 0.5 * t, r_0 + 0.5 * t};
  if (!(ring.inner > 0.0)) input.fail("thickness", "expected less than the diameter");
  const Scheme scheme = read_scheme(input);
  const exact::ExpandingRing thin{rho, Y, hoop_modulus(material.law), r_0, v_0};

  return [=](Run& run) {
    Simulation<2> simulation;
    simulation.body = ring_of(run, ring, material.law, scheme, [&](double r) { return v_0 * r_0 / r; });
    const double stop = exact::expanding_ring_stop(thin);
    watch_ring(simulation, 2.0 * stop);
    const auto mean_radius = [](const Simulation<2>& s) {
      double sum = 0.0, mass = 0.0;
      for (std::size_t i = 0; i < s.body.particles.size(); ++i) {
        sum += s.body.particles.mass[i] * s.body.particles.position[i].norm();
        mass += s.body.particles.mass[i];
      }
      return sum / mass;
    };
    DynamicRun<2> dynamic(run, simulation);
    probe_ring(dynamic, ring);
    dynamic.probe({"mean_radius", "r", "m", "mean radius of the ring"}, mean_radius);
    dynamic.until(6.0 * (stop - r_0) / v_0, 600, 6, has_turned);
    exercise_ring(run, scheme);

    const auto& radius = dynamic.column("mean_radius");
    const double reached = *std::max_element(radius.begin(), radius.end());
    run.measure("growth", reached - radius.front(), "m", {stop - r_0, 0.0});

    // Speed over radius: root of the kinetic energy against the closed form, in parts of the first speed.
    const auto& kinetic = dynamic.column("kinetic_energy");
    const std::size_t rest = row_of_least(kinetic);
    double sum = 0.0;
    Series computed, exact;
    for (std::size_t n = 0; n <= rest; ++n) {
      const double v = v_0 * std::sqrt(kinetic[n] / kinetic.front());
      const double truth = exact::expanding_ring_speed(thin, radius[n]);
      sum += std::pow((v - truth) / v_0, 2);
      computed.x.push_back(1e3 * radius[n]), computed.y.push_back(v);
      exact.x.push_back(1e3 * radius[n]), exact.y.push_back(truth);
    }
    run.measure("speed_l2", std::sqrt(sum / static_cast<double>(rest + 1)));
    run.measure("out_of_round", dynamic.column("out_of_round")[rest]);
    elastodynamic_cases::measure_energy(run, dynamic);
    Figure figure;
    figure.name = "speed";
    figure.title = "Speed of the ring over its radius";
    figure.x = {"radius", "mm"};
    figure.y = {"speed", "m/s"};
    computed.label = "computed";
    exact.label = "exact";
    exact.role = "reference";
    figure.add(std::move(exact));
    figure.add(std::move(computed));
    run.figure(std::move(figure));
  };
}

}  // namespace furrow::elastic_plastic_cases
