#include "solver/io/snapshot.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <numeric>
#include <set>
#include <stdexcept>

#include "solver/io/hdf5.hpp"

namespace furrow {
namespace {

constexpr std::uint8_t vtk_vertex = 1;

std::size_t count_particles(const Snapshot& snapshot) {
  if (snapshot.dimensions != 2 && snapshot.dimensions != 3)
    throw std::invalid_argument(fmt::format("snapshot: {} dimensions; 2 or 3 are possible", snapshot.dimensions));
  const auto dimensions = static_cast<std::size_t>(snapshot.dimensions);
  if (snapshot.points.size() % dimensions != 0)
    throw std::invalid_argument(fmt::format("snapshot: {} coordinates are no whole number of points in {} dimensions",
                                            snapshot.points.size(), dimensions));
  return snapshot.points.size() / dimensions;
}

void check_fields(const Snapshot& snapshot, std::size_t particles) {
  std::set<std::string> names;
  for (const auto& field : snapshot.fields) {
    if (field.name.empty() || field.name.find('/') != std::string::npos)
      throw std::invalid_argument(fmt::format("snapshot: '{}' cannot name a field: it is empty or has a slash", field.name));
    if (!names.insert(field.name).second) throw std::invalid_argument(fmt::format("snapshot: two fields '{}'", field.name));
    if (field.unit.empty())
      throw std::invalid_argument(fmt::format("snapshot: field '{}' has no unit (a pure number has unit 1)", field.name));
    if (field.components != 1 && field.components != 2 && field.components != 3 && field.components != 9)
      throw std::invalid_argument(
          fmt::format("snapshot: field '{}' has {} components; 1, 2, 3 or 9 are possible", field.name, field.components));
    if (field.values.size() != particles * static_cast<std::size_t>(field.components))
      throw std::invalid_argument(fmt::format("snapshot: field '{}' has {} values for {} particles of {} components", field.name,
                                              field.values.size(), particles, field.components));
  }
}

std::vector<double> fill_up(const std::vector<double>& plane) {
  std::vector<double> space;
  space.reserve(plane.size() / 2 * 3);
  for (std::size_t i = 0; i < plane.size(); i += 2) space.insert(space.end(), {plane[i], plane[i + 1], 0.0});
  return space;
}

void describe(hdf5::Dataset dataset, const std::string& symbol, const std::string& unit, const std::string& description) {
  dataset.set_attribute("unit", unit);
  dataset.set_attribute("symbol", symbol);
  dataset.set_attribute("description", description);
}

hdf5::Dataset write_rows(hdf5::Group& group, const std::string& name, const std::vector<double>& values, int components) {
  if (components == 1) return group.write(name, values);
  if (components == 2) return write_rows(group, name, fill_up(values), 3);
  const auto width = static_cast<std::size_t>(components);
  return group.write(name, std::span<const double>(values), {values.size() / width, width});
}

/// One vertex cell a particle: cell i joins point i alone.
void write_vertices(hdf5::Group& grid, std::size_t particles) {
  const std::vector<std::int64_t> count = {static_cast<std::int64_t>(particles)};
  grid.write("NumberOfPoints", count);
  grid.write("NumberOfCells", count);
  grid.write("NumberOfConnectivityIds", count);
  std::vector<std::int64_t> index(particles + 1);
  std::iota(index.begin(), index.end(), std::int64_t{0});
  grid.write("Offsets", index);
  index.pop_back();
  grid.write("Connectivity", index);
  grid.write("Types", std::vector<std::uint8_t>(particles, vtk_vertex));
}

}  // namespace

void write_snapshot(const std::filesystem::path& file, const Snapshot& snapshot) {
  const std::size_t particles = count_particles(snapshot);
  check_fields(snapshot, particles);

  hdf5::Output output(file);
  auto grid = output.root().create_group("VTKHDF");
  const std::vector<std::int64_t> version = {1, 0};
  grid.set_attribute("Version", version);
  grid.set_attribute("Type", "UnstructuredGrid");

  write_vertices(grid, particles);
  describe(write_rows(grid, "Points", snapshot.points, snapshot.dimensions), "x", "m", "Positions of the particles.");
  auto point_data = grid.create_group("PointData");
  for (const auto& field : snapshot.fields)
    describe(write_rows(point_data, field.name, field.values, field.components), field.symbol, field.unit, field.description);
  auto field_data = grid.create_group("FieldData");
  describe(field_data.write("time", std::vector<double>{snapshot.time}), "t", "s", "Simulated time.");
  output.commit();
}

}  // namespace furrow
