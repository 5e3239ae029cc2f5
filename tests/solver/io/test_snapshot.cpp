// Snapshots: layout and values by our own reader; test_vtkhdf.py reads the same file as ParaView does.
#include "solver/io/snapshot.hpp"

#include <cmath>
#include <limits>

#include "solver/io/hdf5.hpp"
#include "tests/catch.hpp"
#include "tests/solver/io/scratch.hpp"

using namespace furrow;
using furrow::test::Scratch;
using furrow::test::file_error;
using furrow::test::contains;

namespace {

/// `count` particles on a spiral; every value is a formula that test_vtkhdf.py repeats.
Snapshot example(int dimensions, int count = 7) {
  Snapshot snapshot;
  snapshot.time = 0.125;
  snapshot.dimensions = dimensions;
  SnapshotField density = {"density", "rho", "kg/m3", "Mass density.", 1, {}};
  SnapshotField velocity = {"velocity", "v", "m/s", "Velocity.", dimensions, {}};
  SnapshotField stress = {"stress", "sigma", "Pa", "Cauchy stress.", 9, {}};
  for (int i = 0; i < count; ++i) {
    for (int d = 0; d < dimensions; ++d) {
      snapshot.points.push_back(0.5 * i + 0.01 * d);
      velocity.values.push_back(-1.0 * i + d);
    }
    density.values.push_back(7850.0 + i);
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) stress.values.push_back(1e6 * i + 10 * (row + column) + row * column);
  }
  snapshot.fields = {density, velocity, stress};
  return snapshot;
}

}  // namespace

TEST_CASE("a snapshot has the VTKHDF layout and the values it was given", "[io][snapshot]") {
  const Scratch scratch;
  const auto file = scratch / "s.vtkhdf";
  const auto snapshot = example(2);
  write_snapshot(file, snapshot);

  const hdf5::Input input(file);
  const auto grid = input.root().group("VTKHDF");
  CHECK(grid.integer_attribute("Version") == std::vector<std::int64_t>{1, 0});
  CHECK(grid.text_attribute("Type") == "UnstructuredGrid");
  CHECK(grid.dataset("NumberOfPoints").read<std::int64_t>() == std::vector<std::int64_t>{7});
  CHECK(grid.dataset("Types").read<std::uint8_t>() == std::vector<std::uint8_t>(7, 1));
  CHECK(grid.dataset("Offsets").read<std::int64_t>().size() == 8);
  CHECK(grid.dataset("Points").extents() == std::vector<std::size_t>{7, 3});

  const auto velocity = grid.group("PointData").dataset("velocity");
  const auto values = velocity.read<double>();
  REQUIRE(values.size() == 21);
  for (std::size_t i = 0; i < 7; ++i) {
    CHECK(values[3 * i] == snapshot.fields[1].values[2 * i]);
    CHECK(values[3 * i + 1] == snapshot.fields[1].values[2 * i + 1]);
    CHECK(values[3 * i + 2] == 0.0);
  }
  CHECK(velocity.text_attribute("unit") == "m/s");
  CHECK(velocity.text_attribute("symbol") == "v");
  CHECK(velocity.text_attribute("description") == "Velocity.");
  CHECK(grid.group("PointData").dataset("stress").read<double>() == snapshot.fields[2].values);
  CHECK(grid.group("FieldData").dataset("time").read<double>() == std::vector<double>{0.125});
  CHECK(grid.group("FieldData").dataset("time").text_attribute("unit") == "s");
}

TEST_CASE("the same particles give the same bytes", "[io][snapshot]") {
  const Scratch scratch;
  write_snapshot(scratch / "a.vtkhdf", example(3));
  write_snapshot(scratch / "b.vtkhdf", example(3));
  CHECK(read_bytes(scratch / "a.vtkhdf") == read_bytes(scratch / "b.vtkhdf"));
}

TEST_CASE("a snapshot keeps NaN, so that a run that went wrong can be looked at", "[io][snapshot]") {
  const Scratch scratch;
  auto snapshot = example(3);
  snapshot.fields[0].values[3] = std::numeric_limits<double>::quiet_NaN();
  write_snapshot(scratch / "s.vtkhdf", snapshot);
  const hdf5::Input input(scratch / "s.vtkhdf");
  CHECK(std::isnan(input.root().group("VTKHDF").group("PointData").dataset("density").read<double>()[3]));
}

TEST_CASE("a snapshot that does not fit together is refused and nothing is written", "[io][snapshot]") {
  const Scratch scratch;
  auto snapshot = example(3);
  SECTION("dimensions") { snapshot.dimensions = 1; }
  SECTION("points") { snapshot.points.pop_back(); }
  SECTION("values") { snapshot.fields[1].values.pop_back(); }
  SECTION("components") { snapshot.fields[1].components = 4; }
  SECTION("no unit") { snapshot.fields[0].unit.clear(); }
  SECTION("name twice") { snapshot.fields[0].name = "velocity"; }
  SECTION("name with slash") { snapshot.fields[0].name = "a/b"; }
  CHECK_THROWS_AS(write_snapshot(scratch / "s.vtkhdf", snapshot), std::invalid_argument);
  CHECK(scratch.files() == 0);
}

TEST_CASE("a full disk while a snapshot is written leaves the earlier one", "[io][snapshot]") {
  const Scratch scratch;
  const auto file = scratch / "s.vtkhdf";
  write_snapshot(file, example(3));
  const auto before = read_bytes(file);
  const test::FileSizeLimit limit(100'000);
  CHECK_THAT(file_error([&] { write_snapshot(file, example(3, 10'000)); }),
             contains(file.string()) && contains("File too large"));
  CHECK(read_bytes(file) == before);
  CHECK(scratch.files() == 1);
}

TEST_CASE("write the snapshots that test_vtkhdf.py reads", "[.write-files]") {
  const auto folder = test::folder_of_python_tests();
  write_snapshot(folder / "plane.vtkhdf", example(2));
  write_snapshot(folder / "space.vtkhdf", example(3));
  write_snapshot(folder / "empty.vtkhdf", example(3, 0));
}
