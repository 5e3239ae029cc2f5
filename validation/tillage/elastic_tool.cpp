// The paper's cut with its own numbers: a tool that must stay elastic, its deflection against beam theory under the measured
// forces.
#include <cmath>

#include "reference/exact/beam.hpp"
#include "reference/exact/elastic_plastic.hpp"
#include "reference/exact/plasticity.hpp"
#include "validation/tillage/coupled_cut.hpp"
#include "validation/tillage/problems.hpp"
#include "validation/tillage/rigid_cut.hpp"

namespace furrow::tillage_cases {

Problem elastic_tool(const Parameters& input) {
  const CoupledSetup setup = read_coupled(input);
  const double from = input.quantity("window_start", dimension::time, {0.0, setup.end_time, false, true});
  const double to =
      input.quantity_or("window_end", dimension::time, setup.end_time, {from, setup.end_time * (1.0 + 1e-9), true, false});
  const double filter = input.quantity("filter", dimension::length, range::positive) / setup.blade.speed;
  return [=](Run& run) {
    const CoupledResult result = coupled_cut(run, setup);
    const CoupledHistory& h = result.history;
    run.measure("plastic_strain", *std::max_element(h.plastic_strain.begin(), h.plastic_strain.end()));
    const double beam = mean_over(h, h.beam, from, to);
    run.measure("tip_deflection", mean_over(h, h.deflection, from, to), "m", {beam, 0.02 * std::abs(beam)});
    run.measure("greatest_deflection", *std::max_element(h.deflection.begin(), h.deflection.end()), "m");
    run.measure("clamp_moment", mean_over(h, h.moment, from, to), "N");

    // The rigid blade of the same outline beside it, over the same travel.
    Run beside(run.resolution(), run.folder() / "rigid", run.threads());
    const CutResult rigid = cut(beside, setup.bed, setup.blade, setup.interface.contact, from * setup.blade.speed, false);
    run.count(beside.steps(), beside.particles());
    const double draft = mean_over(h, h.draft, from, to);
    run.measure("draft", draft, "N/m", {rigid.draft, 0.0});
    run.measure("vertical", mean_over(h, h.vertical, from, to), "N/m", {rigid.vertical, 0.0});

    // The first maximum and how far the force falls after it, from the chip at the free face.
    const std::vector<double> F = smoothed(h.time, h.normal, filter);
    const auto stages = stages_of(h, filter);
    const auto early = static_cast<std::size_t>(
        std::max_element(
            F.begin(), std::find_if(F.begin(), F.end(),
                                    [&](const double& f) { return h.travel[static_cast<std::size_t>(&f - F.data())] > 4e-3; })) -
        F.begin());
    run.measure("first_maximum_time", h.time[early], "s");
    run.measure("first_maximum", F[early], "N/m");
    std::size_t lowest = early;
    for (std::size_t k = early; k < F.size() && h.travel[k] < h.travel[early] + 4e-3; ++k)
      if (F[k] < F[lowest]) lowest = k;
    run.measure("fall_after_it", F[lowest] / F[early]);
    run.measure("lowest_time", h.time[lowest], "s");
    // What it would take: moments that a section of this metal can carry, over the greatest that the clamp has seen. The load of
    // soil whose weight and inertia are small beside its strength grows with its cohesion.
    const double greatest_moment = *std::max_element(h.moment.begin(), h.moment.end());
    const double t = setup.blade.thickness;
    if (const auto* law = std::get_if<JohnsonCook<MieGrueneisen>>(&setup.tool.material.law)) {
      const double limit = exact::limit_moment(law->strength.A, t);
      Table& table = run.table("what-would-it-take", "What it would take, by the moment at the clamp",
                               {{"event"},
                                {"moment of the section", "N"},
                                {"over the greatest at the clamp"},
                                {"cohesion, were the load in proportion", "kPa"}});
      const double c =
          exact::plane_strain_cohesion({setup.bed.soil.law.cone.alpha, setup.bed.soil.law.cone.k, setup.bed.soil.law.cone.beta});
      for (const auto& [event, moment] : {std::pair{"first yield", limit / 1.5}, std::pair{"plastic hinge", limit}})
        table.row({std::string(event), moment, moment / greatest_moment, 1e-3 * c * moment / greatest_moment});
    }
    int found = 0;
    for (const Stage& stage : stages)
      if (stage.name != "rise" && stage.present) ++found;
    run.measure("stages_after_rise", found);
    run.note("Stages of the force: " + in_words(stages) + ".");

    measure_coupling(run, result);
    Figure& figure = run.figure(
        {.name = "rigid-beside", .title = "Elastic and rigid tool", .x = {"travel", "m"}, .y = {"draft per width", "N/m"}});
    figure.add({.label = "elastic", .x = h.travel, .y = h.draft});
    figure.add({.label = "rigid", .role = "bound", .x = rigid.history.travel, .y = rigid.history.draft});
    stage_figure(run, h, stages, filter);
  };
}

}  // namespace furrow::tillage_cases
