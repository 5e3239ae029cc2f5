#include "verification/kernel/arrangements.hpp"

#include <cmath>
#include <numbers>
#include <random>

namespace furrow::kernel_cases {
namespace {

/// As many points as the lattice has, thrown at random into its box. Points nearer than `reach` push each other apart, harder
/// the nearer, and each moves a little along the sum of its pushes.
template <int Dim>
Points<Dim> relaxed(Points<Dim> points, unsigned seed) {
  constexpr int steps = Dim == 2 ? 200 : 60;
  const double dx = points.spacing, reach = (Dim == 2 ? 2.5 : 2.0) * dx;
  std::mt19937_64 generator(seed);
  for (Vector<Dim>& x : points.position) {
    for (int a = 0; a < Dim; ++a) x[a] = points.box.length[a] * uniform(generator);
  }
  for (int step = 0; step < steps; ++step) {
    const Arrangement<Dim> now = arranged(points, 1.0, reach);
    const std::vector<Vector<Dim>>& x = now.particles.position;
    for (std::size_t i = 0; i < x.size(); ++i) {
      Vector<Dim> push = Vector<Dim>::Zero();
      for (const std::int32_t j : now.neighbours.row(i)) {
        const Vector<Dim> apart = now.box.displacement(x[i], x[static_cast<std::size_t>(j)]);
        const double r = apart.norm();
        if (r > 0.0) push += (1.0 / r - 1.0 / reach) * apart;
      }
      points.position[i] = now.box.wrapped(x[i] + 0.1 * dx * push);
    }
  }
  return points;
}

}  // namespace

template <int Dim>
std::vector<Sample<Dim>> samples(double dx, int across, unsigned seed) {
  const auto cells_of = [across](double edge) { return static_cast<int>(std::ceil(across / edge)); };
  const Points<Dim> square = square_lattice<Dim>(all_axes<Dim>(across), dx, true);
  std::vector<Sample<Dim>> all;
  if constexpr (Dim == 2) {
    all.push_back({"square", "square", square});
    all.push_back({"hexagonal", "hexagonal", hexagonal_lattice({across, cells_of(std::numbers::sqrt3)}, dx, true)});
  } else {
    all.push_back({"cubic", "cubic", square});
    all.push_back({"FCC", "fcc", fcc_lattice(all_axes<3>(cells_of(std::numbers::sqrt2)), dx, true)});
  }
  for (const int percent : {5, 10, 20}) {
    all.push_back({"jittered " + std::to_string(percent) + " %", "", jittered(square, 0.01 * percent, seed)});
  }
  all.push_back({"relaxed", "", relaxed(square, seed)});
  return all;
}

template std::vector<Sample<2>> samples<2>(double, int, unsigned);
template std::vector<Sample<3>> samples<3>(double, int, unsigned);

}  // namespace furrow::kernel_cases
