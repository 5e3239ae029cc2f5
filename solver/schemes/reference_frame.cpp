#include "solver/schemes/reference_frame.hpp"

#include <Eigen/LU>

#include "solver/modules.hpp"
#include "solver/particles/ordered_sum.hpp"

namespace furrow {

namespace {

/// Sum over the pairs of one particle of what springs and dampers do to it.
template <int Dim>
struct HourglassSum {
  double zeta, h;
  LaneVector<Dim> x_i, v_i;
  LaneMatrix<Dim> G_i;
  double rho_i, c_i, scale;   ///< scale = V_i/m_i
  LaneVector<Dim> a{};
  Lanes sprung{}, damped{};

  /// `stretch(x_ij)`: delta_ij.x_ij
  template <class K, class Stretch>
  void add(const Pairs<Dim>& pair, const LaneVector<Dim>& x_j, const LaneVector<Dim>& v_j, const LaneMatrix<Dim>& G_j,
           const Lanes& rho_j, const Lanes& c_j, const Lanes& V_j, Stretch&& stretch) {
    const LaneVector<Dim> x_ij = x_i - x_j, v_ij = v_i - v_j;
    const LaneVector<Dim> d = v_ij - broadcast(0.5) * ((G_i + G_j) * pair.x_ij);
    const Lanes rho = 0.5 * (rho_i + rho_j), c = 0.5 * (c_i + c_j);
    const Lanes W = furrow::scale<K, Dim>(h) * Shape<K, Dim>::w(pair.r * (1.0 / h));
    const Lanes weight = broadcast(-scale) * rho * c * W * V_j / (pair.r * pair.r * (dot(x_ij, x_ij) + 1e-300));
    const Lanes spring = weight * stretch(x_ij, c), damper = zeta * h * weight * dot(d, x_ij);
    const Lanes approach = dot(x_ij, v_ij);
    const Lanes spring_in = pair.r > 1e-140 ? spring : Lanes{};   // not the padding with the particle itself
    const Lanes damper_in = pair.r > 1e-140 ? damper : Lanes{};
    a += (spring_in + damper_in) * x_ij;
    sprung += spring_in * approach;
    damped += damper_in * approach;
  }
};

}  // namespace

template <int Dim>
double largest_frequency(const Stencil<Dim>& reference, const PairWeights& weights, const Particles<Dim>& p,
                         std::span<const Matrix<Dim>> correction, double reference_density,
                         std::span<const std::uint8_t> left_out) {
  const std::size_t n = p.size(), extended = reference.position.size();
  std::vector<Vector<Dim>> u(extended, Vector<Dim>::Zero()), a(n);
  std::vector<Matrix<Dim>> gradient(n), A(extended);
  // Noise of the place, odd about the planes through the origin: a body and its half behind a plane of symmetry take the same
  // steps, whatever the order of their particles. Knuth's generator, the same on every machine.
  for (std::size_t i = 0; i < n; ++i) {
    const Vector<Dim>& X = reference.position[i];
    std::uint64_t noise = 0;
    const auto stir = [&noise](std::uint64_t key) { noise = (noise ^ key) * 6364136223846793005U + 1442695040888963407U; };
    for (int k = 0; k < Dim; ++k) stir(static_cast<std::uint64_t>(std::llround(std::abs(X[k]) / reference.smoothing_length * 1024.0)));
    for (int k = 0; k < Dim; ++k) {
      stir(0);
      const double a = static_cast<double>(noise >> 33) * 0x1p-30 - 1.0;
      u[i][k] = X[k] < 0.0 ? -a : a;
    }
  }
  const auto norm = [&](std::span<const Vector<Dim>> w) {
    return std::sqrt(std::get<0>(ordered_sum<1>(n, [&](std::size_t i, auto& sum) { sum[0] += p.mass[i] * w[i].squaredNorm(); })));
  };
  double omega = 0.0;
  for (int iteration = 0; iteration < 10; ++iteration) {
    if (reference.images) reference.images->fill_velocities(std::span(u));
    reference_gradient<Dim>(reference, weights, u, correction, gradient);
    for_all(n, [&](std::size_t i) {
      A[i].setZero();
      if (!left_out.empty() && left_out[i]) return;
      const Matrix<Dim> inverse = p.deformation_gradient[i].inverse();
      const double modulus = reference_density * p.sound_speed[i] * p.sound_speed[i];
      const Matrix<Dim> P = modulus * (gradient[i] * inverse).trace() * inverse.transpose();
      A[i] = correction.empty() ? P : Matrix<Dim>(P * correction[i].transpose());
    });
    if (reference.images) reference.images->fill_tensors(std::span(A));
    reference_divergence<Dim>(reference, weights, A, reference_density, a);
    const double ratio = norm(a) / norm(u);
    omega = std::sqrt(ratio);
    for_all(n, [&](std::size_t i) { u[i] = a[i] / ratio; });
  }
  return omega;
}

template <int Dim>
void reference_hourglass(const Stencil<Dim>& reference, const Particles<Dim>& p, std::span<const double> volume,
                         std::span<const Vector<Dim>> velocity, std::span<const Matrix<Dim>> gradient_rate, double chi,
                         double zeta, std::span<Vector<Dim>> acceleration, std::span<MomentumPower> power) {
  has_run(Module::hourglass);
  const auto sum_of = [&](std::size_t i) {
    return HourglassSum<Dim>{.zeta = zeta, .h = reference.smoothing_length, .x_i = broadcast<Dim>(p.position[i]),
                             .v_i = broadcast<Dim>(velocity[i]), .G_i = broadcast<Dim>(gradient_rate[i]), .rho_i = p.density[i],
                             .c_i = p.sound_speed[i], .scale = volume[i] / p.mass[i]};
  };
  const auto take = [&](std::size_t i, const HourglassSum<Dim>& s) {
    acceleration[i] += sum(s.a);
    power[i].artificial -= 0.5 * sum(s.sprung);
    power[i].viscous -= 0.5 * sum(s.damped);
  };
  if (chi > 0.0) {
    const auto read = reads(p.position, velocity, gradient_rate, p.density, p.sound_speed, volume, p.deformation_gradient);
    for_each_particle(reference, read, [&]<class K>(std::size_t i, auto&& neighbours, K) {
      HourglassSum<Dim> s = sum_of(i);
      const LaneMatrix<Dim> F_i = broadcast<Dim>(p.deformation_gradient[i]);
      neighbours([&](const Pairs<Dim>& pair, const LaneVector<Dim>& x_j, const LaneVector<Dim>& v_j, const LaneMatrix<Dim>& G_j,
                     const Lanes& rho_j, const Lanes& c_j, const Lanes& V_j, const LaneMatrix<Dim>& F_j) {
        s.template add<K>(pair, x_j, v_j, G_j, rho_j, c_j, V_j, [&](const LaneVector<Dim>& x_ij, const Lanes& c) {
          return chi * c * dot(x_ij - broadcast(0.5) * ((F_i + F_j) * pair.x_ij), x_ij);
        });
      });
      take(i, s);
    });
  } else {   // dampers need no deformation gradient, a third of what springs read
    const auto read = reads(p.position, velocity, gradient_rate, p.density, p.sound_speed, volume);
    for_each_particle(reference, read, [&]<class K>(std::size_t i, auto&& neighbours, K) {
      HourglassSum<Dim> s = sum_of(i);
      neighbours([&](const Pairs<Dim>& pair, const LaneVector<Dim>& x_j, const LaneVector<Dim>& v_j, const LaneMatrix<Dim>& G_j,
                     const Lanes& rho_j, const Lanes& c_j, const Lanes& V_j) {
        s.template add<K>(pair, x_j, v_j, G_j, rho_j, c_j, V_j, [](const LaneVector<Dim>&, const Lanes&) { return Lanes{}; });
      });
      take(i, s);
    });
  }
}

#define FURROW_INSTANTIATE(Dim)                                                                                               \
  template double largest_frequency<Dim>(const Stencil<Dim>&, const PairWeights&, const Particles<Dim>&,                      \
                                         std::span<const Matrix<Dim>>, double, std::span<const std::uint8_t>);                \
  template void reference_hourglass<Dim>(const Stencil<Dim>&, const Particles<Dim>&, std::span<const double>,                 \
                                         std::span<const Vector<Dim>>, std::span<const Matrix<Dim>>, double, double,          \
                                         std::span<Vector<Dim>>, std::span<MomentumPower>);
FURROW_INSTANTIATE(2)
FURROW_INSTANTIATE(3)
#undef FURROW_INSTANTIATE

}  // namespace furrow
