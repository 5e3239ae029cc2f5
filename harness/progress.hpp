// Progress of a run: one live bar on a terminal, a plain line a case otherwise, nothing when quiet.
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>

#include "harness/case_run.hpp"

namespace furrow {

class Progress {
 public:
  /// `expected` holds every case that will run, with its expected seconds where they are known.
  Progress(std::map<std::string, std::optional<double>> expected, int jobs, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void started(const std::string& id);
  void moved(const std::string& id, const CaseProgress& progress);
  void finished(const std::string& id, const std::string& verdict, const std::string& reason, double seconds);
  void draw();   ///< the bar, a few times a second

 private:
  using Clock = std::chrono::steady_clock;
  struct Running {
    Clock::time_point start;
    std::optional<double> expected;   // s
    CaseProgress progress;
  };

  std::optional<double> time_left() const;   // s; empty as long as nothing is known
  std::string bar() const;
  void clear();

  std::map<std::string, std::optional<double>> waiting_;
  std::map<std::string, Running> running_;
  std::size_t total_, done_ = 0;
  double seconds_done_ = 0.0;
  int jobs_;
  bool quiet_, terminal_, drawn_ = false;
  Clock::time_point last_draw_;
};

/// "850 ms", "12.3 s", "4 min 05 s", "2 h 03 min".
std::string duration_words(double seconds);

}  // namespace furrow
