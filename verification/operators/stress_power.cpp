// The energy of a uniform deformation under a uniform stress: every kilogram takes up sigma:L/rho, and what the particles take up
// together is the work that is done on them. The paper's Eq. 9 has the viscosity of a fluid in its place (Monaghan 2005, Eq. 2.33).
#include <algorithm>
#include <cmath>
#include <string>

#include "reference/exact/lattice.hpp"
#include "solver/schemes/kernel_correction.hpp"
#include "solver/schemes/momentum.hpp"
#include "verification/lattices.hpp"
#include "verification/operators/largest.hpp"
#include "verification/operators/problems.hpp"

namespace furrow::operator_cases {
namespace {

struct Motion {
  const char* name;
  Tensor L, stress;   // 1/s, Pa
};

std::vector<Motion> motions() {
  Tensor squeeze = Tensor::Zero(), pull = Tensor::Zero(), shear = Tensor::Zero(), general, stress;
  squeeze(0, 0) = squeeze(1, 1) = -50.0;
  pull(0, 0) = 80.0;
  shear(0, 1) = 100.0;
  general << 20.0, -70.0, 0.0, 110.0, -60.0, 0.0, 0.0, 0.0, 0.0;
  stress << 3e6, 2e6, 0.0, 2e6, -5e6, 0.0, 0.0, 0.0, -1e6;
  return {{"even compression under pressure", squeeze, -4e6 * Tensor::Identity()},
          {"uniaxial strain under a general stress", pull, stress},
          {"simple shear under a general stress", shear, stress},
          {"any motion under a general stress", general, stress}};
}

}  // namespace

Problem stress_power(const Parameters& input) {
  const std::string name = input.choice("kernel", kernel_names());
  const double spacing = input.quantity("spacing", dimension::length, range::positive), ratio = input.number("h_over_dx", {0.8, 4.0});
  const double density = input.quantity("density", dimension::density, range::positive);
  const int cells = static_cast<int>(input.integer("cells", 8, 300));
  if (const double supports = support(*kernel_by_name(name)) * ratio; cells < 4.0 * supports + 2.0)
    input.fail("cells", "particles inside must have neighbours that have all their neighbours: at least four supports across");

  return [=](Run& run) {
    run.exercises("schemes/momentum");
    run.exercises("schemes/kernel_correction");
    const AnyKernel kernel = *kernel_by_name(name);
    const double h = ratio * spacing, reach = support(kernel) * h;
    Arrangement<2> a = arranged(square_lattice<2>({cells, cells}, spacing, false), density, reach * (1.0 + 1e-9));
    Particles<2>& p = a.particles;
    const std::size_t n = p.size();
    run.count(0, static_cast<long>(n));
    const Stencil<2> stencil = a.stencil(kernel, h);
    std::vector<Matrix<2>> B(n);
    kernel_correction<2>(stencil, a.volume(), B);
    const double norm = exact::lattice_norms("square", exact::kernel(name, 2), ratio).gradient;
    const auto depth = [&](std::size_t i) {   // distance to the nearest edge particle
      const Vector<2> x = p.position[i] - Vector<2>::Constant(0.5 * spacing), y = Vector<2>::Constant((cells - 1) * spacing) - x;
      return std::min(x.minCoeff(), y.minCoeff());
    };

    Table& table = run.table("powers", "Power over sigma:L",
                             {{"motion"}, {"sigma:L/rho", "W/kg"}, {"paper's form, inside"}, {"paper's form, whole block"}, {"dual form, inside"}, {"dual form, whole block"}});
    Largest paper_inside, dual_inside, dual_whole, paper_whole;
    for (const Motion& motion : motions()) {
      const double expected = double_contraction(motion.stress, motion.L) / density;
      for (std::size_t i = 0; i < n; ++i) {
        p.velocity[i] = motion.L.topLeftCorner<2, 2>() * p.position[i];
        p.stress[i] = motion.stress;
      }
      std::vector<Vector<2>> acceleration(n);
      std::vector<MomentumPower> paper(n), dual(n);
      MomentumWorkspace<2> workspace;
      momentum<2>(stencil, p, p.velocity, {}, {{}, {}, spacing}, workspace, acceleration, paper);
      momentum<2>(stencil, p, p.velocity, B, {{}, {}, spacing}, workspace, acceleration, dual);
      double paper_sum = 0.0, dual_sum = 0.0, paper_centre = 0.0, dual_centre = 0.0, deepest = -1.0;
      for (std::size_t i = 0; i < n; ++i) {
        paper_sum += paper[i].stress / expected / static_cast<double>(n);
        dual_sum += dual[i].stress / expected / static_cast<double>(n);
        if (depth(i) >= reach) paper_inside.add(paper[i].stress / expected - norm);
        if (depth(i) >= 2.0 * reach) dual_inside.add(dual[i].stress / expected - 1.0);
        if (depth(i) > deepest) deepest = depth(i), paper_centre = paper[i].stress / expected, dual_centre = dual[i].stress / expected;
      }
      dual_whole.add(dual_sum - 1.0);
      paper_whole.add(paper_sum - 1.0);
      table.row({motion.name, expected, paper_centre, paper_sum, dual_centre, dual_sum});
      if (table.rows.size() == 1) {
        Figure& figure = run.figure({.name = "power", .title = motion.name, .kind = "particles", .x = {"x", "mm"},
                                     .y = {"y", "mm"}, .colour = {"power over sigma:L/rho"}});
        figure.caption = "Where the paper's form puts the power; one is right. Particles at an edge take up too little.";
        Series& series = figure.add({.label = "particles"});
        for (std::size_t i = 0; i < n; ++i)
          series.x.push_back(1e3 * p.position[i][0]), series.y.push_back(1e3 * p.position[i][1]), series.colour.push_back(paper[i].stress / expected);
      }
    }
    run.measure("paper_form_inside", paper_inside.value());
    run.measure("dual_form_inside", dual_inside.value());
    run.measure("dual_form_whole_block", dual_whole.value());
    run.measure("paper_form_whole_block", paper_whole.value());
  };
}

}  // namespace furrow::operator_cases
