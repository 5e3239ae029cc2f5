#include "harness/case_file.hpp"

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>

#include <fmt/format.h>

#include "harness/metric_file.hpp"

namespace furrow {
namespace {

constexpr std::array<double, 4> default_time_limit{60.0, 300.0, 3600.0, 21600.0};   // s, by tier

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
    for (const Parameters& metric : metrics) {
      if (!metric.was_read("class"))
        metric.fail("name", "found a metric that no case takes from this set, expected one that does: each brings its own of this "
                            "name");
      metric.check_all_used();
    }
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
