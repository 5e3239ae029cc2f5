// The tool of metal: a strip that is rigid above and free below, as the stiff body of a coupled simulation.
#pragma once

#include <string>

#include "solver/coupled_simulation.hpp"
#include "validation/tillage/bed.hpp"

namespace furrow::tillage_cases {

struct Tool {
  NamedMaterial material;
  double shear_modulus, bulk_modulus;   ///< Pa
  double free_length;                   ///< m, below the rigid part
  int across;                           ///< particles over the thickness
  double smoothing_ratio;
  double courant;
  Scheme scheme;

  double spacing(const Blade& blade) const { return blade.thickness / across; }
  double young_modulus() const { return 9.0 * bulk_modulus * shear_modulus / (3.0 * bulk_modulus + shear_modulus); }
  double poisson_ratio() const { return (3.0 * bulk_modulus - 2.0 * shear_modulus) / (6.0 * bulk_modulus + 2.0 * shear_modulus); }
};
/// The table `tool` and the material that it names; an InputError for a tool that cannot bend or does not fit.
Tool read_tool(const Parameters& input, const Blade& blade);

/// A stone that does not move.
struct Stone {
  Vector<2> centre;
  double radius;
};
/// The table `stone`: radius, and where its centre stands before and below the edge's path; empty where there is none.
std::optional<Stone> read_stone(const Parameters& input, const Bed& bed, const Blade& blade);

/// Sets up the tool in coupled.stiff and its surface in coupled.surface, moving as the blade does.
void add_tool(CoupledSimulation& coupled, const Tool& tool, const Bed& bed, const Blade& blade);

/// Where a particle of the tool began, along the blade from the end and across from the face, m.
struct Place {
  double along, across;
};
Place place_of(const Tool& tool, const Blade& blade, std::int32_t id);

/// Deflection of the tool's end against its motion, along the face's normal, m.
double tip_deflection(const CoupledSimulation& coupled, const Tool& tool, const Blade& blade);
/// The same of a cantilever that carries the forces which the soil puts on the tool now.
double beam_deflection(const CoupledSimulation& coupled, const Tool& tool, const Blade& blade);
/// Moment with which the driven particles hold the tool, about the middle of the clamped section, N.
double clamp_moment(const CoupledSimulation& coupled, const Tool& tool, const Bed& bed, const Blade& blade);
/// Moment of a section that flows where the tool is bent most: sum over the column of (2/sqrt(3)) sigma_y |y| dx with each
/// particle's own flow stress; 0 while no column flows.
double plastic_moment(const CoupledSimulation& coupled, const Tool& tool, const Blade& blade);
/// Greatest of a field of the tool.
double greatest(const std::vector<double>& field);
double failed_particles(const CoupledSimulation& coupled);
/// Those that have lost some of their strength at least.
double softened_particles(const CoupledSimulation& coupled);

}  // namespace furrow::tillage_cases
