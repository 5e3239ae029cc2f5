// A cut with a tool of metal, as run and as measured.
#pragma once

#include "validation/tillage/stages.hpp"
#include "validation/tillage/tool.hpp"

namespace furrow::tillage_cases {

struct CoupledSetup {
  Bed bed;
  Blade blade;
  Tool tool;
  Interface interface;
  std::optional<Stone> stone;
  ContactLaw stone_contact;   ///< of the tool with the stone
  double end_time;            ///< s
  bool single_rate;
  int snapshots;
  int rows;   ///< of the history
};
CoupledSetup read_coupled(const Parameters& input);

/// Columns of the history of a cut, by row.
struct CoupledHistory {
  std::vector<double> time, step, travel;   ///< middle and length of the time since the row before, s; m
  std::vector<double> normal,
      tangential;   ///< force of soil and stone on the tool along the face's inward normal and up the face, N/m
  std::vector<double> draft, vertical;          ///< the same against the motion, and up
  std::vector<double> whole;                    ///< magnitude of the same, whichever way the bent tool is pushed, N/m
  std::vector<double> actuator;                 ///< force along the motion with which the actuator drives, N/m
  std::vector<double> deflection, beam;         ///< of the tool's end, and of the cantilever with the soil's forces, m
  std::vector<double> moment, plastic_moment;   ///< at the clamp, and of the section that flows, N
  std::vector<double> plastic_strain, softened, failed;   ///< greatest of the tool; numbers of particles
};

struct CoupledResult {
  CoupledHistory history;
  double penetration;         ///< largest of soil and tool, spacings of the soil
  double stone_penetration;   ///< largest of tool and stone, spacings of the tool
  double energy_error;        ///< largest in the history, over the actuator's work at the end
  double momentum_error;      ///< of the tool: its momentum less all impulses, over the actuator's impulse
  double exchange_error;      ///< impulses of soil and tool together, over the tool's
  double sub_steps;           ///< tool steps per soil step
  double gain;                ///< bound on what sub-steps save, (N_s + N_t)/(N_t + N_s/n) by numbers of particles
  long soil_particles, tool_particles;
};
CoupledResult coupled_cut(Run& run, const CoupledSetup& setup);
/// Measures how well the coupling did: penetration, errors of energy, momentum and exchange, sub-steps and the bound on the gain.
void measure_coupling(Run& run, const CoupledResult& result);

/// Mean of a column over times from `from` to `to`, s.
double mean_over(const CoupledHistory& history, const std::vector<double>& column, double from, double to);

/// Stages of the magnitude of the whole force on the tool; the filter is `filter_time` long, in s. A tool that bends by tens of
/// degrees turns its face away from where that stood at first: a component along the first normal would fall by the turning alone.
std::array<Stage, 5> stages_of(const CoupledHistory& history, double filter_time);
void stage_figure(Run& run, const CoupledHistory& history, const std::array<Stage, 5>& stages, double filter_time);

}  // namespace furrow::tillage_cases
