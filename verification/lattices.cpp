#include "verification/lattices.hpp"

#include <cmath>
#include <random>
#include <stdexcept>

namespace furrow {
namespace {

/// Calls visit(corner) for the lower corner of every cell of size `edge`, first axis fastest.
template <int Dim, class Visit>
void for_each_cell(const std::array<int, Dim>& cells, const Vector<Dim>& edge, Visit&& visit) {
  std::size_t total = 1;
  for (const int n : cells) {
    if (n < 1) throw std::invalid_argument("a lattice needs at least one cell along each axis");
    total *= static_cast<std::size_t>(n);
  }
  for (std::size_t c = 0; c < total; ++c) {
    Vector<Dim> corner;
    std::size_t rest = c;
    for (int a = 0; a < Dim; ++a) {
      const auto n = static_cast<std::size_t>(cells[static_cast<std::size_t>(a)]);
      corner[a] = static_cast<double>(rest % n) * edge[a];
      rest /= n;
    }
    visit(corner);
  }
}

/// Cells of size `edge` with points at these fractions of it.
template <int Dim>
Points<Dim> crystal(const std::array<int, Dim>& cells, const Vector<Dim>& edge, const std::vector<Vector<Dim>>& basis, double spacing,
                    bool periodic) {
  Points<Dim> points;
  points.spacing = spacing;
  points.volume = edge.prod() / static_cast<double>(basis.size());
  for_each_cell<Dim>(cells, edge, [&](const Vector<Dim>& corner) {
    for (const Vector<Dim>& b : basis) points.position.push_back(corner + b.cwiseProduct(edge));
  });
  if (periodic)
    for (int a = 0; a < Dim; ++a) points.box.length[a] = cells[static_cast<std::size_t>(a)] * edge[a];
  return points;
}

}  // namespace

template <int Dim>
Points<Dim> square_lattice(const std::array<int, Dim>& cells, double spacing, bool periodic) {
  return crystal<Dim>(cells, Vector<Dim>::Constant(spacing), {Vector<Dim>::Constant(0.5)}, spacing, periodic);
}

Points<2> hexagonal_lattice(const std::array<int, 2>& cells, double spacing, bool periodic) {
  return crystal<2>(cells, {spacing, std::sqrt(3.0) * spacing}, {{0.25, 0.25}, {0.75, 0.75}}, spacing, periodic);
}

Points<3> fcc_lattice(const std::array<int, 3>& cells, double spacing, bool periodic) {
  return crystal<3>(cells, Vector<3>::Constant(std::sqrt(2.0) * spacing),
                    {{0.25, 0.25, 0.25}, {0.75, 0.75, 0.25}, {0.75, 0.25, 0.75}, {0.25, 0.75, 0.75}}, spacing, periodic);
}

template <int Dim>
Points<Dim> jittered(Points<Dim> points, double fraction, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  for (Vector<Dim>& x : points.position) {
    for (int a = 0; a < Dim; ++a) x[a] += fraction * points.spacing * (2.0 * uniform(generator) - 1.0);
    x = points.box.wrapped(x);
  }
  return points;
}

template <int Dim>
std::vector<double> Arrangement<Dim>::volume() const {
  std::vector<double> V(particles.size());
  for (std::size_t i = 0; i < V.size(); ++i) V[i] = particles.volume(i);
  return V;
}

template <int Dim>
Stencil<Dim> Arrangement<Dim>::stencil(const AnyKernel& kernel, double h) const {
  if (support(kernel) * h > neighbours.reach * (1.0 + 1e-12))
    throw std::logic_error("the kernel reaches further than the neighbours of this arrangement");
  return {kernel, h, box, particles.position, &neighbours};
}

template <int Dim>
Arrangement<Dim> arranged(const Points<Dim>& points, double density, double reach) {
  Arrangement<Dim> a;
  a.box = points.box;
  a.spacing = points.spacing;
  resize(a.particles, points.position.size());
  for (std::size_t i = 0; i < points.position.size(); ++i) {
    a.particles.id[i] = static_cast<std::int32_t>(i);
    a.particles.position[i] = points.position[i];
    a.particles.density[i] = density;
    a.particles.mass[i] = density * points.volume;
  }
  const CellGrid<Dim> grid(a.particles.position, reach, a.box);
  const CellOrder sorted = order_by_cell<Dim>(grid, a.particles.position);
  permute(a.particles, sorted.order);
  build_neighbours<Dim>(grid, sorted.begin, a.particles.position, reach, a.neighbours);
  return a;
}

#define FURROW_INSTANTIATE(Dim)                                                             \
  template Points<Dim> square_lattice<Dim>(const std::array<int, Dim>&, double, bool);      \
  template Points<Dim> jittered<Dim>(Points<Dim>, double, std::uint64_t);                   \
  template struct Arrangement<Dim>;                                                         \
  template Arrangement<Dim> arranged<Dim>(const Points<Dim>&, double, double);
FURROW_INSTANTIATE(1)
FURROW_INSTANTIATE(2)
FURROW_INSTANTIATE(3)
#undef FURROW_INSTANTIATE

}  // namespace furrow
