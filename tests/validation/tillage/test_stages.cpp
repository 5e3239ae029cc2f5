// The detector of force stages on curves whose stages are known: whole, noisy, and with stages missing.
#include "validation/tillage/stages.hpp"

#include <cmath>
#include <random>

#include "tests/catch.hpp"

using namespace furrow::tillage_cases;

namespace {

constexpr StageDefinition definition{.filter = 0.25e-3};

double between(double t, const std::vector<std::pair<double, double>>& points) {
  for (std::size_t k = 1; k < points.size(); ++k)
    if (t <= points[k].first) {
      const auto [t0, y0] = points[k - 1];
      const auto [t1, y1] = points[k];
      return y0 + (y1 - y0) * (t - t0) / (t1 - t0);
    }
  return points.back().second;
}

/// 10 ms in steps of 10 us: contact at 0.2 ms, yield at 1.5, lowest at 2, peak with fracture at 7, down to a quarter at 8. The
/// tool's end falls back at 1.5 m/s.
ForceHistory whole() {
  ForceHistory h;
  for (int k = 0; k <= 1000; ++k) {
    const double t = 1e-5 * k;
    h.time.push_back(t);
    h.force.push_back(
        between(t, {{0.0, 0.0}, {0.2e-3, 0.0}, {1.5e-3, 10e3}, {2e-3, 9e3}, {7e-3, 18e3}, {8e-3, 4.5e3}, {10e-3, 4e3}}));
    h.deflection.push_back(1.5 * std::max(0.0, t - 0.2e-3));
    h.plastic_strain.push_back(t < 1.5e-3 ? 0.0 : 200.0 * (t - 1.5e-3));
    h.failed.push_back(t < 6.9e-3 ? 0.0 : 1.0 + std::floor(1e4 * (t - 6.9e-3)));
    h.softened.push_back(h.failed.back());
  }
  return h;
}

const Stage& stage(const std::array<Stage, 5>& stages, std::string_view name) {
  for (const Stage& s : stages)
    if (s.name == name) return s;
  throw std::logic_error("no such stage");
}

}  // namespace

TEST_CASE("all five stages of a curve that has them", "[stages]") {
  ForceHistory h = whole();
  const double noise = GENERATE(0.0, 0.05, 0.15);
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (double& f : h.force) f *= 1.0 + noise * normal(random);
  const auto stages = force_stages(h, definition);
  for (const Stage& s : stages) {
    INFO(s.name << ": " << s.reason);
    CHECK(s.present);
  }
  CHECK(stage(stages, "rise").begin == Approx(0.3e-3).margin(0.15e-3));
  CHECK(stage(stages, "rise").end == Approx(1.5e-3).margin(0.1e-3));
  CHECK(stage(stages, "rise").force_end == Approx(10e3).epsilon(0.08));
  CHECK(stage(stages, "yield").end == Approx(2e-3).margin(0.2e-3));
  CHECK(stage(stages, "hardening").force_end == Approx(18e3).epsilon(0.08));
  CHECK(stage(stages, "peak").begin == Approx(7e-3).margin(0.3e-3));
  CHECK(stage(stages, "decline").end == Approx(10e-3));
}

TEST_CASE("a chip at the free face is no yield: the same force with a tool that stays elastic", "[stages]") {
  ForceHistory h = whole();
  h.plastic_strain.assign(h.time.size(), 0.0);
  h.softened.assign(h.time.size(), 0.0), h.failed.assign(h.time.size(), 0.0);
  const auto stages = force_stages(h, definition);
  CHECK(stage(stages, "rise").present);
  for (const char* name : {"yield", "hardening", "peak", "decline"}) {
    CHECK_FALSE(stage(stages, name).present);
    CHECK_FALSE(stage(stages, name).reason.empty());
  }
  CHECK(stage(stages, "yield").reason == "no plastic strain in the tool");
}

TEST_CASE("a tool that yields and holds has no peak with fracture and no decline", "[stages]") {
  ForceHistory h = whole();
  for (std::size_t k = 700; k <= 1000; ++k) h.force[k] = 18e3;
  h.softened.assign(h.time.size(), 0.0), h.failed.assign(h.time.size(), 0.0);
  const auto stages = force_stages(h, definition);
  CHECK(stage(stages, "yield").present);
  CHECK(stage(stages, "hardening").present);
  CHECK_FALSE(stage(stages, "peak").present);
  CHECK_FALSE(stage(stages, "decline").present);
}

TEST_CASE("a perfectly plastic tool does not harden", "[stages]") {
  ForceHistory h = whole();
  for (std::size_t k = 150; k <= 1000; ++k) h.force[k] = 10e3;
  h.softened.assign(h.time.size(), 0.0), h.failed.assign(h.time.size(), 0.0);
  const auto stages = force_stages(h, definition);
  CHECK(stage(stages, "yield").present);
  CHECK_FALSE(stage(stages, "hardening").present);
}

TEST_CASE("a force that climbs on, but much more slowly, shows a yield without a dip", "[stages]") {
  ForceHistory h = whole();
  for (std::size_t k = 150; k <= 700; ++k) h.force[k] = 10e3 + 8e3 * (h.time[k] - 1.5e-3) / 5.5e-3;
  const auto stages = force_stages(h, definition);
  CHECK(stage(stages, "yield").present);
  CHECK(stage(stages, "yield").end == Approx(2.3e-3).margin(0.03e-3));
  CHECK(stage(stages, "hardening").present);
}

TEST_CASE("plastic strain that the force does not show is no yield", "[stages]") {
  ForceHistory h = whole();
  for (std::size_t k = 150; k <= 700; ++k) h.force[k] = 10e3 * (h.time[k] - 0.2e-3) / 1.3e-3;
  CHECK_FALSE(stage(force_stages(h, definition), "yield").present);
}

TEST_CASE("soil that builds up hides a yield from the force over time, not from the force over deflection", "[stages]") {
  ForceHistory h = whole();
  for (std::size_t k = 150; k <= 700; ++k) {
    h.force[k] = 10e3 + 7e6 * (h.time[k] - 1.5e-3);   // of 7.7e6 N/m/s before: over time nothing halves
    h.deflection[k] = 1.95e-3 + 4.0 * (h.time[k] - 1.5e-3);
  }
  for (std::size_t k = 701; k <= 1000; ++k) h.deflection[k] = h.deflection[700];
  CHECK(stage(force_stages(h, definition), "yield").present);
}

TEST_CASE("a chip that takes the force from a tool as stiff as before is no yield, whatever has flowed a little", "[stages]") {
  ForceHistory h = whole();
  for (std::size_t k = 0; k <= 1000; ++k) {
    h.force[k] = between(h.time[k], {{0.0, 0.0}, {0.2e-3, 0.0}, {1.5e-3, 10e3}, {2e-3, 5e3}, {7e-3, 18e3}, {10e-3, 18e3}});
    h.deflection[k] = 2e-7 * h.force[k];
  }
  CHECK(stage(force_stages(h, definition), "yield").reason == "the tool is as stiff as before");
  for (std::size_t k = 150; k <= 1000; ++k) h.deflection[k] = h.deflection[150];
  CHECK(stage(force_stages(h, definition), "yield").reason == "the tool does not bend on");
}

TEST_CASE("a peak that has lost a tenth when fracture begins is still held, one that has lost a third is not", "[stages]") {
  ForceHistory h = whole();
  const double lost = GENERATE(0.1, 0.33);
  for (std::size_t k = 0; k <= 1000; ++k) {
    const double t = h.time[k];
    if (t > 7e-3) h.force[k] = between(t, {{7e-3, 18e3}, {7.2e-3, 18e3 * (1.0 - lost)}, {8.5e-3, 18e3 * (1.0 - lost)}, {9e-3, 4e3}, {10e-3, 4e3}});
    h.softened[k] = h.failed[k] = t > 8.4e-3 ? 1.0 : 0.0;
  }
  CHECK(stage(force_stages(h, definition), "peak").present == (lost < 0.2));
  CHECK(stage(force_stages(h, definition), "decline").present == (lost < 0.2));
}

TEST_CASE("a force that falls before anything breaks has no peak with fracture", "[stages]") {
  ForceHistory h = whole();
  for (std::size_t k = 0; k < h.time.size(); ++k) h.softened[k] = h.failed[k] = h.time[k] > 9e-3 ? 1.0 : 0.0;
  const auto stages = force_stages(h, definition);
  CHECK_FALSE(stage(stages, "peak").present);
  CHECK_FALSE(stage(stages, "decline").present);
}

TEST_CASE("where strength is lost bit by bit, the peak is where that begins", "[stages]") {
  ForceHistory h = whole();
  for (std::size_t k = 0; k < h.time.size(); ++k) h.failed[k] = h.time[k] > 7.4e-3 ? 1.0 : 0.0;
  CHECK(stage(force_stages(h, definition), "peak").present);
  CHECK(stage(force_stages(h, definition), "decline").present);
  for (std::size_t k = 0; k < h.time.size(); ++k) h.failed[k] = h.time[k] > 8e-3 ? 1.0 : 0.0;
  CHECK(stage(force_stages(h, definition), "peak").reason == "the force has fallen before anything has failed");
}

TEST_CASE("a force that recovers has not declined", "[stages]") {
  ForceHistory h = whole();
  for (std::size_t k = 950; k <= 1000; ++k) h.force[k] = 12e3;
  const auto stages = force_stages(h, definition);
  CHECK(stage(stages, "peak").present);
  CHECK_FALSE(stage(stages, "decline").present);
  CHECK(stage(stages, "decline").reason == "the force recovers");
}

TEST_CASE("no force, no stages; histories that are none are refused", "[stages]") {
  ForceHistory h = whole();
  h.force.assign(h.time.size(), 0.0);
  for (const Stage& s : force_stages(h, definition)) CHECK_FALSE(s.present);
  h.force.pop_back();
  CHECK_THROWS_AS(force_stages(h, definition), std::invalid_argument);
  h = whole();
  h.time[5] = h.time[4];
  CHECK_THROWS_AS(force_stages(h, definition), std::invalid_argument);
  CHECK_THROWS_AS(force_stages(whole(), {.filter = 0.0}), std::invalid_argument);
}

TEST_CASE("a centred mean keeps straight lines and the mean of noise", "[stages]") {
  std::vector<double> t, y;
  for (int k = 0; k < 100; ++k) t.push_back(k), y.push_back(3.0 * k);
  const auto mean = smoothed(t, y, 10.0);
  for (std::size_t k = 5; k < 95; ++k) CHECK(mean[k] == Approx(y[k]));
}
