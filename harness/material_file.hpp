// Material files: the constants of one material as data, each number with unit and source; a new material is a new file.
//
//   name = "6061-T6 aluminium"
//   why = "..."                          # what was chosen where sources conflict
//   law = "johnson_cook"                 # elastic | j2 | johnson_cook | drucker_prager
//   density = { value = 2700, unit = "kg/m^3", source = "..." }   # every constant in this form; the source is a key of the
//                                                                 # bibliography, or of [sources] in the file itself
//   [elasticity]        # shear_modulus and bulk_modulus, or young_modulus and poisson_ratio, or shear_modulus and
//                       # poisson_ratio
//   [equation_of_state] # kind = "linear" (the bulk modulus above; the default) | "mie_grueneisen": sound_speed, slope,
//                       # gamma
//   [strength]          # j2: yield_stress, hardening_modulus; johnson_cook: A, B, n, C, m, reference_rate,
//                       # reference_temperature, melting_temperature; drucker_prager: friction_angle, cohesion, dilation_angle,
//                       # tension_limit (optional)
//   [heating]           # johnson_cook: specific_heat, taylor_quinney (0 is isothermal)
//   [damage]            # johnson_cook, optional: D1..D5, lowest_triaxiality, highest_triaxiality, least_fracture_strain,
//                       # softening_length (optional)
//   cone = "plane_strain"                # drucker_prager: bui | plane_strain | compression | extension
//   update = "return_map"                # drucker_prager, optional: return_map | rate | rate_printed
//   [form]              # johnson_cook, optional: eq_9, eq_17, eq_19, eq_21, eq_24, failure = "right" | "printed" (the paper)
#pragma once

#include <string>
#include <vector>

#include "harness/case.hpp"
#include "harness/input.hpp"
#include "solver/materials/materials.hpp"

namespace furrow {

struct NamedMaterial {
  std::string name;                    ///< as a reader knows it: "6061-T6 aluminium"
  std::string why;
  AnyMaterial law;
  std::vector<std::string> sources;    ///< keys of the bibliography, each once
};

/// A change of a material file by a case: dotted path of a key and TOML value, {"form.eq_17", "printed"}.
struct MaterialChange {
  std::string path, value;
};

/// The material that the parameter `key` names: KEY.toml beside the file that the parameter stands in, or else one of
/// reference/materials; with the changes that the case lists under `KEY_set = ["form.eq_17=printed"]` and then those given here.
/// `spacing` (m) is the particle spacing for a law that knows a length; 0 where there are no particles.
/// Throws InputError for a file that is not there, unknown keys, missing constants and constants that no material has.
NamedMaterial read_material(const Parameters& parameters, std::string_view key, double spacing = 0.0,
                            const std::vector<MaterialChange>& changes = {});

/// The material of one file that has been parsed already.
NamedMaterial read_material(const Parameters& file, double spacing);

/// Names the law and its parts among what the run exercises.
void exercise(Run& run, const AnyMaterial& material);

}  // namespace furrow
