// Case: what a family gives to the testbed (problems that can be built from parameters) and what a problem gives back while
// it runs (measurements, tables, figures). This is the whole surface that verification/ and validation/ are written against.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "harness/input.hpp"
#include "harness/units.hpp"

namespace furrow {

/// One rung of a case's resolution ladder. Problems without a ladder get spacing 0 and h/dx 0.
struct Resolution {
  double spacing = 0.0;            ///< dx, m
  double smoothing_ratio = 0.0;    ///< h/dx
  double smoothing_length() const { return spacing * smoothing_ratio; }
};

/// The true value that a problem computes at run time (a closed form at its own parameters, an independent solution).
struct Reference {
  double value = 0.0;
  double standard_uncertainty = 0.0;
};

struct Measurement {
  double value = 0.0;
  std::string unit = "1";                 ///< unit of value and reference
  std::optional<Reference> reference;     ///< only when the case file says reference.value = "computed"
  std::string skipped;                    ///< reason; empty for a measured number
};

struct Column {
  std::string label{};
  std::string unit = "1";
};
using Cell = std::variant<double, std::string>;

/// A table of the report.
struct Table {
  std::string name{}, title{};
  std::vector<Column> columns{};
  std::vector<std::vector<Cell>> rows{};
  void row(std::vector<Cell> cells) { rows.push_back(std::move(cells)); }
};

/// One curve or cloud of points.
struct Series {
  std::string label{};
  std::string role = "computed";       ///< computed | reference | experiment | published | bound
  std::vector<double> x{}, y{};
  std::vector<double> uncertainty{};     ///< standard uncertainty of y; empty when none is stated
  std::vector<double> colour{};          ///< a third quantity, for kind particles
};

/// A figure of the report: data, never pixels. Units are shown with the labels.
struct Figure {
  std::string name{}, title{}, caption{};
  std::string kind = "lines";          ///< lines | points | particles (equal axes, coloured points)
  Column x{}, y{}, colour{};
  bool log_x = false, log_y = false;
  std::vector<Series> series{};
  Series& add(Series s) { return series.emplace_back(std::move(s)); }
};

/// What one run of a problem, at one resolution, sees of the testbed and tells it.
class Run {
 public:
  struct Progress {
    double simulated_time = 0.0, end_time = 0.0;   ///< s
    long steps = 0;
  };

  Run(Resolution resolution, std::filesystem::path folder, int threads, std::function<void(const Progress&)> on_progress = {},
      std::uint64_t particle_order = 0);

  const Resolution& resolution() const { return resolution_; }
  const std::filesystem::path& folder() const { return folder_; }   ///< where history.h5 and snapshots of this rung go
  int threads() const { return threads_; }
  /// 0: particles as the problem made them; else the seed of another order, which is as right and rounds differently.
  std::uint64_t particle_order() const { return particle_order_; }

  /// Each metric of the case file is measured exactly once (or skipped with a reason); a second time is a std::logic_error.
  void measure(std::string_view metric, double value, std::string_view unit = "1");
  void measure(std::string_view metric, double value, std::string_view unit, Reference reference);
  void skip(std::string_view metric, std::string_view reason);

  /// References stay valid while the Run lives.
  Table& table(std::string_view name, std::string_view title, std::vector<Column> columns);
  Figure& figure(Figure figure);
  void note(std::string_view sentence);            ///< a finding that the report prints as it is
  void exercises(std::string_view module);         ///< "smoothing/cubic_spline", "schemes/momentum"
  void file(std::string_view kind, const std::filesystem::path& path);   ///< kind: history | snapshots
  void count(long steps, long particles);          ///< cost
  void progress(double simulated_time, double end_time, long steps);

  const std::map<std::string, Measurement, std::less<>>& measurements() const { return measurements_; }
  const std::deque<Table>& tables() const { return tables_; }
  const std::deque<Figure>& figures() const { return figures_; }
  const std::vector<std::string>& notes() const { return notes_; }
  const std::set<std::string>& modules() const { return modules_; }
  const std::vector<std::pair<std::string, std::filesystem::path>>& files() const { return files_; }
  long steps() const { return steps_; }
  long particles() const { return particles_; }
  long particle_steps() const { return particle_steps_; }

 private:
  Resolution resolution_;
  std::filesystem::path folder_;
  int threads_;
  std::function<void(const Progress&)> on_progress_;
  std::map<std::string, Measurement, std::less<>> measurements_;
  std::deque<Table> tables_;
  std::deque<Figure> figures_;
  std::vector<std::string> notes_;
  std::set<std::string> modules_;
  std::vector<std::pair<std::string, std::filesystem::path>> files_;
  long steps_ = 0, particles_ = 0, particle_steps_ = 0;
  std::uint64_t particle_order_;
};

/// A problem is built once from the parameters of an instance (all input is checked then, before anything runs) and run once a
/// rung of the resolution ladder.
using Problem = std::function<void(Run&)>;
using ProblemBuilder = Problem (*)(const Parameters&);

/// A family: a folder with a cases.toml, and the problems its instances may name.
class Family {
 public:
  Family(std::string name, std::string folder, std::string description);
  Family& add(std::string problem, ProblemBuilder build);

  const std::string& name() const { return name_; }
  const std::string& folder() const { return folder_; }          ///< relative to the project's root
  const std::string& description() const { return description_; }
  const std::map<std::string, ProblemBuilder, std::less<>>& problems() const { return problems_; }

 private:
  std::string name_, folder_, description_;
  std::map<std::string, ProblemBuilder, std::less<>> problems_;
};

}  // namespace furrow
