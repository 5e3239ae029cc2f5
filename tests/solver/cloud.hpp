// Random particles for the tests of the sums: nothing is equal, nothing is symmetric, so that no error can cancel.
#pragma once

#include <Eigen/LU>
#include <random>

#include "verification/lattices.hpp"

namespace furrow {

/// A jittered lattice, periodic or open, with random masses, densities, velocities and symmetric stresses of order one.
template <int Dim>
Arrangement<Dim> cloud(const std::array<int, Dim>& cells, bool periodic, double reach, std::uint64_t seed) {
  Arrangement<Dim> a = arranged(jittered(square_lattice<Dim>(cells, 1.0, periodic), 0.3, seed), 1.0, reach);
  std::mt19937_64 generator(seed + 1);
  const auto within = [&generator](double low, double high) { return low + (high - low) * uniform(generator); };
  Particles<Dim>& p = a.particles;
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.density[i] = within(0.8, 1.2);
    p.mass[i] = within(0.7, 1.3);
    p.sound_speed[i] = within(1.0, 2.0);
    for (int b = 0; b < Dim; ++b) p.velocity[i][b] = within(-1.0, 1.0);
    for (int b = 0; b < 3; ++b)
      for (int c = 0; c <= b; ++c) p.stress[i](b, c) = p.stress[i](c, b) = within(-1.0, 1.0);
  }
  return a;
}

/// Shortest x_i - x_j by trying the images next to the box, one by one.
template <int Dim>
Vector<Dim> shortest(const Box<Dim>& box, const Vector<Dim>& x_i, const Vector<Dim>& x_j) {
  Vector<Dim> d = x_i - x_j;
  for (int a = 0; a < Dim; ++a)
    for (const double image : {d[a] - box.length[a], d[a] + box.length[a]})
      if (std::abs(image) < std::abs(d[a])) d[a] = image;
  return d;
}

/// Angular velocity as a matrix: W r = w x r.
inline Tensor cross(double x, double y, double z) {
  Tensor W;
  W << 0.0, -z, y, z, 0.0, -x, -y, x, 0.0;
  return W;
}

}  // namespace furrow
