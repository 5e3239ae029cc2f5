#include "validation/tillage/stages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace furrow::tillage_cases {

std::vector<double> smoothed(const std::vector<double>& time, const std::vector<double>& value, double width) {
  std::vector<double> mean(value.size());
  std::size_t low = 0, high = 0;
  double sum = 0.0;
  for (std::size_t k = 0; k < value.size(); ++k) {
    while (high < value.size() && time[high] <= time[k] + 0.5 * width) sum += value[high++];
    while (time[low] < time[k] - 0.5 * width) sum -= value[low++];
    mean[k] = sum / static_cast<double>(high - low);
  }
  return mean;
}

std::array<Stage, 5> force_stages(const ForceHistory& h, const StageDefinition& d) {
  const std::size_t n = h.time.size();
  if (n < 3 || h.force.size() != n || h.deflection.size() != n || h.plastic_strain.size() != n || h.softened.size() != n ||
      h.failed.size() != n)
    throw std::invalid_argument("stages need three rows or more, and as many of each column");
  for (std::size_t k = 1; k < n; ++k)
    if (!(h.time[k] > h.time[k - 1])) throw std::invalid_argument("times of a force history must rise");
  if (!(d.filter > 0.0)) throw std::invalid_argument("the filter of force stages must have a positive width");

  const std::vector<double> F = smoothed(h.time, h.force, d.filter), w = smoothed(h.time, h.deflection, d.filter);
  std::array<Stage, 5> stages;
  constexpr std::string_view names[] = {"rise", "yield", "hardening", "peak", "decline"};
  for (std::size_t s = 0; s < 5; ++s) stages[s].name = names[s];
  auto& [rise, yield, hardening, peak, decline] = stages;
  const auto set = [&](Stage& stage, std::size_t from, std::size_t to) {
    stage.present = true;
    stage.begin = h.time[from], stage.end = h.time[to];
    stage.force_begin = F[from], stage.force_end = F[to];
  };
  const auto first_where = [&](std::size_t from, auto&& is) {
    for (std::size_t k = from; k < n; ++k)
      if (is(k)) return k;
    return n;
  };
  const auto greatest = [&](std::size_t from) {
    return static_cast<std::size_t>(std::max_element(F.begin() + static_cast<std::ptrdiff_t>(from), F.end()) - F.begin());
  };

  const std::size_t top = greatest(0);
  if (!(F[top] > 0.0)) {
    for (Stage& stage : stages) stage.reason = "no force";
    return stages;
  }
  const std::size_t begin = first_where(0, [&](std::size_t k) { return F[k] >= d.onset * F[top]; });
  const std::size_t plastic = first_where(0, [&](std::size_t k) { return h.plastic_strain[k] > d.plastic_onset; });
  const std::size_t rise_end = plastic < n ? plastic : top;
  if (rise_end > begin && F[rise_end] > F[begin]) set(rise, begin, rise_end);
  else rise.reason = "no growth of the force before the tool yields";

  if (plastic == n) {
    yield.reason = hardening.reason = "no plastic strain in the tool";
  } else if (!rise.present) {
    yield.reason = hardening.reason = "no rise before it";
  } else {
    const double grew = w[plastic] - w[begin], stiffness = (F[plastic] - F[begin]) / grew;
    const std::size_t later = first_where(plastic, [&](std::size_t k) {
      return w[k] >= w[plastic] + 0.5 * grew && h.time[k] >= h.time[plastic] + 3.0 * d.filter;
    });
    if (!(grew > 0.0) || later == n) {
      yield.reason = "the tool does not bend on";
    } else if ((F[later] - F[plastic]) / (w[later] - w[plastic]) < d.slope_drop * stiffness) {
      const auto lowest = static_cast<std::size_t>(
          std::min_element(F.begin() + static_cast<std::ptrdiff_t>(plastic), F.begin() + static_cast<std::ptrdiff_t>(later) + 1) -
          F.begin());
      set(yield, plastic, lowest > plastic ? lowest : later);
    } else {
      yield.reason = "the tool is as stiff as before";
    }
  }

  const std::size_t cracked = first_where(0, [&](std::size_t k) { return h.failed[k] > 0.0; });
  const std::size_t from = plastic < n ? plastic : 0, highest = greatest(from);
  if (yield.present) {
    const double yielded = yield.end;
    const std::size_t start = first_where(0, [&](std::size_t k) { return h.time[k] >= yielded; });
    if (highest > start && F[highest] >= (1.0 + d.strengthening) * F[start]) set(hardening, start, highest);
    else hardening.reason = "the force does not grow after yield";
  } else if (hardening.reason.empty()) {
    hardening.reason = "no yield before it";
  }

  if (cracked == n) {
    peak.reason = decline.reason = "no particle of the tool has failed";
    return stages;
  }
  const std::size_t fallen = first_where(highest, [&](std::size_t k) { return F[k] < d.fall * F[highest]; });
  const std::size_t begun = first_where(0, [&](std::size_t k) { return h.softened[k] > 0.0; });
  // Where F was last held: from there on it falls for good.
  std::size_t edge = highest;
  for (std::size_t k = highest; k < n; ++k)
    if (F[k] >= d.held * F[highest]) edge = k;
  const bool caused = begun < n && h.time[begun] <= h.time[edge] + d.filter;
  if (caused && cracked <= fallen) set(peak, highest, edge);
  else peak.reason = caused ? "the force has fallen before anything has failed" : "the force falls before fracture begins";
  const bool stays = fallen < n && std::all_of(F.begin() + static_cast<std::ptrdiff_t>(fallen), F.end(),
                                               [&](double f) { return f < d.fall * F[highest]; });
  if (!peak.present) decline.reason = "no peak with fracture before it";
  else if (fallen == n) decline.reason = "the force does not fall far enough";
  else if (!stays) decline.reason = "the force recovers";
  else set(decline, edge, n - 1);
  return stages;
}

std::string in_words(const std::array<Stage, 5>& stages) {
  std::string text;
  for (const Stage& stage : stages) {
    if (!text.empty()) text += ", ";
    text += stage.present ? fmt::format("{} {:.2f}-{:.2f} ms", stage.name, 1e3 * stage.begin, 1e3 * stage.end)
                          : fmt::format("{} absent ({})", stage.name, stage.reason);
  }
  return text;
}

}  // namespace furrow::tillage_cases
