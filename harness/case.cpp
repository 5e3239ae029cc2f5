#include "harness/case.hpp"

#include <stdexcept>

namespace furrow {

Run::Run(Resolution resolution, std::filesystem::path folder, int threads, std::function<void(const Progress&)> on_progress,
         std::uint64_t particle_order)
    : resolution_(resolution),
      folder_(std::move(folder)),
      threads_(threads),
      on_progress_(std::move(on_progress)),
      particle_order_(particle_order) {}

namespace {

void add_once(std::map<std::string, Measurement, std::less<>>& all, std::string_view metric, Measurement m) {
  if (!all.emplace(std::string(metric), std::move(m)).second)
    throw std::logic_error("metric '" + std::string(metric) + "' is measured twice in one run");
}

}  // namespace

void Run::measure(std::string_view metric, double value, std::string_view unit_symbol) {
  unit(unit_symbol);
  add_once(measurements_, metric, {value, std::string(unit_symbol), std::nullopt, {}});
}

void Run::measure(std::string_view metric, double value, std::string_view unit_symbol, Reference reference) {
  unit(unit_symbol);
  add_once(measurements_, metric, {value, std::string(unit_symbol), reference, {}});
}

void Run::skip(std::string_view metric, std::string_view reason) {
  if (reason.empty()) throw std::logic_error("metric '" + std::string(metric) + "' is skipped without a reason");
  add_once(measurements_, metric, {0.0, "1", std::nullopt, std::string(reason)});
}

Table& Run::table(std::string_view name, std::string_view title, std::vector<Column> columns) {
  return tables_.emplace_back(Table{std::string(name), std::string(title), std::move(columns), {}});
}

Figure& Run::figure(Figure figure) { return figures_.emplace_back(std::move(figure)); }

void Run::note(std::string_view sentence) { notes_.emplace_back(sentence); }

void Run::exercises(std::string_view module) { modules_.emplace(module); }

void Run::file(std::string_view kind, const std::filesystem::path& path) {
  if (kind != "history" && kind != "snapshots")
    throw std::logic_error("kind of file '" + std::string(kind) + "': history or snapshots");
  files_.emplace_back(std::string(kind), path);
}

void Run::count(long steps, long particles) {
  steps_ += steps;
  particles_ = particles;
  particle_steps_ += steps * particles;
}

void Run::progress(double simulated_time, double end_time, long steps) {
  if (on_progress_) on_progress_({simulated_time, end_time, steps});
}

Family::Family(std::string name, std::string folder, std::string description)
    : name_(std::move(name)), folder_(std::move(folder)), description_(std::move(description)) {}

Family& Family::add(std::string problem, ProblemBuilder build) {
  if (!problems_.emplace(problem, build).second)
    throw std::logic_error("problem '" + problem + "' is added twice to family " + name_);
  return *this;
}

}  // namespace furrow
