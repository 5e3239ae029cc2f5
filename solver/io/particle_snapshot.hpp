#pragma once

#include "solver/io/snapshot.hpp"
#include "solver/particles/fields.hpp"

namespace furrow {

/// A snapshot with every field of the table (fields.hpp) but the position, which is its points.
template <int Dim>
Snapshot particle_snapshot(const Particles<Dim>& particles, double time) {
  Snapshot snapshot{time, Dim, {}, {}};
  const std::size_t n = particles.size();
  for_each_field(particles, [&](const Field& field, const auto& array) {
    using Element = typename std::remove_cvref_t<decltype(array)>::value_type;
    std::vector<double> values;
    int components = 1;
    if constexpr (std::is_arithmetic_v<Element>) {
      values.assign(array.begin(), array.begin() + static_cast<std::ptrdiff_t>(n));
    } else if constexpr (Element::ColsAtCompileTime == 1) {
      components = Dim;
      for (std::size_t i = 0; i < n; ++i) values.insert(values.end(), array[i].data(), array[i].data() + Dim);
    } else {
      components = 9;   // row by row, a tensor of the plane embedded in space
      for (std::size_t i = 0; i < n; ++i)
        for (int a = 0; a < 3; ++a)
          for (int b = 0; b < 3; ++b) values.push_back(a < array[i].rows() && b < array[i].cols() ? array[i](a, b) : 0.0);
    }
    if (field.name == "position")
      snapshot.points = std::move(values);
    else
      snapshot.fields.push_back({std::string(field.name), std::string(field.symbol), std::string(field.unit),
                                 std::string(field.meaning), components, std::move(values)});
  });
  return snapshot;
}

}  // namespace furrow
