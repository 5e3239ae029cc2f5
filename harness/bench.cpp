#include "harness/bench.hpp"

#include <benchmark/benchmark.h>
#include <omp.h>

#include <cmath>
#include <map>
#include <numbers>

#include "harness/input.hpp"
#include "solver/schemes/momentum.hpp"
#include "solver/schemes/velocity_gradient.hpp"
#include "solver/simulation.hpp"

namespace furrow {
namespace {

/// Centres of cubes of edge dx that fill the box from the origin to `count` cubes.
template <int Dim>
std::vector<Vector<Dim>> lattice(const std::array<int, 3>& count, double dx) {
  std::vector<Vector<Dim>> centres;
  for (int c = 0; c < (Dim > 2 ? count[2] : 1); ++c)
    for (int b = 0; b < count[1]; ++b)
      for (int a = 0; a < count[0]; ++a) {
        const Vector<3> x = dx * Vector<3>(a + 0.5, b + 0.5, c + 0.5);
        centres.push_back(x.head<Dim>());
      }
  return centres;
}

/// OFHC copper of Johnson & Cook flies at 190 m/s, a square rod four times as long as wide, against a rigid wall. Wendland C2 with
/// h = 1.3 dx has 74 neighbours.
Simulation<3> metal_rod(long particles) {
  const int side = std::max(2, static_cast<int>(std::lround(std::cbrt(static_cast<double>(particles) / 4.0))));
  const int length = std::max(1, static_cast<int>(std::lround(static_cast<double>(particles) / (side * side))));
  const double dx = 7.62e-3 / side;
  Simulation<3> simulation;
  Body<3>& body = simulation.body;
  body.material = JohnsonCook<MieGrueneisen>{.eos = {.reference_density = 8930.0, .sound_speed = 3940.0, .slope = 1.489, .gamma = 1.99},
                                             .shear_modulus = 46e9,
                                             .strength = {.A = 90e6, .B = 292e6, .n = 0.31, .C = 0.025, .m = 1.09,
                                                          .reference_rate = 1.0, .reference_temperature = 294.0,
                                                          .melting_temperature = 1356.0},
                                             .specific_heat = 383.0,
                                             .taylor_quinney = 0.9};
  body.scheme.smoothing_ratio = 1.3;
  body.scheme.correction = Correction::none;
  body.spacing = dx;
  body.add(lattice<3>({side, side, length}, dx), {0.0, 0.0, -190.0});
  body.walls.push_back({Vector<3>::Zero(), Vector<3>::Unit(2), 200e9});
  return simulation;
}

/// The paper's soil, a square column, settles on a floor under gravity. Wendland C2 with h = 1.3 dx has 20 neighbours.
Simulation<2> soil_column(long particles) {
  const int side = std::max(2, static_cast<int>(std::lround(std::sqrt(static_cast<double>(particles)))));
  const double dx = 0.1 / side;
  Simulation<2> simulation;
  Body<2>& body = simulation.body;
  body.material = DruckerPrager{.reference_density = 1540.0, .bulk_modulus = 1.5e6, .shear_modulus = 0.9e6,
                                .cone = DruckerPragerCone::bui(5e3, 28.0 * std::numbers::pi / 180.0, 0.0)};
  body.scheme.smoothing_ratio = 1.3;
  body.scheme.correction = Correction::none;
  body.spacing = dx;
  body.add(lattice<2>({side, side, 1}, dx));
  body.walls.push_back({Vector<2>::Zero(), Vector<2>::Unit(1), 10e6});
  body.loads.gravity = {0.0, -9.81};
  return simulation;
}

template <int Dim>
Simulation<Dim> problem(long particles) {
  if constexpr (Dim == 3) return metal_rod(particles);
  else return soil_column(particles);
}

/// Bytes that one particle takes: its fields and its row of neighbours.
template <int Dim>
double bytes_per_particle(Body<Dim>& body) {
  std::size_t bytes = body.neighbours().index.size() * sizeof(std::int32_t) + body.particles.size() * (sizeof(std::int64_t) + sizeof(std::int32_t));
  for_each_field(body.particles, [&](const Field&, const auto& array) { bytes += array.size() * sizeof array[0]; });
  return static_cast<double>(bytes) / static_cast<double>(body.particles.size());
}

enum class What { neighbour_build, velocity_gradient, momentum, whole_step };
const std::map<What, std::string> names{{What::neighbour_build, "neighbour_build"},
                                        {What::velocity_gradient, "velocity_gradient"},
                                        {What::momentum, "momentum"},
                                        {What::whole_step, "whole_step"}};

template <int Dim>
void measure(benchmark::State& state, What what, long particles, int threads) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(threads);
  Simulation<Dim> simulation = problem<Dim>(particles);
  simulation.start();
  // Particles have left the lattice, and the first neighbour lists are behind, when the clock starts.
  for (int k = 0; k < (particles > 200000 ? 5 : 20); ++k) simulation.step(1.0);
  Body<Dim>& body = simulation.body;
  Particles<Dim>& p = body.particles;
  const std::size_t n = p.size();
  std::vector<double> volume(p.position.size());
  for (std::size_t i = 0; i < n; ++i) volume[i] = p.volume(i);
  std::vector<Matrix<Dim>> L(n);
  std::vector<Vector<Dim>> a(n);
  std::vector<MomentumPower> power(n);
  MomentumWorkspace<Dim> workspace;
  const MomentumTerms terms{body.scheme.viscosity, body.scheme.artificial_stress, body.spacing};

  const std::int64_t builds_before = body.builds();
  for (auto _ : state) {
    switch (what) {
      case What::neighbour_build:
        body.refresh_neighbours(true);
        break;
      case What::velocity_gradient:
        velocity_gradient<Dim>(body.stencil(), volume, p.velocity, {}, L);
        break;
      case What::momentum:
        momentum<Dim>(body.stencil(), p, p.velocity, {}, terms, workspace, a, power);
        break;
      case What::whole_step:
        simulation.step(1.0);
        break;
    }
    benchmark::ClobberMemory();
  }
  omp_set_num_threads(before);

  double pairs = 0.0;
  for (const std::int32_t count : body.neighbours().count) pairs += count;
  const auto rate = [&](double amount, benchmark::Counter::Flags flags) {
    return benchmark::Counter(amount, benchmark::Counter::kIsIterationInvariantRate | flags);
  };
  state.counters[what == What::whole_step ? "particle_steps_per_s" : "particles_per_s"] =
      rate(static_cast<double>(n), benchmark::Counter::kDefaults);
  // Seconds a pair: shown as ns by the table, as a number in seconds by JSON.
  state.counters["time_per_pair"] = rate(pairs, benchmark::Counter::kInvert);
  // A step in which neighbours are found costs more: two sizes compare only where this is alike.
  state.counters["builds_per_iteration"] = benchmark::Counter(static_cast<double>(body.builds() - builds_before), benchmark::Counter::kAvgIterations);
  state.counters["neighbours"] = pairs / static_cast<double>(n);
  state.counters["bytes_per_particle"] = bytes_per_particle(body);
  state.counters["threads_used"] = threads;
}

}  // namespace

int run_benchmarks(const BenchOptions& options) {
  std::vector<int> threads{1};
  if (omp_get_num_procs() > 1) threads.push_back(omp_get_num_procs());
  for (const auto& [what, name] : names)
    for (const int dim : {2, 3})
      for (long particles = 10000; particles <= options.most_particles; particles *= 10)
        for (const int t : threads)
          benchmark::RegisterBenchmark((name + "/" + std::to_string(dim) + "d/" + std::to_string(particles) + "/threads:" + std::to_string(t)).c_str(),
                                       [=, what = what](benchmark::State& state) {
                                         dim == 2 ? measure<2>(state, what, particles, t) : measure<3>(state, what, particles, t);
                                       })
              ->UseRealTime()
              ->MeasureProcessCPUTime()
              ->Unit(benchmark::kMillisecond);

  std::vector<std::string> words{"furrow bench", "--benchmark_min_time=" + std::to_string(options.least_time),
                                 "--benchmark_repetitions=" + std::to_string(options.repetitions)};
  if (options.json) words.emplace_back("--benchmark_format=json");
  if (!options.filter.empty()) words.push_back("--benchmark_filter=" + options.filter);
  if (!options.file.empty()) words.insert(words.end(), {"--benchmark_out_format=json", "--benchmark_out=" + options.file});
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  int argc = static_cast<int>(argv.size());
  benchmark::Initialize(&argc, argv.data());
  const std::size_t ran = benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  if (ran == 0)
    throw InputError("bench", 0, "--filter",
                     "found '" + options.filter + "', which matches no benchmark, expected part of a name such as whole_step/3d/10000");
  return 0;
}

}  // namespace furrow
