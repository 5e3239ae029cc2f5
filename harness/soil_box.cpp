#include "harness/soil_box.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace furrow {

Soil read_soil(const Parameters& input) {
  const NamedMaterial material = read_material(input, "material");
  const auto* law = std::get_if<DruckerPrager>(&material.law);
  if (!law) input.fail("material", fmt::format("found {}, expected a soil: a material with the law drucker_prager", material.name));
  return {material.name, *law};
}

double active_ratio(const DruckerPrager& law, double pressure) {
  // (1 - K) p/sqrt(3) - alpha (1 + 2 K) p = k with equal stresses in both lateral directions.
  const double root = 1.0 / std::sqrt(3.0), alpha = law.cone.alpha;
  return ((root - alpha) * pressure - law.cone.k) / ((root + 2.0 * alpha) * pressure);
}

double RestingRatio::operator()(const DruckerPrager& law, double pressure) const {
  if (given) return *given;
  const double K = law.bulk_modulus, G = law.shear_modulus;
  const double elastic = (3.0 * K - 2.0 * G) / (3.0 * K + 4.0 * G);   // nu/(1 - nu)
  return pressure > 0.0 ? std::max(elastic, 1.02 * active_ratio(law, pressure)) : elastic;
}

RestingRatio read_resting_ratio(const Parameters& input, const DruckerPrager& law, double largest_pressure) {
  if (!input.has("k0")) return {};
  const double k0 = input.number("k0", range::not_negative);
  const double p = largest_pressure;
  Tensor stress = -k0 * p * Tensor::Identity();
  stress(1, 1) = -p;
  if (law.yield_function(stress) > 1e-9 * p)
    input.fail("k0", fmt::format("found {:g}, expected a ratio inside the yield surface: under {:.6g} Pa the soil yields {}", k0, p,
                                 k0 < 1.0 ? fmt::format("below {:.4f}", active_ratio(law, p)) : "passively before"));
  return {k0};
}

std::vector<Vector<2>> rectangle(const Vector<2>& corner, double width, double height, double dx) {
  const auto cells = [dx](double length, const char* what) {
    const double count = length / dx;
    if (std::abs(count - std::round(count)) > 1e-6 || count < 0.5)
      throw std::invalid_argument(fmt::format("{} of {:.6g} m is not a whole number of spacings of {:.6g} m", what, length, dx));
    return static_cast<int>(std::lround(count));
  };
  std::vector<Vector<2>> centres;
  const int columns = cells(width, "width"), rows = cells(height, "height");
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) centres.push_back(corner + dx * Vector<2>(i + 0.5, j + 0.5));
  return centres;
}

void add_flat_layer(Body<2>& body, std::string name, const Vector<2>& from, const Vector<2>& to, Slip slip,
                    std::function<Vector<2>(double)> velocity) {
  const double dx = body.spacing, length = (to - from).norm();
  const Vector<2> along = (to - from) / length, normal(-along[1], along[0]);
  // One row more than the soil reaches: the gradients of the others must not be corrected for an end that is none.
  const int rows = static_cast<int>(std::ceil(support(body.scheme.kernel) * body.scheme.smoothing_ratio - 1e-9)) + 1;
  const int columns = static_cast<int>(std::lround(length / dx));
  BoundaryLayer<2> layer{.name = std::move(name), .slip = slip, .velocity = std::move(velocity), .ids = {}, .normal = {}, .depth = {}};
  if (!layer.velocity) layer.velocity = [](double) { return Vector<2>(Vector<2>::Zero()); };
  std::vector<Vector<2>> centres;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      const double depth = (j + 0.5) * dx;
      layer.ids.push_back(static_cast<std::int32_t>(body.particles.size() + centres.size()));
      layer.normal.push_back(normal);
      layer.depth.push_back(depth);
      centres.push_back(from + (i + 0.5) * dx * along - depth * normal);
    }
  body.add(centres, layer.velocity(0.0));
  body.layers.push_back(std::move(layer));
}

std::vector<std::uint8_t> layer_flags(const Body<2>& body) {
  std::vector<std::uint8_t> in_layer(body.particles.size(), 0);
  for (const BoundaryLayer<2>& layer : body.layers)
    for (const std::int32_t id : layer.ids) in_layer[static_cast<std::size_t>(id)] = 1;
  return in_layer;
}

void set_geostatic(Body<2>& body, const DruckerPrager& law, double top, const RestingRatio& ratio) {
  const std::vector<std::uint8_t> in_layer = layer_flags(body);
  const double weight = law.reference_density * body.loads.gravity.norm();
  for (std::size_t i = 0; i < body.particles.size(); ++i) {
    if (in_layer[static_cast<std::size_t>(body.particles.id[i])]) continue;
    const double p = weight * (top - body.particles.position[i][1]);
    body.particles.stress[i] = -ratio(law, p) * p * Tensor::Identity();
    body.particles.stress[i](1, 1) = -p;
  }
}

void check_clear(const Body<2>& body) {
  const std::vector<std::uint8_t> in_layer = layer_flags(body);
  const Particles<2>& p = body.particles;
  std::vector<std::size_t> soil;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (!in_layer[static_cast<std::size_t>(p.id[i])]) soil.push_back(i);
  const double least = 0.99 * body.spacing;
  for (const BoundaryLayer<2>& layer : body.layers)
    for (const std::int32_t id : layer.ids)
      for (const std::size_t i : soil)
        if ((p.position[i] - p.position[static_cast<std::size_t>(id)]).squaredNorm() < least * least)
          throw std::invalid_argument(fmt::format("the soil at ({:.6g}, {:.6g}) m overlaps {}", p.position[i][0], p.position[i][1], layer.name));
}

Figure& soil_figure(Run& run, const Body<2>& body, const std::string& name, const std::string& title, const Column& colour,
                    const std::function<double(std::size_t)>& value) {
  Figure& figure =
      run.figure({.name = name, .title = title, .kind = "particles", .x = {"x", "m"}, .y = {"y", "m"}, .colour = colour});
  Series series{.label = "soil"};
  for (std::size_t i = 0; i < body.particles.size(); ++i) {
    if (body.is_in_layer(i)) continue;
    series.x.push_back(body.particles.position[i][0]);
    series.y.push_back(body.particles.position[i][1]);
    series.colour.push_back(value(i));
  }
  figure.add(std::move(series));
  return figure;
}

}  // namespace furrow
