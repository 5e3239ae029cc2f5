// A plane wave on a periodic lattice (Swegle, Hicks & Attaway 1995; Balsara 1995): each sum over neighbours turns it into itself
// times a number. The velocity gradient and the divergence of stress both carry the factor sum V dW/dx sin(kx)/k, so that the
// discrete body's speed of sound is that times the true one; at two spacings a wave it is zero.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "reference/exact/plane_wave.hpp"
#include "solver/schemes/density.hpp"
#include "solver/schemes/momentum.hpp"
#include "solver/schemes/velocity_gradient.hpp"
#include "solver/schemes/xsph.hpp"
#include "verification/lattices.hpp"
#include "verification/operators/largest.hpp"
#include "verification/operators/problems.hpp"

namespace furrow::operator_cases {
namespace {

using std::numbers::pi;
constexpr double density = 1000.0, stress_amplitude = 1e6, xsph_eps = 0.5;

struct Setup {
  std::string lattice;
  double spacing;                  // m
  int cells;                       // of the lattice along the wave
  std::vector<double> waves;       // in the box
};

template <int Dim>
Points<Dim> points_of(const Setup& s, double reach) {
  const auto across = [reach](double edge) { return static_cast<int>(std::ceil(2.0 * reach / edge)) + 1; };
  const double dx = s.spacing;
  if constexpr (Dim == 2) {
    if (s.lattice == "hexagonal") return hexagonal_lattice({s.cells, across(std::sqrt(3.0) * dx)}, dx, true);
    return square_lattice<2>({s.cells, across(dx)}, dx, true);
  } else {
    if (s.lattice == "fcc") return fcc_lattice({s.cells, across(std::sqrt(2.0) * dx), across(std::sqrt(2.0) * dx)}, dx, true);
    return square_lattice<3>({s.cells, across(dx), across(dx)}, dx, true);
  }
}

/// Factors by which the sums change a wave along x, and how far the result is from being that wave.
struct Response {
  double wavelength;                       // in spacings
  double speed, shear_speed;               // of a longitudinal and of a transverse wave, over the true ones
  double interpolated, smoothed;           // amplitudes left by Eq. 6 and by XSPH
  double residual;                         // Linf of result - factor * wave, relative
};

template <int Dim>
Response response(Arrangement<Dim>& a, const AnyKernel& kernel, double h, double waves) {
  Particles<Dim>& p = a.particles;
  const std::size_t n = p.size();
  const double k = 2.0 * pi * waves / a.box.length[0];
  std::vector<double> s(n), c(n), interpolated(n);
  for (std::size_t i = 0; i < n; ++i) {
    s[i] = std::sin(k * p.position[i][0]);
    c[i] = std::cos(k * p.position[i][0]);
    p.velocity[i].setZero();
    p.velocity[i][0] = p.velocity[i][1] = s[i];
    p.stress[i].setZero();
    p.stress[i](0, 0) = p.stress[i](0, 1) = p.stress[i](1, 0) = stress_amplitude * c[i];
  }
  const Stencil<Dim> stencil = a.stencil(kernel, h);
  const std::vector<double> V = a.volume();
  std::vector<Matrix<Dim>> L(n);
  std::vector<Vector<Dim>> acceleration(n), moved(n);
  std::vector<MomentumPower> power(n);
  MomentumWorkspace<Dim> workspace;
  velocity_gradient<Dim>(stencil, V, p.velocity, {}, L);
  momentum<Dim>(stencil, p, p.velocity, {}, {{}, {}, a.spacing}, workspace, acceleration, power);
  interpolate<Dim>(stencil, V, c, interpolated);
  xsph_velocity<Dim>(stencil, p, p.velocity, xsph_eps, moved);

  const double force = stress_amplitude * k / density;
  const auto factor = [n](auto&& result, const std::vector<double>& wave) {
    double product = 0.0, square = 0.0;
    for (std::size_t i = 0; i < n; ++i) product += result(i) * wave[i], square += wave[i] * wave[i];
    return product / square;
  };
  const double stretch = factor([&](std::size_t i) { return L[i](0, 0) / k; }, c);
  const double shear = factor([&](std::size_t i) { return L[i](1, 0) / k; }, c);
  const double push = factor([&](std::size_t i) { return -acceleration[i][0] / force; }, s);
  const double slide = factor([&](std::size_t i) { return -acceleration[i][1] / force; }, s);
  Response r{2.0 * pi / (k * a.spacing), std::sqrt(stretch * push), std::sqrt(shear * slide),
             factor([&](std::size_t i) { return interpolated[i]; }, c), factor([&](std::size_t i) { return moved[i][0]; }, s), 0.0};
  for (std::size_t i = 0; i < n; ++i) {
    Matrix<Dim> rest = L[i] / k;
    rest(0, 0) -= stretch * c[i];
    rest(1, 0) -= shear * c[i];
    Vector<Dim> rest_force = acceleration[i] / force;
    rest_force[0] += push * s[i];
    rest_force[1] += slide * s[i];
    r.residual = std::max({r.residual, rest.norm(), rest_force.norm(), std::abs(interpolated[i] - r.interpolated * c[i]),
                           std::abs(moved[i][0] - r.smoothed * s[i])});
  }
  return r;
}

/// The wave of two spacings, +1 and -1 by turns, which no symmetric first derivative sees: the largest that any sum makes of it.
template <int Dim>
double answer_to_shortest_wave(Arrangement<Dim>& a, const AnyKernel& kernel, double h) {
  Particles<Dim>& p = a.particles;
  std::vector<double> V = a.volume();
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double sign = static_cast<long>(std::floor(p.position[i][0] / a.spacing)) % 2 == 0 ? 1.0 : -1.0;
    p.velocity[i].setConstant(sign);
    p.stress[i].setConstant(stress_amplitude * sign);
  }
  std::vector<Matrix<Dim>> L(p.size());
  std::vector<Vector<Dim>> acceleration(p.size());
  std::vector<MomentumPower> power(p.size());
  MomentumWorkspace<Dim> workspace;
  const Stencil<Dim> stencil = a.stencil(kernel, h);
  velocity_gradient<Dim>(stencil, V, p.velocity, {}, L);
  momentum<Dim>(stencil, p, p.velocity, {}, {{}, {}, a.spacing}, workspace, acceleration, power);
  double largest = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i)
    largest = std::max({largest, L[i].norm() * a.spacing, acceleration[i].norm() * density * a.spacing / stress_amplitude});
  return largest;
}

/// Calls f with an arrangement of the right dimension, its neighbours wide enough for the largest h.
template <class F>
void with_arrangement(const Setup& s, const AnyKernel& kernel, double largest_ratio, F&& f) {
  const double reach = support(kernel) * largest_ratio * s.spacing * (1.0 + 1e-9);
  const auto in = [&]<int Dim>(std::integral_constant<int, Dim>) {
    Arrangement<Dim> a = arranged(points_of<Dim>(s, reach), density, reach);
    f(a);
  };
  if (s.lattice == "square" || s.lattice == "hexagonal")
    in(std::integral_constant<int, 2>{});
  else
    in(std::integral_constant<int, 3>{});
}

template <int Dim>
void show_wave(Run& run, const Arrangement<Dim>& a) {
  Figure& figure = run.figure({.name = "arrangement", .title = "The wave on the lattice", .kind = "particles", .x = {"x", "mm"},
                               .y = {"y", "mm"}, .colour = {"v", "m/s"}});
  figure.caption = "Part of the periodic box, with the velocity of the longest wave.";
  Series& series = figure.add({.label = "particles"});
  const double k = 2.0 * pi / (0.5 * a.box.length[0]);
  for (const Vector<Dim>& x : a.particles.position) {
    if (x[0] > 0.5 * a.box.length[0]) continue;
    if constexpr (Dim == 3)
      if (x[2] > a.spacing) continue;
    series.x.push_back(1e3 * x[0]), series.y.push_back(1e3 * x[1]), series.colour.push_back(std::sin(k * x[0]));
  }
}

}  // namespace

Problem plane_waves(const Parameters& input) {
  const std::string name = input.choice("kernel", kernel_names());
  const Setup setup{input.choice("lattice", {"square", "hexagonal", "cubic", "fcc"}),
                    input.quantity("spacing", dimension::length, range::positive), static_cast<int>(input.integer("cells", 16, 1000)),
                    input.numbers("waves", range::positive)};
  const std::vector<double> ratios = input.numbers("h_over_dx", {0.8, 4.0});
  if (ratios.empty() || setup.waves.empty()) input.fail("waves", "there must be at least one wave and one h/dx");
  for (const double waves : setup.waves)
    if (waves != std::floor(waves)) input.fail("waves", "the box is periodic: it holds a whole number of waves");
  const bool has_shortest_wave = setup.lattice == "square" || setup.lattice == "cubic";
  if (has_shortest_wave && setup.cells % 2 != 0) input.fail("cells", "the shortest wave takes two cells: an even number");

  return [=](Run& run) {
    const AnyKernel kernel = *kernel_by_name(name);
    const int dim = setup.lattice == "square" || setup.lattice == "hexagonal" ? 2 : 3;
    const exact::Kernel truth = exact::kernel(name, dim);
    for (const char* module : {"velocity_gradient", "momentum", "density", "xsph"}) run.exercises(std::string("schemes/") + module);

    Table& table = run.table("wave_speed", "Speed of the discrete body's longitudinal wave over the true one", {{"h/dx"}});
    Figure& figure = run.figure({.name = "dispersion", .title = "Numerical dispersion", .x = {"waves per spacing, dx/lambda"}, .y = {"c/c0"}});
    figure.caption = "Short waves are too slow; the lattice sum (lines) and what the solver's sums give (points).";
    Largest speed, shear, interpolated, smoothed, residual, shortest;
    with_arrangement(setup, kernel, *std::max_element(ratios.begin(), ratios.end()), [&](auto& a) {
      show_wave(run, a);
      run.count(0, static_cast<long>(a.particles.size()));
      for (const double ratio : ratios) {
        const double unity = exact::lattice_norms(setup.lattice, truth, ratio).unity;
        std::vector<Cell> cells{ratio};
        Series computed{.label = "h/dx = " + std::to_string(ratio).substr(0, 3)};
        Series curve{.label = computed.label + ", lattice sum", .role = "reference"};
        for (const double waves : setup.waves) {
          const Response r = response(a, kernel, ratio * setup.spacing, waves);
          const exact::PlaneWaveFactors f = exact::plane_wave_factors(setup.lattice, truth, ratio, {2.0 * pi / r.wavelength, 0.0, 0.0});
          const double expected = exact::lattice_wave_speed(setup.lattice, truth, ratio, r.wavelength);
          speed.add(r.speed - expected);
          shear.add(r.shear_speed - expected);
          interpolated.add(r.interpolated - f.value);
          smoothed.add(r.smoothed - (1.0 + xsph_eps * (f.value - unity)));
          residual.add(r.residual);
          if (ratio == ratios.front()) table.columns.push_back({"lambda/dx = " + std::to_string(r.wavelength).substr(0, 5)});
          cells.emplace_back(r.speed);
          computed.x.push_back(1.0 / r.wavelength), computed.y.push_back(r.speed);
        }
        if (has_shortest_wave) shortest.add(answer_to_shortest_wave(a, kernel, ratio * setup.spacing));
        for (int i = 1; i <= 60; ++i) {
          curve.x.push_back(0.5 * i / 60.0);
          curve.y.push_back(exact::lattice_wave_speed(setup.lattice, truth, ratio, 120.0 / i));
        }
        table.row(std::move(cells));
        figure.add(std::move(curve));
        figure.add(std::move(computed));
      }
    });
    run.measure("wave_speed", speed.value());
    run.measure("shear_wave_speed", shear.value());
    run.measure("interpolation", interpolated.value());
    run.measure("xsph", smoothed.value());
    run.measure("residual", residual.value());
    if (has_shortest_wave) run.measure("shortest_wave", shortest.value());
  };
}

Problem tabulated_wave_speeds(const Parameters& input) {
  const Setup setup{"square", input.quantity("spacing", dimension::length, range::positive),
                    static_cast<int>(input.integer("cells", 16, 1000)), input.numbers("waves", range::positive)};
  struct Row {
    std::string kernel;
    double ratio, gradient_norm;
    std::vector<double> speed;
  };
  std::vector<Row> rows;
  for (const Parameters& row : input.tables("rows")) {
    rows.push_back({row.choice("kernel", kernel_names()), row.number("h_over_dx", {0.8, 4.0}), row.number("gradient_norm", range::positive),
                    row.numbers("speed", {0.0, 2.0})});
    if (rows.back().speed.size() != setup.waves.size()) row.fail("speed", "as many speeds as there are waves");
  }
  if (rows.empty()) input.fail("rows", "the table must have a row");

  return [=](Run& run) {
    run.exercises("schemes/velocity_gradient");
    run.exercises("schemes/momentum");
    Table& table = run.table("against_print", "c/c0: computed - printed", {{"kernel"}, {"h/dx"}});
    Largest worst, worst_norm;
    for (const Row& row : rows) {
      const AnyKernel kernel = *kernel_by_name(row.kernel);
      std::vector<Cell> cells{row.kernel, row.ratio};
      with_arrangement(setup, kernel, row.ratio, [&]<int Dim>(Arrangement<Dim>& a) {
        for (std::size_t w = 0; w < setup.waves.size(); ++w) {
          const Response r = response(a, kernel, row.ratio * setup.spacing, setup.waves[w]);
          worst.add(r.speed - row.speed[w]);
          if (&row == &rows.front()) table.columns.push_back({"lambda/dx = " + std::to_string(r.wavelength).substr(0, 4)});
          cells.emplace_back(r.speed - row.speed[w]);
        }
        Particles<Dim>& p = a.particles;
        std::vector<Matrix<Dim>> L(p.size());
        for (std::size_t i = 0; i < p.size(); ++i) {   // dv_x/dy in a box that is periodic: only the particles half-way up count
          p.velocity[i].setZero();
          p.velocity[i][0] = p.position[i][1];
        }
        velocity_gradient<Dim>(a.stencil(kernel, row.ratio * setup.spacing), a.volume(), p.velocity, {}, L);
        for (std::size_t i = 0; i < p.size(); ++i) {
          if (std::abs(p.position[i][1] - 0.5 * a.box.length[1]) > 0.6 * a.spacing) continue;
          worst_norm.add(L[i](0, 1) - row.gradient_norm);
        }
      });
      table.row(std::move(cells));
    }
    run.measure("wave_speed", worst.value());
    run.measure("gradient_norm", worst_norm.value());
  };
}

}  // namespace furrow::operator_cases
