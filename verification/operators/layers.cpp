// Boundary layers beside a block of soil whose stress is the same everywhere: what the layers' particles carry is then known, and
// the force on each layer is a sum over its pairs with soil alone.
#include <cmath>
#include <string>

#include "harness/scheme_input.hpp"
#include "harness/soil_box.hpp"
#include "reference/exact/kernels.hpp"
#include "verification/operators/largest.hpp"
#include "verification/operators/problems.hpp"

namespace furrow::operator_cases {
namespace {

/// Force on one layer from the soil: sum over pairs V^2 (sigma_w + sigma_j) grad_w W. And the sum of the magnitudes.
std::pair<Vector<2>, double> force_on(const Body<2>& body, const BoundaryLayer<2>& layer, const exact::Kernel& kernel) {
  const Particles<2>& p = body.particles;
  const double h = body.smoothing_length(), V = body.spacing * body.spacing;
  Vector<2> force = Vector<2>::Zero();
  double size = 0.0;
  for (const std::int32_t id : layer.ids) {
    const std::size_t w = body.index_of(id);
    for (std::size_t j = 0; j < p.size(); ++j) {
      if (body.is_in_layer(j)) continue;
      const Vector<2> x = p.position[w] - p.position[j];
      const double r = x.norm();
      if (r >= kernel.support() * h) continue;
      const Matrix<2> on_w = p.stress[w].topLeftCorner<2, 2>(), on_j = p.stress[j].topLeftCorner<2, 2>();
      const double slope = V * V * kernel.derivative(r, h);
      force += slope / r * ((on_w + on_j) * x);
      size += std::abs(slope) * (on_w.norm() + on_j.norm());   // either alone: of a mirrored shear they are opposite
    }
  }
  return {force, size};
}

bool sees_soil(const Body<2>& body, std::size_t w, double reach) {
  for (std::size_t j = 0; j < body.particles.size(); ++j)
    if (!body.is_in_layer(j) && (body.particles.position[w] - body.particles.position[j]).norm() < reach * (1.0 - 1e-9)) return true;
  return false;
}

}  // namespace

Problem stressed_layers(const Parameters& input) {
  const std::string name = input.choice("kernel", kernel_names());
  const double dx = input.quantity("spacing", dimension::length, range::positive), ratio = input.number("h_over_dx", {0.8, 4.0});
  const double density = input.quantity("density", dimension::density, range::positive);
  const double size = input.quantity("stress", dimension::stress, range::positive);
  const int cells = static_cast<int>(input.integer("cells", 6, 60));
  return [=](Run& run) {
    const exact::Kernel kernel = exact::kernel(name, 2);
    Largest pressed, pulled, sheared, forces;
    Tensor shear = Tensor::Zero(), general = Tensor::Zero();
    shear(0, 1) = shear(1, 0) = size;
    general.topLeftCorner<2, 2>() << -1.3 * size, 0.4 * size, 0.4 * size, -0.7 * size;
    for (const Tensor& stress : {Tensor(-size * Tensor::Identity()), Tensor(size * Tensor::Identity()), shear, general}) {
      Body<2> body;
      body.material = LinearElastic::from_young(density, 2e6, 0.3);
      body.spacing = dx;
      body.scheme.kernel = *kernel_by_name(name);
      body.scheme.smoothing_ratio = ratio;
      body.scheme.correction = Correction::none;
      body.scheme.viscosity.reset();
      const double edge = cells * dx;
      body.add(rectangle({0.0, 0.0}, edge, edge, dx));
      add_flat_layer(body, "floor", {0.0, 0.0}, {edge, 0.0}, Slip::free);
      add_flat_layer(body, "wall", {0.0, edge}, {0.0, 0.0}, Slip::free);
      check_clear(body);
      body.refresh_neighbours(true);
      body.respond(1e-12, 0);
      Particles<2>& p = body.particles;
      for (std::size_t i = 0; i < p.size(); ++i)
        if (!body.is_in_layer(i)) p.stress[i] = stress;
      body.accelerate(0.0, p.velocity);

      const double reach = kernel.support() * body.smoothing_length();
      for (std::size_t l = 0; l < body.layers.size(); ++l) {
        const BoundaryLayer<2>& layer = body.layers[l];
        const auto [expected, scale] = force_on(body, layer, kernel);
        forces.add((body.layer_forces()[l] - expected).norm() / scale);
        for (std::size_t k = 0; k < layer.ids.size(); ++k) {
          const std::size_t w = body.index_of(layer.ids[k]);
          if (!sees_soil(body, w, reach)) continue;
          const Matrix<2> s = p.stress[w].topLeftCorner<2, 2>() / size;
          const Vector<2>& n = layer.normal[k];
          const double across = n.dot(s * n), along = n.dot(s * Vector<2>(-n[1], n[0]));
          if (stress(0, 0) == -size) pressed.add(across + 1.0);
          if (stress(0, 0) == size) pulled.add(across);
          if (stress(0, 0) == 0.0) sheared.add(along + n.dot(shear.topLeftCorner<2, 2>() * Vector<2>(-n[1], n[0])) / size);
        }
      }
      run.count(0, static_cast<long>(p.size()));
    }
    run.exercises("boundaries/boundary_layer");
    run.exercises("schemes/momentum");
    run.measure("pressed", pressed.value());
    run.measure("pulled", pulled.value());
    run.measure("sheared", sheared.value());
    run.measure("force", forces.value());
  };
}

}  // namespace furrow::operator_cases
