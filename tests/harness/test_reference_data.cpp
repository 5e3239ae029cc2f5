// Reference data: numbers in SI with their source, and a clear word where a file is not what it should be.
#include "harness/reference_data.hpp"

#include <unistd.h>

#include <cmath>
#include <fstream>

#include "harness/input.hpp"
#include "tests/catch.hpp"

using namespace furrow;
namespace fs = std::filesystem;

namespace {

struct Folder {
  fs::path path = fs::temp_directory_path() / ("furrow-data-" + std::to_string(getpid()));
  Folder() { fs::create_directories(path / "set"); }
  ~Folder() { fs::remove_all(path); }
  ReferenceData read(const std::string& csv) const {
    std::ofstream(path / "set/data.csv") << csv;
    std::ofstream(path / "set/source.toml")
        << "source = \"somebody\"\ncitation = \"Figure 3\"\nclass = \"experiment\"\nuncertainty = \"1 mm\"\nlicence = \"free\"\n";
    return read_reference_data("set", path);
  }
};

}  // namespace

TEST_CASE("columns come in SI, an empty field is no number", "[reference-data]") {
  const ReferenceData data = Folder().read("x (mm),force (kN),share (%)\n1,2,50\n3,,25\n");
  CHECK(data.rows() == 2);
  CHECK(data.column("x")[1] == Approx(0.003));
  CHECK(data.column("force")[0] == Approx(2000.0));
  CHECK(std::isnan(data.column("force")[1]));
  CHECK(data.column("share")[0] == Approx(0.5));
  CHECK(data.reference_class == "experiment");
  CHECK_THROWS_AS(data.column("y"), std::out_of_range);
}

TEST_CASE("what is no table is refused", "[reference-data]") {
  const Folder folder;
  CHECK_THROWS_AS(folder.read(""), InputError);
  CHECK_THROWS_AS(folder.read("x (mm)\n"), InputError);
  CHECK_THROWS_AS(folder.read("x\n1\n"), InputError);
  CHECK_THROWS_AS(folder.read("x (furlong)\n1\n"), InputError);
  CHECK_THROWS_AS(folder.read("x (mm),y (mm)\n1\n"), InputError);
  CHECK_THROWS_AS(folder.read("x (mm)\none\n"), InputError);
}

TEST_CASE("the sets of the project can be read", "[reference-data]") {
  for (const char* set : {"column-bui-2008", "column-nguyen-2017"}) {
    const ReferenceData data = read_reference_data(set);
    CHECK(data.reference_class == "independent");
    CHECK(data.column("height").size() == data.column("x").size());
    for (const double h : data.column("height")) CHECK((h >= 0.0 && h < 0.101));
  }
}
