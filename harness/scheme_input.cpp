#include "harness/scheme_input.hpp"

namespace furrow {
namespace {

/// A term that is a table of its constants, or false.
bool is_on(const Parameters& scheme, std::string_view term) {
  if (!scheme.has(term)) return false;
  if (!scheme.is_table(term)) {
    if (scheme.flag(term)) scheme.fail(term, "found true; expected a table of its constants, or false");
    return false;
  }
  return true;
}

}  // namespace

Correction read_correction(const Parameters& table) {
  const std::string correction = table.choice_or("correction", "linear", {"none", "linear", "quadratic"});
  return correction == "none" ? Correction::none : correction == "linear" ? Correction::linear : Correction::quadratic;
}

Scheme read_scheme(const Parameters& parameters) {
  const Parameters in = parameters.table_or_empty("scheme");
  Scheme scheme;
  scheme.kernel = *kernel_by_name(in.choice_or("kernel", "wendland_c2", kernel_names()));
  scheme.correction = read_correction(in);
  scheme.dual_gradient = in.flag_or("dual_gradient", false);
  if (scheme.dual_gradient && scheme.correction != Correction::none)
    in.fail("dual_gradient", "has no meaning beside a correction: corrected gradients are the dual of their momentum sum already");
  scheme.least_span = in.number_or("least_span", scheme.least_span, {0.0, 1.0});
  const std::string density = in.choice_or("density", "continuity", {"continuity", "shepard", "summation", "constant"});
  scheme.density = density == "continuity" ? DensityEquation::continuity
                   : density == "shepard"  ? DensityEquation::shepard
                   : density == "constant" ? DensityEquation::constant
                                           : DensityEquation::summation;
  scheme.shepard_every = static_cast<int>(in.integer_or("shepard_every", 0, 0, 1'000'000));
  scheme.viscosity.reset();
  if (is_on(in, "viscosity")) {
    const Parameters viscosity = in.table("viscosity");
    scheme.viscosity = ArtificialViscosity{viscosity.number("alpha", range::not_negative), viscosity.number("beta", range::not_negative)};
  }
  scheme.artificial_stress.reset();
  if (is_on(in, "artificial_stress")) {
    const Parameters artificial = in.table("artificial_stress");
    scheme.artificial_stress = ArtificialStress{artificial.number("eps", range::not_negative), artificial.number("n", range::positive),
                                                artificial.flag_or("neutral", false)};
  }
  scheme.frame = in.choice_or("frame", "current", {"current", "reference"}) == "reference" ? Frame::reference : Frame::current;
  if (is_on(in, "bulk_viscosity")) {
    const Parameters bulk = in.table("bulk_viscosity");
    scheme.bulk_viscosity = BulkViscosity{bulk.number("linear", range::not_negative), bulk.number("quadratic", range::not_negative)};
  }
  scheme.hourglass_damping = in.number_or("hourglass_damping", 0.0, {0.0, 1.0});
  scheme.hourglass = in.number_or("hourglass", 0.0, {0.0, 10.0});
  scheme.cracks = in.flag_or("cracks", false);
  scheme.sub_cycling = in.flag_or("sub_cycling", false);
  scheme.xsph = in.number_or("xsph", 0.0, {0.0, 1.0});
  scheme.energy = in.flag_or("energy", true);
  const bool reference = scheme.frame == Frame::reference;
  for (const char* key : {"viscosity", "artificial_stress", "xsph", "shepard_every", "density"})
    if (reference && in.has(key)) in.fail(key, "has no meaning in the reference frame");
  for (const char* key : {"bulk_viscosity", "hourglass_damping", "cracks", "sub_cycling"})
    if (!reference && in.has(key)) in.fail(key, "is there in the reference frame only: frame = \"reference\"");
  if (reference) scheme.viscosity.reset();
  return scheme;
}

void exercise(Run& run, const Scheme& scheme) {
  run.exercises("smoothing/" + std::string(std::visit([](auto k) { return decltype(k)::name; }, scheme.kernel)));
  if (scheme.frame == Frame::current) {
    if (scheme.correction != Correction::quadratic) run.exercises("schemes/velocity_gradient");
    run.exercises("schemes/momentum");
  } else {
    run.exercises("schemes/reference_frame");
  }
  if (scheme.correction == Correction::linear) run.exercises("schemes/kernel_correction");
  if (scheme.correction == Correction::quadratic) run.exercises("schemes/quadratic_gradient");
  const bool sums_density = scheme.density == DensityEquation::shepard || scheme.density == DensityEquation::summation;
  if (sums_density || scheme.shepard_every > 0) run.exercises("schemes/density");
  if (scheme.viscosity) run.exercises("schemes/viscosity");
  if (scheme.artificial_stress) run.exercises("schemes/artificial_stress");
  if (scheme.hourglass > 0.0 || scheme.hourglass_damping > 0.0) run.exercises("schemes/hourglass");
  if (scheme.xsph > 0.0) run.exercises("schemes/xsph");
  run.exercises("integrators/step_control");
  run.exercises("simulation");
}

}  // namespace furrow
