#include "harness/result.hpp"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>

namespace furrow {
namespace {

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json numbers(const std::vector<double>& list) {
  Json result = Json::array();
  for (const double x : list) result.push_back(number(x));
  return result;
}

Json ladder_json(const Ladder& ladder) {
  return {{"h_over_dx", ladder.smoothing_ratio},
          {"kind", name(ladder.kind)},
          {"spacing", numbers(ladder.spacing)},
          {"value", numbers(ladder.value)},
          {"order", number(ladder.order)},
          {"order_stderr", number(ladder.order_stderr)},
          {"state", name(ladder.state)},
          {"gci", number(ladder.gci)},
          {"extrapolated", number(ladder.extrapolated)}};
}

Json metric_json(const CaseSpec& spec, const MetricSpec& metric, const MetricResult& result) {
  Json json{{"name", metric.name},
            {"symbol", metric.symbol},
            {"description", metric.description},
            {"unit", metric.unit.symbol},
            {"value", number(result.value)},
            {"class", metric.reference_class},
            {"reference",
             {{"value", number(result.reference)},
              {"standard_uncertainty", number(result.standard_uncertainty)},
              {"source", metric.source}}},
            {"error", number(result.error)},
            {"norm", metric.norm_words},
            {"band", metric.band ? numbers({metric.band->low, metric.band->high}) : Json(nullptr)}};
  if (metric.band) json["band_why"] = metric.band_why;
  json["verdict"] = name(result.verdict);
  if (!result.reason.empty()) json["reason"] = result.reason;
  if (!spec.spacing.empty())
    json["at"] = {{"spacing", spec.spacing[metric.spacing_index]}, {"h_over_dx", spec.smoothing_ratio[metric.ratio_index]}};
  if (!result.ladders.empty()) {
    for (const Ladder& ladder : result.ladders)
      if (ladder.smoothing_ratio == spec.smoothing_ratio[metric.ratio_index]) json["ladder"] = ladder_json(ladder);
    json["ladders"] = Json::array();
    for (const Ladder& ladder : result.ladders) json["ladders"].push_back(ladder_json(ladder));
  }
  return json;
}

Json table_json(const Table& table) {
  Json columns = Json::array(), rows = Json::array();
  for (const Column& column : table.columns) columns.push_back({{"label", column.label}, {"unit", column.unit}});
  for (const std::vector<Cell>& row : table.rows) {
    Json cells = Json::array();
    for (const Cell& cell : row) {
      const double* value = std::get_if<double>(&cell);
      cells.push_back(value ? number(*value) : Json(std::get<std::string>(cell)));
    }
    rows.push_back(std::move(cells));
  }
  return {{"name", table.name}, {"title", table.title}, {"columns", std::move(columns)}, {"rows", std::move(rows)}};
}

Json figure_json(const Figure& figure) {
  const auto axis = [](const Column& column, bool log) {
    return Json{{"label", column.label}, {"unit", column.unit}, {"log", log}};
  };
  Json json{{"name", figure.name},   {"title", figure.title},           {"caption", figure.caption},
            {"kind", figure.kind},   {"x", axis(figure.x, figure.log_x)}, {"y", axis(figure.y, figure.log_y)}};
  if (!figure.colour.label.empty()) json["colour"] = axis(figure.colour, false);
  json["series"] = Json::array();
  for (const Series& series : figure.series) {
    Json one{{"label", series.label}, {"role", series.role}, {"x", numbers(series.x)}, {"y", numbers(series.y)}};
    if (!series.uncertainty.empty()) one["uncertainty"] = numbers(series.uncertainty);
    if (!series.colour.empty()) one["colour"] = numbers(series.colour);
    json["series"].push_back(std::move(one));
  }
  return json;
}

}  // namespace

Json result_json(const CaseSpec& spec, const CaseVerdict& verdict, const Shown& shown, const Cost& cost, const Json& provenance) {
  Json json{{"schema", 1},          {"case", spec.id}, {"family", spec.family},           {"problem", spec.problem},
            {"title", spec.title},  {"why", spec.why}, {"description", spec.description}, {"tier", name(spec.tier)},
            {"verdict", name(verdict.verdict)}};
  if (!verdict.reason.empty()) json["reason"] = verdict.reason;
  json["parameters"] = Json::parse(spec.parameters_json);
  json["overrides"] = spec.overrides;
  if (!spec.spacing.empty()) {
    const double factor = unit(spec.spacing_unit).factor;
    std::vector<double> spacing;
    for (const double dx : spec.spacing) spacing.push_back(dx / factor);
    json["resolution"] = {{"spacing", spacing}, {"unit", spec.spacing_unit}, {"h_over_dx", spec.smoothing_ratio}};
  }
  json["metrics"] = Json::array();
  for (std::size_t i = 0; i < spec.metrics.size(); ++i)
    json["metrics"].push_back(metric_json(spec, spec.metrics[i], verdict.metrics[i]));
  json["tables"] = Json::array();
  for (const Table& table : shown.tables) json["tables"].push_back(table_json(table));
  json["figures"] = Json::array();
  for (const Figure& figure : shown.figures) json["figures"].push_back(figure_json(figure));
  json["notes"] = shown.notes;
  json["citations"] = Json::array();
  for (const Citation& citation : spec.citations) {
    Json one{{"key", citation.key}, {"text", citation.text}};
    if (!citation.doi.empty()) one["doi"] = citation.doi;
    json["citations"].push_back(std::move(one));
  }
  json["cost"] = {{"wall_s", cost.wall},
                  {"cpu_s", cost.cpu},
                  {"steps", cost.steps},
                  {"particles", cost.particles},
                  {"particle_steps_per_s", cost.wall > 0.0 ? static_cast<double>(cost.particle_steps) / cost.wall : 0.0},
                  {"peak_rss_bytes", cost.peak_rss}};
  json["provenance"] = provenance;
  json["provenance"]["inputs"] = spec.fingerprint;
  json["exercises"] = shown.modules;
  json["files"] = Json::object();
  if (!shown.history.empty()) json["files"]["history"] = shown.history;
  if (!shown.snapshots.empty()) json["files"]["snapshots"] = shown.snapshots;
  return json;
}

void write_whole(const std::filesystem::path& file, const std::string& text) {
  const std::filesystem::path beside = file.string() + fmt::format(".{}.part", getpid());
  const auto failed = [&](const char* what) {
    const std::string reason = std::strerror(errno);
    ::unlink(beside.c_str());
    throw std::runtime_error(fmt::format("{}: cannot {}: {}", file.string(), what, reason));
  };
  const int descriptor = ::open(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor < 0) failed("be opened for writing");
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = ::write(descriptor, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      ::close(descriptor);
      failed("be written");
    }
    done += static_cast<std::size_t>(written);
  }
  const bool synced = ::fsync(descriptor) == 0;
  if (::close(descriptor) != 0 || !synced) failed("be written");
  if (::rename(beside.c_str(), file.c_str()) != 0) failed("be renamed to");
}

void write_json(const std::filesystem::path& file, const Json& json) {
  write_whole(file, json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

Json read_json(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) return nullptr;
  Json json = Json::parse(in, nullptr, false);
  return json.is_discarded() ? Json(nullptr) : json;
}

}  // namespace furrow
