// The wrapper: types are exact, order is kept, and errors carry file, object and HDF5's words.
#include "solver/io/hdf5.hpp"

#include "tests/catch.hpp"
#include "tests/solver/io/scratch.hpp"

using namespace furrow;
using furrow::test::Scratch;
using furrow::test::file_error;
using furrow::test::contains;

TEST_CASE("HDF5 groups, datasets and attributes come back", "[io][hdf5]") {
  const Scratch scratch;
  const auto file = scratch / "f.h5";
  hdf5::Output output(file);
  auto group = output.root().create_group("z");
  output.root().write("b", std::vector<std::uint64_t>{18446744073709551615U});
  const std::vector<double> six = {1, 2, 3, 4, 5, 6};
  output.root().write("a", std::span<const double>(six), {2, 3}).set_attribute("unit", "");
  group.write_text("note", "\xce\xb1");
  const std::vector<std::string> words = {"time", "", "x"};
  group.set_attribute("words", words);
  CHECK(scratch.files() == 0);
  output.commit();

  const hdf5::Input input(file);
  CHECK(input.root().names() == std::vector<std::string>{"a", "b", "z"});
  CHECK(input.root().dataset("a").extents() == std::vector<std::size_t>{2, 3});
  CHECK(input.root().dataset("a").read<double>() == six);
  CHECK(input.root().dataset("a").text_attribute("unit").empty());
  CHECK(input.root().dataset("b").read<std::uint64_t>().front() == 18446744073709551615U);
  CHECK(input.root().group("z").dataset("note").read_text() == "\xce\xb1");
  CHECK(input.root().group("z").texts_attribute("words") == words);
}

TEST_CASE("HDF5 errors name the file, the object and the cause", "[io][hdf5]") {
  const Scratch scratch;
  const auto file = scratch / "f.h5";
  hdf5::Output output(file);
  output.root().write("a", std::vector<std::int32_t>{1});
  CHECK_THAT(file_error([&] { output.root().write("a", std::vector<double>{1}); }),
             contains(file.string() + ": cannot write /a") && contains("exists"));
  const std::vector<double> two = {1, 2};
  CHECK_THAT(file_error([&] { output.root().write("c", std::span<const double>(two), {3}); }), contains("cannot write /c"));
  output.commit();

  const hdf5::Input input(file);
  CHECK_THAT(file_error([&] { input.root().dataset("b"); }),
             contains(file.string() + ": cannot open /b") && contains("doesn't exist"));
  CHECK_THAT(file_error([&] { input.root().dataset("a").read<double>(); }), contains("/a holds numbers of another type"));
  CHECK_THAT(file_error([&] { input.root().dataset("a").text_attribute("unit"); }), contains("attribute 'unit' of /a"));
  CHECK_THAT(file_error([&] { input.root().group("none"); }), contains("open group /none"));
  CHECK_THAT(file_error([&] { input.root().dataset("a").read_text(); }), contains("/a is not a text"));
}
