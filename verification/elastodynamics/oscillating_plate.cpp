// Oscillating plate, Gray, Monaghan & Swift 2001, CMAME 190:6641. A plate clamped at its left swings in its first bending mode.
#include "verification/elastodynamics/problems.hpp"

namespace furrow::elastodynamic_cases {
namespace {

/// Zeros of a curve, by linear interpolation between samples; the start counts.
std::vector<double> zeros(const std::vector<double>& t, const std::vector<double>& y) {
  std::vector<double> found{t.front()};
  for (std::size_t k = 2; k < t.size(); ++k)
    if (y[k - 1] * y[k] < 0.0) found.push_back(t[k - 1] + (t[k] - t[k - 1]) * y[k - 1] / (y[k - 1] - y[k]));
  return found;
}

}  // namespace

Problem oscillating_plate(const Parameters& input) {
  const LinearElastic material = read_elastic(input);
  const double L = input.quantity("length", dimension::length, range::positive);
  const double H = input.quantity("thickness", dimension::length, range::positive);
  const double clamp = input.quantity("clamp_length", dimension::length, range::positive);
  const bool by_faces = input.choice("clamp", {"faces", "layers"}) == "faces";
  const double V_f = input.number("velocity_amplitude", range::positive);
  const double end = input.quantity("end_time", dimension::time, range::positive);
  const double courant = input.number_or("courant", 0.4, range::positive);
  const Scheme scheme = read_scheme(input);

  return [=](Run& run) {
    const double dx = run.resolution().spacing;
    const int across = cells(H, dx, "thickness"), along = cells(L, dx, "length"), held = cells(clamp, dx, "clamp_length");

    // Geometry: the plate from -clamp to L about y = 0.
    Simulation<2> simulation;
    simulation.body = elastic_body(run, material, scheme);
    Body<2>& body = simulation.body;
    body.add(block(held + along, across, dx, {-clamp, -0.5 * H}));
    const int plate = static_cast<int>(body.particles.size());

    // Boundaries: both faces of the part behind x = 0 are held; or, as the literature has it, layers that do not move fill a support
    // above and below it.
    if (by_faces) {
      std::vector<std::vector<std::int32_t>> columns;
      for (int i = 0; i < held; ++i) {
        const int bottom = i * across, top = bottom + across - 1;
        columns.insert(columns.end(), {{bottom, bottom + 1}, {top, top - 1}});
      }
      body.hold_face("clamp", columns);
    } else {
      const int layers = static_cast<int>(std::ceil(support(scheme.kernel) * body.scheme.smoothing_ratio));
      body.add(block(held, layers, dx, {-clamp, 0.5 * H}));
      body.add(block(held, layers, dx, {-clamp, -0.5 * H - layers * dx}));
      PrescribedMotion<2> rest{"clamp", {}, [](double) { return Vector<2>(Vector<2>::Zero()); }};
      for (int i = plate; i < static_cast<int>(body.particles.size()); ++i) rest.ids.push_back(i);
      body.loads.motions.push_back(rest);
    }

    // Start: the first mode of a clamped beam, v_y = V_f c_0 F(x)/F(L), c_0 = sqrt(K/rho).
    const double k = 1.875104068711961 / L, c_0 = std::sqrt(material.bulk_modulus / material.reference_density);
    const auto F = [k, L](double x) {
      return (std::cos(k * L) + std::cosh(k * L)) * (std::cosh(k * x) - std::cos(k * x)) +
             (std::sin(k * L) - std::sinh(k * L)) * (std::sinh(k * x) - std::sin(k * x));
    };
    for (int i = 0; i < plate; ++i) {
      const double x = body.particles.position[static_cast<std::size_t>(i)][0];
      if (x > 0.0) body.particles.velocity[static_cast<std::size_t>(i)] = {0.0, V_f * c_0 * F(x) / F(L)};
    }
    simulation.control.courant = courant;
    simulation.watch.low = {-2.0 * clamp, -L};
    simulation.watch.high = {2.0 * L, L};

    // Probes: the middle of the free end, and the share of the mode in the deflection, in which higher modes cancel.
    const std::int32_t tip = (held + along - 1) * across + across / 2;
    const double y_0 = body.particles.position[static_cast<std::size_t>(tip)][1];
    DynamicRun<2> dynamic(run, simulation);
    dynamic.probe({"tip_deflection", "u_y", "m", "deflection of the middle of the free end"},
                  [tip, y_0](const Simulation<2>& s) { return s.body.particles.position[s.body.index_of(tip)][1] - y_0; });
    std::vector<double> mode(body.particles.size(), 0.0), height(body.particles.size(), 0.0);
    for (int i = 0; i < plate; ++i) {
      const Vector<2>& x = body.particles.position[static_cast<std::size_t>(i)];
      mode[static_cast<std::size_t>(i)] = x[0] > 0.0 ? F(x[0]) / F(L) : 0.0;
      height[static_cast<std::size_t>(i)] = x[1];
    }
    dynamic.probe({"mode_deflection", "a", "m", "share of the first mode in the deflection"}, [mode, height](const Simulation<2>& s) {
      double projection = 0.0, norm = 0.0;
      for (std::size_t i = 0; i < s.body.particles.size(); ++i) {
        const auto id = static_cast<std::size_t>(s.body.particles.id[i]);
        projection += mode[id] * (s.body.particles.position[i][1] - height[id]);
        norm += mode[id] * mode[id];
      }
      return projection / norm;
    });
    dynamic.until(end, 400, 4);
    exercise(run, scheme);
    run.exercises(by_faces ? "boundaries/held_face" : "boundaries/prescribed_motion");

    const std::vector<double>& u = dynamic.column("tip_deflection");
    const std::vector<double> t_0 = zeros(dynamic.column("time"), dynamic.column("mode_deflection"));
    if (t_0.size() < 2) throw std::runtime_error("the plate has not swung back by the end: the period is longer than twice end_time");
    const auto half_periods = static_cast<double>(t_0.size() - 1);
    run.measure("period", 2.0 * (t_0.back() - t_0.front()) / half_periods, "s");
    run.measure("amplitude", *std::max_element(u.begin(), u.end()) / L);
    measure_energy(run, dynamic);
    history_figure(run, dynamic, "deflection", "Deflection of the free end", {"tip_deflection"}, {"u_y", "m"});
  };
}

}  // namespace furrow::elastodynamic_cases
