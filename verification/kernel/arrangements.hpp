// The arrangements that a kernel is summed over: perfect lattices, lattices shaken at random, a random cloud that has relaxed.
#pragma once

#include <string>
#include <vector>

#include "verification/lattices.hpp"

namespace furrow::kernel_cases {

template <int Dim>
struct Sample {
  std::string name;      ///< in tables and curves: "square", "jittered 10 %"
  std::string lattice;   ///< name of the perfect lattice in reference/exact; empty for a disordered arrangement
  Points<Dim> points;    ///< in a periodic box
};

/// square, hexagonal (cubic, FCC in 3D), jittered by 5, 10 and 20 % of dx, relaxed: in this order, in boxes at least `across`
/// spacings wide. Jitter is the same random pattern for each share. Relaxed particles begin at random and repel each other.
template <int Dim>
std::vector<Sample<Dim>> samples(double dx, int across, unsigned seed);

}  // namespace furrow::kernel_cases
