// A kernel summed over particles. In the continuum int W dV = 1, int grad W dV = 0, int (x' - x) (x) grad W dV' = I; a sum over
// particles misses all three by what the arrangement and h/dx decide, and at fixed h/dx no refinement mends it (Quinlan, Basa &
// Lastiwka 2006). With the corrected gradient (Bonet & Lok 1999) linear fields are exact on any arrangement, edges included.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>

#include "verification/kernel/arrangements.hpp"
#include "verification/kernel/consistency.hpp"
#include "verification/kernel/problems.hpp"

namespace furrow::kernel_cases {
namespace {

struct Input {
  std::string kernel;
  double spacing;               // dx, m
  std::vector<double> ratios;   // h/dx
  double shown;                 // the h/dx, one of the ratios, at which single numbers are metrics
  int across;                   // spacings along an edge of the box
  unsigned seed;
};

/// The particles (in space: of one layer) coloured by their partition of unity.
template <int Dim>
void draw(Run& run, const Sample<Dim>& sample, const Arrangement<Dim>& solver, const std::vector<KernelSums<Dim>>& sums,
          double ratio) {
  Series particles{.label = sample.name};
  for (std::size_t k = 0; k < sums.size(); ++k) {
    const Vector<Dim>& x = solver.particles.position[k];
    if (Dim == 3 && x[Dim - 1] > sample.points.spacing) continue;
    particles.x.push_back(1e3 * x[0]), particles.y.push_back(1e3 * x[1]), particles.colour.push_back(sums[k].unity);
  }
  std::string name = "particles-" + sample.name;
  std::erase_if(name, [](char c) { return c == ' ' || c == '%'; });
  Figure& figure = run.figure({.name = name, .title = "Partition of unity, " + sample.name, .kind = "particles"});
  figure.caption = fmt::format("sum V W of each particle at h/dx = {}{}.", ratio, Dim == 3 ? ", the lowest layer" : "");
  figure.x = {"x", "mm"}, figure.y = {"y", "mm"}, figure.colour = {"sum V W"};
  figure.add(particles);
}

template <int Dim>
void run_discrete(Run& run, const Input& in) {
  const AnyKernel kernel = *kernel_by_name(in.kernel);
  const exact::Kernel truth = exact::kernel(in.kernel, Dim);
  run.exercises("smoothing/" + in.kernel);
  for (const char* module : {"particles/neighbours", "schemes/kernel_correction", "schemes/velocity_gradient"}) {
    run.exercises(module);
  }

  Table& table = run.table("consistency", "Errors of the sums over the particles of a periodic box",
                           {{"arrangement"}, {"h/dx"}, {"neighbours"}, {"|sum V W - 1| L1"}, {"L2"}, {"Linf"},
                            {"h |sum V grad W| L1"}, {"L2"}, {"Linf"}, {"|sum V x grad W - I| L1"}, {"L2"}, {"Linf"}});
  const char* caption = "L2 norm over the particles. On perfect lattices it falls steeply with h/dx; disorder sets a floor.";
  const auto figure = [&](const char* name, const char* title, const char* y) -> Figure& {
    return run.figure({.name = name, .title = title, .caption = caption, .x = {"h/dx"}, .y = {y}, .log_y = true});
  };
  Figure& unity_figure = figure("unity", "Partition of unity", "|sum V W - 1|");
  Figure& constant_figure = figure("constant", "Gradient of a constant field", "h |sum V grad W|");
  Figure& linear_figure = figure("linear", "Gradient of a linear field", "|sum V x grad W - I|");

  Largest all_pairs, lattice_sums, lattice_constant, corrected_linear, plain_linear;
  std::map<std::string, Consistency> shown;
  for (const Sample<Dim>& sample : samples<Dim>(in.spacing, in.across, in.seed)) {
    Series unity{.label = sample.name}, constant{.label = sample.name}, linear{.label = sample.name};
    for (const double ratio : in.ratios) {
      const double h = ratio * in.spacing;
      const Arrangement<Dim> solver = arranged(sample.points, 1.0, support(kernel) * h);
      const std::vector<double> volume = solver.volume();
      std::vector<KernelSums<Dim>> sums(volume.size());
      kernel_sums<Dim>(solver.stencil(kernel, h), volume, sums);
      const Consistency c = consistency<Dim>(sums, volume, h);

      compare(solver, sums, sample.points, truth, h, all_pairs);
      add_edge_errors(kernel, sample.points, h, plain_linear, corrected_linear);
      if (!sample.lattice.empty()) {
        const exact::LatticeNorms perfect = exact::lattice_norms(sample.lattice, truth, ratio);
        for (const KernelSums<Dim>& s : sums) {
          lattice_sums.add(s.unity - perfect.unity);
          lattice_sums.add((s.linear - perfect.gradient * Matrix<Dim>::Identity()).norm());
        }
        lattice_constant.add(c.constant.linf);
        if (ratio == in.shown && shown.empty()) run.measure("gradient_norm", sums[0].linear(0, 0), "1", {perfect.gradient, 0.0});
      }
      if (ratio == in.shown) {
        shown[sample.name] = c;
        if (sample.lattice.empty()) draw(run, sample, solver, sums, ratio);
      }

      const auto& n = solver.neighbours.count;
      const double neighbours = std::accumulate(n.begin(), n.end(), 0.0) / static_cast<double>(n.size());
      std::vector<Cell> row{sample.name, ratio, neighbours};
      for (const FieldNorms& e : {c.unity, c.constant, c.linear}) row.insert(row.end(), {e.l1, e.l2, e.linf});
      table.row(row);
      for (const auto& [curve, e] : {std::pair{&unity, c.unity}, {&constant, c.constant}, {&linear, c.linear}}) {
        curve->x.push_back(ratio), curve->y.push_back(e.l2);
      }
    }
    unity_figure.add(unity);
    linear_figure.add(linear);
    if (sample.lattice.empty()) constant_figure.add(constant);   // round-off on a lattice
  }
  run.measure("all_pairs", all_pairs.magnitude);
  run.measure("lattice_sums", lattice_sums.magnitude);
  run.measure("lattice_constant", lattice_constant.magnitude);
  run.measure("corrected_linear", corrected_linear.magnitude);
  run.measure("plain_linear", plain_linear.magnitude);
  run.measure("disorder_order", std::log2(shown.at("jittered 10 %").constant.l2 / shown.at("jittered 5 %").constant.l2));
  run.measure("relaxed_unity", shown.at("relaxed").unity.l2);
  run.measure("relaxed_linear", shown.at("relaxed").linear.l2);
}

}  // namespace

Problem discrete(const Parameters& input) {
  const long dimension = input.integer("dimension", 2, 3);
  Input in{.kernel = input.choice("kernel", kernel_names()),
           .spacing = input.quantity("spacing", dimension::length, range::positive),
           .ratios = input.numbers("h_over_dx", {0.8, 3.0}),
           .shown = input.number("shown_h_over_dx", {0.8, 3.0}),
           .across = 0,
           .seed = static_cast<unsigned>(input.integer("seed", 0, 1000000))};
  if (std::find(in.ratios.begin(), in.ratios.end(), in.shown) == in.ratios.end()) {
    input.fail("shown_h_over_dx", "must be one of the numbers of h_over_dx");
  }
  // Enough particles for a mean, and a box twice as wide as the largest support.
  const double particles = static_cast<double>(input.integer("particles", 16, 100000));
  const double widest = support(*kernel_by_name(in.kernel)) * *std::max_element(in.ratios.begin(), in.ratios.end());
  const double along_edge = std::pow(particles, 1.0 / static_cast<double>(dimension));
  in.across = static_cast<int>(std::ceil(std::max(along_edge, 2.0 * widest) - 1e-9));
  return [=](Run& run) { dimension == 2 ? run_discrete<2>(run, in) : run_discrete<3>(run, in); };
}

}  // namespace furrow::kernel_cases
