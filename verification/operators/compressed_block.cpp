// A block squeezed evenly from all sides, its particles moved as they should: density must follow rho_0/J, J the ratio of areas.
// The paper calls Eq. 7 the conservation of mass. It is a Shepard average, of which a uniform density is the fixed point: squeezed
// by whatever factor, the block keeps its density, and no pressure ever develops from it. Continuity follows rho_0/J.
#include <algorithm>
#include <cmath>
#include <string>

#include "reference/exact/lattice.hpp"
#include "solver/schemes/density.hpp"
#include "solver/schemes/kernel_correction.hpp"
#include "solver/schemes/velocity_gradient.hpp"
#include "verification/lattices.hpp"
#include "verification/operators/largest.hpp"
#include "verification/operators/problems.hpp"

namespace furrow::operator_cases {
namespace {

struct Setup {
  std::string kernel;
  double spacing, ratio, density, compression;   // compression: J at the end
  int cells, steps;
};

/// Continuity, d rho/dt = -rho tr L, of every particle over one step under the flow v = -rate x, by Runge and Kutta's fourth-order
/// rule. Positions shrink by exp(-rate dt); h stays, as it does for the solver's particles.
class Continuity {
 public:
  Continuity(const Arrangement<2>& a, const AnyKernel& kernel, double h, bool corrected)
      : kernel_(kernel), h_(h), corrected_(corrected), a_(a), density_(a.particles.density) {}

  const std::vector<double>& density() const { return density_; }

  void step(double rate, double dt) {
    const double half = std::exp(-0.5 * rate * dt);
    const std::vector<double> k1 = rates(density_, rate);
    shrink(half);
    const std::vector<double> k2 = rates(moved(k1, 0.5 * dt), rate), k3 = rates(moved(k2, 0.5 * dt), rate);
    shrink(half);
    const std::vector<double> k4 = rates(moved(k3, dt), rate);
    for (std::size_t i = 0; i < density_.size(); ++i) density_[i] += dt / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
  }

 private:
  void shrink(double factor) {
    for (Vector<2>& x : a_.particles.position) x *= factor;
  }
  std::vector<double> moved(const std::vector<double>& slope, double dt) const {
    std::vector<double> at = density_;
    for (std::size_t i = 0; i < at.size(); ++i) at[i] += dt * slope[i];
    return at;
  }
  std::vector<double> rates(const std::vector<double>& density, double rate) {
    Particles<2>& p = a_.particles;
    const std::size_t n = p.size();
    std::vector<double> V(n), result(n);
    for (std::size_t i = 0; i < n; ++i) {
      V[i] = p.mass[i] / density[i];
      p.velocity[i] = -rate * p.position[i];
    }
    const Stencil<2> stencil = a_.stencil(kernel_, h_);
    std::vector<Matrix<2>> B, L(n);
    if (corrected_) {
      B.resize(n);
      kernel_correction<2>(stencil, V, B);
    }
    velocity_gradient<2>(stencil, V, p.velocity, B, L);
    for (std::size_t i = 0; i < n; ++i) result[i] = density_rate<2>(density[i], L[i]);
    return result;
  }

  AnyKernel kernel_;
  double h_;
  bool corrected_;
  Arrangement<2> a_;
  std::vector<double> density_;
};

}  // namespace

Problem compressed_block(const Parameters& input) {
  const Setup setup{.kernel = input.choice("kernel", kernel_names()),
                    .spacing = input.quantity("spacing", dimension::length, range::positive),
                    .ratio = input.number("h_over_dx", {0.8, 4.0}),
                    .density = input.quantity("density", dimension::density, range::positive),
                    .compression = input.number("area_ratio", {0.3, 1.0, false, true}),
                    .cells = static_cast<int>(input.integer("cells", 8, 200)),
                    .steps = static_cast<int>(input.integer("steps", 8, 1000))};
  return [=](Run& run) {
    const AnyKernel kernel = *kernel_by_name(setup.kernel);
    const double h = setup.ratio * setup.spacing, shrunk = std::sqrt(setup.compression);
    // Neighbours of the start with a reach that holds those of the end.
    Points<2> points = square_lattice<2>({setup.cells, setup.cells}, setup.spacing, false);
    for (Vector<2>& x : points.position) x -= Vector<2>::Constant(0.5 * setup.cells * setup.spacing);
    Arrangement<2> a = arranged(points, setup.density, support(kernel) * h / shrunk * (1.0 + 1e-9));
    Particles<2>& p = a.particles;
    const std::size_t n = p.size();
    run.count(setup.steps, static_cast<long>(n));
    for (const char* module : {"density", "velocity_gradient", "kernel_correction"}) run.exercises(std::string("schemes/") + module);

    Continuity corrected(a, kernel, h, true), plain(a, kernel, h, false);
    const std::vector<Vector<2>> start = p.position;
    std::vector<double> shepard(n, setup.density), before(n), summed(n);
    const std::size_t centre = static_cast<std::size_t>(
        std::min_element(start.begin(), start.end(), [](const Vector<2>& x, const Vector<2>& y) { return x.squaredNorm() < y.squaredNorm(); }) -
        start.begin());
    const std::size_t corner = static_cast<std::size_t>(
        std::max_element(start.begin(), start.end(), [](const Vector<2>& x, const Vector<2>& y) { return x.sum() < y.sum(); }) - start.begin());

    Table& table = run.table("densities", "Density over its start at the centre of the block",
                             {{"J"}, {"exact, 1/J"}, {"continuity, corrected"}, {"continuity, plain"}, {"Eq. 7"}, {"Eq. 6"}, {"Eq. 6, corner"}});
    Series exact{.label = "1/J", .role = "reference"}, by_continuity{.label = "continuity, corrected"}, by_plain{.label = "continuity, plain, centre"},
        by_shepard{.label = "Eq. 7 alone (Shepard)"}, by_sum{.label = "Eq. 6, centre"}, by_corner{.label = "Eq. 6, corner"};
    Largest shepard_moved, shepard_missing, continuity_error;
    const double rate = 1.0, dt = -0.5 * std::log(setup.compression) / (rate * setup.steps);
    for (int k = 0; k <= setup.steps; ++k) {
      if (k > 0) {
        corrected.step(rate, dt);
        plain.step(rate, dt);
      }
      const double stretch = std::exp(-rate * dt * k), J = stretch * stretch;
      for (std::size_t i = 0; i < n; ++i) p.position[i] = stretch * start[i];
      const Stencil<2> stencil = a.stencil(kernel, h);
      before = shepard;
      shepard_density<2>(stencil, p.mass, before, shepard);
      summation_density<2>(stencil, p.mass, summed);
      for (std::size_t i = 0; i < n; ++i) {
        shepard_moved.add(shepard[i] / setup.density - 1.0);
        continuity_error.add(corrected.density()[i] * J / setup.density - 1.0);
        if (k == setup.steps) shepard_missing.add(shepard[i] * J / setup.density);
      }
      const auto over = [&](double density) { return density / setup.density; };
      exact.x.push_back(J), exact.y.push_back(1.0 / J);
      for (auto [series, density] : {std::pair{&by_continuity, corrected.density()[centre]}, {&by_plain, plain.density()[centre]},
                                     {&by_shepard, shepard[centre]}, {&by_sum, summed[centre]}, {&by_corner, summed[corner]}})
        series->x.push_back(J), series->y.push_back(over(density));
      if (k % std::max(1, setup.steps / 8) == 0)
        table.row({J, 1.0 / J, over(corrected.density()[centre]), over(plain.density()[centre]), over(shepard[centre]), over(summed[centre]), over(summed[corner])});
    }
    Figure& figure = run.figure({.name = "density", .title = "Density of a squeezed block", .kind = "lines", .x = {"J, area over area at the start"},
                                 .y = {"density over density at the start"}});
    figure.caption = "Eq. 7 alone does not see the compression. Summation (Eq. 6) sees it, and the free corner as well.";
    figure.series = {exact, by_continuity, by_plain, by_shepard, by_sum, by_corner};
    Figure& picture = run.figure({.name = "block", .title = "The block at the end, density by summation (Eq. 6)", .kind = "particles", .x = {"x", "mm"},
                                  .y = {"y", "mm"}, .colour = {"rho J/rho_0"}});
    picture.caption = "One is right. The missing neighbours at the edges read as missing mass.";
    Series& cloud = picture.add({.label = "particles"});
    for (std::size_t i = 0; i < n; ++i)
      cloud.x.push_back(1e3 * p.position[i][0]), cloud.y.push_back(1e3 * p.position[i][1]), cloud.colour.push_back(summed[i] * setup.compression / setup.density);

    run.measure("shepard_change", shepard_moved.value());
    run.measure("shepard_over_exact", shepard_missing.value(), "1", {setup.compression, 0.0});
    run.measure("continuity", continuity_error.value());
    const double unity = exact::lattice_norms("square", exact::kernel(setup.kernel, 2), setup.ratio / shrunk).unity;
    run.measure("summation_centre", summed[centre] * setup.compression / setup.density, "1", {unity, 0.0});
    run.measure("summation_corner", summed[corner] * setup.compression / setup.density);
    run.measure("continuity_plain_centre", plain.density()[centre] * setup.compression / setup.density);
  };
}

}  // namespace furrow::operator_cases
