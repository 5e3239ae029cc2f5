// A column under its own weight: brought to rest by damping, which is then off. Does it stay at rest, with the stress of statics?
#include "harness/soil_box.hpp"
#include "verification/elastodynamics/problems.hpp"

namespace furrow::elastodynamic_cases {

Problem gravity_column(const Parameters& input) {
  const LinearElastic material = read_elastic(input);
  const double H = input.quantity("height", dimension::length, range::positive);
  const double g = input.quantity("gravity", dimension::acceleration, range::positive);
  const std::string base = input.choice("base", {"wall", "held_layer", "boundary_layer", "symmetry"});
  const StepControl control = read_control(input);
  const Scheme scheme = read_scheme(input);

  return [=](Run& run) {
    const double dx = run.resolution().spacing, rho = material.reference_density;
    const double M = material.bulk_modulus + 4.0 / 3.0 * material.shear_modulus, c = std::sqrt(M / rho);
    constexpr int columns = 8;
    const int rows = cells(H, dx, "height");
    const int held = base == "held_layer" ? static_cast<int>(std::ceil(support(scheme.kernel) * run.resolution().smoothing_ratio)) : 0;

    // Geometry: a strip between symmetry planes, so that it strains along y alone; what it stands on is a rigid wall, held
    // particles, a layer that borrows its stress, or a symmetry plane.
    Simulation<2> simulation;
    simulation.body = elastic_body(run, material, scheme);
    simulation.control = control;
    Body<2>& body = simulation.body;
    body.add(block(columns, held + rows, dx, {0.0, -held * dx}));
    std::vector<SymmetryPlane<2>> planes{{{0.0, 0.0}, {1.0, 0.0}}, {{columns * dx, 0.0}, {-1.0, 0.0}}};
    if (base == "symmetry") planes.push_back({{0.0, 0.0}, {0.0, 1.0}});
    body.images = Images<2>(planes);
    if (base == "wall") body.walls.push_back({{0.0, 0.0}, {0.0, 1.0}, 4.0 * M});
    if (base == "boundary_layer") add_flat_layer(body, "base", {0.0, 0.0}, {columns * dx, 0.0}, Slip::free);
    if (base == "held_layer") {
      PrescribedMotion<2> rest{"base", {}, [](double) { return Vector<2>(Vector<2>::Zero()); }};
      for (int i = 0; i < columns; ++i)
        for (int j = 0; j < held; ++j) rest.ids.push_back(i * (held + rows) + j);
      body.loads.motions.push_back(rest);
    }

    // Loads: gravity; damping that is critical for the lowest mode, until that mode is down to 1e-5 of its start.
    const double omega = 0.5 * M_PI * c / H, settled = 15.0 / omega, end = settled + 3.0 * 4.0 * H / c;
    body.loads.gravity = {0.0, -g};
    body.loads.damping = 2.0 * omega;
    body.loads.damping_end = settled;
    simulation.watch.low = {-H, -H};
    simulation.watch.high = {2.0 * H, 2.0 * H};

    const auto inside = [](const Particles<2>& p, std::size_t i) { return p.reference_position[i][1] > 0.0; };
    DynamicRun<2> dynamic(run, simulation);
    dynamic.probe({"height_of_centre", "y_c", "m", "height of the centre of mass"}, [inside](const Simulation<2>& s) {
      const Particles<2>& p = s.body.particles;
      double sum = 0.0, mass = 0.0;
      for (std::size_t i = 0; i < p.size(); ++i)
        if (inside(p, i)) sum += p.mass[i] * p.position[i][1], mass += p.mass[i];
      return sum / mass;
    });
    dynamic.probe({"base_force", "F", "N", "force on what the column stands on, per metre of width of the plane"},
                  [base](const Simulation<2>& s) {
                    if (base == "wall") return s.body.wall_forces()[0];
                    if (base == "held_layer") return -s.body.reactions()[0][1];
                    if (base == "boundary_layer") return -s.body.layer_forces()[0][1];
                    return 0.0;
                  });
    dynamic.probe({"largest_velocity", "v", "m/s", "largest velocity of a particle"}, [](const Simulation<2>& s) {
      double largest = 0.0;
      for (std::size_t i = 0; i < s.body.particles.size(); ++i) largest = std::max(largest, s.body.particles.velocity[i].norm());
      return largest;
    });
    dynamic.until(end, 600, 2);
    exercise(run, scheme);
    run.exercises("particles/images");
    if (base == "wall") run.exercises("boundaries/wall");
    if (base == "held_layer") run.exercises("boundaries/prescribed_motion");
    if (base == "boundary_layer") run.exercises("boundaries/boundary_layer");

    // Statics at where each particle has come from: sigma_yy = -rho g (H - Y), sigma_xx = nu/(1 - nu) sigma_yy.
    const Particles<2>& p = body.particles;
    const double ratio = (material.bulk_modulus - 2.0 / 3.0 * material.shear_modulus) / M;
    // Apart from the ends: further from them than the support of the kernel, where a sum sees neither.
    const double reach = support(scheme.kernel) * body.smoothing_length();
    double square = 0.0, square_side = 0.0, square_inner = 0.0, largest = 0.0, count = 0.0, inner = 0.0, mass = 0.0;
    Series computed{.label = "vertical"}, side{.label = "horizontal"}, exact{.label = "rho g (H - Y)", .role = "reference"};
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double Y = p.reference_position[i][1], weight = rho * g * (H - Y);
      mass += body.is_in_layer(i) ? 0.0 : p.mass[i];   // what is held hangs on those who hold it
      if (!inside(p, i)) continue;
      const double e = (p.stress[i](1, 1) + weight) / (rho * g * H);
      const double e_side = (p.stress[i](0, 0) + ratio * weight) / (ratio * rho * g * H);
      square += e * e;
      square_side += e_side * e_side;
      largest = std::max(largest, std::abs(e));
      count += 1.0;
      if (Y > reach && Y < H - reach) square_inner += e * e, inner += 1.0;
      computed.x.push_back(Y), computed.y.push_back(-p.stress[i](1, 1));
      side.x.push_back(Y), side.y.push_back(-p.stress[i](0, 0));
    }
    exact.x = {0.0, H};
    exact.y = {rho * g * H, 0.0};
    run.measure("vertical_stress", std::sqrt(square / count));
    run.measure("horizontal_stress", std::sqrt(square_side / count));
    run.measure("inner_stress", std::sqrt(square_inner / inner));
    run.measure("largest_stress_error", largest);
    if (base != "symmetry") run.measure("base_force", dynamic.column("base_force").back(), "N/m", {mass * g, 0.0});

    // Drift: what happens after the damping is off, on the scales of the settlement under weight and of its speed.
    const double settlement = 0.5 * rho * g * H * H / M;
    const auto& t = dynamic.column("time");
    double lowest = 1e30, highest = -1e30, speed = 0.0;
    for (std::size_t k = 0; k < t.size(); ++k) {
      if (t[k] < settled) continue;
      lowest = std::min(lowest, dynamic.column("height_of_centre")[k]);
      highest = std::max(highest, dynamic.column("height_of_centre")[k]);
      speed = std::max(speed, dynamic.column("largest_velocity")[k]);
    }
    run.measure("drift", (highest - lowest) / settlement);
    run.measure("residual_velocity", speed / (settlement * omega));
    measure_energy(run, dynamic);

    Figure figure;
    figure.name = "stress";
    figure.title = "Stress over height";
    figure.kind = "points";
    figure.x = {"Y", "m"};
    figure.y = {"pressure", "Pa"};
    figure.add(std::move(computed));
    figure.add(std::move(side));
    figure.add(std::move(exact));
    run.figure(std::move(figure));
    history_figure(run, dynamic, "height", "Height of the centre of mass", {"height_of_centre"}, {"y_c", "m"});
  };
}

}  // namespace furrow::elastodynamic_cases
