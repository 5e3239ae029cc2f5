// A simulation as a case runs it: history.h5 with energies and probes, snapshots, checkpoints from which an interrupted run goes
// on, progress, and what is left behind when it goes wrong.
#pragma once

#include <chrono>
#include <functional>
#include <optional>

#include "harness/case.hpp"
#include "solver/io/checkpoint.hpp"
#include "solver/io/history.hpp"
#include "solver/simulation.hpp"

namespace furrow {

/// Wall time between checkpoints: 30 s, or as many seconds as the environment variable FURROW_CHECKPOINT_INTERVAL says; an
/// InputError when that is no number of seconds.
std::chrono::duration<double> checkpoint_interval();

template <int Dim>
class DynamicRun {
 public:
  using Probe = std::function<double(const Simulation<Dim>&)>;

  /// The body must be set up; the run starts it, or goes on from a checkpoint in the run's folder.
  DynamicRun(Run& run, Simulation<Dim>& simulation) : run_(run), simulation_(simulation) {}

  /// A column of the history beside those that every run has.
  void probe(HistoryColumn column, Probe value);

  /// What else a restart needs, such as a second body: `save` adds it to a checkpoint, `load` takes it back before the run goes on.
  void carry(std::function<void(Checkpoint&)> save, std::function<void(const Checkpoint&)> load);
  /// Called after each snapshot with its number, for what else is to be kept of that moment.
  void with_snapshots(std::function<void(int number)> also);

  /// Runs to `end` with `rows` rows of history and `snapshots` snapshots after the first; or ends after the first row at which
  /// `at_rest`, which sees the history, says so. Throws Divergence, with a snapshot of the last good state in the run's folder.
  void until(double end, int rows, int snapshots, const std::function<bool(const DynamicRun&)>& at_rest = {});

  const HistoryTable& history() const { return history_->table(); }
  /// Column of the history by name; a std::logic_error when there is none.
  const std::vector<double>& column(std::string_view name) const;

  /// Largest |energy imbalance| seen in the history.
  double energy_imbalance() const;

 private:
  void append_row();
  void write_snapshot();
  void write_checkpoint();
  bool resume();

  Run& run_;
  Simulation<Dim>& simulation_;
  std::vector<HistoryColumn> columns_;
  std::vector<Probe> probes_;
  std::function<void(Checkpoint&)> save_;
  std::function<void(const Checkpoint&)> load_;
  std::function<void(int)> with_snapshots_;
  std::optional<History> history_;
  int snapshots_ = 0, next_row_ = 1, next_snapshot_ = 1;
};

}  // namespace furrow
