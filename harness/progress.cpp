#include "harness/progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <sys/ioctl.h>
#include <unistd.h>

#include <fmt/format.h>

namespace furrow {
namespace {

// Share of a case that is done, by its rungs and the simulated time within the rung.
double fraction(const CaseProgress& p) {
  const double within = p.end_time > 0.0 ? std::clamp(p.simulated_time / p.end_time, 0.0, 1.0) : 0.0;
  return (static_cast<double>(p.rung) + within) / std::max(1, p.rungs);
}

double seconds_between(std::chrono::steady_clock::time_point a, std::chrono::steady_clock::time_point b) {
  return std::chrono::duration<double>(b - a).count();
}

std::size_t terminal_width() {
  winsize size{};
  return ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 20 ? size.ws_col : 80;
}

}  // namespace

std::string duration_words(double seconds) {
  if (seconds < 0.9995) return fmt::format("{:.0f} ms", 1000.0 * seconds);
  if (seconds < 59.95) return fmt::format("{:.1f} s", seconds);
  const long whole = std::lround(seconds);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

Progress::Progress(std::map<std::string, std::optional<double>> expected, int jobs, bool quiet)
    : waiting_(std::move(expected)),
      total_(waiting_.size()),
      jobs_(std::max(1, jobs)),
      quiet_(quiet),
      terminal_(isatty(STDOUT_FILENO) == 1) {}

Progress::~Progress() { clear(); }

void Progress::started(const std::string& id) {
  const auto it = waiting_.find(id);
  running_[id] = {Clock::now(), it == waiting_.end() ? std::nullopt : it->second, {}};
  if (it != waiting_.end()) waiting_.erase(it);
}

void Progress::moved(const std::string& id, const CaseProgress& progress) {
  if (const auto it = running_.find(id); it != running_.end()) it->second.progress = progress;
}

void Progress::finished(const std::string& id, const std::string& verdict, const std::string& reason, double seconds) {
  running_.erase(id);
  ++done_;
  seconds_done_ += seconds;
  if (quiet_) return;
  clear();
  if (!terminal_ || verdict != "pass") {
    const std::string count = fmt::format("{}/{}", done_, total_);
    fmt::print("{:>7}  {:<9}  {}  {}{}{}\n", count, verdict, id, duration_words(seconds), reason.empty() ? "" : "  ", reason);
    std::fflush(stdout);
  }
  draw();
}

std::optional<double> Progress::time_left() const {
  // A case of which nothing is known is taken to last as long as those that are done did on average.
  const double average = done_ > 0 ? seconds_done_ / static_cast<double>(done_) : 0.0;
  double left = 0.0, longest = 0.0;
  for (const auto& [id, seconds] : waiting_) {
    if (!seconds && done_ == 0) return std::nullopt;
    left += seconds.value_or(average);
  }
  for (const auto& [id, running] : running_) {
    const double done = fraction(running.progress), elapsed = seconds_between(running.start, Clock::now());
    const double rest = done > 0.01 ? elapsed * (1.0 - done) / done : std::max(0.0, running.expected.value_or(average) - elapsed);
    left += rest;
    longest = std::max(longest, rest);
  }
  return std::max(left / jobs_, longest);
}

std::string Progress::bar() const {
  constexpr std::size_t cells = 20;
  double done = static_cast<double>(done_);
  for (const auto& [id, running] : running_) done += fraction(running.progress);
  const auto filled = static_cast<std::size_t>(
      std::lround(static_cast<double>(cells) * done / static_cast<double>(std::max<std::size_t>(1, total_))));
  std::string text = fmt::format("[{}{}] {}/{}", std::string(std::min(filled, cells), '#'),
                                 std::string(cells - std::min(filled, cells), '.'), done_, total_);
  if (!running_.empty()) {
    const auto longest = std::min_element(running_.begin(), running_.end(),
                                          [](const auto& a, const auto& b) { return a.second.start < b.second.start; });
    const CaseProgress& p = longest->second.progress;
    text += "  " + longest->first;
    if (p.rungs > 1) text += fmt::format(" ({} of {})", p.rung + 1, p.rungs);
    if (p.end_time > 0.0) text += fmt::format("  t = {:.3g} of {:.3g} s", p.simulated_time, p.end_time);
    if (p.steps_per_second > 0.0) text += fmt::format("  {:.3g} steps/s", p.steps_per_second);
  }
  if (const std::optional<double> left = time_left(); left && *left > 0.5) text += "  " + duration_words(*left) + " left";
  return text.substr(0, terminal_width() - 1);
}

void Progress::clear() {
  if (!drawn_) return;
  fmt::print("\r\033[K");
  std::fflush(stdout);
  drawn_ = false;
}

void Progress::draw() {
  if (quiet_ || !terminal_ || (drawn_ && seconds_between(last_draw_, Clock::now()) < 0.1)) return;
  last_draw_ = Clock::now();
  fmt::print("\r\033[K{}", bar());
  std::fflush(stdout);
  drawn_ = true;
}

}  // namespace furrow
