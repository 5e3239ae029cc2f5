// Every sum over neighbours against the plain double loop over all pairs, with the independent kernels.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"   // seen in g++ 12's own AVX-512 header (GCC bug 105593)
#endif
#include "tests/catch.hpp"

#include <omp.h>

#include "reference/exact/kernels.hpp"
#include "solver/schemes/density.hpp"
#include "solver/schemes/kernel_correction.hpp"
#include "solver/schemes/momentum.hpp"
#include "solver/schemes/velocity_gradient.hpp"
#include "solver/schemes/xsph.hpp"
#include "tests/solver/cloud.hpp"

namespace furrow {
namespace {

constexpr double tolerance = 1e-12;   // round-off of a hundred terms of order one
constexpr double h = 1.1;

/// One pair as the equations have it.
template <int Dim>
struct Pair {
  std::size_t j;
  Vector<Dim> x_ij, grad;
  double r, W;
};

/// Particles, and every pair of them by brute force.
template <int Dim>
struct Sums {
  Arrangement<Dim> a;
  Stencil<Dim> stencil;
  exact::Kernel kernel;
  const Particles<Dim>& p = a.particles;
  std::vector<double> V = a.volume();

  Sums(const std::string& name, bool periodic)
      : a(cloud<Dim>(all_axes<Dim>(Dim == 2 ? 13 : 7), periodic, 3.4, 11)),
        stencil(a.stencil(*kernel_by_name(name), h)),
        kernel(exact::kernel(name, Dim)) {}

  /// Calls f(pair) for every j other than i, however far.
  template <class F>
  void pairs(std::size_t i, F&& f) const {
    for (std::size_t j = 0; j < p.size(); ++j) {
      if (j == i) continue;
      const Vector<Dim> x_ij = shortest<Dim>(a.box, p.position[i], p.position[j]);
      const double r = x_ij.norm();
      f(Pair<Dim>{j, x_ij, kernel.derivative(r, h) / r * x_ij, r, kernel.value(r, h)});
    }
  }
};

template <int Dim>
using CorrectionOf = std::vector<Matrix<Dim>>;

/// Part of a uniform stress that pairs weighed by f^n carry on a lattice: by shells of equal distance.
template <int Dim>
double lattice_share(const exact::Kernel& kernel, const ArtificialStress& model, double dx) {
  double carried = 0.0, all = 0.0;
  for (int squared = 1; squared * dx * dx < 16.0 * h * h; ++squared) {
    int members = 0;
    const int side = static_cast<int>(std::sqrt(squared)) + 1;
    for (int a = -side; a <= side; ++a)
      for (int b = -side; b <= side; ++b)
        for (int c = Dim == 3 ? -side : 0; c <= (Dim == 3 ? side : 0); ++c) members += a * a + b * b + c * c == squared;
    const double r = dx * std::sqrt(squared), part = members * r * kernel.derivative(r, h);
    all += part;
    carried += part * std::pow(kernel.value(r, h) / kernel.value(dx, h), model.n);
  }
  return carried / all;
}

/// a_i and powers from the equations as they are written in momentum.hpp, term by term.
template <int Dim>
void check_momentum(const Sums<Dim>& s, const CorrectionOf<Dim>& B, const MomentumTerms& terms) {
  const Particles<Dim>& p = s.p;
  std::vector<Vector<Dim>> acceleration(p.size());
  std::vector<MomentumPower> power(p.size());
  MomentumWorkspace<Dim> workspace;
  const CorrectionView<Dim> correction = B.empty() ? CorrectionView<Dim>{} : std::span<const Matrix<Dim>>(B);
  momentum<Dim>(s.stencil, p, p.velocity, correction, terms, workspace, acceleration, power);

  std::vector<Matrix<Dim>> R(p.size(), Matrix<Dim>::Zero());
  for (std::size_t i = 0; terms.artificial_stress && i < p.size(); ++i) {
    const Eigen::SelfAdjointEigenSolver<Matrix<Dim>> principal(p.stress[i].template topLeftCorner<Dim, Dim>());
    for (int k = 0; k < Dim; ++k) {
      const double tension = std::max(0.0, principal.eigenvalues()[k]);
      R[i] -= terms.artificial_stress->eps * tension / (p.density[i] * p.density[i]) * principal.eigenvectors().col(k) *
              principal.eigenvectors().col(k).transpose();
    }
  }
  double worst = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    Vector<Dim> a = Vector<Dim>::Zero();
    double from_stress = 0.0, from_viscosity = 0.0, from_artificial = 0.0;
    const Matrix<Dim> sigma_i = p.stress[i].template topLeftCorner<Dim, Dim>();
    s.pairs(i, [&](const Pair<Dim>& pair) {
      if (pair.W == 0.0) return;
      const std::size_t j = pair.j;
      const Vector<Dim> v_ij = p.velocity[i] - p.velocity[j];
      const Matrix<Dim> sigma_j = p.stress[j].template topLeftCorner<Dim, Dim>();
      Vector<Dim> f;
      if (B.empty())
        f = p.mass[j] * (sigma_i / std::pow(p.density[i], 2) + sigma_j / std::pow(p.density[j], 2)) * pair.grad;
      else
        f = s.V[j] / p.density[i] * (sigma_i * B[i].transpose() + sigma_j * B[j].transpose()) * pair.grad;
      a += f;
      from_stress -= 0.5 * f.dot(v_ij);
      if (terms.viscosity && v_ij.dot(pair.x_ij) < 0.0) {
        const double mu = h * v_ij.dot(pair.x_ij) / (pair.r * pair.r + 0.01 * h * h);
        const double c = 0.5 * (p.sound_speed[i] + p.sound_speed[j]), rho = 0.5 * (p.density[i] + p.density[j]);
        const Vector<Dim> g = -p.mass[j] * (-terms.viscosity->alpha * c * mu + terms.viscosity->beta * mu * mu) / rho * pair.grad;
        a += g;
        from_viscosity -= 0.5 * g.dot(v_ij);
      }
      if (terms.artificial_stress) {
        const double share = terms.artificial_stress->neutral ? lattice_share<Dim>(s.kernel, *terms.artificial_stress, terms.spacing) : 0.0;
        const double f_n = std::pow(pair.W / s.kernel.value(terms.spacing, h), terms.artificial_stress->n) - share;
        const Vector<Dim> g = p.mass[j] * f_n * (R[i] + R[j]) * pair.grad;
        a += g;
        from_artificial -= 0.5 * g.dot(v_ij);
      }
    });
    worst = std::max({worst, (a - acceleration[i]).norm(), std::abs(power[i].stress - from_stress),
                      std::abs(power[i].viscous - from_viscosity), std::abs(power[i].artificial - from_artificial)});
  }
  CHECK(worst < 100.0 * tolerance);   // f^4 reaches 30 where jitter brings two particles close
}

template <int Dim>
void check_sums(const std::string& name, bool periodic) {
  INFO(name << " in " << Dim << "D, periodic " << periodic);
  const Sums<Dim> s(name, periodic);
  const Particles<Dim>& p = s.p;
  const std::size_t n = p.size();
  std::vector<double> f(n), interpolated(n), summed(n), shepard(n);
  for (std::size_t i = 0; i < n; ++i) f[i] = p.stress[i](0, 0);
  std::vector<Matrix<Dim>> B(n), L(n), corrected_L(n);
  std::vector<KernelSums<Dim>> sums(n);
  std::vector<Vector<Dim>> grad(n), corrected_grad(n), smooth(n);
  interpolate<Dim>(s.stencil, s.V, f, interpolated);
  summation_density<Dim>(s.stencil, p.mass, summed);
  shepard_density<Dim>(s.stencil, p.mass, p.density, shepard);
  kernel_sums<Dim>(s.stencil, s.V, sums);
  kernel_correction<Dim>(s.stencil, s.V, B);
  gradient<Dim>(s.stencil, s.V, f, {}, grad);
  gradient<Dim>(s.stencil, s.V, f, B, corrected_grad);
  velocity_gradient<Dim>(s.stencil, s.V, p.velocity, {}, L);
  velocity_gradient<Dim>(s.stencil, s.V, p.velocity, B, corrected_L);
  xsph_velocity<Dim>(s.stencil, p, p.velocity, 0.5, smooth);

  double worst = 0.0;
  const auto compare = [&worst](double error) { worst = std::max(worst, std::abs(error)); };
  for (std::size_t i = 0; i < n; ++i) {
    const double W_0 = s.kernel.value(0.0, h);
    double value = s.V[i] * f[i] * W_0, mass = p.mass[i] * W_0, unity = s.V[i] * W_0;
    Vector<Dim> constant = Vector<Dim>::Zero(), slope = Vector<Dim>::Zero(), drift = Vector<Dim>::Zero();
    Matrix<Dim> linear = Matrix<Dim>::Zero(), rate = Matrix<Dim>::Zero();
    s.pairs(i, [&](const Pair<Dim>& pair) {
      const std::size_t j = pair.j;
      const Vector<Dim> v_ji = p.velocity[j] - p.velocity[i];
      value += s.V[j] * f[j] * pair.W;
      mass += p.mass[j] * pair.W;
      unity += s.V[j] * pair.W;
      constant += s.V[j] * pair.grad;
      linear -= s.V[j] * pair.x_ij * pair.grad.transpose();
      slope += s.V[j] * (f[j] - f[i]) * pair.grad;
      rate += s.V[j] * v_ji * pair.grad.transpose();
      drift += p.mass[j] / (0.5 * (p.density[i] + p.density[j])) * pair.W * v_ji;
    });
    compare(interpolated[i] - value);
    compare(summed[i] - mass);
    compare(shepard[i] - mass / unity);
    compare(sums[i].unity - unity);
    compare((sums[i].constant - constant).norm());
    compare((sums[i].linear - linear).norm());
    compare((B[i] * linear - Matrix<Dim>::Identity()).norm());
    compare((grad[i] - slope).norm());
    compare((linear.transpose() * corrected_grad[i] - slope).norm());
    compare((L[i] - rate).norm());
    compare((corrected_L[i] * linear - rate).norm());
    compare((smooth[i] - p.velocity[i] - 0.5 * drift).norm());
    compare(density_rate<Dim>(p.density[i], L[i]) + p.density[i] * rate.trace());
  }
  CHECK(worst < tolerance);

  for (const bool dual : {false, true}) {
    const CorrectionOf<Dim> correction = dual ? B : CorrectionOf<Dim>{};
    MomentumTerms terms{.viscosity = {}, .artificial_stress = {}, .spacing = 1.0};
    check_momentum(s, correction, terms);
    terms.viscosity = ArtificialViscosity{.alpha = 0.7, .beta = 1.7};
    check_momentum(s, correction, terms);
    terms.artificial_stress = ArtificialStress{.eps = 0.4, .n = 4.0};
    check_momentum(s, correction, terms);
    terms.viscosity.reset();
    terms.artificial_stress->n = 2.55;
    check_momentum(s, correction, terms);
    terms.artificial_stress->neutral = true;
    check_momentum(s, correction, terms);
  }
}

/// Everything that the sums give, as one row of numbers.
std::vector<double> all_sums(int threads) {
  omp_set_num_threads(threads);
  const Sums<3> s("cubic_spline", true);
  const std::size_t n = s.p.size();
  std::vector<Matrix<3>> B(n), L(n);
  std::vector<Vector<3>> a(n), smooth(n);
  std::vector<MomentumPower> power(n);
  std::vector<double> density(n), row;
  MomentumWorkspace<3> workspace;
  kernel_correction<3>(s.stencil, s.V, B);
  velocity_gradient<3>(s.stencil, s.V, s.p.velocity, B, L);
  momentum<3>(s.stencil, s.p, s.p.velocity, B, {ArtificialViscosity{}, ArtificialStress{}, 1.0}, workspace, a, power);
  summation_density<3>(s.stencil, s.p.mass, density);
  xsph_velocity<3>(s.stencil, s.p, s.p.velocity, 0.5, smooth);
  for (std::size_t i = 0; i < n; ++i) {
    row.insert(row.end(), L[i].data(), L[i].data() + 9);
    row.insert(row.end(), a[i].data(), a[i].data() + 3);
    row.insert(row.end(), smooth[i].data(), smooth[i].data() + 3);
    row.insert(row.end(), {density[i], power[i].stress, power[i].viscous, power[i].artificial});
  }
  return row;
}

}  // namespace

TEST_CASE("every sum is that of the double loop over all pairs", "[schemes]") {
  for (const std::string& name : kernel_names())
    for (const bool periodic : {false, true}) {
      if (name != "quintic_spline" || !periodic) check_sums<3>(name, periodic);
      check_sums<2>(name, periodic);
    }
}

TEST_CASE("one thread and two give the same sums, bit for bit", "[schemes]") {
  const int before = omp_get_max_threads();
  const std::vector<double> one = all_sums(1);
  CHECK(all_sums(2) == one);
  CHECK(all_sums(3) == one);
  omp_set_num_threads(before);
}

TEST_CASE("without correction the stress power is that of the gradient with m_j/rho_i", "[schemes]") {
  const Sums<2> s("wendland_c2", true);   // densities differ from particle to particle
  const std::size_t n = s.p.size();
  std::vector<Matrix<2>> own(n), others(n);
  std::vector<Vector<2>> a(n);
  std::vector<MomentumPower> power(n);
  MomentumWorkspace<2> workspace;
  velocity_gradient<2>(s.stencil, s.p.mass, s.p.velocity, {}, own);
  velocity_gradient<2>(s.stencil, s.V, s.p.velocity, {}, others);
  momentum<2>(s.stencil, s.p, s.p.velocity, {}, {{}, {}, 1.0}, workspace, a, power);
  double taken = 0.0, dual = 0.0, printed = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const Matrix<2> sigma = s.p.stress[i].topLeftCorner<2, 2>();
    taken += s.p.mass[i] * power[i].stress;
    dual += s.p.mass[i] / s.p.density[i] * sigma.cwiseProduct(own[i] / s.p.density[i]).sum();
    printed += s.p.mass[i] / s.p.density[i] * sigma.cwiseProduct(others[i]).sum();
  }
  CHECK(taken == Approx(dual).epsilon(1e-11));
  CHECK(std::abs(taken - printed) > 1e-4 * std::abs(taken));
}

TEST_CASE("particles with too few neighbours are not corrected", "[schemes]") {
  // Alone; a pair, which spans a line and no plane; a row of three; and a full corner, which spans it.
  const std::vector<std::vector<Vector<2>>> none{{{0, 0}}, {{0, 0}, {1, 0}}, {{0, 0}, {1, 0}, {2, 0}}};
  for (const auto& position : none) {
    const Arrangement<2> a = arranged(Points<2>{position, 1.0, 1.0, {}}, 1.0, 2.6);
    std::vector<Matrix<2>> B(position.size());
    kernel_correction<2>(a.stencil(CubicSpline{}, 1.3), a.volume(), B);
    for (const Matrix<2>& b : B) CHECK(b == Matrix<2>::Identity());
  }
  const Arrangement<2> corner = arranged(Points<2>{{{0, 0}, {1, 0}, {0, 1}, {1, 1}}, 1.0, 1.0, {}}, 1.0, 2.6);
  std::vector<Matrix<2>> B(4);
  std::vector<Vector<2>> slope(4);
  kernel_correction<2>(corner.stencil(CubicSpline{}, 1.3), corner.volume(), B);
  std::vector<double> f(4);
  for (std::size_t i = 0; i < 4; ++i) f[i] = 3.0 + Vector<2>(2.0, -1.0).dot(corner.particles.position[i]);
  gradient<2>(corner.stencil(CubicSpline{}, 1.3), corner.volume(), f, B, slope);
  for (const Vector<2>& g : slope) CHECK((g - Vector<2>(2.0, -1.0)).norm() < tolerance);
}

}  // namespace furrow
