// What the paper's interface (Eqs 25, 26: sums over the particles of soil and tool alike) does to the tool's skin. A block of the
// tool's metal is driven against a block of soil, as a patch of the blade's face is, for as long as a wave takes through the soil.
//
//       soil            metal
//   +-----------+ +-------------+
//   |           | |   free |driven
//   |  at rest  | |        |      |   V = -v (sin(rake), cos(rake)): into the soil and down the face
//   |           | |        |      |
//   +-----------+ +-------------+
//
// Soil whose cohesion is 5 kPa cannot press harder than the wave that an impact sends through it while elastic: what metal of
// 324 MPa yield stress may feel of it is some hundredths of its strength.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/dynamic_run.hpp"
#include "harness/scheme_input.hpp"
#include "harness/soil_box.hpp"
#include "reference/exact/kernels.hpp"
#include "solver/coupled_simulation.hpp"
#include "solver/io/coupled_checkpoint.hpp"
#include "validation/tillage/interface_input.hpp"
#include "validation/tillage/problems.hpp"

namespace furrow::tillage_cases {
namespace {

struct Patch {
  Soil soil;
  NamedMaterial metal;
  Scheme scheme;         ///< of both bodies
  Interface interface;
  double soil_depth, metal_depth, height;   ///< m; along x twice, and of both
  Vector<2> velocity;                       ///< of the metal, m/s
  double end_time, courant;
};

constexpr int driven_columns = 4;

void set_up(CoupledSimulation& coupled, const Patch& patch, double dx, double smoothing_ratio) {
  const auto fill = [&](Body<2>& body, const char* name, const AnyMaterial& law, double x, double width, const Vector<2>& v) {
    body.name = name;
    body.material = law;
    body.scheme = patch.scheme;
    body.scheme.smoothing_ratio = smoothing_ratio;
    body.spacing = dx;
    body.add(rectangle({x, 0.0}, width, patch.height, dx), v);
  };
  Body<2>&soil = coupled.soft.body, &metal = coupled.stiff.body;
  fill(soil, "soil", patch.soil.law, -patch.soil_depth, patch.soil_depth, Vector<2>::Zero());
  fill(metal, "metal", patch.metal.law, 0.0, patch.metal_depth, patch.velocity);

  // The metal's back is driven; its outline goes through its outermost particles, anticlockwise from the lower left.
  const auto at = [&](int column, int row) {
    const Vector<2> x((column + 0.5) * dx, (row + 0.5) * dx);
    const auto& all = metal.particles.position;
    return static_cast<std::int32_t>(
        std::min_element(all.begin(), all.end(), [&](const auto& a, const auto& b) { return (a - x).norm() < (b - x).norm(); }) -
        all.begin());
  };
  const int columns = static_cast<int>(std::lround(patch.metal_depth / dx));
  const int rows = static_cast<int>(std::lround(patch.height / dx));
  std::vector<std::int32_t> driven;
  for (int c = columns - driven_columns; c < columns; ++c)
    for (int r = 0; r < rows; ++r) driven.push_back(at(c, r));
  const auto velocity = [v = patch.velocity](double) { return v; };
  metal.loads.motions.push_back({"actuator", driven, velocity});
  BodySurface& surface = coupled.surface;
  const auto node = [&](int c, int r) {
    surface.ids.push_back(at(c, r));
    surface.start.push_back(metal.particles.position[static_cast<std::size_t>(surface.ids.back())]);
  };
  for (int c = 0; c < columns; ++c) node(c, 0);
  for (int r = 1; r < rows; ++r) node(columns - 1, r);
  for (int c = columns - 2; c >= 0; --c) node(c, rows - 1);
  for (int r = rows - 2; r > 0; --r) node(0, r);
  surface.radius = 0.5 * dx;
  surface.displacement = [v = patch.velocity](double t) { return Vector<2>(t * v); };
  surface.velocity = velocity;

  coupled.soft.control.courant = coupled.stiff.control.courant = patch.courant;
  coupled.soft.watch.largest_imbalance = coupled.stiff.watch.largest_imbalance = 1e30;   // a metric says what energy does
  coupled.contact.law = patch.interface.contact;
  couple(coupled, patch.interface);
}

/// -dv_x/dx that the sum over the soil puts into the first column of metal as the block arrives, from the kernel's textbook
/// polynomial: the soil is a half lattice at rest.
double exact_skin_rate(const Patch& patch, double dx, double h) {
  const auto name = std::visit([](auto k) { return std::string(decltype(k)::name); }, patch.scheme.kernel);
  const exact::Kernel W = exact::kernel(name, 2);
  double sum = 0.0;
  for (int k = 1; k <= 10; ++k)
    for (int l = -10; l <= 10; ++l) {
      const double x = k * dx, y = l * dx, r = std::hypot(x, y);
      if (r < W.support() * h) sum += dx * dx * (0.0 - patch.velocity[0]) * W.derivative(r, h) * x / r;
    }
  return -sum;
}

/// Particles, by id, of the column at |x| = dx/2, in the middle third of the height: no wave from the ends has come there.
std::vector<std::int32_t> skin(const Body<2>& body, const Patch& patch) {
  std::vector<std::int32_t> ids;
  for (std::size_t i = 0; i < body.particles.size(); ++i) {
    const Vector<2>& x = body.particles.reference_position[i];
    if (std::abs(x[0]) < body.spacing && std::abs(x[1] - 0.5 * patch.height) < patch.height / 6.0)
      ids.push_back(body.particles.id[i]);
  }
  return ids;
}

template <class Value>
double mean(const Body<2>& body, const std::vector<std::int32_t>& ids, Value&& value) {
  double sum = 0.0;
  for (const std::int32_t id : ids) sum += value(body.particles, body.index_of(id));
  return sum / static_cast<double>(ids.size());
}

}  // namespace

Problem interface_patch(const Parameters& input) {
  constexpr double degree = std::numbers::pi / 180.0;
  const double rake = input.quantity("rake", dimension::none, {10.0 * degree, 90.0 * degree});
  const double v = input.quantity("speed", dimension::velocity, range::positive);
  const Soil soil = read_soil(input);
  const Patch patch{.soil = soil,
                    .metal = read_material(input, "metal"),
                    .scheme = read_scheme(input),
                    .interface = read_interface(input, soil.law),
                    .soil_depth = input.quantity("soil_depth", dimension::length, range::positive),
                    .metal_depth = input.quantity("metal_depth", dimension::length, range::positive),
                    .height = input.quantity("height", dimension::length, range::positive),
                    .velocity = {-v * std::sin(rake), -v * std::cos(rake)},
                    .end_time = input.quantity("end_time", dimension::time, range::positive),
                    .courant = input.number_or("courant", 0.3, range::positive)};
  return [=](Run& run) {
    const double dx = run.resolution().spacing, h = run.resolution().smoothing_length();
    CoupledSimulation coupled;
    set_up(coupled, patch, dx, run.resolution().smoothing_ratio);
    const Body<2>&sand = coupled.soft.body, &metal = coupled.stiff.body;
    const std::vector<std::int32_t> metal_skin = skin(metal, patch), soil_skin = skin(sand, patch);

    // Before anything moves: what the sum alone says.
    if (coupled.summation) {
      std::vector<Matrix<2>> L(metal.particles.size(), Matrix<2>::Zero());
      coupled.summation->find_pairs(sand.particles, metal.particles, std::vector<std::uint8_t>(sand.particles.size(), 1));
      coupled.summation->strain_stiff(sand.particles, metal.particles, L);
      const double rate = -L[static_cast<std::size_t>(metal_skin[metal_skin.size() / 2])](0, 0);
      run.measure("skin_strain_rate", rate, "1/s", {exact_skin_rate(patch, dx, h), 0.0});
    }

    DynamicRun<2> dynamic(run, coupled.soft);
    dynamic.carry([&](Checkpoint& checkpoint) { save_stiff(coupled, checkpoint); },
                  [&](const Checkpoint& checkpoint) { load_stiff(checkpoint, coupled); });
    const auto add = [&](const char* name, const char* symbol, const char* unit, const char* meaning,
                         std::function<double()> value) {
      dynamic.probe({name, symbol, unit, meaning}, [value = std::move(value)](const Simulation<2>&) { return value(); });
    };
    const auto stress = [](const Particles<2>& p, std::size_t i) { return p.stress[i](0, 0); };
    add("metal_stress", "sigma_m", "Pa", "stress normal to the interface in the first column of metal",
        [&] { return mean(metal, metal_skin, stress); });
    add("soil_stress", "sigma_s", "Pa", "the same in the first column of soil", [&] { return mean(sand, soil_skin, stress); });
    add("metal_shear", "tau_m", "Pa", "shear stress in the first column of metal",
        [&] { return mean(metal, metal_skin, [](const auto& p, std::size_t i) { return p.stress[i](0, 1); }); });
    const double rho_0 = metal.particles.density[0];
    const auto swelling = [rho_0](const auto& p, std::size_t i) { return p.density[i] / rho_0 - 1.0; };
    add("metal_density", "rho/rho_0 - 1", "1", "change of density in the first column of metal",
        [&, swelling] { return mean(metal, metal_skin, swelling); });
    for (const int axis : {0, 1})
      add(axis ? "jump_y" : "jump_x", axis ? "dv_y" : "dv_x", "m/s", "velocity of the first column of metal less that of soil",
          [&, axis] {
            const auto v = [axis](const auto& p, std::size_t i) { return p.velocity[i][axis]; };
            return mean(metal, metal_skin, v) - mean(sand, soil_skin, v);
          });
    add("impulse", "I", "N s", "given to the soil by the metal, normal to the interface",
        [&] { return coupled.impulses().soil[0]; });
    add("metal_plastic_strain", "eps_p", "1", "greatest in the metal",
        [&] { return *std::max_element(metal.particles.plastic_strain.begin(), metal.particles.plastic_strain.end()); });
    add("energy_error", "dE", "J", "energy of both less what came from outside", [&] { return coupled.energy_error(); });
    dynamic.until(patch.end_time, 200, 1);
    exercise(run, patch.scheme);
    for (const char* module : {"materials/drucker_prager", "boundaries/prescribed_motion", "coupled_simulation"})
      run.exercises(module);
    run.exercises(coupled.summation ? "boundaries/summation_interface" : "boundaries/contact");
    run.exercises("materials/" + std::string(std::visit([](const auto& law) { return std::string(law.name); }, patch.metal.law)));
    run.count(static_cast<long>(coupled.stiff.steps()), static_cast<long>(metal.particles.size()));

    // What the soil's wave can press with while elastic, and what came.
    const auto largest = [&](const char* name) {
      double most = 0.0;
      for (const double x : dynamic.column(name)) most = std::max(most, std::abs(x));
      return most;
    };
    const auto late = [&](const char* name) {
      const auto& column = dynamic.column(name);
      double sum = 0.0;
      for (std::size_t k = column.size() / 2; k < column.size(); ++k) sum += column[k];
      return sum / static_cast<double>(column.size() - column.size() / 2);
    };
    const MaterialState at_rest = patch.soil.law.initial_state();
    const double pressure = at_rest.density * patch.soil.law.sound_speed(at_rest) * -patch.velocity[0];
    run.measure("metal_stress", largest("metal_stress"), "Pa", {pressure, 0.0});
    run.measure("metal_shear", largest("metal_shear"), "Pa", {pressure, 0.0});
    const auto& I = dynamic.column("impulse");
    run.measure("traction", std::abs(I.back()) / (patch.height * dynamic.column("time").back()), "Pa", {pressure, 0.0});
    const double bulk = std::visit(
        [](const auto& law) {
          const MaterialState s = law.initial_state();
          const double c = law.sound_speed(s);
          double shear = 0.0;
          if constexpr (requires { law.shear_modulus; }) shear = law.shear_modulus;
          return s.density * c * c - 4.0 / 3.0 * shear;
        },
        patch.metal.law);
    run.measure("skin_density", largest("metal_density"), "1", {pressure / bulk, 0.0});
    run.measure("plastic_strain", dynamic.column("metal_plastic_strain").back());
    run.measure("stress_ratio", late("metal_stress") / late("soil_stress"));
    run.measure("closing", late("jump_x") / patch.velocity[0]);
    run.measure("slip", late("jump_y") / patch.velocity[1]);
    run.measure("penetration", coupled.contact.largest_penetration());
    const auto& i = coupled.impulses();
    run.measure("exchange_error", (i.soil + i.contact + i.rigid + i.pending).norm() / i.contact.norm());
    run.measure("energy_error", largest("energy_error") / std::abs(coupled.actuator_work()));

    Figure& figure = run.figure({.name = "stress",
                                 .title = "Stress normal to the interface in the first columns of metal and soil",
                                 .x = {"time", "s"},
                                 .y = {"stress", "Pa"}});
    figure.add({.label = "metal", .x = dynamic.column("time"), .y = dynamic.column("metal_stress")});
    figure.add({.label = "soil", .x = dynamic.column("time"), .y = dynamic.column("soil_stress")});
    figure.add({.label = "most that soil can press with",
                .role = "bound",
                .x = {0.0, patch.end_time},
                .y = {-pressure, -pressure}});
    const auto depth = [&](const Body<2>& body, const char* label, double at_start) {
      Series series{.label = label, .x = {}, .y = {}};
      for (std::size_t k = 0; k < body.particles.size(); ++k) {
        const Vector<2>& x = body.particles.reference_position[k];
        if (std::abs(x[1] - 0.5 * patch.height) > 0.5 * dx) continue;
        series.x.push_back(x[0]), series.y.push_back(body.particles.density[k] / at_start - 1.0);
      }
      return series;
    };
    Figure& density = run.figure({.name = "density",
                                  .title = "Change of density across the interface at the end, middle rows",
                                  .kind = "points",
                                  .x = {"distance from the interface", "m"},
                                  .y = {"rho/rho_0 - 1", "1"}});
    density.add(depth(metal, "metal", rho_0));
    density.add(depth(sand, "soil", at_rest.density));
  };
}

}  // namespace furrow::tillage_cases
