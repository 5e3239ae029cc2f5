#include "harness/metric_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <regex>
#include <set>

#include <fmt/format.h>

namespace furrow {
namespace {

// States of a ladder in which an order can mean something.
constexpr std::array gateable{LadderState::asymptotic, LadderState::plateau, LadderState::undetermined};

const std::vector<std::string> classes{"exact", "manufactured", "independent", "experiment", "published", "self"};

std::size_t rung_of(const Parameters& at, std::string_view key, double wanted, const std::vector<double>& list) {
  const auto it = std::find_if(list.begin(), list.end(), [&](double x) { return std::abs(x - wanted) <= 1e-9 * std::abs(x); });
  if (it == list.end()) at.fail(key, "found a number that is not in the case's resolution, expected one of those listed there");
  return static_cast<std::size_t>(it - list.begin());
}

void read_reference(const Parameters& at, const Bibliography& bibliography, MetricSpec& metric) {
  const Parameters reference = at.table("reference");
  metric.source = known_source(reference, "source", reference.text("source"), bibliography);
  if (reference.is_text("value")) {
    reference.choice("value", {"computed"});
    metric.computed_reference = true;
  } else if (metric.norm != Norm::value || reference.has("value")) {
    metric.reference = reference.number("value");
    metric.standard_uncertainty = reference.number("standard_uncertainty", range::not_negative);
  }
  if (metric.norm == Norm::relative && metric.reference == 0.0)
    reference.fail("value", "found 0, expected another number, for the norm is relative to it");
}

void read_band(const Parameters& at, MetricSpec& metric) {
  if (at.flag_or("reported", false)) {
    if (at.has("band")) at.fail("band", "found a band on a metric that is only reported, expected one of the two");
    return;
  }
  const std::vector<double> ends = at.numbers("band", {-range::infinity, range::infinity});
  if (ends.size() != 2) at.fail("band", fmt::format("found {} numbers, expected two, [lowest, highest]", ends.size()));
  if (ends[0] > ends[1])
    at.fail("band",
            fmt::format("found [{:g}, {:g}], expected the lower end first, [{:g}, {:g}]", ends[0], ends[1], ends[1], ends[0]));
  if (std::isinf(ends[0]) && std::isinf(ends[1]))
    at.fail("band", "found two open ends, expected at least one number: such a band cannot fail");
  if (!metric.observed_order_of.empty() && (std::isinf(ends[0]) || std::isinf(ends[1])))
    at.fail("band", "found an open end, expected two numbers: an order that is too high is as wrong as one that is too low");
  metric.band = Band{ends[0], ends[1]};
  metric.band_why = at.text("band_why");
}

void read_norm(const Parameters& at, MetricSpec& metric) {
  metric.norm_words = at.text("norm");
  static const std::regex form("((L1|L2|Linf) )?((absolute|relative) )?(absolute|relative|value)");
  std::smatch match;
  if (!std::regex_match(metric.norm_words, match, form) || (match[4].matched && match[5] != "value"))
    at.fail(
        "norm",
        fmt::format(
            "found \"{}\", expected absolute, relative or value, with the field norm before it where there is one, as in "
            "\"L2 relative\"",
            metric.norm_words));
  metric.norm = match[5] == "absolute" ? Norm::absolute : match[5] == "relative" ? Norm::relative : Norm::value;
}

void read_ladder(const Parameters& at, MetricSpec& metric) {
  if (at.has("ladder"))
    metric.ladder = at.choice("ladder", {"error", "value"}) == "error" ? LadderKind::error : LadderKind::value;
  metric.observed_order_of = at.text_or("observed_order_of", "");
  metric.limit_of = at.text_or("limit_of", "");
  metric.states = {LadderState::asymptotic};
  if (metric.ladder && !metric.ladder_of().empty())
    at.fail("ladder", "found a ladder on a metric that is read from another's, expected it on that other one");
  if (!metric.limit_of.empty() && !metric.observed_order_of.empty())
    at.fail("limit_of", "found a limit and an observed order in one metric, expected one of the two");
  if (metric.observed_order_of.empty()) return;
  if (metric.norm != Norm::value)
    at.fail("norm", fmt::format("found \"{}\", expected \"value\" for an observed order", metric.norm_words));
  if (metric.unit.dimension != dimension::none || metric.unit.factor != 1.0)
    at.fail("unit", fmt::format("found \"{}\", expected \"1\" for an observed order", metric.unit.symbol));
  if (at.has("states")) {
    metric.states.clear();
    for (const std::string& word : at.texts("states")) {
      const auto known = std::find_if(gateable.begin(), gateable.end(), [&](LadderState s) { return name(s) == word; });
      if (known == gateable.end())
        at.fail("states", fmt::format("found \"{}\", expected \"asymptotic\", \"plateau\" or \"undetermined\"", word));
      metric.states.push_back(*known);
    }
  }
}

void read_known_gap(const Parameters& at, MetricSpec& metric) {
  if (!at.has("known_gap")) return;
  const Parameters gap = at.table("known_gap");
  metric.known_gap = KnownGap{gap.text("reason"), gap.date("date"), gap.date("expires")};
  if (!metric.known_gap->date.ok()) gap.fail("date", "expected a day of the calendar");
  if (!metric.known_gap->expires.ok()) gap.fail("expires", "expected a day of the calendar");
  if (metric.known_gap->expires <= metric.known_gap->date)
    gap.fail("expires", "found a day not after the gap's date, expected a later one");
  if (metric.known_gap->reason.empty()) gap.fail("reason", "found nothing, expected the cause of the gap");
  if (!metric.band) gap.fail("reason", "found a known gap on a metric without band, expected a band");
}

}  // namespace

std::string known_source(const Parameters& at, std::string_view key, const std::string& source,
                         const Bibliography& bibliography) {
  if (!bibliography.contains(source)) {
    std::vector<std::string> known;
    for (const auto& [name, citation] : bibliography) known.push_back(name);
    const std::string nearest = nearest_word(source, known);
    at.fail(key,
            fmt::format("found \"{}\", expected a key of the bibliography (reference/sources.toml, or [sources] of this file){}",
                        source, nearest.empty() ? "" : fmt::format("; did you mean \"{}\"?", nearest)));
  }
  return source;
}

MetricSets read_metric_sets(const Parameters& root) {
  MetricSets sets;
  if (!root.has("metric-set")) return sets;
  const Parameters table = root.table("metric-set");
  const std::vector<Parameters> cases = root.tables("case");
  for (const std::string& name : table.keys()) {
    const bool named = std::any_of(cases.begin(), cases.end(), [&](const Parameters& block) {
      if (!block.has("metric_sets")) return false;
      const std::vector<std::string> of = block.texts("metric_sets");
      return std::find(of.begin(), of.end(), name) != of.end();
    });
    if (!named) table.fail(name, "found a set of metrics that no case names, expected it among the metric_sets of one");
    sets[name] = table.tables(name);
    std::set<std::string> metrics;
    for (const Parameters& metric : sets[name])
      if (!metrics.insert(metric.text("name")).second)
        metric.fail("name", fmt::format("found \"{}\" twice in this set, expected a name of its own", metric.text("name")));
  }
  return sets;
}

std::vector<MetricBlock> metric_blocks(const Parameters& at, const MetricSets& sets) {
  std::vector<MetricBlock> blocks;
  const auto put = [&](const Parameters& metric, bool shared) {
    const std::string name = metric.text("name");
    const auto same = std::find_if(blocks.begin(), blocks.end(),
                                   [&](const MetricBlock& b) { return b.shared && b.at.text("name") == name; });
    if (same == blocks.end()) blocks.push_back({metric, shared});
    else *same = {metric, shared};
  };
  if (at.has("metric_sets"))
    for (const std::string& name : at.texts("metric_sets")) {
      const auto set = sets.find(name);
      if (set == sets.end()) {
        std::string known;
        for (const auto& [key, metrics] : sets) known += known.empty() ? key : ", " + key;
        at.fail("metric_sets", fmt::format("found \"{}\", expected a [[metric-set.NAME]] of this file: {}", name,
                                           known.empty() ? "there is none" : known));
      }
      for (const Parameters& metric : set->second) put(metric, true);
    }
  for (const Parameters& metric : at.tables("metric")) put(metric, false);
  return blocks;
}

bool applies(const Parameters& at, const Parameters& parameters) {
  if (!at.has("when")) return true;
  const Parameters when = at.table("when");
  bool result = true;
  for (const std::string& key : when.keys()) {
    if (!parameters.has(key))
      when.fail(key, "found a condition on a parameter that this case does not have, expected one of its parameters");
    const std::string value = parameters.word(key);
    bool listed = false;
    for (std::size_t i = 0; i < when.length(key); ++i) listed = listed || when.word(key, i) == value;
    result = result && listed;
  }
  return result;
}

MetricSpec read_metric(const Parameters& at, const Bibliography& bibliography, const CaseSpec& spec) {
  MetricSpec metric;
  metric.name = at.text("name");
  if (!std::regex_match(metric.name, std::regex("[a-z][a-z0-9_]*")))
    at.fail("name", fmt::format("found \"{}\", expected small letters, digits and underscores", metric.name));
  metric.symbol = at.text("symbol");
  metric.description = at.text_or("description", "");
  const std::string symbol = at.text("unit");
  const auto unit = parse_unit(symbol);
  if (!unit)
    at.fail("unit", fmt::format("found \"{}\", expected a unit that furrow knows, such as \"1\", \"mm\" or \"MPa\"", symbol));
  metric.unit = *unit;
  metric.reference_class = at.choice("class", classes);
  read_norm(at, metric);
  read_ladder(at, metric);
  read_reference(at, bibliography, metric);
  read_band(at, metric);
  read_known_gap(at, metric);

  metric.spacing_index = spec.spacing.empty() ? 0 : spec.spacing.size() - 1;
  if (at.has("at")) {
    const Parameters rung = at.table("at");
    if (rung.has("spacing"))
      metric.spacing_index = rung_of(rung, "spacing", rung.quantity("spacing", dimension::length, range::positive), spec.spacing);
    if (rung.has("h_over_dx")) metric.ratio_index = rung_of(rung, "h_over_dx", rung.number("h_over_dx"), spec.smoothing_ratio);
  }
  return metric;
}

void check_metrics(const std::vector<Parameters>& blocks, const CaseSpec& spec) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const MetricSpec& metric = spec.metrics[i];
    if (!names.insert(metric.name).second)
      blocks[i].fail("name", fmt::format("found \"{}\" twice in this case, expected a name of its own", metric.name));
    if (metric.ladder && spec.spacing.size() < 3 && spec.overrides.empty())
      blocks[i].fail("ladder", fmt::format("found a ladder of {} spacings, expected at least three", spec.spacing.size()));
    if (metric.ladder_of().empty()) continue;
    const char* key = metric.limit_of.empty() ? "observed_order_of" : "limit_of";
    const auto of = std::find_if(spec.metrics.begin(), spec.metrics.end(),
                                 [&](const MetricSpec& m) { return m.name == metric.ladder_of(); });
    if (of == spec.metrics.end() || !of->ladder)
      blocks[i].fail(key, fmt::format("found \"{}\", expected a metric of this case that has a ladder", metric.ladder_of()));
    if (!metric.limit_of.empty() && (of->ladder != LadderKind::value || of->unit.symbol != metric.unit.symbol))
      blocks[i].fail(key, fmt::format("found \"{}\", expected a metric with a ladder of values in the same unit", metric.limit_of));
  }
}

}  // namespace furrow
