#include "harness/ladder.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <stdexcept>

namespace furrow {
namespace {

constexpr double none = Ladder::none;

double mean(std::span<const double> x) { return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size()); }

struct Line {
  double intercept, slope, slope_stderr, residual;   // residual: sum of squares
};

// Least squares of y = intercept + slope x.
Line fit_line(std::span<const double> x, std::span<const double> y) {
  const double mx = mean(x), my = mean(y);
  double sxx = 0.0, sxy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sxx += (x[i] - mx) * (x[i] - mx);
    sxy += (x[i] - mx) * (y[i] - my);
  }
  const double slope = sxy / sxx, intercept = my - slope * mx;
  double residual = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) residual += std::pow(y[i] - intercept - slope * x[i], 2);
  const double freedom = static_cast<double>(x.size()) - 2.0;
  return {intercept, slope, freedom > 0.0 ? std::sqrt(residual / freedom / sxx) : none, residual};
}

Ladder started(LadderKind kind, std::vector<double> spacing, std::vector<double> value) {
  if (spacing.size() != value.size()) throw std::invalid_argument("a ladder needs one value for each spacing");
  for (std::size_t i = 0; i + 1 < spacing.size(); ++i)
    if (!(spacing[i] > spacing[i + 1])) throw std::invalid_argument("a ladder goes from coarse to fine");
  Ladder ladder;
  ladder.kind = kind;
  ladder.spacing = std::move(spacing);
  ladder.value = std::move(value);
  return ladder;
}

bool all_finite(std::span<const double> x) {
  return std::all_of(x.begin(), x.end(), [](double v) { return std::isfinite(v); });
}

// Number of local orders that fall before a plateau begins; zero when there is no plateau.
std::size_t falling_part(std::span<const double> local) {
  const double largest = *std::max_element(local.begin(), local.end());
  if (largest < 0.25) return 0;
  std::size_t falling = 0;
  while (falling < local.size() && local[falling] >= 0.5 * largest) ++falling;
  const bool flat_after = falling < local.size() && std::all_of(local.begin() + static_cast<std::ptrdiff_t>(falling), local.end(),
                                                                [&](double p) { return std::abs(p) < 0.5 * largest; });
  return flat_after ? falling : 0;
}

}  // namespace

std::string_view name(LadderState state) {
  switch (state) {
    case LadderState::asymptotic: return "asymptotic";
    case LadderState::plateau: return "plateau";
    case LadderState::oscillatory: return "oscillatory";
    case LadderState::diverging: return "diverging";
    case LadderState::round_off: return "round-off";
    case LadderState::undetermined: return "undetermined";
  }
  throw std::logic_error("a ladder without state");
}

std::string_view name(LadderKind kind) { return kind == LadderKind::error ? "error" : "value"; }

Ladder error_ladder(std::vector<double> spacing, std::vector<double> error, double round_off) {
  for (double& e : error) e = std::abs(e);
  Ladder ladder = started(LadderKind::error, std::move(spacing), std::move(error));
  const std::size_t rungs = ladder.value.size();
  if (rungs < 3 || !all_finite(ladder.value)) return ladder;

  if (ladder.value.back() <= round_off) {
    ladder.state = LadderState::round_off;
    return ladder;
  }
  if (std::any_of(ladder.value.begin(), ladder.value.end(), [&](double e) { return e <= round_off; })) return ladder;

  std::vector<double> log_dx, log_e, local;
  for (std::size_t i = 0; i < rungs; ++i) {
    log_dx.push_back(std::log(ladder.spacing[i]));
    log_e.push_back(std::log(ladder.value[i]));
  }
  for (std::size_t i = 0; i + 1 < rungs; ++i) local.push_back((log_e[i] - log_e[i + 1]) / (log_dx[i] - log_dx[i + 1]));

  const Line whole = fit_line(log_dx, log_e);
  ladder.order = whole.slope;
  ladder.order_stderr = whole.slope_stderr;

  const auto every = [&](auto holds) { return std::all_of(local.begin(), local.end(), holds); };
  if (every([](double p) { return std::abs(p) < 0.25; })) {
    ladder.state = LadderState::plateau;
  } else if (const std::size_t falling = falling_part(local); falling > 0) {
    ladder.state = LadderState::plateau;
    const Line part = fit_line(std::span(log_dx).first(falling + 1), std::span(log_e).first(falling + 1));
    ladder.order = part.slope;
    ladder.order_stderr = part.slope_stderr;
  } else if (whole.slope < -0.1 && local.back() < -0.1) {
    ladder.state = LadderState::diverging;
  } else if (!every([](double p) { return p > 0.0; }) && !every([](double p) { return p < 0.0; })) {
    ladder.state = LadderState::oscillatory;
  } else if (whole.slope >= 0.5 && every([&](double p) { return std::abs(p - whole.slope) <= 0.2; })) {
    ladder.state = LadderState::asymptotic;
  }
  return ladder;
}

namespace {

// f = a + c ((dx/dx_coarse)^p - 1)/p: the same family of curves as f0 + C dx^p, and smooth through p = 0 (where it is a + c log).
struct PowerFit {
  double p, limit, residual;
  double fitted_finest, order_stderr;
};

std::vector<double> power_basis(std::span<const double> spacing, double p) {
  std::vector<double> b;
  for (const double dx : spacing) {
    const double t = std::log(dx / spacing.front());
    b.push_back(std::abs(p) < 1e-8 ? t : std::expm1(p * t) / p);
  }
  return b;
}

PowerFit fit_power(std::span<const double> spacing, std::span<const double> value) {
  const auto residual = [&](double p) { return fit_line(power_basis(spacing, p), value).residual; };
  constexpr double low = -4.0, high = 12.0, step = 0.05;
  double best = low, least = residual(low);
  for (double p = low + step; p <= high; p += step)
    if (const double r = residual(p); r < least) {
      least = r;
      best = p;
    }
  double a = best - step, b = best + step;
  constexpr double golden = 0.6180339887498949;
  for (int i = 0; i < 80; ++i) {
    const double left = b - golden * (b - a), right = a + golden * (b - a);
    (residual(left) < residual(right) ? b : a) = residual(left) < residual(right) ? right : left;
  }
  const double p = 0.5 * (a + b);
  const std::vector<double> basis = power_basis(spacing, p);
  const Line line = fit_line(basis, value);

  // Standard error of p: the part of df/dp that the two linear unknowns cannot take up.
  double order_stderr = none;
  if (const double freedom = static_cast<double>(value.size()) - 3.0; freedom > 0.0) {
    constexpr double dp = 1e-4;
    const std::vector<double> above = power_basis(spacing, p + dp), below = power_basis(spacing, p - dp);
    std::vector<double> slope(basis.size());
    for (std::size_t i = 0; i < slope.size(); ++i) slope[i] = line.slope * (above[i] - below[i]) / (2.0 * dp);
    order_stderr = std::sqrt(line.residual / freedom / fit_line(basis, slope).residual);
  }
  return {p, line.intercept - line.slope / p, line.residual, line.intercept + line.slope * basis.back(), order_stderr};
}

}  // namespace

Ladder value_ladder(std::vector<double> spacing, std::vector<double> value, double round_off) {
  Ladder ladder = started(LadderKind::value, std::move(spacing), std::move(value));
  const std::vector<double>& f = ladder.value;
  const std::size_t rungs = f.size();
  if (rungs < 3 || !all_finite(f)) return ladder;

  const double finest = f.back();
  const auto relative = [&](double uncertainty) { return finest != 0.0 ? std::abs(uncertainty / finest) : none; };
  if (std::abs(finest - f[rungs - 2]) <= round_off) {
    ladder.state = LadderState::round_off;
    ladder.extrapolated = finest;
    ladder.gci = relative(round_off);
    return ladder;
  }

  const auto [lowest, highest] = std::minmax_element(f.begin(), f.end());
  const double range = *highest - *lowest;
  ladder.gci = relative(3.0 * range);
  bool rises = false, falls = false;
  for (std::size_t i = 0; i + 1 < rungs; ++i) (f[i + 1] > f[i] ? rises : falls) = true;
  if (rises && falls) {
    ladder.state = LadderState::oscillatory;
    return ladder;
  }

  const PowerFit fit = fit_power(ladder.spacing, f);
  ladder.order = fit.p;
  ladder.order_stderr = fit.order_stderr;
  if (fit.p <= 0.0) {
    ladder.state = LadderState::diverging;
    return ladder;
  }
  const double deviation = rungs > 3 ? std::sqrt(fit.residual / (static_cast<double>(rungs) - 3.0)) : 0.0;
  if (fit.p < 0.5 || fit.p > 4.0 || deviation > 0.05 * range) return ladder;
  ladder.state = LadderState::asymptotic;
  ladder.extrapolated = fit.limit;
  const double safety = fit.p <= 2.1 ? 1.25 : 3.0;
  ladder.gci = relative(safety * std::abs(finest - fit.limit) + deviation + std::abs(finest - fit.fitted_finest));
  return ladder;
}

}  // namespace furrow
