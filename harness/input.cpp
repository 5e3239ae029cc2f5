#include "harness/input.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <toml++/toml.h>

namespace furrow {
namespace {

struct Place {
  std::string file;
  int line = 0;
};
// Where every node below a table stands, by its path in that table: "metric[2].band".
using Places = std::map<std::string, Place, std::less<>>;

std::string join(std::string_view path, std::string_view key) {
  return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
}

void record_places(const toml::node& node, const std::string& path, const std::string& file, Places& places) {
  places[path] = {file, static_cast<int>(node.source().begin.line)};
  if (const auto* table = node.as_table()) {
    for (const auto& [key, value] : *table) record_places(value, join(path, key.str()), file, places);
  } else if (const auto* array = node.as_array()) {
    for (std::size_t i = 0; i < array->size(); ++i) record_places((*array)[i], fmt::format("{}[{}]", path, i), file, places);
  }
}

// The places of everything at and below `path`, renamed to be below `renamed`.
Places places_below(const Places& all, const std::string& path, const std::string& renamed) {
  Places below;
  for (auto it = all.lower_bound(path); it != all.end() && it->first.starts_with(path); ++it) {
    std::string_view rest = std::string_view(it->first).substr(path.size());
    if (!rest.empty() && rest.front() != '.' && rest.front() != '[') continue;
    if (renamed.empty() && rest.starts_with('.')) rest.remove_prefix(1);
    below[renamed + std::string(rest)] = it->second;
  }
  return below;
}

// A value as it would be written in TOML, cut when it is long.
std::string written(const toml::node& node) {
  if (const auto text = node.value_exact<std::string>()) return fmt::format("\"{}\"", *text);
  if (const auto number = node.value_exact<double>()) return fmt::format("{}", *number);
  std::string inner;
  if (const auto* array = node.as_array()) {
    for (const toml::node& entry : *array) inner += (inner.empty() ? "" : ", ") + written(entry);
    return "[" + inner + "]";
  }
  if (const auto* table = node.as_table()) {
    for (const auto& [key, value] : *table)
      inner += fmt::format("{}{} = {}", inner.empty() ? "" : ", ", key.str(), written(value));
    return inner.empty() ? "{}" : "{ " + inner + " }";
  }
  std::ostringstream out;
  out << toml::node_view<const toml::node>(node);
  return out.str();
}

std::string shown(const toml::node& node) {
  std::string text = written(node);
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.size() > 60 ? text.substr(0, 57) + "..." : text;
}

std::string joined(const std::vector<std::string>& words, std::string_view between) {
  std::string result;
  for (const std::string& word : words) {
    if (!result.empty()) result += between;
    result += word;
  }
  return result;
}

std::string number_words(double x) { return fmt::format("{:g}", x); }

constexpr std::string_view unit_example(Dimension d) {
  if (d == dimension::length) return "mm";
  if (d == dimension::stress) return "MPa";
  if (d == dimension::time) return "ms";
  if (d == dimension::velocity) return "m/s";
  return {};
}

}  // namespace

std::string fingerprint(std::string_view text) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return fmt::format("{:016x}", hash);
}

struct Parameters::Node {
  toml::table table;
  std::string path;    // of this table in its file, for messages
  Place place;
  Places places;
  std::set<std::string, std::less<>> asked;                          // keys that were asked for, present or not
  std::map<std::string, std::shared_ptr<Node>, std::less<>> tables;  // those handed out, so that all copies share one record
  std::map<std::string, std::string> files;                          // name and hash of files that were read besides

  Place place_of(std::string_view key) const {
    const auto it = places.find(key);
    return it == places.end() ? place : it->second;
  }
  [[noreturn]] void fail(std::string_view key, std::string_view message) const {
    const Place at = place_of(key);
    throw InputError(at.file, at.line, join(path, key), message);
  }
  const toml::node* find(std::string_view key) {
    asked.emplace(key);
    return table.get(key);
  }
  const toml::node& need(std::string_view key, std::string_view expected) {
    const toml::node* node = find(key);
    if (!node) fail(key, fmt::format("found nothing, expected {}", expected));
    return *node;
  }
  [[noreturn]] void wrong(std::string_view key, const toml::node& node, std::string_view expected) const {
    fail(key, fmt::format("found {}, expected {}", shown(node), expected));
  }
  double number_in(std::string_view key, const toml::node& node, Range allowed, std::string_view expected) const {
    const auto value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value || !allowed.contains(*value)) wrong(key, node, expected);
    return *value;
  }
  Unit unit_in(std::string_view key, const toml::table& quantity, Dimension dimension) const {
    for (const auto& [name, value] : quantity)
      if (name != "value" && name != "unit")
        fail(fmt::format("{}.{}", key, name.str()), "unknown key, expected value and unit only");
    const toml::node* node = quantity.get("unit");
    const auto symbol = node ? node->value_exact<std::string>() : std::nullopt;
    const std::string_view example = unit_example(dimension);
    const std::string expected = fmt::format("a unit of dimension {}{}", si_symbol(dimension),
                                             example.empty() ? "" : fmt::format(", such as \"{}\"", example));
    const std::string unit_key = fmt::format("{}.unit", key);
    if (!symbol) fail(node ? unit_key : key, fmt::format("found {}, expected {}", node ? shown(*node) : "no unit", expected));
    const auto unit = parse_unit(*symbol);
    if (!unit) fail(unit_key, fmt::format("found \"{}\", which is no unit that furrow knows, expected {}", *symbol, expected));
    if (unit->dimension != dimension)
      fail(unit_key,
           fmt::format("found \"{}\", which is of dimension {}, expected {}", *symbol, si_symbol(unit->dimension), expected));
    return *unit;
  }
  static std::string quantity_words(Dimension dimension, Range allowed, bool list) {
    const std::string_view example = unit_example(dimension);
    const std::string unit = example.empty() ? si_symbol(dimension) : std::string(example);
    return fmt::format("{} with unit, {}, as in {{ value = {}, unit = \"{}\" }}", list ? "numbers" : "a number", allowed.words(),
                       list ? "[2, 1]" : "2.5", unit);
  }
};

Parameters Parameters::parse(std::string_view text, std::string file) {
  auto node = std::make_shared<Node>();
  node->place = {file, 1};
  try {
    node->table = toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    throw InputError(file, static_cast<int>(error.source().begin.line), "", fmt::format("not TOML: {}", error.description()));
  }
  record_places(node->table, "", file, node->places);
  return Parameters(std::move(node));
}

Parameters Parameters::read(const std::filesystem::path& file) {
  std::error_code none;
  if (!std::filesystem::exists(file, none)) throw InputError(file.string(), 0, "", "found no such file, expected a TOML file");
  if (!std::filesystem::is_regular_file(file, none))
    throw InputError(file.string(), 0, "", "found no regular file, expected a TOML file");
  std::ifstream in(file);
  std::ostringstream text;
  if (!(text << in.rdbuf()) && std::filesystem::file_size(file, none) > 0)
    throw InputError(file.string(), 0, "", "cannot be read, expected a TOML file that this user may read");
  return parse(text.str(), file.string());
}

bool Parameters::has(std::string_view key) const { return node_->find(key) != nullptr; }

bool Parameters::is_table(std::string_view key) const {
  const auto* value = node_->find(key);
  return value != nullptr && value->is_table();
}

double Parameters::number(std::string_view key, Range allowed) const {
  const std::string expected = fmt::format("a number, {}", allowed.words());
  return node_->number_in(key, node_->need(key, expected), allowed, expected);
}

double Parameters::number_or(std::string_view key, double otherwise, Range allowed) const {
  return has(key) ? number(key, allowed) : otherwise;
}

namespace {

/// The bounds, which are in SI, as numbers of a unit.
Range in_unit(Range range, const Unit& unit) {
  range.low /= unit.factor;
  range.high /= unit.factor;
  return range;
}

}  // namespace

double Parameters::quantity(std::string_view key, Dimension dimension, Range allowed) const {
  const std::string expected = Node::quantity_words(dimension, allowed, false);
  const toml::node& node = node_->need(key, expected);
  if (dimension == dimension::none && node.is_number()) return node_->number_in(key, node, allowed, expected);
  const toml::table* quantity = node.as_table();
  const toml::node* value = quantity ? quantity->get("value") : nullptr;
  if (!value) node_->wrong(key, node, expected);
  const Unit unit = node_->unit_in(key, *quantity, dimension);
  return node_->number_in(fmt::format("{}.value", key), *value, in_unit(allowed, unit), expected) * unit.factor;
}

double Parameters::quantity_or(std::string_view key, Dimension dimension, double otherwise, Range allowed) const {
  return has(key) ? quantity(key, dimension, allowed) : otherwise;
}

long Parameters::integer(std::string_view key, long low, long high) const {
  const std::string expected = fmt::format("a whole number between {} and {}", low, high);
  const toml::node& node = node_->need(key, expected);
  const auto value = node.value_exact<std::int64_t>();
  if (!value || *value < low || *value > high) node_->wrong(key, node, expected);
  return static_cast<long>(*value);
}

long Parameters::integer_or(std::string_view key, long otherwise, long low, long high) const {
  return has(key) ? integer(key, low, high) : otherwise;
}

bool Parameters::flag(std::string_view key) const {
  const toml::node& node = node_->need(key, "true or false");
  const auto value = node.value_exact<bool>();
  if (!value) node_->wrong(key, node, "true or false");
  return *value;
}

bool Parameters::flag_or(std::string_view key, bool otherwise) const { return has(key) ? flag(key) : otherwise; }

std::string Parameters::text(std::string_view key) const {
  const toml::node& node = node_->need(key, "text in quotes");
  auto value = node.value_exact<std::string>();
  if (!value) node_->wrong(key, node, "text in quotes");
  return *std::move(value);
}

std::string Parameters::text_or(std::string_view key, std::string_view otherwise) const {
  return has(key) ? text(key) : std::string(otherwise);
}

std::string Parameters::choice(std::string_view key, const std::vector<std::string>& allowed) const {
  const std::string expected = fmt::format("one of \"{}\"", joined(allowed, "\", \""));
  const toml::node& node = node_->need(key, expected);
  auto value = node.value_exact<std::string>();
  if (!value || std::find(allowed.begin(), allowed.end(), *value) == allowed.end()) {
    const std::string nearest = value ? nearest_word(*value, allowed) : "";
    node_->wrong(key, node, nearest.empty() ? expected : fmt::format("{}; did you mean \"{}\"?", expected, nearest));
  }
  return *std::move(value);
}

std::string Parameters::choice_or(std::string_view key, std::string_view otherwise,
                                  const std::vector<std::string>& allowed) const {
  return has(key) ? choice(key, allowed) : std::string(otherwise);
}

std::vector<double> Parameters::numbers(std::string_view key, Range allowed) const {
  const std::string expected = fmt::format("a list of numbers, each {}", allowed.words());
  const toml::node& node = node_->need(key, expected);
  const toml::array* array = node.as_array();
  if (!array) node_->wrong(key, node, expected);
  std::vector<double> result;
  for (const toml::node& entry : *array)
    result.push_back(node_->number_in(fmt::format("{}[{}]", key, result.size()), entry, allowed,
                                      fmt::format("a number, {}", allowed.words())));
  return result;
}

std::vector<double> Parameters::quantities(std::string_view key, Dimension dimension, Range allowed) const {
  const std::string expected = Node::quantity_words(dimension, allowed, true);
  const toml::node& node = node_->need(key, expected);
  if (dimension == dimension::none && node.is_array()) return numbers(key, allowed);
  const toml::table* quantity = node.as_table();
  const toml::node* values = quantity ? quantity->get("value") : nullptr;
  if (!values || !values->is_array()) node_->wrong(key, node, expected);
  const Unit unit = node_->unit_in(key, *quantity, dimension);
  std::vector<double> result;
  for (const toml::node& entry : *values->as_array())
    result.push_back(unit.factor * node_->number_in(fmt::format("{}.value[{}]", key, result.size()), entry, in_unit(allowed, unit),
                                                    fmt::format("a number, {}", allowed.words())));
  return result;
}

std::vector<std::string> Parameters::texts(std::string_view key) const {
  const toml::node& node = node_->need(key, "a list of texts in quotes");
  const toml::array* array = node.as_array();
  if (!array) node_->wrong(key, node, "a list of texts in quotes");
  std::vector<std::string> result;
  for (const toml::node& entry : *array) {
    auto value = entry.value_exact<std::string>();
    if (!value) node_->wrong(fmt::format("{}[{}]", key, result.size()), entry, "text in quotes");
    result.push_back(*std::move(value));
  }
  return result;
}

namespace {

std::shared_ptr<Parameters::Node> child(const Parameters::Node& parent, const toml::table& table, const std::string& key) {
  auto node = std::make_shared<Parameters::Node>();
  node->table = table;
  node->path = join(parent.path, key);
  node->place = parent.place_of(key);
  node->places = places_below(parent.places, key, "");
  return node;
}

}  // namespace

Parameters Parameters::table(std::string_view key) const {
  const toml::node& node = node_->need(key, fmt::format("a table, {} = {{ ... }}", key));
  const toml::table* table = node.as_table();
  if (!table) node_->wrong(key, node, fmt::format("a table, {} = {{ ... }}", key));
  auto& handed_out = node_->tables[std::string(key)];
  if (!handed_out) handed_out = child(*node_, *table, std::string(key));
  return Parameters(handed_out);
}

Parameters Parameters::table_or_empty(std::string_view key) const {
  return has(key) ? table(key) : Parameters(child(*node_, toml::table{}, std::string(key)));
}

std::vector<Parameters> Parameters::tables(std::string_view key) const {
  std::vector<Parameters> result;
  const toml::node* node = node_->find(key);
  if (!node) return result;
  const std::string expected = fmt::format("an array of tables, [[{}]]", join(node_->path, key));
  const toml::array* array = node->as_array();
  if (!array) node_->wrong(key, *node, expected);
  for (std::size_t i = 0; i < array->size(); ++i) {
    const std::string indexed = fmt::format("{}[{}]", key, i);
    const toml::table* table = (*array)[i].as_table();
    if (!table) node_->wrong(indexed, (*array)[i], expected);
    auto& handed_out = node_->tables[indexed];
    if (!handed_out) handed_out = child(*node_, *table, indexed);
    result.push_back(Parameters(handed_out));
  }
  return result;
}

std::chrono::year_month_day Parameters::date(std::string_view key) const {
  const toml::node& node = node_->need(key, "a date, as in 2026-11-22");
  const auto value = node.value_exact<toml::date>();
  if (!value) node_->wrong(key, node, "a date without quotes, as in 2026-11-22");
  return {std::chrono::year{value->year}, std::chrono::month{value->month}, std::chrono::day{value->day}};
}

namespace {

std::string word_of(const toml::node& node) {
  if (const auto text = node.value_exact<std::string>()) return *text;
  if (const auto number = node.value_exact<std::int64_t>()) return fmt::format("{}", *number);
  if (const auto number = node.value_exact<double>()) return number_words(*number);
  if (const auto flag = node.value_exact<bool>()) return *flag ? "true" : "false";
  if (const auto* quantity = node.as_table())
    if (const toml::node* value = quantity->get("value"); value && value->is_number()) return word_of(*value);
  return {};
}

constexpr std::string_view plain_list = "a list of texts, numbers or quantities with unit";

}  // namespace

std::size_t Parameters::length(std::string_view key) const {
  const toml::node& node = node_->need(key, plain_list);
  if (!node.is_array()) node_->wrong(key, node, plain_list);
  return node.as_array()->size();
}

std::string Parameters::word(std::string_view key, std::size_t index) const {
  const std::size_t size = length(key);
  if (index >= size) throw std::out_of_range(fmt::format("entry {} of {} in a list of {}", index, key, size));
  const toml::node& entry = (*node_->need(key, plain_list).as_array())[index];
  const std::string result = word_of(entry);
  if (result.empty()) node_->wrong(fmt::format("{}[{}]", key, index), entry, "a text, a number or a quantity with unit");
  return result;
}

std::string Parameters::word(std::string_view key) const {
  const toml::node& node = node_->need(key, "a text, a number or a quantity with unit");
  const std::string result = word_of(node);
  if (result.empty()) node_->wrong(key, node, "a text, a number or a quantity with unit");
  return result;
}

bool Parameters::is_text(std::string_view key) const {
  const toml::node* node = node_->find(key);
  return node && node->is_string();
}

std::vector<std::string> Parameters::keys() const {
  std::vector<std::string> result;
  for (const auto& [key, value] : node_->table) result.emplace_back(key.str());
  return result;
}

const std::string& Parameters::file() const { return node_->place.file; }
int Parameters::line() const { return node_->place.line; }
int Parameters::line(std::string_view key) const { return node_->place_of(key).line; }
void Parameters::fail(std::string_view key, std::string_view message) const { node_->fail(key, message); }

bool Parameters::was_read(std::string_view key) const { return node_->asked.contains(key); }

void Parameters::check_all_used() const {
  const std::vector<std::string> known(node_->asked.begin(), node_->asked.end());
  for (const auto& [key, value] : node_->table) {
    if (node_->asked.contains(key.str())) continue;
    const std::string nearest = nearest_word(key.str(), known);
    node_->fail(key.str(),
                fmt::format("unknown key{}; known here: {}", nearest.empty() ? "" : fmt::format(", did you mean '{}'?", nearest),
                            known.empty() ? "none" : joined(known, ", ")));
  }
  for (const auto& [key, below] : node_->tables) Parameters(below).check_all_used();
}

Parameters Parameters::copy() const {
  auto node = std::make_shared<Node>(*node_);
  node->asked.clear();
  node->tables.clear();
  node->files.clear();
  return Parameters(std::move(node));
}

namespace {

void put(toml::table& table, std::string_view key, const toml::node& value) {
  value.visit([&](const auto& concrete) { table.insert_or_assign(key, concrete); });
}

}  // namespace

namespace {

// The table that a dotted path leads to, made where it is missing, and what remains of the path: the key in it.
std::pair<toml::table*, std::string_view> descend(toml::table& root, std::string_view path, const std::string& origin) {
  toml::table* table = &root;
  std::string_view rest = path;
  for (std::size_t dot = rest.find('.'); dot != std::string_view::npos; dot = rest.find('.')) {
    const std::string_view key = rest.substr(0, dot);
    toml::node* below = table->get(key);
    if (!below) below = &table->insert_or_assign(key, toml::table{}).first->second;
    if (!below->is_table())
      throw InputError(origin, 0, path, fmt::format("found '{}', which is no table here, expected the path of a key", key));
    table = below->as_table();
    rest.remove_prefix(dot + 1);
  }
  if (rest.empty()) throw InputError(origin, 0, path, "found no key, expected one, such as parameters.kernel");
  return {table, rest};
}

void forget_places(Places& places, const std::string& path) {
  for (const auto& [below, place] : places_below(places, path, path)) places.erase(below);
}

}  // namespace

void Parameters::assign(std::string_view path, const Parameters& from, std::string_view from_key, std::size_t index) {
  const std::string indexed = fmt::format("{}[{}]", from_key, index);
  const auto [table, key] = descend(node_->table, path, file());
  put(*table, key, (*from.node_->need(from_key, plain_list).as_array())[index]);
  forget_places(node_->places, std::string(path));
  node_->places.merge(places_below(from.node_->places, indexed, std::string(path)));
}

void Parameters::assign(std::string_view path, std::string_view value, const std::string& origin) {
  toml::table parsed;
  try {
    parsed = toml::parse(fmt::format("value = {}\n", value));
  } catch (const toml::parse_error&) {
    parsed.insert_or_assign("value", std::string(value));
  }
  const auto [table, key] = descend(node_->table, path, origin);
  put(*table, key, *parsed.get("value"));
  forget_places(node_->places, std::string(path));
  Places places;
  record_places(*parsed.get("value"), std::string(path), origin, places);
  for (auto& [below, place] : places) place.line = 0;
  node_->places.merge(places);
}

std::string Parameters::json() const {
  std::ostringstream out;
  out << toml::json_formatter(node_->table);
  return out.str();
}

void Parameters::depends_on(const std::filesystem::path& file) const {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in.is_open() || in.bad())
    throw InputError(file.string(), 0, "", "cannot be read, expected a file that this user may read");
  node_->files[file.filename().string()] += fingerprint(text.view());
}

std::string Parameters::dependencies() const {
  std::string all;
  for (const auto& [name, hash] : node_->files) all += fmt::format("{} {}\n", name, hash);
  for (const auto& [key, below] : node_->tables) all += Parameters(below).dependencies();
  return all;
}

}  // namespace furrow
