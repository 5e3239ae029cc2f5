// ./furrow bench: how fast the solver is. Google Benchmark measures the neighbour build, the two pair loops and whole steps on the
// problems that public codes are compared on: a metal rod that hits a wall in 3D, a soil column that rests on a floor in 2D.
#pragma once

#include <string>

namespace furrow {

struct BenchOptions {
  bool json = false;            ///< JSON on standard output instead of a table
  std::string filter;           ///< regular expression on names such as whole_step/3d/100000/threads:2; empty = all
  std::string file;             ///< JSON into this file as well; empty = none
  long most_particles = 1000000;
  double least_time = 0.5;      ///< s a benchmark
  int repetitions = 1;
};

/// Runs the benchmarks; returns the exit code. Throws InputError when the filter matches nothing.
int run_benchmarks(const BenchOptions& options);

}  // namespace furrow
