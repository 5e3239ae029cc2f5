#include "validation/tillage/bed.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "reference/exact/plasticity.hpp"

namespace furrow::tillage_cases {

Bed read_bed(const Parameters& input) {
  return {.soil = read_soil(input),
          .length = input.quantity("soil_length", dimension::length, range::positive),
          .height = input.quantity("soil_height", dimension::length, range::positive),
          .right_wall = input.flag_or("right_wall", false),
          .gravity = input.quantity_or("gravity", dimension::acceleration, 0.0, range::not_negative),
          .courant = input.number_or("courant", 0.3, range::positive),
          .scheme = read_scheme(input)};
}

Blade read_blade(const Parameters& input, const Bed& bed) {
  constexpr double degree = std::numbers::pi / 180.0;
  const Blade blade{.rake = input.quantity("rake", dimension::none, {10.0 * degree, 120.0 * degree}),
                    .depth = input.quantity("depth", dimension::length, range::positive),
                    .length = input.quantity("blade_length", dimension::length, range::positive),
                    .thickness = input.quantity("thickness", dimension::length, range::positive),
                    .relief = input.quantity_or("relief", dimension::none, 0.0, {-89.0 * degree, 89.0 * degree}),
                    .gap = input.quantity("gap", dimension::length),
                    .speed = input.quantity("speed", dimension::velocity),
                    .friction = input.number_or("friction", 0.0, range::not_negative),
                    .adhesion = input.quantity_or("adhesion", dimension::stress, 0.0, range::not_negative),
                    .travel = input.quantity("travel", dimension::length, range::positive)};
  if (!(blade.speed > 0.0))
    input.fail("speed", fmt::format("found {:g} m/s, expected a speed to the left above 0: the blade must move into the soil",
                                    blade.speed));
  if (blade.depth >= bed.height)
    input.fail("depth", fmt::format("found {:g} m, expected less than the soil's height of {:g} m", blade.depth, bed.height));
  if (blade.gap < 0.0)
    input.fail("gap", fmt::format("found {:g} m, expected 0 or more: the blade would stand in the soil at the start", blade.gap));
  if (blade.gap >= blade.travel)
    input.fail("gap", fmt::format("found {:g} m, expected less than the travel of {:g} m: the blade would not touch the soil",
                                  blade.gap, blade.travel));
  if (blade.travel >= bed.length)
    input.fail("travel", fmt::format("found {:g} m, expected less than the soil's length of {:g} m", blade.travel, bed.length));
  if (blade.relief >= blade.rake) input.fail("relief", "found an end that is as steep as the face, expected less than the rake");
  return blade;
}

Interface read_interface(const Parameters& input, const Bed& bed, const Blade& blade) {
  Interface interface = read_interface(input, bed.soil.law);
  if (interface.summation && (blade.friction > 0.0 || blade.adhesion > 0.0))
    input.fail(blade.friction > 0.0 ? "friction" : "adhesion",
               "found one beside sums over both bodies, which do not know a surface");
  interface.contact.friction = blade.friction;
  interface.contact.adhesion = blade.adhesion;
  return interface;
}

Body<2> soil_body(const Bed& bed, const Blade& blade, const Resolution& resolution,
                  const std::optional<std::pair<Vector<2>, double>>& disc) {
  Body<2> body;
  body.name = "soil";
  body.material = bed.soil.law;
  body.scheme = bed.scheme;
  body.scheme.smoothing_ratio = resolution.smoothing_ratio;
  body.spacing = resolution.spacing;
  body.loads.gravity = {0.0, -bed.gravity};
  if (blade.gap > body.spacing)
    throw std::invalid_argument(
        fmt::format("the gap of {:g} m between blade and soil is larger than the spacing of {:g} m", blade.gap, body.spacing));
  std::vector<Vector<2>> centres = rectangle({0.0, 0.0}, bed.length, bed.height, body.spacing);
  if (disc)
    std::erase_if(centres, [&](const Vector<2>& x) { return (x - disc->first).norm() < disc->second + 0.5 * body.spacing; });
  body.add(centres);
  body.images = Images<2>({SymmetryPlane<2>{{0.0, 0.0}, {1.0, 0.0}}});
  const double dx = body.spacing;
  add_flat_layer(body, "floor", {0.0, 0.0}, {bed.length + 4.0 * dx, 0.0}, Slip::none);
  if (bed.right_wall)
    add_flat_layer(body, "right wall", {bed.length, 0.0}, {bed.length, dx * std::floor((bed.height - blade.depth) / dx + 1e-6)},
                   Slip::free);
  if (bed.gravity > 0.0) set_geostatic(body, bed.soil.law, bed.height, {});
  return body;
}

std::vector<Vector<2>> outline_of(const Bed& bed, const Blade& blade) {
  const Vector<2> edge = blade.edge(bed), u = blade.along(), back = -blade.normal();
  // The end leaves the edge under the angle of relief and meets the back at the thickness.
  const Vector<2> end(std::cos(blade.relief), std::sin(blade.relief));
  const Vector<2> heel = edge + blade.thickness / end.dot(back) * end;
  return {edge, heel, edge + blade.length * u + blade.thickness * back, edge + blade.length * u};
}

void check_start(const Body<2>& soil, const Outline<2>& outline, const Blade& blade, double range) {
  const std::vector<std::uint8_t> in_layer = layer_flags(soil);
  bool on_the_way = false;
  for (std::size_t i = 0; i < soil.particles.size(); ++i) {
    if (in_layer[static_cast<std::size_t>(soil.particles.id[i])]) continue;
    const Vector<2>& x = soil.particles.position[i];
    if (nearest_point(outline, x).distance < range - 1e-9 * soil.spacing)
      throw std::invalid_argument(fmt::format("the blade stands in the soil at the start: at ({:.6g}, {:.6g}) m", x[0], x[1]));
    Vector<2> later = x;
    later[0] += blade.travel;
    on_the_way = on_the_way || nearest_point(outline, later).distance < range ||
                 nearest_point(outline, Vector<2>(0.5 * (x + later))).distance < range;
  }
  if (!on_the_way) throw std::invalid_argument("the blade does not touch the soil on its way");
}

exact::CutForce wedge_of(const Bed& bed, const Blade& blade, exact::Rupture rupture) {
  const exact::Cone cone{bed.soil.law.cone.alpha, bed.soil.law.cone.k, bed.soil.law.cone.beta};
  const exact::Cut cut{.density = bed.soil.law.reference_density,
                       .cohesion = exact::plane_strain_cohesion(cone),
                       .friction_angle = exact::plane_strain_friction(cone),
                       .rake = blade.rake,
                       .depth = blade.depth,
                       .speed = blade.speed,
                       .tool_friction = std::atan(blade.friction),
                       .adhesion = blade.adhesion,
                       .gravity = bed.gravity};
  return exact::earthmoving(cut, rupture);
}

void picture(Run& run, const Body<2>& soil, const std::vector<std::pair<std::string, std::vector<Vector<2>>>>& outlines,
             const std::string& name, const std::string& title, const Column& colour,
             const std::function<double(std::size_t)>& value) {
  Figure& figure = soil_figure(run, soil, name, title, colour, value);
  // The tool's outline as points of no value, half a spacing apart: a figure of particles has a colour for each of its points.
  for (const auto& [label, nodes] : outlines) {
    Series outline{.label = label, .role = "bound"};
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const Vector<2>&a = nodes[k], &b = nodes[(k + 1) % nodes.size()];
      const int points = std::max(1, static_cast<int>((b - a).norm() / (0.5 * soil.spacing)));
      for (int l = 0; l < points; ++l) {
        const Vector<2> x = a + (b - a) * l / points;
        outline.x.push_back(x[0]), outline.y.push_back(x[1]), outline.colour.push_back(0.0);
      }
    }
    figure.add(std::move(outline));
  }
}

}  // namespace furrow::tillage_cases
