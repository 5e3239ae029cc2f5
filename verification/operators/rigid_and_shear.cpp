// A block with free edges that turns as a rigid body, and the same block in uniform shear (paper Eqs 12, 13). Rotation must not
// strain, shear must turn with half its rate. A corrected gradient is exact for both up to the edges; the plain sum is off by the
// lattice's gradient norm inside, and by half and more at the edges.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "reference/exact/lattice.hpp"
#include "solver/schemes/kernel_correction.hpp"
#include "solver/schemes/velocity_gradient.hpp"
#include "verification/lattices.hpp"
#include "verification/operators/largest.hpp"
#include "verification/operators/problems.hpp"

namespace furrow::operator_cases {
namespace {

constexpr double rate = 100.0;   // of rotation and of shear, 1/s

struct Setup {
  std::string kernel, arrangement;
  double spacing, ratio, jitter;
  int cells;
  std::uint64_t seed;
  bool plane() const { return arrangement == "square" || arrangement == "hexagonal" || arrangement == "jittered_square"; }
  bool lattice() const { return jitter == 0.0; }
};

template <int Dim>
Points<Dim> block(const Setup& s) {
  const auto over = [&s](double edge) { return std::max(1, static_cast<int>(std::lround(s.cells / edge))); };
  Points<Dim> points;
  if constexpr (Dim == 2)
    points = s.arrangement == "hexagonal" ? hexagonal_lattice({s.cells, over(std::sqrt(3.0))}, s.spacing, false)
                                          : square_lattice<2>({s.cells, s.cells}, s.spacing, false);
  else
    points = s.arrangement == "fcc" ? fcc_lattice(all_axes<3>(over(std::sqrt(2.0))), s.spacing, false)
                                    : square_lattice<3>(all_axes<3>(s.cells), s.spacing, false);
  return s.lattice() ? points : jittered(points, s.jitter, s.seed);
}

/// dv/dx of a turn about an axis that favours no direction of the lattice.
template <int Dim>
Matrix<Dim> turning() {
  Matrix<Dim> W;
  if constexpr (Dim == 2)
    W << 0.0, -1.0, 1.0, 0.0;
  else
    W << 0.0, -0.48, 0.64, 0.48, 0.0, -0.6, -0.64, 0.6, 0.0;
  return rate * W;
}

/// dv_x/dy and, in space, dv_y/dz.
template <int Dim>
Matrix<Dim> shearing() {
  Matrix<Dim> L = Matrix<Dim>::Zero();
  L(0, 1) = rate;
  if constexpr (Dim == 3) L(1, 2) = -0.5 * rate;
  return L;
}

template <int Dim>
Matrix<Dim> symmetric(const Matrix<Dim>& L) { return 0.5 * (L + L.transpose()); }
template <int Dim>
Matrix<Dim> skew(const Matrix<Dim>& L) { return 0.5 * (L - L.transpose()); }

template <int Dim>
void run_block(Run& run, const Setup& s) {
  const AnyKernel kernel = *kernel_by_name(s.kernel);
  const double h = s.ratio * s.spacing, reach = support(kernel) * h;
  Arrangement<Dim> a = arranged(block<Dim>(s), 1000.0, reach * (1.0 + 1e-9));
  const Stencil<Dim> stencil = a.stencil(kernel, h);
  Particles<Dim>& p = a.particles;
  const std::size_t n = p.size();
  const std::vector<double> V = a.volume();
  std::vector<Matrix<Dim>> B(n), plain(n), corrected(n);
  kernel_correction<Dim>(stencil, V, B);
  run.count(0, static_cast<long>(n));

  Vector<Dim> low = p.position[0], high = low;
  for (const Vector<Dim>& x : p.position) low = low.cwiseMin(x), high = high.cwiseMax(x);
  const auto inside = [&](std::size_t i) {   // a whole support around it
    return ((p.position[i] - low).array() >= reach).all() && ((high - p.position[i]).array() >= reach).all();
  };
  const auto gradients_of = [&](const Matrix<Dim>& L) {
    for (std::size_t i = 0; i < n; ++i) p.velocity[i] = L * (p.position[i] - 0.5 * (low + high));
    velocity_gradient<Dim>(stencil, V, p.velocity, {}, plain);
    velocity_gradient<Dim>(stencil, V, p.velocity, B, corrected);
  };
  Table& table = run.table("errors", "Largest error over the rate", {{"motion"}, {"error of"}, {"corrected, everywhere"}, {"plain, inside"}, {"plain, edges included"}});
  // Errors over the rate of the motion: of the corrected sum anywhere, of the plain one inside and anywhere.
  const auto errors_of = [&](const char* motion, const char* what, const auto& error) {
    Largest best, inner, edge;
    for (std::size_t i = 0; i < n; ++i) {
      best.add(error(corrected[i]) / rate);
      edge.add(error(plain[i]) / rate);
      if (inside(i)) inner.add(error(plain[i]) / rate);
    }
    table.row({motion, what, best.value(), inner.value(), edge.value()});
    return std::array{best.value(), inner.value(), edge.value()};
  };

  const Matrix<Dim> W = turning<Dim>();
  gradients_of(W);
  const auto strain = errors_of("rigid rotation", "strain rate", [](const Matrix<Dim>& L) { return symmetric<Dim>(L).norm(); });
  const auto spin = errors_of("rigid rotation", "spin", [&](const Matrix<Dim>& L) { return (skew<Dim>(L) - W).norm(); });
  Figure& figure = run.figure({.name = "rotation", .title = "Strain rate of a block that only turns, plain sum", .kind = "particles",
                               .x = {"x", "mm"}, .y = {"y", "mm"}, .colour = {"|D|/omega"}});
  figure.caption = "Zero is right. The corrected sum gives zero everywhere.";
  Series& series = figure.add({.label = "particles"});
  for (std::size_t i = 0; i < n; ++i) {
    if (Dim == 3 && std::abs(p.position[i][Dim - 1] - 0.5 * (low + high)[Dim - 1]) > 0.5 * s.spacing) continue;
    series.x.push_back(1e3 * p.position[i][0]), series.y.push_back(1e3 * p.position[i][1]);
    series.colour.push_back(symmetric<Dim>(plain[i]).norm() / rate);
  }

  const Matrix<Dim> L = shearing<Dim>();
  gradients_of(L);
  const auto shear_spin = errors_of("uniform shear", "spin", [&](const Matrix<Dim>& m) { return (skew<Dim>(m) - skew<Dim>(L)).norm(); });
  const auto shear_strain = errors_of("uniform shear", "strain rate", [&](const Matrix<Dim>& m) { return (symmetric<Dim>(m) - symmetric<Dim>(L)).norm(); });

  run.measure("rotation_strain_rate", strain[0]);
  run.measure("rotation_spin", spin[0]);
  run.measure("shear_spin", shear_spin[0]);
  run.measure("shear_strain_rate", shear_strain[0]);
  run.measure("plain_rotation_strain_rate_edge", strain[2]);
  run.measure("plain_shear_spin_edge", shear_spin[2]);
  if (s.lattice()) {
    const double norm = exact::lattice_norms(s.arrangement, exact::kernel(s.kernel, Dim), s.ratio).gradient;
    run.measure("plain_rotation_strain_rate", strain[1]);
    run.measure("plain_shear_spin", shear_spin[1], "1", {std::abs(norm - 1.0) * skew<Dim>(L).norm() / rate, 0.0});
  } else {
    run.measure("plain_rotation_strain_rate_inside", strain[1]);
  }
}

}  // namespace

Problem rigid_and_shear(const Parameters& input) {
  const std::string arrangement = input.choice("arrangement", {"square", "hexagonal", "jittered_square", "cubic", "fcc", "jittered_cubic"});
  const bool disordered = arrangement.starts_with("jittered");
  const double jitter = input.number("jitter", {0.0, 0.3, true, false});   // of the arrangements that are jittered
  const Setup setup{.kernel = input.choice("kernel", kernel_names()),
                    .arrangement = arrangement,
                    .spacing = input.quantity("spacing", dimension::length, range::positive),
                    .ratio = input.number("h_over_dx", {0.8, 4.0}),
                    .jitter = disordered ? jitter : 0.0,
                    .cells = static_cast<int>(input.integer("cells", 4, 500)),
                    .seed = static_cast<std::uint64_t>(input.integer("seed", 0, 1'000'000))};
  return [=](Run& run) {
    run.exercises("schemes/velocity_gradient");
    run.exercises("schemes/kernel_correction");
    if (setup.plane())
      run_block<2>(run, setup);
    else
      run_block<3>(run, setup);
  };
}

}  // namespace furrow::operator_cases
