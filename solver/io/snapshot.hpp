// Snapshots: all particles at one time in a VTKHDF 1.0 file, which ParaView (5.11) and VTK (9.1) open as it is.
// Format: https://docs.vtk.org, "VTKHDF format specification", unstructured grid; each particle is one vertex cell.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace furrow {

/// One quantity on all particles, particle by particle.
struct SnapshotField {
  std::string name;           ///< "density"
  std::string symbol;         ///< "rho"
  std::string unit;           ///< SI; "1" for a number without unit
  std::string description;    ///< one sentence
  int components = 1;         ///< 1 scalar; 2 or 3 vector (2 is filled up with z = 0); 9 tensor, row by row (xx, xy, xz, yx, ...)
  std::vector<double> values; ///< particles x components
};

struct Snapshot {
  double time = 0.0;                  ///< s
  int dimensions = 3;                 ///< 2 (plane z = 0) or 3
  std::vector<double> points;         ///< m, particles x dimensions
  std::vector<SnapshotField> fields;
};

/// Writes /VTKHDF with Points, PointData/<name> and FieldData/time; every dataset with a meaning carries the attributes `unit`,
/// `symbol` and `description`. Atomic as in write_atomically. The numbers are stored as they are, NaN included: a snapshot is
/// also what shows a run that went wrong.
/// @throws std::invalid_argument if sizes do not fit, a name is empty, has a slash or occurs twice, or a unit is empty
/// @throws FileError
void write_snapshot(const std::filesystem::path& file, const Snapshot& snapshot);

}  // namespace furrow
