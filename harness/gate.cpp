#include "harness/gate.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace furrow {
namespace {

constexpr double none = MetricResult::none;

// Numbers of one metric at one rung, in the metric's unit; or the reason why there are none.
struct Number {
  double value = none, reference = none, standard_uncertainty = none, error = none;
  std::string skipped, fault;
};

std::string day(std::chrono::year_month_day date) {
  return fmt::format("{:04}-{:02}-{:02}", static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                     static_cast<unsigned>(date.day()));
}

Number faulty(std::string fault) {
  Number number;
  number.fault = std::move(fault);
  return number;
}

void compare(const MetricSpec& metric, Number& number) {
  switch (metric.norm) {
    case Norm::absolute: number.error = number.value - number.reference; break;
    case Norm::relative: number.error = (number.value - number.reference) / number.reference; break;
    case Norm::value: number.error = number.value; break;
  }
}

Number number_of(const MetricSpec& metric, const Rung& rung) {
  const auto found = rung.measurements.find(metric.name);
  if (found == rung.measurements.end()) return faulty("the case file names this metric, but the code does not measure it");
  const Measurement& measured = found->second;
  Number number;
  if (!measured.skipped.empty()) {
    number.skipped = measured.skipped;
    return number;
  }
  const auto unit = parse_unit(measured.unit);
  if (!unit) return faulty(fmt::format("measured in \"{}\", which is no unit that furrow knows", measured.unit));
  if (unit->dimension != metric.unit.dimension)
    return faulty(fmt::format("measured in \"{}\" (dimension {}), but the case file says \"{}\" (dimension {})", measured.unit,
                              si_symbol(unit->dimension), metric.unit.symbol, si_symbol(metric.unit.dimension)));
  const double scale = unit->factor / metric.unit.factor;
  number.value = measured.value * scale;
  if (metric.computed_reference != measured.reference.has_value())
    return faulty(metric.computed_reference ? "the case file says that the code computes the reference, but it hands none over"
                                            : "the code hands a reference over, but the case file does not say \"computed\"");
  number.reference = measured.reference ? measured.reference->value * scale : metric.reference;
  number.standard_uncertainty =
      measured.reference ? measured.reference->standard_uncertainty * scale : metric.standard_uncertainty;
  compare(metric, number);
  return number;
}

// What round-off alone may leave of an error: a thousand units in the last place of the number that the error is taken from.
double round_off_of(const MetricSpec& metric, double value, double reference) {
  constexpr double ulps = 1000.0 * std::numeric_limits<double>::epsilon();
  if (metric.ladder == LadderKind::value) return ulps * std::abs(value);
  if (metric.norm == Norm::absolute && std::isfinite(reference) && reference != 0.0) return ulps * std::abs(reference);
  return ulps;
}

class Judge {
 public:
  Judge(const CaseSpec& spec, const std::vector<Rung>& rungs, std::chrono::year_month_day today)
      : spec_(spec), rungs_(rungs), today_(today) {}

  CaseVerdict run() const {
    CaseVerdict result;
    result.metrics.resize(spec_.metrics.size());
    for (std::size_t i = 0; i < spec_.metrics.size(); ++i)
      if (spec_.metrics[i].ladder_of().empty()) result.metrics[i] = measured(spec_.metrics[i]);
    for (std::size_t i = 0; i < spec_.metrics.size(); ++i)
      if (!spec_.metrics[i].ladder_of().empty()) result.metrics[i] = read_from_ladder(spec_.metrics[i], result.metrics);
    sum_up(result);
    return result;
  }

 private:
  MetricResult measured(const MetricSpec& metric) const {
    MetricResult result;
    bool found = false;
    for (const Rung& rung : rungs_) {
      const Number number = number_of(metric, rung);
      if (!number.fault.empty()) {
        result.reason = number.fault;
        return result;
      }
      if (rung.spacing_index != metric.spacing_index || rung.ratio_index != metric.ratio_index) continue;
      found = true;
      result.value = number.value;
      result.reference = number.reference;
      result.standard_uncertainty = number.standard_uncertainty;
      result.error = number.error;
      if (!number.skipped.empty()) {
        result.verdict = Verdict::skipped;
        result.reason = number.skipped;
      }
    }
    if (!found) {
      result.reason = "the gated rung of the resolution ladder did not run";
      return result;
    }
    if (metric.ladder) result.ladders = ladders(metric);
    if (result.verdict != Verdict::skipped) gate(metric, result);
    return result;
  }

  std::vector<Ladder> ladders(const MetricSpec& metric) const {
    std::vector<Ladder> result;
    for (std::size_t ratio = 0; ratio < spec_.smoothing_ratio.size(); ++ratio) {
      std::vector<double> spacing, value;
      double round_off = 0.0;
      for (std::size_t s = 0; s < spec_.spacing.size(); ++s)
        for (const Rung& rung : rungs_) {
          if (rung.spacing_index != s || rung.ratio_index != ratio) continue;
          const Number number = number_of(metric, rung);
          if (!number.skipped.empty()) continue;
          spacing.push_back(spec_.spacing[s]);
          value.push_back(metric.ladder == LadderKind::error ? number.error : number.value);
          round_off = round_off_of(metric, number.value, number.reference);
        }
      if (spacing.empty()) continue;
      result.push_back(metric.ladder == LadderKind::error ? error_ladder(spacing, value, round_off)
                                                          : value_ladder(spacing, value, round_off));
      result.back().smoothing_ratio = spec_.smoothing_ratio[ratio];
    }
    return result;
  }

  MetricResult read_from_ladder(const MetricSpec& metric, const std::vector<MetricResult>& measured) const {
    MetricResult result;
    result.reference = metric.reference;
    result.standard_uncertainty = metric.standard_uncertainty;
    const auto of = std::find_if(spec_.metrics.begin(), spec_.metrics.end(),
                                 [&](const MetricSpec& m) { return m.name == metric.ladder_of(); });
    if (of == spec_.metrics.end()) {
      result.reason = fmt::format("read from the ladder of {}, which is no metric of this case", metric.ladder_of());
      return result;
    }
    if (spec_.spacing.size() < 3) {
      result.verdict = Verdict::skipped;
      result.reason = "an order or a limit needs three spacings";
      return result;
    }
    const MetricResult& base = measured[static_cast<std::size_t>(of - spec_.metrics.begin())];
    const auto ladder = std::find_if(base.ladders.begin(), base.ladders.end(), [&](const Ladder& l) {
      return l.smoothing_ratio == spec_.smoothing_ratio[metric.ratio_index];
    });
    if (ladder == base.ladders.end()) {
      result.reason = fmt::format("{} has no ladder at this h/dx", metric.ladder_of());
      return result;
    }
    result.ladders = {*ladder};
    if (metric.limit_of.empty())
      observed_order(metric, result);
    else
      limit(metric, base, result);
    return result;
  }

  void observed_order(const MetricSpec& metric, MetricResult& result) const {
    const Ladder& ladder = result.ladders.front();
    result.value = result.error = ladder.order;
    gate(metric, result);
    const bool usable = std::find(metric.states.begin(), metric.states.end(), ladder.state) != metric.states.end();
    if (metric.band && !usable) {
      result.reason = fmt::format("the ladder is in the state {}, which gives no order that could pass", name(ladder.state));
      if (result.verdict == Verdict::pass) result.verdict = Verdict::fail;
    }
  }

  /// The extrapolated value; without one, both ends of the finest value's numerical uncertainty: the first that fails, else the
  /// upper.
  void limit(const MetricSpec& metric, const MetricResult& base, MetricResult& result) const {
    const Ladder& ladder = result.ladders.front();
    Number number;
    number.reference = result.reference = metric.computed_reference ? base.reference : metric.reference;
    result.standard_uncertainty = metric.computed_reference ? base.standard_uncertainty : metric.standard_uncertainty;
    const auto set = [&](double value) {
      number.value = value;
      compare(metric, number);
      result.value = number.value;
      result.error = number.error;
      gate(metric, result);
    };
    if (std::isfinite(ladder.extrapolated)) return set(ladder.extrapolated);
    const double finest = ladder.value.empty() ? none : ladder.value.back();
    const double uncertainty = std::abs(finest) * ladder.gci;
    set(finest - uncertainty);
    if (result.verdict == Verdict::pass || result.verdict == Verdict::reported) set(finest + uncertainty);
    if (result.reason.empty())
      result.reason = fmt::format("the ladder is in the state {} and has no limit: the finest value with its numerical "
                                  "uncertainty of {:.2g} %",
                                  name(ladder.state), 100.0 * ladder.gci);
  }

  void gate(const MetricSpec& metric, MetricResult& result) const {
    if (!std::isfinite(result.value)) {
      result.verdict = Verdict::error;
      result.reason = "no finite number";
      return;
    }
    if (!metric.band) {
      result.verdict = Verdict::reported;
      return;
    }
    if (!std::isfinite(result.error)) {
      result.verdict = Verdict::error;
      result.reason = "no finite error against the reference";
      return;
    }
    const bool inside = metric.band->contains(result.error);
    result.verdict = inside ? Verdict::pass : Verdict::fail;
    if (!metric.known_gap) return;
    const KnownGap& gap = *metric.known_gap;
    if (inside) {
      result.reason = "inside its band, although a known gap is recorded: the record can go";
    } else if (std::chrono::sys_days(today_) >= std::chrono::sys_days(gap.expires)) {
      result.reason = fmt::format("the known gap has expired: {}", gap.reason);
    } else {
      result.verdict = Verdict::known_gap;
      result.reason = fmt::format("{} (recorded {}, expires {})", gap.reason, day(gap.date), day(gap.expires));
    }
  }

  // Names that the code measures and the case file does not know.
  std::string left_over() const {
    for (const Rung& rung : rungs_)
      for (const auto& entry : rung.measurements) {
        const std::string& measured = entry.first;
        const auto known =
            std::find_if(spec_.metrics.begin(), spec_.metrics.end(), [&](const MetricSpec& m) { return m.name == measured; });
        if (known == spec_.metrics.end())
          return fmt::format("the code measures '{}', which the case file does not name", measured);
        if (!known->observed_order_of.empty())
          return fmt::format("the code measures '{}', which is an observed order and no measurement", measured);
      }
    return {};
  }

  void sum_up(CaseVerdict& result) const {
    const auto first = [&](Verdict verdict) {
      const auto it =
          std::find_if(result.metrics.begin(), result.metrics.end(), [&](const MetricResult& m) { return m.verdict == verdict; });
      return it == result.metrics.end()
                 ? std::string()
                 : fmt::format("{}: {}", spec_.metrics[static_cast<std::size_t>(it - result.metrics.begin())].name, it->reason);
    };
    const auto any = [&](Verdict verdict) {
      return std::any_of(result.metrics.begin(), result.metrics.end(),
                         [&](const MetricResult& m) { return m.verdict == verdict; });
    };
    result.verdict = Verdict::error;
    if (spec_.metrics.empty()) {
      result.reason = "the case has no metric";
    } else if (const std::string unknown = left_over(); !unknown.empty()) {
      result.reason = unknown;
    } else if (any(Verdict::error)) {
      result.reason = first(Verdict::error);
    } else if (any(Verdict::fail)) {
      result.verdict = Verdict::fail;
    } else if (any(Verdict::known_gap)) {
      result.verdict = Verdict::known_gap;
      result.reason = first(Verdict::known_gap);
    } else if (any(Verdict::pass)) {
      result.verdict = Verdict::pass;
    } else {
      result.reason = "no metric of the case was gated";
    }
  }

  const CaseSpec& spec_;
  const std::vector<Rung>& rungs_;
  std::chrono::year_month_day today_;
};

}  // namespace

std::string_view name(Verdict verdict) {
  switch (verdict) {
    case Verdict::pass: return "pass";
    case Verdict::fail: return "fail";
    case Verdict::error: return "error";
    case Verdict::known_gap: return "known-gap";
    case Verdict::skipped: return "skipped";
    case Verdict::reported: return "reported";
  }
  throw std::logic_error("a result without verdict");
}

CaseVerdict judge(const CaseSpec& spec, const std::vector<Rung>& rungs, std::chrono::year_month_day today) {
  return Judge(spec, rungs, today).run();
}

CaseVerdict all_error(const CaseSpec& spec, const std::string& reason) {
  CaseVerdict result;
  result.reason = reason;
  for (const MetricSpec& metric : spec.metrics) {
    MetricResult none_measured;
    none_measured.reference = metric.reference;
    none_measured.standard_uncertainty = metric.standard_uncertainty;
    none_measured.reason = reason;
    result.metrics.push_back(std::move(none_measured));
  }
  return result;
}

}  // namespace furrow
