#include "harness/gate.hpp"

#include <cmath>
#include <limits>

#include "tests/catch.hpp"

using namespace furrow;
using std::chrono::year;

namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr std::chrono::year_month_day today{year{2026}, std::chrono::November, std::chrono::day{22}};

MetricSpec metric(std::string name, Norm norm, double reference, Band band) {
  MetricSpec m;
  m.name = std::move(name);
  m.unit = unit("mm");
  m.norm = norm;
  m.reference = reference;
  m.standard_uncertainty = 0.0;
  m.band = band;
  m.states = {LadderState::asymptotic};
  return m;
}

CaseSpec with(std::vector<MetricSpec> metrics) {
  CaseSpec spec;
  spec.metrics = std::move(metrics);
  return spec;
}

Rung one(const std::string& name, Measurement measurement) {
  Rung rung;
  rung.measurements[name] = std::move(measurement);
  return rung;
}

// A case of four spacings at one h/dx, and what it measured there.
std::pair<CaseSpec, std::vector<Rung>> laddered(const std::vector<double>& errors,
                                                std::vector<LadderState> states = {LadderState::asymptotic}) {
  MetricSpec error = metric("error", Norm::value, nan_value, {0.0, 1.0});
  error.unit = unit("1");
  error.ladder = LadderKind::error;
  error.spacing_index = errors.size() - 1;
  MetricSpec order = metric("order", Norm::value, nan_value, {1.8, 2.2});
  order.unit = unit("1");
  order.observed_order_of = "error";
  order.states = std::move(states);
  CaseSpec spec = with({error, order});
  spec.smoothing_ratio = {1.2};
  std::vector<Rung> rungs;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    spec.spacing.push_back(8e-3 / std::pow(2.0, static_cast<double>(i)));
    Rung rung = one("error", {errors[i], "1", {}, {}});
    rung.spacing_index = i;
    rungs.push_back(rung);
  }
  return {spec, rungs};
}

Verdict verdict_of(const MetricSpec& m, Measurement measured) {
  return judge(with({m}), {one(m.name, std::move(measured))}, today).metrics[0].verdict;
}

}  // namespace

TEST_CASE("A number passes inside its band, ends included, and nowhere else", "[gate]") {
  const MetricSpec length = metric("length", Norm::absolute, 10.0, {-0.5, 0.25});
  CHECK(verdict_of(length, {9.5, "mm", {}, {}}) == Verdict::pass);
  CHECK(verdict_of(length, {10.25, "mm", {}, {}}) == Verdict::pass);
  CHECK(verdict_of(length, {9.499, "mm", {}, {}}) == Verdict::fail);
  CHECK(verdict_of(length, {10.251, "mm", {}, {}}) == Verdict::fail);
}

TEST_CASE("NaN and infinities are errors, whatever the band", "[gate]") {
  constexpr double inf = std::numeric_limits<double>::infinity();
  for (const Band band : {Band{-1.0, 1.0}, Band{-inf, 1.0}, Band{-1.0, inf}})
    for (const double value : {nan_value, inf, -inf}) {
      CHECK(verdict_of(metric("length", Norm::absolute, 0.0, band), {value, "mm", {}, {}}) == Verdict::error);
      CHECK(verdict_of(metric("length", Norm::value, nan_value, band), {value, "mm", {}, {}}) == Verdict::error);
    }
  MetricSpec reported = metric("length", Norm::value, nan_value, {});
  reported.band.reset();
  CHECK(verdict_of(reported, {nan_value, "mm", {}, {}}) == Verdict::error);
}

TEST_CASE("Units are converted; another dimension is an error", "[gate]") {
  const CaseSpec spec = with({metric("length", Norm::absolute, 25.4, {-1e-9, 1e-9})});
  const CaseVerdict metres = judge(spec, {one("length", {0.0254, "m", {}, {}})}, today);
  CHECK(metres.verdict == Verdict::pass);
  CHECK(metres.metrics[0].value == Approx(25.4));
  CHECK(judge(spec, {one("length", {25.4, "MPa", {}, {}})}, today).verdict == Verdict::error);
}

TEST_CASE("Norms: absolute, relative, and the value itself", "[gate]") {
  CHECK(judge(with({metric("l", Norm::relative, 20.0, {-1, 1})}), {one("l", {21.0, "mm", {}, {}})}, today).metrics[0].error ==
        Approx(0.05));
  CHECK(judge(with({metric("l", Norm::absolute, 20.0, {-1, 1})}), {one("l", {21.0, "mm", {}, {}})}, today).metrics[0].error ==
        Approx(1.0));
  CHECK(judge(with({metric("l", Norm::value, 20.0, {-1, 1})}), {one("l", {21.0, "mm", {}, {}})}, today).metrics[0].error ==
        Approx(21.0));
}

TEST_CASE("A computed reference must be handed over, and only then", "[gate]") {
  MetricSpec length = metric("length", Norm::relative, nan_value, {-0.1, 0.1});
  length.computed_reference = true;
  const CaseVerdict given = judge(with({length}), {one("length", {0.021, "m", Reference{0.020, 0.001}, {}})}, today);
  CHECK(given.verdict == Verdict::pass);
  CHECK(given.metrics[0].reference == Approx(20.0));
  CHECK(given.metrics[0].standard_uncertainty == Approx(1.0));
  CHECK(verdict_of(length, {21.0, "mm", {}, {}}) == Verdict::error);
  CHECK(verdict_of(metric("length", Norm::absolute, 20.0, {-9, 9}), {21.0, "mm", Reference{20.0, 0.0}, {}}) == Verdict::error);
  CHECK(verdict_of(length, {21.0, "mm", Reference{0.0, 0.0}, {}}) == Verdict::error);
}

TEST_CASE("What is missing, left over or never gated is an error and never a pass", "[gate]") {
  const MetricSpec length = metric("length", Norm::absolute, 1.0, {-1, 1});
  CHECK(judge(with({}), {Rung{}}, today).verdict == Verdict::error);
  CHECK(judge(with({length}), {Rung{}}, today).verdict == Verdict::error);
  CHECK(judge(with({length}), {}, today).verdict == Verdict::error);

  Rung more = one("length", {1.0, "mm", {}, {}});
  more.measurements["width"] = {1.0, "mm", {}, {}};
  const CaseVerdict left_over = judge(with({length}), {more}, today);
  CHECK(left_over.verdict == Verdict::error);
  CHECK(left_over.reason.find("'width'") != std::string::npos);

  MetricSpec reported = length;
  reported.band.reset();
  CHECK(judge(with({reported}), {one("length", {1.0, "mm", {}, {}})}, today).verdict == Verdict::error);
  CHECK(judge(with({length}), {one("length", {0.0, "1", {}, "no probe there"})}, today).verdict == Verdict::error);

  MetricSpec width = length;
  width.name = "width";
  Rung both = one("length", {0.0, "1", {}, "no probe there"});
  both.measurements["width"] = {1.0, "mm", {}, {}};
  const CaseVerdict partly = judge(with({length, width}), {both}, today);
  CHECK(partly.verdict == Verdict::pass);
  CHECK(partly.metrics[0].verdict == Verdict::skipped);
  CHECK(partly.metrics[0].reason == "no probe there");
}

TEST_CASE("An error outweighs a failure, a failure a known gap, a known gap a pass", "[gate]") {
  const auto named = [](const char* name) { return metric(name, Norm::value, nan_value, {0, 1}); };
  MetricSpec gap = named("gap");
  gap.known_gap = KnownGap{"boundary", today, today + std::chrono::years{1}};
  const CaseSpec spec = with({named("good"), gap, named("bad"), named("nan")});
  Rung rung;
  rung.measurements["good"] = {0.5, "mm", {}, {}};
  rung.measurements["gap"] = {0.5, "mm", {}, {}};
  rung.measurements["bad"] = {0.5, "mm", {}, {}};
  rung.measurements["nan"] = {0.5, "mm", {}, {}};
  CHECK(judge(spec, {rung}, today).verdict == Verdict::pass);
  rung.measurements["gap"].value = 2.0;
  CHECK(judge(spec, {rung}, today).verdict == Verdict::known_gap);
  rung.measurements["bad"].value = 2.0;
  CHECK(judge(spec, {rung}, today).verdict == Verdict::fail);
  rung.measurements["nan"].value = nan_value;
  CHECK(judge(spec, {rung}, today).verdict == Verdict::error);
}

TEST_CASE("A known gap covers a failure until the day of its expiry, and never an error", "[gate]") {
  MetricSpec length = metric("length", Norm::absolute, 1.0, {-0.1, 0.1});
  length.known_gap = KnownGap{"boundary", today, today + std::chrono::months{1}};
  const CaseSpec spec = with({length});
  const std::vector<Rung> outside{one("length", {2.0, "mm", {}, {}})};
  CHECK(judge(spec, outside, today).verdict == Verdict::known_gap);
  CHECK(judge(spec, outside, today).reason.find("boundary") != std::string::npos);
  CHECK(judge(spec, outside, today + std::chrono::months{1}).verdict == Verdict::fail);
  CHECK(judge(spec, {one("length", {nan_value, "mm", {}, {}})}, today).verdict == Verdict::error);
  const CaseVerdict closed = judge(spec, {one("length", {1.0, "mm", {}, {}})}, today);
  CHECK(closed.verdict == Verdict::pass);
  CHECK(closed.metrics[0].reason.find("can go") != std::string::npos);
}

TEST_CASE("An observed order is taken from the ladder and gated with its state", "[gate]") {
  const auto [spec, rungs] = laddered({0.64, 0.16, 0.04, 0.01});
  const CaseVerdict result = judge(spec, rungs, today);
  CHECK(result.verdict == Verdict::pass);
  CHECK(result.metrics[1].value == Approx(2.0));
  REQUIRE(result.metrics[1].ladders.size() == 1);
  CHECK(result.metrics[1].ladders[0].state == LadderState::asymptotic);
  CHECK(result.metrics[0].value == 0.01);

  const auto [high, high_rungs] = laddered({0.8, 0.1, 0.0125, 0.0015625});
  CHECK(judge(high, high_rungs, today).verdict == Verdict::fail);   // order 3, above the band
}

TEST_CASE("An order inside its band does not pass from a ladder in another state", "[gate]") {
  const std::vector<double> falls_then_stands{0.64, 0.16, 0.04, 0.038};
  const auto [spec, rungs] = laddered(falls_then_stands);
  const CaseVerdict result = judge(spec, rungs, today);
  CHECK(result.metrics[1].value == Approx(2.0));
  CHECK(result.metrics[1].verdict == Verdict::fail);
  CHECK(result.metrics[1].reason.find("plateau") != std::string::npos);

  const auto [allowed, same_rungs] = laddered(falls_then_stands, {LadderState::asymptotic, LadderState::plateau});
  CHECK(judge(allowed, same_rungs, today).verdict == Verdict::pass);
}

TEST_CASE("An order from errors at round-off, or with a NaN, is an error", "[gate]") {
  const auto [exact, exact_rungs] = laddered({1e-16, 2e-16, 1e-16, 0.0});
  CHECK(judge(exact, exact_rungs, today).metrics[1].verdict == Verdict::error);
  const auto [broken, broken_rungs] = laddered({0.64, nan_value, 0.04, 0.01});
  const CaseVerdict result = judge(broken, broken_rungs, today);
  CHECK(result.metrics[1].verdict == Verdict::error);
  CHECK(result.verdict == Verdict::error);
}

TEST_CASE("A metric that is missing on one rung only is an error too", "[gate]") {
  auto [spec, rungs] = laddered({0.64, 0.16, 0.04, 0.01});
  rungs[1].measurements.clear();
  CHECK(judge(spec, rungs, today).verdict == Verdict::error);
}

TEST_CASE("the limit of a ladder of values is gated beside its finest value", "[gate]") {
  const auto judged = [](const std::vector<double>& values, Band band) {
    MetricSpec length = metric("length", Norm::relative, 10.0, {-0.5, 0.5});
    length.ladder = LadderKind::value;
    length.spacing_index = values.size() - 1;
    MetricSpec limit = metric("length_limit", Norm::relative, 10.0, band);
    limit.limit_of = "length";
    CaseSpec spec = with({limit, length});
    spec.smoothing_ratio = {1.2};
    std::vector<Rung> rungs;
    for (std::size_t i = 0; i < values.size(); ++i) {
      spec.spacing.push_back(8e-3 / std::pow(2.0, static_cast<double>(i)));
      rungs.push_back(one("length", {values[i], "mm", {}, {}}));
      rungs.back().spacing_index = i;
    }
    return judge(spec, rungs, today).metrics[0];
  };
  // 10 + 2^-2i: second order, tends to 10
  const MetricResult limit = judged({11.0, 10.25, 10.0625}, {-1e-3, 1e-3});
  CHECK(limit.verdict == Verdict::pass);
  CHECK(limit.value == Approx(10.0));
  CHECK(judged({11.0, 10.25, 10.0625}, {0.005, 0.01}).verdict == Verdict::fail);   // the finest value alone would pass
  // No limit: 10.1 +- three times the range
  CHECK(judged({10.0, 10.2, 10.1}, {-0.06, 0.08}).verdict == Verdict::pass);
  CHECK(judged({10.0, 10.2, 10.1}, {-0.06, 0.06}).verdict == Verdict::fail);
  CHECK(judged({10.0, 10.2, 10.1}, {-0.04, 0.08}).verdict == Verdict::fail);
  CHECK(judged({10.0, 10.2, 10.1}, {-0.04, 0.08}).reason.find("oscillatory") != std::string::npos);
  CHECK(judged({10.0, nan_value, 10.1}, {-0.04, 0.08}).verdict == Verdict::error);
}
