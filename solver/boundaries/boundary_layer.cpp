#include "solver/boundaries/boundary_layer.hpp"

#include <algorithm>

namespace furrow {
namespace {

/// Calls f(k, i, loop) for each particle of the layer, its number k and its index i; loop(g) calls g(weight, j, x_j - x_i) for the
/// soil in reach of its kernel.
template <int Dim, class F>
void for_each_of(const LayerSurroundings<Dim>& around, const BoundaryLayer<Dim>& layer, F&& f) {
  std::visit(
      [&](auto kernel) {
        const double h = around.smoothing_length;
        const auto n = static_cast<std::int64_t>(layer.ids.size());
#pragma omp parallel for schedule(static)
        for (std::int64_t l = 0; l < n; ++l) {
          const auto k = static_cast<std::size_t>(l);
          const auto i = static_cast<std::size_t>(around.index_of_id[static_cast<std::size_t>(layer.ids[k])]);
          f(k, i, [&](auto&& g) {
            for (const std::int32_t at : around.neighbours->row(i)) {
              const auto j = static_cast<std::size_t>(at);
              if (around.soil_volume[j] == 0.0) continue;
              const Vector<Dim> away = around.box.displacement(around.position[j], around.position[i]);
              const double W = value<decltype(kernel), Dim>(away.norm(), h);
              if (W > 0.0) g(around.soil_volume[j] * W, j, away);
            }
          });
        }
      },
      around.kernel);
}

}  // namespace

template <int Dim>
void extrapolate_velocity(const LayerSurroundings<Dim>& around, const BoundaryLayer<Dim>& layer, Slip slip,
                          const Vector<Dim>& wall_velocity, std::span<Vector<Dim>> velocity) {
  for_each_of(around, layer, [&](std::size_t k, std::size_t i, auto&& soil) {
    double sum = 0.0, height = 0.0;
    Vector<Dim> mean = Vector<Dim>::Zero();
    const Vector<Dim>& n = layer.normal[k];
    soil([&](double weight, std::size_t j, const Vector<Dim>& away) {
      sum += weight;
      mean += weight * (velocity[j] - wall_velocity);
      height += weight * away.dot(n);
    });
    velocity[i] = wall_velocity;
    if (sum == 0.0) return;
    mean /= sum;
    height = height / sum - layer.depth[k];
    const double ratio = layer.depth[k] < height ? layer.depth[k] / height : 1.0;
    if (slip == Slip::none)
      velocity[i] -= ratio * mean;
    else
      velocity[i] += mean - (1.0 + ratio) * mean.dot(n) * n;
  });
}

template <int Dim>
void extrapolate_stress(const LayerSurroundings<Dim>& around, const BoundaryLayer<Dim>& layer, const Vector<Dim>& weight,
                        std::span<const Matrix<Dim>> stress, std::span<Tensor> layer_stress) {
  for_each_of(around, layer, [&](std::size_t k, std::size_t i, auto&& soil) {
    double sum = 0.0, height = 0.0;
    Matrix<Dim> mean = Matrix<Dim>::Zero();
    const Vector<Dim>& n = layer.normal[k];
    soil([&](double w, std::size_t j, const Vector<Dim>& away) {
      sum += w;
      mean += w * stress[j];
      height += w * away.dot(n);
    });
    layer_stress[i].setZero();
    if (sum == 0.0) return;
    mean /= sum;
    const double pressed = std::max(0.0, -n.dot(mean * n)), beneath = weight.dot(n) * height / sum;
    mean += std::clamp(beneath, -pressed, pressed) * n * n.transpose();
    if (layer.slip == Slip::free) {
      const Matrix<Dim> mirror = Matrix<Dim>::Identity() - 2.0 * n * n.transpose();
      mean = (mirror * mean * mirror).eval();
      mean -= std::max(0.0, n.dot(mean * n)) * n * n.transpose();
    }
    layer_stress[i] = embed<Dim>(mean);
  });
}

template <int Dim>
void layer_exchange(const LayerSurroundings<Dim>& around, const BoundaryLayer<Dim>& layer, const Vector<Dim>& wall_velocity,
                    std::span<const double> volume, std::span<const Matrix<Dim>> A, std::span<const Vector<Dim>> velocity,
                    std::span<LayerExchange<Dim>> out) {
  std::visit(
      [&](auto kernel) {
        const double h = around.smoothing_length;
        const auto n = static_cast<std::int64_t>(layer.ids.size());
#pragma omp parallel for schedule(static)
        for (std::int64_t k = 0; k < n; ++k) {
          const auto w = static_cast<std::size_t>(around.index_of_id[static_cast<std::size_t>(layer.ids[static_cast<std::size_t>(k)])]);
          LayerExchange<Dim> sum;
          for (const std::int32_t at : around.neighbours->row(w)) {
            const auto j = static_cast<std::size_t>(at);
            const Vector<Dim> x_wj = around.box.displacement(around.position[w], around.position[j]);
            const double r = x_wj.norm();
            if (!(r > 0.0 && r < decltype(kernel)::support * h)) continue;
            const Vector<Dim> grad_w = volume[w] * volume[j] * derivative<decltype(kernel), Dim>(r, h) / r * x_wj;
            const Vector<Dim> f_wj = (A[w] + A[j]) * grad_w;
            sum.stress_force += f_wj;
            if (j < around.layer_of.size() && around.layer_of[j] != 0 && around.layer_of[j] != around.layer_of[w])
              sum.from_other_layers += f_wj;
            if (around.soil_volume[j] > 0.0)
              sum.power += f_wj.dot(velocity[j] - wall_velocity) + (velocity[w] - velocity[j]).dot(A[j] * grad_w);
          }
          out[static_cast<std::size_t>(k)] = sum;
        }
      },
      around.kernel);
}

#define FURROW_INSTANTIATE(Dim)                                                                                              \
  template void extrapolate_velocity<Dim>(const LayerSurroundings<Dim>&, const BoundaryLayer<Dim>&, Slip,                    \
                                          const Vector<Dim>&, std::span<Vector<Dim>>);                                       \
  template void extrapolate_stress<Dim>(const LayerSurroundings<Dim>&, const BoundaryLayer<Dim>&, const Vector<Dim>&,        \
                                        std::span<const Matrix<Dim>>, std::span<Tensor>);                                    \
  template void layer_exchange<Dim>(const LayerSurroundings<Dim>&, const BoundaryLayer<Dim>&, const Vector<Dim>&,            \
                                    std::span<const double>, std::span<const Matrix<Dim>>, std::span<const Vector<Dim>>,     \
                                    std::span<LayerExchange<Dim>>);
FURROW_INSTANTIATE(2)
FURROW_INSTANTIATE(3)
#undef FURROW_INSTANTIATE

}  // namespace furrow
