// A block that hangs sideways in a held face under its weight: the face stays where it is, and holding does no work.
#include "verification/loads/problems.hpp"

namespace furrow::loads_cases {

Problem held_block(const Parameters& input) {
  const LinearElastic material = read_elastic(input);
  const int columns = static_cast<int>(input.integer("columns", 6, 200)), rows = static_cast<int>(input.integer("rows", 4, 200));
  const int depth = static_cast<int>(input.integer("depth", 2, 6));
  const double g = input.quantity("gravity", dimension::acceleration, range::positive);
  const double passes = input.number("passes", range::positive);
  const Scheme scheme = read_scheme(input);

  return [=](Run& run) {
    const double dx = run.resolution().spacing, L = columns * dx;
    const double c = std::sqrt((material.bulk_modulus + 4.0 / 3.0 * material.shear_modulus) / material.reference_density);
    Simulation<2> simulation;
    Body<2>& body = simulation.body;
    body = elastic_body(run, material, scheme);
    body.add(block(columns, rows, dx, {0.0, 0.0}));
    body.loads.gravity = g * Vector<2>(2.0, -1.0) / std::sqrt(5.0);
    std::vector<std::vector<std::int32_t>> behind(static_cast<std::size_t>(rows));
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < depth; ++i) behind[static_cast<std::size_t>(j)].push_back(i * rows + j);
    body.hold_face("face", behind);

    DynamicRun<2> dynamic(run, simulation);
    dynamic.probe({"face_velocity", "v_f", "m/s", "largest velocity of the face, as read from the columns behind it"}, [](const Simulation<2>& s) {
      double largest = 0.0;
      for (const HeldFace::Column& column : s.body.loads.faces[0].columns) {
        Vector<2> v = Vector<2>::Zero();
        for (std::size_t k = 0; k < column.ids.size(); ++k)
          v += column.weights[k] * s.body.particles.velocity[s.body.index_of(column.ids[k])];
        largest = std::max(largest, v.norm());
      }
      return largest;
    });
    dynamic.until(passes * L / c, 200, 2);
    exercise(run, scheme);
    run.exercises("boundaries/held_face");
    run.exercises("boundaries/gravity");

    double largest = 0.0;
    for (const double v : dynamic.column("face_velocity")) largest = std::max(largest, v);
    run.measure("face_velocity", largest / (g * L / c));
    measure_energy(run, dynamic);
  };
}

}  // namespace furrow::loads_cases
