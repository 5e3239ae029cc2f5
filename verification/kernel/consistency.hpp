// What the solver's sums make of one, of a constant and of a linear field, and how far that is from the truth.
#pragma once

#include <span>
#include <vector>

#include "harness/norms.hpp"
#include "reference/exact/lattice.hpp"
#include "solver/schemes/kernel_correction.hpp"
#include "solver/schemes/velocity_gradient.hpp"
#include "verification/kernel/largest.hpp"
#include "verification/lattices.hpp"

namespace furrow::kernel_cases {

/// Norms over all particles of the errors of the three sums, made dimensionless with h.
struct Consistency {
  FieldNorms unity, constant, linear;
};

template <int Dim>
Consistency consistency(const std::vector<KernelSums<Dim>>& sums, const std::vector<double>& volume, double h) {
  std::vector<double> unity, constant, linear;
  for (const KernelSums<Dim>& s : sums) {
    unity.push_back(s.unity - 1.0);
    constant.push_back(h * s.constant.norm());
    linear.push_back((s.linear - Matrix<Dim>::Identity()).norm());
  }
  return {norms(unity, volume), norms(constant, volume), norms(linear, volume)};
}

/// Adds the differences between the solver's sums and those over all pairs of the points that it was given.
template <int Dim>
void compare(const Arrangement<Dim>& solver, const std::vector<KernelSums<Dim>>& sums, const Points<Dim>& points,
             const exact::Kernel& truth, double h, Largest& most) {
  const auto point = [](const Vector<Dim>& x) { return exact::Point{x[0], x[1], Dim == 3 ? x[Dim - 1] : 0.0}; };
  std::vector<exact::Point> x;
  for (const Vector<Dim>& x_i : points.position) x.push_back(point(x_i));
  const exact::PairSums all = exact::pair_sums(x, std::vector(x.size(), points.volume), truth, h, point(points.box.length));
  for (std::size_t k = 0; k < sums.size(); ++k) {
    const auto i = static_cast<std::size_t>(solver.particles.id[k]);
    most.add(sums[k].unity - all.unity[i]);
    for (int p = 0; p < Dim; ++p) {
      const auto row = static_cast<std::size_t>(p);
      most.add(h * (sums[k].constant[p] - all.gradient[i][row]));
      for (int q = 0; q < Dim; ++q) most.add(sums[k].linear(p, q) - all.first[i][row][static_cast<std::size_t>(q)]);
    }
  }
}

/// Adds the errors of the gradient of a linear field, plain and corrected, on the block of points alone: its edges are free.
template <int Dim>
void add_edge_errors(const AnyKernel& kernel, Points<Dim> points, double h, Largest& plain, Largest& corrected) {
  points.box = {};
  const Arrangement<Dim> block = arranged(points, 1.0, support(kernel) * h);
  const Stencil<Dim> stencil = block.stencil(kernel, h);
  const std::vector<double> volume = block.volume();
  const Vector<Dim> slope = Vector<Dim>::LinSpaced(1.0, 2.0);
  std::vector<double> field;
  for (const Vector<Dim>& x : block.particles.position) field.push_back(slope.dot(x));
  std::vector<Matrix<Dim>> correction(field.size());
  kernel_correction<Dim>(stencil, volume, correction);
  std::vector<Vector<Dim>> found(field.size());
  const auto add_errors = [&](std::span<const Matrix<Dim>> B, Largest& most) {
    gradient<Dim>(stencil, volume, field, B, found);
    for (const Vector<Dim>& g : found) most.add((g - slope).norm() / slope.norm());
  };
  add_errors({}, plain);
  add_errors(correction, corrected);
}

}  // namespace furrow::kernel_cases
