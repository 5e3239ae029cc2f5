#include "harness/case_file.hpp"

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>

#include <fmt/format.h>

namespace furrow {
namespace {

constexpr std::array<double, 4> default_time_limit{60.0, 300.0, 3600.0, 21600.0};   // s, by tier

// States of a ladder in which an order can mean something.
constexpr std::array gateable{LadderState::asymptotic, LadderState::plateau, LadderState::undetermined};

const std::vector<std::string> classes{"exact", "manufactured", "independent", "experiment", "published", "self"};

std::string replaced(std::string text, char from, char to) {
  std::replace(text.begin(), text.end(), from, to);
  return text;
}

// Fills {key} with the sweep's value.
std::string filled(const Parameters& at, std::string_view key, std::string text, const std::map<std::string, std::string>& values,
                   char underscore) {
  for (std::size_t open = text.find('{'); open != std::string::npos; open = text.find('{', open)) {
    const std::size_t close = text.find('}', open);
    const std::string word = text.substr(open + 1, close == std::string::npos ? close : close - open - 1);
    const auto value = values.find(word);
    if (close == std::string::npos || value == values.end())
      at.fail(key, fmt::format("found {{{}}}, expected a key of the sweep in braces", word));
    const std::string inserted = replaced(value->second, '_', underscore);
    text.replace(open, close - open + 1, inserted);
    open += inserted.size();
  }
  return text;
}

void read_sources(const Parameters& table, Bibliography& bibliography) {
  for (const std::string& key : table.keys()) {
    const Parameters entry = table.table(key);
    const Citation citation{key, entry.text("text"), entry.text_or("doi", "")};
    entry.check_all_used();
    if (!bibliography.emplace(key, citation).second)
      table.fail(key, "found a source of this name before, expected a name of its own");
  }
}

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

void read_resolution(const Parameters& at, CaseSpec& spec) {
  if (!at.has("resolution")) return;
  const Parameters resolution = at.table("resolution");
  spec.spacing = resolution.quantities("spacing", dimension::length, range::positive);
  spec.spacing_unit = resolution.table("spacing").text("unit");
  resolution.table("spacing").has("value");
  spec.smoothing_ratio = resolution.numbers("h_over_dx", {0.8, 4.0});
  const auto check = [&](std::string_view key, std::vector<double> list) {
    if (list.empty()) resolution.fail(key, "found an empty list, expected at least one number");
    std::sort(list.begin(), list.end());
    if (std::adjacent_find(list.begin(), list.end()) != list.end())
      resolution.fail(key, "found a number twice, expected each once");
  };
  check("spacing", spec.spacing);
  check("h_over_dx", spec.smoothing_ratio);
  std::sort(spec.spacing.begin(), spec.spacing.end(), std::greater<>());
}

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

/// Metrics that cases of a file share, by the name of their set.
using MetricSets = std::map<std::string, std::vector<Parameters>>;

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

struct MetricBlock {
  Parameters at;
  bool shared;   ///< from a set
};

/// Metrics of the sets that a case names, in their order, then its own. Of one name, a later set's and the case's own stand in
/// the place of an earlier set's.
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

using Combination = std::map<std::string, std::size_t>;   // sweep key -> index of its value

std::vector<Combination> combinations(const Parameters& at) {
  std::vector<Combination> result{{}};
  if (!at.has("sweep")) return result;
  const Parameters sweep = at.table("sweep");
  for (const std::string& key : sweep.keys()) {
    const std::size_t length = sweep.length(key);
    if (length == 0) sweep.fail(key, "found an empty list, expected at least one value");
    std::vector<Combination> longer;
    for (const Combination& c : result)
      for (std::size_t i = 0; i < length; ++i) {
        longer.push_back(c);
        longer.back()[key] = i;
      }
    result = std::move(longer);
  }
  return result;
}

CaseSpec read_instance(const Parameters& block, const Combination& combination, const Family& family,
                       const Bibliography& bibliography, const MetricSets& sets, const Overrides& overrides) {
  Parameters at = block.copy();
  CaseSpec spec;
  spec.family = family.name();

  std::map<std::string, std::string> words;
  if (!combination.empty()) {
    const Parameters sweep = at.table("sweep");
    const Parameters given = at.table_or_empty("parameters").copy();
    for (const auto& [key, index] : combination) {
      if (given.has(key)) sweep.fail(key, "found in parameters too, expected it in one of the two");
      words[key] = sweep.word(key, index);
    }
  }
  const std::string name = filled(at, "name", at.text("name"), words, '-');
  if (!std::regex_match(name, std::regex("[a-z0-9][a-z0-9._-]*")))
    at.fail("name", fmt::format("found \"{}\", expected small letters, digits, dots and dashes", name));
  spec.id = family.name() + "/" + name;

  Parameters changed = at.copy();
  if (!combination.empty()) {
    const Parameters sweep = at.table("sweep");
    for (const auto& [key, index] : combination) changed.assign("parameters." + key, sweep, key, index);
  }
  if (std::find(overrides.ids.begin(), overrides.ids.end(), spec.id) != overrides.ids.end()) {
    for (const std::string& assignment : overrides.assignments) {
      const std::size_t equals = assignment.find('=');
      if (equals == std::string::npos || equals == 0)
        throw InputError("--set " + assignment, 0, "", "expected KEY=VALUE, such as parameters.kernel=wendland_c2");
      const std::string key = assignment.substr(0, equals);
      if (!key.starts_with("parameters.") && !key.starts_with("resolution.") && !key.starts_with("time_limit"))
        throw InputError("--set " + assignment, 0, key, "expected a key below parameters or resolution, or time_limit");
      changed.assign(key, assignment.substr(equals + 1), "--set " + assignment);
    }
    spec.overrides = overrides.assignments;
  }
  at = changed;

  at.has("name");
  at.has("sweep");
  if (at.has("sweep")) for (const Parameters sweep = at.table("sweep"); const std::string& key : sweep.keys()) sweep.has(key);
  const auto text = [&](std::string_view key) { return filled(at, key, at.text(key), words, ' '); };
  spec.title = text("title");
  spec.why = text("why");
  spec.description = text("description");
  spec.tier = tier_by_name(at.choice("tier", tier_names));
  spec.time_limit =
      at.quantity_or("time_limit", dimension::time, default_time_limit[static_cast<std::size_t>(spec.tier)], range::positive);
  read_resolution(at, spec);

  const Parameters parameters = at.table_or_empty("parameters");
  std::vector<Parameters> blocks;
  std::string shared;
  for (const auto& [metric, from_set] : metric_blocks(at, sets)) {
    if (from_set) shared += metric.json();
    const bool applicable = applies(metric, parameters);
    MetricSpec read = read_metric(metric, bibliography, spec);
    if (!applicable) continue;
    spec.metrics.push_back(std::move(read));
    blocks.push_back(metric);
  }
  check_metrics(blocks, spec);

  std::set<std::string> cited;
  const auto cite = [&](const std::string& key) {
    if (cited.insert(key).second) spec.citations.push_back(bibliography.find(key)->second);
  };
  for (const MetricSpec& metric : spec.metrics) cite(metric.source);
  if (at.has("sources"))
    for (const std::string& key : at.texts("sources")) cite(known_source(at, "sources", key, bibliography));

  std::vector<std::string> known;
  for (const auto& [problem, build] : family.problems()) known.push_back(problem);
  spec.problem = at.choice("problem", known);
  spec.run = family.problems().find(spec.problem)->second(parameters);
  at.check_all_used();
  parameters.check_all_used();
  spec.parameters_json = parameters.json();
  spec.fingerprint = fingerprint(at.json() + shared + parameters.dependencies());
  return spec;
}

}  // namespace

Tier tier_by_name(const std::string& name) {
  const auto it = std::find(tier_names.begin(), tier_names.end(), name);
  if (it == tier_names.end()) throw std::invalid_argument("no tier is named " + name);
  return static_cast<Tier>(it - tier_names.begin());
}

Bibliography read_bibliography(const std::filesystem::path& file) {
  Bibliography bibliography;
  read_sources(Parameters::read(file), bibliography);
  return bibliography;
}

std::vector<CaseSpec> read_case_file(const std::filesystem::path& file, const std::vector<Family>& families, const Family* family,
                                     const Bibliography& bibliography, const Overrides& overrides) {
  const Parameters root = Parameters::read(file);
  std::vector<std::string> names;
  for (const Family& f : families) names.push_back(f.name());
  const std::string named = family ? root.choice("family", {family->name()}) : root.choice("family", names);
  const Family& of = *std::find_if(families.begin(), families.end(), [&](const Family& f) { return f.name() == named; });

  Bibliography sources = bibliography;
  if (root.has("sources")) read_sources(root.table("sources"), sources);

  const MetricSets sets = read_metric_sets(root);
  std::vector<CaseSpec> specs;
  for (const Parameters& block : root.tables("case"))
    for (const Combination& combination : combinations(block)) {
      CaseSpec spec = read_instance(block, combination, of, sources, sets, overrides);
      spec.file = file;
      if (std::any_of(specs.begin(), specs.end(), [&](const CaseSpec& s) { return s.id == spec.id; }))
        block.fail("name", fmt::format("found a second case {}, expected a name of its own", spec.id));
      specs.push_back(std::move(spec));
    }
  if (specs.empty()) root.fail("case", "found no case, expected at least one [[case]]");
  for (const auto& [name, metrics] : sets)
    for (const Parameters& metric : metrics) metric.check_all_used();
  root.table_or_empty("sources");
  for (const std::string& key : root.keys())
    if (key != "family" && key != "case" && key != "sources" && key != "metric-set") {
      const std::string nearest = nearest_word(key, {"family", "case", "sources", "metric-set"});
      root.fail(key, fmt::format("unknown key{}; known here: family, case, sources, metric-set",
                                 nearest.empty() ? "" : fmt::format(", did you mean '{}'?", nearest)));
    }
  return specs;
}

std::vector<CaseSpec> read_all_cases(const std::vector<Family>& families, const std::filesystem::path& root,
                                     const std::vector<std::filesystem::path>& outside, const Overrides& overrides) {
  const Bibliography bibliography = read_bibliography(root / "reference/sources.toml");
  std::vector<CaseSpec> all;
  const auto add = [&](std::vector<CaseSpec> specs) {
    for (CaseSpec& spec : specs) {
      const auto same = std::find_if(all.begin(), all.end(), [&](const CaseSpec& s) { return s.id == spec.id; });
      if (same != all.end())
        throw InputError(spec.file.string(), 0, spec.id,
                         fmt::format("found a case of this name in {} too, expected a name of its own", same->file.string()));
      all.push_back(std::move(spec));
    }
  };
  for (const Family& family : families)
    add(read_case_file(root / family.folder() / "cases.toml", families, &family, bibliography, overrides));
  for (const std::filesystem::path& file : outside) add(read_case_file(file, families, nullptr, bibliography, overrides));
  return all;
}

}  // namespace furrow
