#include "solver/schemes/reference_frame.hpp"

#include <Eigen/LU>

#include "solver/modules.hpp"

namespace furrow {

template <int Dim>
Matrix<Dim> first_piola(const Matrix<Dim>& cauchy, const Matrix<Dim>& F, double J) {
  return J * cauchy * F.inverse().transpose();
}

template <int Dim>
double reference_speed(const Matrix<Dim>& F, double c) {
  const Matrix<Dim> inverse = F.inverse();
  return c * std::sqrt((inverse * inverse.transpose()).cwiseAbs().rowwise().sum().maxCoeff());
}

template <int Dim>
void reference_hourglass(const Stencil<Dim>& reference, const Particles<Dim>& p, std::span<const double> volume,
                         std::span<const Vector<Dim>> velocity, std::span<const Matrix<Dim>> gradient_rate, double chi,
                         double zeta, std::span<Vector<Dim>> acceleration, std::span<MomentumPower> power) {
  has_run(Module::hourglass);
  const double h = reference.smoothing_length;
  const auto read = reads(p.position, velocity, p.deformation_gradient, gradient_rate, p.density, p.sound_speed, volume);
  for_each_particle(reference, read, [&]<class K>(std::size_t i, auto&& neighbours, K) {
    const LaneVector<Dim> x_i = broadcast<Dim>(p.position[i]), v_i = broadcast<Dim>(velocity[i]);
    const LaneMatrix<Dim> F_i = broadcast<Dim>(p.deformation_gradient[i]), G_i = broadcast<Dim>(gradient_rate[i]);
    const Lanes half = broadcast(0.5);
    LaneVector<Dim> a;
    Lanes sprung{}, damped{};
    neighbours([&](const Pairs<Dim>& pair, const LaneVector<Dim>& x_j, const LaneVector<Dim>& v_j, const LaneMatrix<Dim>& F_j,
                   const LaneMatrix<Dim>& G_j, const Lanes& rho_j, const Lanes& c_j, const Lanes& V_j) {
      const LaneVector<Dim> x_ij = x_i - x_j, v_ij = v_i - v_j;
      const LaneVector<Dim> delta = x_ij - half * ((F_i + F_j) * pair.x_ij);
      const LaneVector<Dim> d = v_ij - half * ((G_i + G_j) * pair.x_ij);
      const Lanes rho = 0.5 * (p.density[i] + rho_j), c = 0.5 * (p.sound_speed[i] + c_j);
      const Lanes W = scale<K, Dim>(h) * Shape<K, Dim>::w(pair.r * (1.0 / h));
      const Lanes weight = broadcast(-volume[i] / p.mass[i]) * rho * c * W * V_j /
                           (pair.r * pair.r * (dot(x_ij, x_ij) + 1e-300));
      const Lanes spring = chi * weight * c * dot(delta, x_ij), damper = zeta * h * weight * dot(d, x_ij);
      const Lanes approach = dot(x_ij, v_ij);
      const Lanes spring_in = pair.r > 1e-140 ? spring : Lanes{};   // not the padding with the particle itself
      const Lanes damper_in = pair.r > 1e-140 ? damper : Lanes{};
      a += (spring_in + damper_in) * x_ij;
      sprung += spring_in * approach;
      damped += damper_in * approach;
    });
    acceleration[i] += sum(a);
    power[i].artificial -= 0.5 * sum(sprung);
    power[i].viscous -= 0.5 * sum(damped);
  });
}

#define FURROW_INSTANTIATE(Dim)                                                                                               \
  template Matrix<Dim> first_piola<Dim>(const Matrix<Dim>&, const Matrix<Dim>&, double);                                      \
  template double reference_speed<Dim>(const Matrix<Dim>&, double);                                                           \
  template void reference_hourglass<Dim>(const Stencil<Dim>&, const Particles<Dim>&, std::span<const double>,                 \
                                         std::span<const Vector<Dim>>, std::span<const Matrix<Dim>>, double, double,          \
                                         std::span<Vector<Dim>>, std::span<MomentumPower>);
FURROW_INSTANTIATE(2)
FURROW_INSTANTIATE(3)
#undef FURROW_INSTANTIATE

}  // namespace furrow
