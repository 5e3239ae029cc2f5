// A block of particles that is deformed at random, under random stresses: the power of its internal forces must be that of its
// stresses, J sigma:L over the undeformed volume, where the sums are those of the undeformed body, and what holds zigzags must be
// its definition, summed once more over all pairs.
#include <Eigen/LU>
#include <random>
#include <string>

#include "harness/scheme_input.hpp"
#include "reference/exact/kernels.hpp"
#include "solver/body.hpp"
#include "verification/lattices.hpp"
#include "verification/operators/largest.hpp"
#include "verification/operators/problems.hpp"

namespace furrow::operator_cases {
namespace {

struct Setup {
  std::string kernel;
  double spacing, ratio, density, strain, spring, damper;
  int cells;
  std::uint64_t seed;
};

constexpr double instant = 1e-12;   // s, in which nothing moves: rates are some 1/s
constexpr double stress_scale = 1e6, slowest = 30.0;

/// Numbers in [-1, 1).
class Random {
 public:
  explicit Random(std::uint64_t seed) : generator_(seed) {}
  double operator()() { return 2.0 * uniform(generator_) - 1.0; }
  Vector<2> vector() {
    const double x = (*this)();
    return {x, (*this)()};
  }
  Matrix<2> matrix() {
    Matrix<2> m;
    m << (*this)(), (*this)(), (*this)(), (*this)();
    return m;
  }

 private:
  std::mt19937_64 generator_;
};

Body<2> block(const Setup& s, Frame frame) {
  Body<2> body;
  body.material = LinearElastic::from_young(s.density, 2e6, 0.3);
  body.spacing = s.spacing;
  body.scheme.kernel = *kernel_by_name(s.kernel);
  body.scheme.smoothing_ratio = s.ratio;
  body.scheme.frame = frame;
  body.scheme.viscosity.reset();
  body.scheme.correction = Correction::linear;
  body.add(square_lattice<2>({s.cells, s.cells}, s.spacing, false).position);
  return body;
}

double cross(const Vector<2>& a, const Vector<2>& b) { return a[0] * b[1] - a[1] * b[0]; }

/// sum_j of the definition: force of springs and dampers on particle i, N. `weight(i, j, r, X)` is V_i V_j W, of a pair at the
/// distance r that was X; `stiffness(i, j)` and `resistance(i, j)` are what comes before delta.n and d.n.
template <class Near, class Spring, class Damper>
Vector<2> held(const Particles<2>& p, std::size_t i, std::span<const Matrix<2>> rate, Near&& weight, Spring&& stiffness,
               Damper&& resistance) {
  Vector<2> force = Vector<2>::Zero();
  for (std::size_t j = 0; j < p.size(); ++j) {
    if (j == i) continue;
    const Vector<2> X = p.reference_position[i] - p.reference_position[j], x = p.position[i] - p.position[j], n = x / x.norm();
    const Matrix<2> F = 0.5 * (p.deformation_gradient[i] + p.deformation_gradient[j]);
    const Vector<2> delta = x - F * X;
    double push = stiffness(i, j) * delta.dot(n);
    if (!rate.empty()) push += resistance(i, j) * (p.velocity[i] - p.velocity[j] - 0.5 * (rate[i] + rate[j]) * X).dot(n);
    force -= weight(i, j, x.norm(), X.norm()) / X.squaredNorm() * push * n;
  }
  return force;
}

/// Sums over the undeformed body.
void in_reference(Run& run, const Setup& s) {
  Random random(s.seed);
  Body<2> body = block(s, Frame::reference);
  body.refresh_neighbours(true);
  Particles<2>& p = body.particles;
  const std::size_t n = p.size();
  Matrix<2> mean;
  mean << 0.6, 1.0, -0.4, -0.8;

  // Displacements, and the deformation gradient that the body's own sums see of them: the velocity gradient of a motion that
  // would cover them in a second.
  std::vector<Vector<2>> u(n);
  for (std::size_t i = 0; i < n; ++i) {
    u[i] = s.strain * (mean * p.reference_position[i] + 0.3 * s.spacing * random.vector());
    p.velocity[i] = u[i];
  }
  body.respond(instant, 0);
  std::vector<Matrix<2>> F(n), rate(n);
  for (std::size_t i = 0; i < n; ++i) F[i] = Matrix<2>::Identity() + body.velocity_gradient()[i];

  std::vector<Tensor> stress(n, Tensor::Zero());
  std::vector<double> sound(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Matrix<2> S = stress_scale * random.matrix();
    stress[i].topLeftCorner<2, 2>() = S + S.transpose();
    sound[i] = slowest * (2.0 + random());
    p.velocity[i] = random.vector();
  }
  const auto set = [&] {
    for (std::size_t i = 0; i < n; ++i) {
      p.deformation_gradient[i] = F[i];
      p.density[i] = s.density / F[i].determinant();
      p.stress[i] = stress[i];
      p.sound_speed[i] = sound[i];
      p.position[i] = p.reference_position[i] + u[i];
    }
  };
  set();
  body.respond(instant, 1);
  set();
  for (std::size_t i = 0; i < n; ++i) rate[i] = body.velocity_gradient()[i] * F[i];

  body.accelerate(0.0, p.velocity);
  const std::vector<Vector<2>> by_stress = p.acceleration;
  Vector<2> force = Vector<2>::Zero();
  double torque = 0.0, power = 0.0, forces = 0.0, torques = 0.0, powers = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vector<2> f = p.mass[i] * p.acceleration[i];
    const Matrix<2> sigma = stress[i].topLeftCorner<2, 2>();
    const double taken = p.mass[i] / p.density[i] * (sigma.array() * body.velocity_gradient()[i].array()).sum();
    force += f, forces += f.norm();
    torque += cross(p.position[i], f), torques += p.position[i].norm() * f.norm();
    power += f.dot(p.velocity[i]) + taken, powers += std::abs(f.dot(p.velocity[i])) + std::abs(taken);
  }
  run.measure("momentum", force.norm() / forces);
  run.measure("angular_momentum", std::abs(torque) / torques);
  run.measure("power", std::abs(power) / powers);

  // Springs and dampers, against the definition.
  body.scheme.hourglass = s.spring;
  body.scheme.hourglass_damping = s.damper;
  body.accelerate(0.0, p.velocity);
  const exact::Kernel kernel = exact::kernel(s.kernel, 2);
  const double h = body.smoothing_length(), V = s.spacing * s.spacing;
  double off = 0.0, size = 0.0, balance = 0.0, works = 0.0;
  const auto mean_of = [](const std::vector<double>& f, std::size_t i, std::size_t j) { return 0.5 * (f[i] + f[j]); };
  for (std::size_t i = 0; i < n; ++i) {
    const Vector<2> expected = held(
        p, i, rate, [&](std::size_t, std::size_t, double, double X) { return V * V * kernel.value(X, h); },
        [&](std::size_t a, std::size_t b) {
          return s.spring * mean_of(p.density, a, b) * std::pow(mean_of(p.sound_speed, a, b), 2);
        },
        [&](std::size_t a, std::size_t b) { return s.damper * mean_of(p.density, a, b) * mean_of(p.sound_speed, a, b) * h; });
    const Vector<2> found = p.mass[i] * (p.acceleration[i] - by_stress[i]);
    off = std::max(off, (found - expected).norm());
    size = std::max(size, expected.norm());
    const double kept = p.mass[i] * (body.power()[i].artificial + body.power()[i].viscous);
    balance += found.dot(p.velocity[i]) + kept, works += std::abs(found.dot(p.velocity[i])) + std::abs(kept);
  }
  run.measure("reference_hourglass", off / size);
  run.measure("reference_hourglass_power", std::abs(balance) / works);
}

/// Sums over the block as it is.
void in_place(Run& run, const Setup& s) {
  Random random(s.seed + 1);
  Body<2> body = block(s, Frame::current);
  for (Vector<2>& x : body.particles.position) x += 0.1 * s.spacing * random.vector();
  body.refresh_neighbours(true);
  Particles<2>& p = body.particles;
  body.respond(instant, 0);
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.deformation_gradient[i] = Matrix<2>::Identity() + s.strain * random.matrix();
    p.density[i] = s.density * (1.0 + 0.2 * random());
    p.sound_speed[i] = slowest * (2.0 + random());
    p.stress[i].setZero();
    p.velocity[i] = random.vector();
  }
  body.scheme.hourglass = s.spring;
  body.accelerate(0.0, p.velocity);
  const exact::Kernel kernel = exact::kernel(s.kernel, 2);
  const double h = body.smoothing_length(), reach = kernel.support() * h;
  const auto V = [&](std::size_t i) { return p.mass[i] / p.density[i]; };
  const auto modulus = [&](std::size_t i) { return p.density[i] * p.sound_speed[i] * p.sound_speed[i]; };
  double off = 0.0, size = 0.0, balance = 0.0, works = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vector<2> expected = held(
        p, i, {},
        [&](std::size_t a, std::size_t b, double r, double X) { return X < reach ? V(a) * V(b) * kernel.value(r, h) : 0.0; },
        [&](std::size_t a, std::size_t b) { return 0.5 * s.spring * (modulus(a) + modulus(b)); },
        [](std::size_t, std::size_t) { return 0.0; });
    const Vector<2> found = p.mass[i] * p.acceleration[i];
    off = std::max(off, (found - expected).norm());
    size = std::max(size, expected.norm());
    const double kept = p.mass[i] * body.power()[i].artificial;
    balance += found.dot(p.velocity[i]) + kept, works += std::abs(found.dot(p.velocity[i])) + std::abs(kept);
  }
  run.measure("hourglass", off / size);
  run.measure("hourglass_power", std::abs(balance) / works);
}

}  // namespace

Problem deformed_block(const Parameters& input) {
  const Setup setup{.kernel = input.choice("kernel", kernel_names()),
                    .spacing = input.quantity("spacing", dimension::length, range::positive),
                    .ratio = input.number("h_over_dx", {0.8, 4.0}),
                    .density = input.quantity("density", dimension::density, range::positive),
                    .strain = input.number("strain", {0.0, 0.4}),
                    .spring = input.number("spring", range::positive),
                    .damper = input.number("damper", range::positive),
                    .cells = static_cast<int>(input.integer("cells", 4, 60)),
                    .seed = static_cast<std::uint64_t>(input.integer("seed", 0, 1'000'000))};
  return [=](Run& run) {
    run.count(0, static_cast<long>(2 * setup.cells * setup.cells));
    for (const char* module : {"schemes/reference_frame", "schemes/hourglass", "schemes/momentum", "schemes/velocity_gradient",
                               "schemes/kernel_correction"})
      run.exercises(module);
    in_reference(run, setup);
    in_place(run, setup);
  };
}

}  // namespace furrow::operator_cases
