#include "validation/tillage/tool.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reference/exact/beam.hpp"

namespace furrow::tillage_cases {
namespace {

int free_columns(const Tool& tool, const Blade& blade) {
  return static_cast<int>(std::lround(tool.free_length / tool.spacing(blade)));
}
int held_columns(const Tool& tool) { return static_cast<int>(std::ceil(support(tool.scheme.kernel) * tool.smoothing_ratio)); }

}  // namespace

Tool read_tool(const Parameters& input, const Blade& blade) {
  const Parameters in = input.table("tool");
  const int across = static_cast<int>(in.integer("across", 1, 1000));
  if (across < 4)
    in.fail("across",
            fmt::format("found {}, expected 4 or more particles over the thickness: fewer do not bend as a plate does", across));
  const double dx = blade.thickness / across;
  Tool tool{.material = read_material(in, "material", dx),
            .shear_modulus = 0.0,
            .bulk_modulus = 0.0,
            .free_length = in.quantity("free_length", dimension::length, range::positive),
            .across = across,
            .smoothing_ratio = in.number_or("h_over_dx", 1.3, {0.8, 4.0}),
            .courant = in.number_or("courant", 0.5, range::positive),
            .scheme = read_scheme(in)};
  std::visit(
      [&](const auto& law) {
        const MaterialState initial = law.initial_state();
        if constexpr (requires { law.shear_modulus; }) {
          const double c = law.sound_speed(initial);
          tool.shear_modulus = law.shear_modulus;
          tool.bulk_modulus = initial.density * c * c - 4.0 / 3.0 * law.shear_modulus;
        }
      },
      tool.material.law);
  if (std::abs(tool.free_length / dx - std::round(tool.free_length / dx)) > 1e-6)
    in.fail("free_length", fmt::format("found {:g} m, expected a whole number of spacings of {:g} m", tool.free_length, dx));
  if (tool.free_length + held_columns(tool) * dx > blade.length)
    in.fail("free_length",
            fmt::format("found {:g} m, expected less than the blade's length of {:g} m by {} spacings that are held",
                        tool.free_length, blade.length, held_columns(tool)));
  return tool;
}

std::optional<Stone> read_stone(const Parameters& input, const Bed& bed, const Blade& blade) {
  if (!input.has("stone")) return std::nullopt;
  const Parameters in = input.table("stone");
  const double radius = in.quantity("radius", dimension::length, range::positive);
  const double ahead = in.quantity("ahead", dimension::length, range::positive);
  const double overlap = in.quantity("overlap", dimension::length, {-bed.height, 2.0 * radius});
  const Vector<2> edge = blade.edge(bed);
  // Its highest point stands `overlap` above the path of the edge, and `ahead` of where the edge begins.
  return Stone{{edge[0] - ahead, edge[1] + overlap - radius}, radius};
}

void add_tool(CoupledSimulation& coupled, const Tool& tool, const Bed& bed, const Blade& blade) {
  Simulation<2>& stiff = coupled.stiff;
  Body<2>& body = stiff.body;
  const double dx = tool.spacing(blade), v = blade.speed;
  body.name = "tool";
  body.material = tool.material.law;
  body.scheme = tool.scheme;
  body.scheme.smoothing_ratio = tool.smoothing_ratio;
  body.spacing = dx;
  stiff.control.courant = tool.courant;

  // Columns from the end up, in each from the face back. The last ones are part of what is rigid, and driven.
  const int free = free_columns(tool, blade), columns = free + held_columns(tool), m = tool.across;
  const Vector<2> edge = blade.edge(bed), u = blade.along(), back = -blade.normal();
  std::vector<Vector<2>> centres;
  for (int c = 0; c < columns; ++c)
    for (int r = 0; r < m; ++r) centres.push_back(edge + (c + 0.5) * dx * u + (r + 0.5) * dx * back);
  body.add(centres, {-v, 0.0});
  const auto velocity = [v](double) { return Vector<2>(-v, 0.0); };
  for (int k = free * m; k < columns * m; ++k) body.loads.motions.push_back({"actuator", {k}, velocity});

  BodySurface& surface = coupled.surface;
  const auto node = [&](int c, int r) {
    surface.ids.push_back(c * m + r);
    surface.start.push_back(centres[static_cast<std::size_t>(c * m + r)]);
  };
  const auto rigid = [&](double across) {
    surface.ids.push_back(BodySurface::rigid);
    surface.start.push_back(edge + (blade.length - 0.5 * dx) * u + across * back);
  };
  for (int r = 0; r < m; ++r) node(0, r);
  for (int c = 1; c < columns; ++c) node(c, m - 1);
  rigid(blade.thickness - 0.5 * dx);
  rigid(0.5 * dx);
  for (int c = columns - 1; c > 0; --c) node(c, 0);
  surface.radius = 0.5 * dx;
  surface.displacement = [v](double t) { return Vector<2>(-v * t, 0.0); };
  surface.velocity = velocity;
}

Place place_of(const Tool& tool, const Blade& blade, std::int32_t id) {
  const double dx = tool.spacing(blade);
  return {(id / tool.across + 0.5) * dx, (id % tool.across + 0.5) * dx};
}

double tip_deflection(const CoupledSimulation& coupled, const Tool& tool, const Blade& blade) {
  const Particles<2>& p = coupled.stiff.body.particles;
  Vector<2> mean = Vector<2>::Zero();
  for (std::int32_t id = 0; id < tool.across; ++id) {
    const std::size_t i = coupled.stiff.body.index_of(id);
    mean += (p.position[i] - p.reference_position[i]) / tool.across;
  }
  return -(mean - coupled.surface.displacement(coupled.stiff.time())).dot(blade.normal());
}

double beam_deflection(const CoupledSimulation& coupled, const Tool& tool, const Blade& blade) {
  std::vector<exact::BeamLoad> loads;
  const auto& ids = coupled.node_ids();
  for (std::size_t k = 0; k < ids.size(); ++k) {
    if (ids[k] == BodySurface::rigid) continue;
    const Place at = place_of(tool, blade, ids[k]);
    const Vector<2>& f = coupled.node_forces()[k];
    // A force up the blade on the side of the face bends it like one that pushes the face back bends it the other way.
    loads.push_back(
        {tool.free_length - at.along, -f.dot(blade.normal()), -f.dot(blade.along()) * (0.5 * blade.thickness - at.across)});
  }
  return exact::cantilever_deflection(loads, tool.free_length - 0.5 * tool.spacing(blade),
                                      exact::plate_stiffness(tool.young_modulus(), tool.poisson_ratio(), blade.thickness));
}

double clamp_moment(const CoupledSimulation& coupled, const Tool& tool, const Bed& bed, const Blade& blade) {
  const Body<2>& body = coupled.stiff.body;
  const Vector<2> centre = blade.edge(bed) + tool.free_length * blade.along() - 0.5 * blade.thickness * blade.normal() +
                           coupled.surface.displacement(coupled.stiff.time());
  double moment = 0.0;
  for (std::size_t k = 0; k < body.reactions().size(); ++k) {
    const Vector<2> arm = body.particles.position[body.index_of(body.loads.motions[k].ids.front())] - centre;
    moment += arm[0] * body.reactions()[k][1] - arm[1] * body.reactions()[k][0];
  }
  return std::abs(moment);
}

double plastic_moment(const CoupledSimulation& coupled, const Tool& tool, const Blade& blade) {
  const Body<2>& body = coupled.stiff.body;
  const Particles<2>& p = body.particles;
  const int free = free_columns(tool, blade);
  return std::visit(
      [&](const auto& law) {
        if constexpr (requires { law.strength; }) {
          // The column that has flowed most, on average.
          int hinge = -1;
          double most = 1e-3;
          for (int c = 0; c < free; ++c) {
            double sum = 0.0;
            for (int r = 0; r < tool.across; ++r) sum += p.plastic_strain[body.index_of(c * tool.across + r)] / tool.across;
            if (sum > most) most = sum, hinge = c;
          }
          if (hinge < 0) return 0.0;
          double moment = 0.0;
          for (int r = 0; r < tool.across; ++r) {
            const std::int32_t id = hinge * tool.across + r;
            const std::size_t i = body.index_of(id);
            const double y = std::abs(place_of(tool, blade, id).across - 0.5 * blade.thickness);
            const double intact = law.damage ? law.damage->integrity(body.state(i)) : 1.0;
            moment += 2.0 / std::sqrt(3.0) * intact * law.strength.flow_stress(p.plastic_strain[i], 0.0, p.temperature[i]).value *
                      y * tool.spacing(blade);
          }
          return moment;
        } else {
          return 0.0;
        }
      },
      tool.material.law);
}

double greatest(const std::vector<double>& field) { return *std::max_element(field.begin(), field.end()); }

double softened_particles(const CoupledSimulation& coupled) {
  const Body<2>& body = coupled.stiff.body;
  return std::visit(
      [&](const auto& law) {
        double count = 0.0;
        if constexpr (requires { law.damage; })
          for (std::size_t i = 0; law.damage && i < body.particles.size(); ++i)
            count += law.damage->integrity(body.state(i)) < 1.0 ? 1.0 : 0.0;
        return count;
      },
      body.material);
}

double failed_particles(const CoupledSimulation& coupled) {
  const Particles<2>& p = coupled.stiff.body.particles;
  double count = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) count += p.damage[i] >= 1.0 ? 1.0 : 0.0;
  return count;
}

}  // namespace furrow::tillage_cases
