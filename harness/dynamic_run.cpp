#include "harness/dynamic_run.hpp"

#include <cstdlib>
#include <numeric>
#include <random>

#include <fmt/format.h>

#include "harness/input.hpp"
#include "solver/io/file.hpp"
#include "solver/io/particle_snapshot.hpp"
#include "solver/io/simulation_checkpoint.hpp"

namespace furrow {
namespace {

constexpr std::int64_t steps_between_good_states = 200;

std::vector<HistoryColumn> standard_columns() {
  return {{"dt", "dt", "s", "length of the last step"},
          {"limiter", "l", "1", "what limited it: 0 Courant, 1 viscous, 2 force, 3 end of run, 4 growth"},
          {"kinetic_energy", "E_k", "J", "kinetic energy; per metre of width in plane strain, as all energies"},
          {"elastic_energy", "E_e", "J", "recoverable energy of the stress state"},
          {"plastic_work", "E_p", "J", "stress work that is not recoverable"},
          {"wall_energy", "E_w", "J", "energy in the springs of rigid walls"},
          {"layer_work", "E_b", "J", "energy taken up by the soil that boundary layers stand for"},
          {"viscous_dissipation", "E_v", "J", "energy dissipated by artificial viscosity"},
          {"artificial_stress_work", "E_a", "J", "energy taken up by artificial stress"},
          {"friction", "E_f", "J", "energy lost to friction on walls"},
          {"damping_dissipation", "E_d", "J", "energy taken out by damping"},
          {"external_work", "E_x", "J", "work of gravity, applied forces and prescribed motion"},
          {"energy_imbalance", "dE", "1", "sum of all less its initial value, over the largest energy so far"},
          {"momentum_x", "p_x", "kg m/s", "momentum along x"},
          {"momentum_y", "p_y", "kg m/s", "momentum along y"},
          {"angular_momentum", "L_z", "kg m^2/s", "angular momentum about z"}};
}

template <int Dim>
std::vector<double> standard_values(const Simulation<Dim>& s) {
  const EnergyLedger& e = s.energy();
  const Vector<Dim> p = s.momentum();
  return {s.dt(),    static_cast<double>(s.limiter()), e.kinetic, e.elastic,  e.plastic, e.wall, e.layer, e.viscous,
          e.artificial, e.contact, e.damping,                     e.external, s.energy_imbalance(), p[0], p[1], s.angular_momentum()};
}

// A permutation of n particles, the same on every machine (Fisher and Yates).
std::vector<std::int32_t> shuffled(std::size_t n, std::uint64_t seed) {
  std::vector<std::int32_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::mt19937_64 random(seed);
  for (std::size_t i = n; i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  return order;
}

}  // namespace

std::chrono::duration<double> checkpoint_interval() {
  const char* text = std::getenv("FURROW_CHECKPOINT_INTERVAL");
  if (text == nullptr) return std::chrono::seconds(30);
  char* end = nullptr;
  const double seconds = std::strtod(text, &end);
  if (end == text || *end != '\0' || !(seconds >= 0.0))
    throw InputError("FURROW_CHECKPOINT_INTERVAL", 0, "",
                     fmt::format("found \"{}\", expected seconds of wall time, 0 or more", text));
  return std::chrono::duration<double>(seconds);
}

template <int Dim>
void DynamicRun<Dim>::probe(HistoryColumn column, Probe value) {
  columns_.push_back(std::move(column));
  probes_.push_back(std::move(value));
}

template <int Dim>
void DynamicRun<Dim>::carry(std::function<void(Checkpoint&)> save, std::function<void(const Checkpoint&)> load) {
  save_ = std::move(save);
  load_ = std::move(load);
}

template <int Dim>
void DynamicRun<Dim>::with_snapshots(std::function<void(int number)> also) {
  with_snapshots_ = std::move(also);
}

template <int Dim>
void DynamicRun<Dim>::append_row() {
  simulation_.take_stock();
  std::vector<double> values = standard_values(simulation_);
  for (const Probe& probe : probes_) values.push_back(probe(simulation_));
  history_->append(simulation_.time(), values);
}

template <int Dim>
void DynamicRun<Dim>::write_snapshot() {
  const auto file = run_.folder() / fmt::format("snapshot-{:04d}.vtkhdf", snapshots_++);
  furrow::write_snapshot(file, particle_snapshot(simulation_.body.particles, simulation_.time()));
  run_.file("snapshots", file);
  if (with_snapshots_) with_snapshots_(snapshots_ - 1);
}

template <int Dim>
void DynamicRun<Dim>::write_checkpoint() {
  history_->flush();
  Checkpoint checkpoint = checkpoint_of(simulation_);
  checkpoint.put_scalar("history_rows", static_cast<std::int64_t>(history_->rows()));
  checkpoint.put_scalar("snapshots", static_cast<std::int32_t>(snapshots_));
  checkpoint.put_scalar("next_row", static_cast<std::int32_t>(next_row_));
  checkpoint.put_scalar("next_snapshot", static_cast<std::int32_t>(next_snapshot_));
  if (save_) save_(checkpoint);
  checkpoint.write(run_.folder() / "checkpoint.h5");
}

template <int Dim>
bool DynamicRun<Dim>::resume() {
  const auto file = run_.folder() / "checkpoint.h5";
  if (!std::filesystem::exists(file)) return false;
  int written = 0;
  try {
    const Checkpoint checkpoint = Checkpoint::read(file);
    resume_from(checkpoint, simulation_);
    if (load_) load_(checkpoint);
    history_.emplace(History::resume(run_.folder() / "history.h5", columns_,
                                     static_cast<std::size_t>(checkpoint.scalar<std::int64_t>("history_rows"))));
    next_row_ = checkpoint.scalar<std::int32_t>("next_row");
    next_snapshot_ = checkpoint.scalar<std::int32_t>("next_snapshot");
    written = checkpoint.scalar<std::int32_t>("snapshots");
  } catch (const std::exception& error) {
    throw std::runtime_error(
        fmt::format("cannot go on from {}: {}; remove it, and the case begins anew", file.string(), error.what()));
  }
  while (snapshots_ < written) run_.file("snapshots", run_.folder() / fmt::format("snapshot-{:04d}.vtkhdf", snapshots_++));
  run_.note(fmt::format("Went on from a checkpoint at t = {:.6g} s.", simulation_.time()));
  return true;
}

template <int Dim>
void DynamicRun<Dim>::until(double end, int rows, int snapshots, const std::function<bool(const DynamicRun&)>& at_rest) {
  std::filesystem::create_directories(run_.folder());
  std::vector<HistoryColumn> all = standard_columns();
  all.insert(all.end(), columns_.begin(), columns_.end());
  columns_ = std::move(all);
  if (!resume()) {
    history_.emplace(run_.folder() / "history.h5", columns_);
    if (run_.particle_order() != 0)
      permute(simulation_.body.particles, shuffled(simulation_.body.particles.size(), run_.particle_order()));
    simulation_.start();
    append_row();
    write_snapshot();
  }

  auto good = simulation_.body.particles;
  double good_time = simulation_.time();
  auto saved = std::chrono::steady_clock::now();
  const auto interval = checkpoint_interval();
  // Rows and snapshots are due at fixed times, so that they do not depend on where a run was interrupted.
  const auto is_due = [&](int& next, int of) {
    bool due = false;
    for (; next <= of && simulation_.time() >= end * next / of; ++next) due = true;
    return due;
  };
  try {
    while (simulation_.time() < end) {
      simulation_.step(end);
      bool ends = false;
      if (is_due(next_row_, rows)) {
        append_row();
        ends = at_rest && at_rest(*this);
      }
      if (is_due(next_snapshot_, snapshots) || ends) write_snapshot();
      if (ends) break;
      if (simulation_.steps() % steps_between_good_states == 0) {
        good = simulation_.body.particles;
        good_time = simulation_.time();
        run_.progress(simulation_.time(), end, simulation_.steps());
      }
      if (std::chrono::steady_clock::now() - saved > interval) {
        write_checkpoint();
        saved = std::chrono::steady_clock::now();
      }
    }
  } catch (const FileError&) {
    throw;   // the disk's trouble, not the run's: what is there already stays
  } catch (const std::runtime_error& error) {
    history_->flush();
    const auto file = run_.folder() / "last-good.vtkhdf";
    furrow::write_snapshot(file, particle_snapshot(good, good_time));
    throw Divergence(
        fmt::format("{}; the last good state, t = {:.6g} s, is in {}", error.what(), good_time, file.filename().string()));
  }
  history_->flush();
  std::filesystem::remove(run_.folder() / "checkpoint.h5");
  run_.file("history", run_.folder() / "history.h5");
  if (simulation_.sub_steps() > simulation_.steps())
    run_.note(fmt::format("The {} steps are those of the whole body; particles that were squeezed took {} shorter ones, which make "
                          "{:.1f} % more steps of particles.",
                          simulation_.steps(), simulation_.sub_steps(),
                          100.0 * (static_cast<double>(simulation_.particle_steps()) /
                                       static_cast<double>(simulation_.steps() * static_cast<std::int64_t>(simulation_.body.particles.size())) -
                                   1.0)));
  run_.count(simulation_.steps(), static_cast<long>(simulation_.body.particles.size()));
}

template <int Dim>
const std::vector<double>& DynamicRun<Dim>::column(std::string_view name) const {
  const HistoryTable& table = history();
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    if (table.columns[c].name == name) return table.values[c];
  throw std::logic_error("the history has no column " + std::string(name));
}

template <int Dim>
double DynamicRun<Dim>::energy_imbalance() const {
  double largest = 0.0;
  for (const double imbalance : column("energy_imbalance")) largest = std::max(largest, std::abs(imbalance));
  return largest;
}

template class DynamicRun<2>;
template class DynamicRun<3>;

}  // namespace furrow
