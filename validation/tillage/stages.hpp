// Stages of a cutting force: what a mechanician would call rise, yield, hardening, peak with fracture and decline, by a written
// definition.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace furrow::tillage_cases {

/// A force over time with the state of the tool beside it, at the same times.
struct ForceHistory {
  std::vector<double> time;             ///< s, rising
  std::vector<double> force;            ///< N/m
  std::vector<double> deflection;       ///< of the tool's end, m
  std::vector<double> plastic_strain;   ///< greatest in the tool
  std::vector<double> softened;         ///< number of the tool's particles whose fracture has begun: some strength is gone
  std::vector<double> failed;           ///< number of those that have failed: all of it is gone
};

/// The definition's numbers.
struct StageDefinition {
  double filter = 0.0;           ///< s: width of the centred mean F that everything is read from
  double onset = 0.05;           ///< share of the greatest F at which the rise begins
  /// Plastic strain of the outer fibre from which a bent tool counts as yielding. At three times the strain at which the fibre
  /// yields a third of the section is still elastic, and it carries 0.96 of its plastic moment: before, no force shows it.
  double plastic_onset = 1e-2;
  double slope_drop = 0.5;       ///< yield shows where dF/dw falls below this share of the stiffness F/w of the rise
  double strengthening = 0.05;   ///< F must grow by this share between yield and peak
  /// Share of the peak down to which a load counts as held: the 0.8 by which tests of structures define failure (ASTM E2126,
  /// EN 12512). A chip that leaves the soil takes less from it.
  double held = 0.8;
  double fall = 0.5;             ///< share of the peak that F falls below, and stays below, in a decline
};

struct Stage {
  std::string_view name;
  bool present = false;
  double begin = 0.0, end = 0.0;               ///< s
  double force_begin = 0.0, force_end = 0.0;   ///< of the mean F
  std::string reason;                          ///< why it is absent
};

/// rise, yield, hardening, peak, decline.
///
/// F is the mean force, w the mean deflection of the tool's end.
/// rise: from F = onset of its greatest to the cause of the next stage, or where there is none to the greatest F.
/// yield: begins when the greatest plastic strain passes plastic_onset, and shows: while w grows by another half of what it grew
///   in the rise, three filter widths of time at least, dF/dw is less than slope_drop of that of the rise. Over deflection, not
///   over time: soil that builds up before a tool that yields lets the force climb on, and a chip that shears off stops it, but
///   neither changes the stiffness of the tool. It ends with the lowest F in that time where F dips, and with that time where F
///   only climbs more slowly.
/// hardening: from the end of yield to the peak, F growing by `strengthening` at least.
/// peak: the greatest F after yield, with fracture: the first particle has begun to lose its strength no later than one filter
///   width after F was last `held`, and one has failed before F has fallen below `fall` of its greatest.
/// decline: F falls below `fall` of the peak after fracture and stays there until the end.
/// A stage without its cause in the tool is absent: a drop of the force alone, as where the first chip shears off at the free
/// face, is no yield. Throws std::invalid_argument for histories of different lengths, times that do not rise, or a filter that
/// is not positive.
std::array<Stage, 5> force_stages(const ForceHistory& history, const StageDefinition& definition);

/// The centred mean over `width`, the window cut at the ends.
std::vector<double> smoothed(const std::vector<double>& time, const std::vector<double>& value, double width);

/// "rise 0.1-0.8 ms, yield absent (no plastic strain), ..."
std::string in_words(const std::array<Stage, 5>& stages);

}  // namespace furrow::tillage_cases
