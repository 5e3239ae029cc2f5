// Checkpoints come back bit for bit or not at all: every single byte of a file is flipped, and it is cut at every length.
#include "solver/io/checkpoint.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "solver/io/hdf5.hpp"
#include "tests/catch.hpp"
#include "tests/solver/io/scratch.hpp"

using namespace furrow;
using furrow::test::Scratch;
using furrow::test::file_error;
using furrow::test::contains;

namespace {

std::vector<std::uint64_t> bits(const std::vector<double>& values) {
  std::vector<std::uint64_t> patterns;
  for (const double v : values) patterns.push_back(std::bit_cast<std::uint64_t>(v));
  return patterns;
}

/// Every kind of double: both zeros, infinities, subnormal, quiet NaN with sign and payload, signalling NaN.
std::vector<double> odd_numbers() {
  std::vector<double> values = {0.0, -0.0, 0.1, 1e308, -1e-308, std::numeric_limits<double>::denorm_min(),
                                std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const std::uint64_t pattern : {0x7ff8000000000000U, 0xfff8000000000123U, 0x7ff0000000000001U, 0x7fffffffffffffffU})
    values.push_back(std::bit_cast<double>(pattern));
  return values;
}

Checkpoint example() {
  Checkpoint checkpoint;
  checkpoint.put_array("stress", odd_numbers());
  checkpoint.put_array("nothing", std::vector<double>{});
  checkpoint.put_array("cell", std::vector<std::int32_t>{-1, 0, std::numeric_limits<std::int32_t>::min()});
  checkpoint.put_array("offset", std::vector<std::int64_t>{std::numeric_limits<std::int64_t>::max(), -5});
  checkpoint.put_array("neighbour", std::vector<std::uint32_t>{0, 4294967295U});
  checkpoint.put_scalar("time", std::bit_cast<double>(std::uint64_t{0xfff8000000000042U}));
  checkpoint.put_scalar("step", std::int64_t{9007199254740993});   // not a double
  checkpoint.put_text("material", "steel, E = 210 GPa, \xce\xbd = 0.3\n");
  checkpoint.put_text("empty", "");
  return checkpoint;
}

std::vector<std::byte> example_bytes(const Scratch& scratch) {
  example().write(scratch / "c.h5");
  return read_bytes(scratch / "c.h5");
}

}  // namespace

TEST_CASE("the checksum is FNV-1a of 64 bits", "[io][checkpoint]") {
  // Test vectors of the draft "The FNV Non-Cryptographic Hash Algorithm" (Fowler, Noll, Vo, Eastlake), appendix C.
  const auto hash = [](std::string_view text) { return fnv1a64(std::as_bytes(std::span(text))); };
  CHECK(hash("") == 0xcbf29ce484222325U);
  CHECK(hash("a") == 0xaf63dc4c8601ec8cU);
  CHECK(hash("foobar") == 0x85944171f73967e8U);
}

TEST_CASE("a checkpoint comes back bit for bit", "[io][checkpoint]") {
  const Scratch scratch;
  const auto file = scratch / "c.h5";
  example().write(file);
  const auto back = Checkpoint::read(file);
  CHECK(bits(back.array<double>("stress")) == bits(odd_numbers()));
  CHECK(back.array<double>("nothing").empty());
  CHECK(back.array<std::int32_t>("cell") == example().array<std::int32_t>("cell"));
  CHECK(back.array<std::int64_t>("offset") == example().array<std::int64_t>("offset"));
  CHECK(back.array<std::uint32_t>("neighbour") == example().array<std::uint32_t>("neighbour"));
  CHECK(std::bit_cast<std::uint64_t>(back.scalar<double>("time")) == 0xfff8000000000042U);
  CHECK(back.scalar<std::int64_t>("step") == 9007199254740993);
  CHECK(back.text("material") == "steel, E = 210 GPa, \xce\xbd = 0.3\n");
  CHECK(back.text("empty").empty());
  CHECK(back.array_names() == std::vector<std::string>{"cell", "neighbour", "nothing", "offset", "stress"});
  CHECK(back.scalar_names() == std::vector<std::string>{"step", "time"});
  CHECK(back.text_names() == std::vector<std::string>{"empty", "material"});

  back.write(scratch / "again.h5");
  CHECK(read_bytes(scratch / "again.h5") == read_bytes(file));
}

TEST_CASE("a checkpoint of a million numbers comes back", "[io][checkpoint]") {
  const Scratch scratch;
  std::vector<double> values(1'000'000);
  std::iota(values.begin(), values.end(), 0.5);
  Checkpoint checkpoint;
  checkpoint.put_array("x", values);
  checkpoint.write(scratch / "c.h5");
  CHECK(Checkpoint::read(scratch / "c.h5").array<double>("x") == values);
}

TEST_CASE("an empty checkpoint comes back empty", "[io][checkpoint]") {
  const Scratch scratch;
  Checkpoint().write(scratch / "c.h5");
  CHECK(Checkpoint::read(scratch / "c.h5").array_names().empty());
}

TEST_CASE("any flipped byte is noticed", "[io][checkpoint]") {
  const Scratch scratch;
  auto bytes = example_bytes(scratch);
  REQUIRE_NOTHROW(Checkpoint::from_bytes("c.h5", bytes));
  std::size_t missed = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const auto good = bytes[i];
    for (const auto flip : {std::byte{0x01}, std::byte{0x80}, std::byte{0xff}}) {
      bytes[i] = good ^ flip;
      if (file_error([&] { Checkpoint::from_bytes("c.h5", bytes); }).empty()) ++missed;
    }
    bytes[i] = good;
  }
  CHECK(missed == 0);
}

TEST_CASE("any truncation is noticed, and so is a longer file", "[io][checkpoint]") {
  const Scratch scratch;
  auto bytes = example_bytes(scratch);
  std::size_t missed = 0;
  for (std::size_t length = 0; length < bytes.size(); ++length)
    if (file_error([&] { Checkpoint::from_bytes("c.h5", std::span(bytes).first(length)); }).empty()) ++missed;
  CHECK(missed == 0);
  CHECK_THAT(file_error([&] { Checkpoint::from_bytes("c.h5", std::span(bytes).first(600)); }),
             contains("c.h5") && contains("cut short: 88 bytes after the header"));
  bytes.push_back(std::byte{});
  CHECK_THAT(file_error([&] { Checkpoint::from_bytes("c.h5", bytes); }), contains("c.h5") && contains("too long"));
}

TEST_CASE("what is wrong with a checkpoint is said", "[io][checkpoint]") {
  const Scratch scratch;
  const auto file = scratch / "c.h5";
  auto bytes = example_bytes(scratch);

  SECTION("a damaged value: both checksums and the byte range") {
    bytes[bytes.size() - 1] ^= std::byte{0x10};
    test::put_bytes(file, bytes);
    CHECK_THAT(file_error([&] { Checkpoint::read(file); }),
               contains(file.string()) && contains("damaged") && contains("bytes 512 to " + std::to_string(bytes.size())));
  }
  SECTION("another version") {
    const std::string head(reinterpret_cast<const char*>(bytes.data()), 100);
    bytes[head.find("version 1") + 8] = std::byte{'7'};
    test::put_bytes(file, bytes);
    CHECK_THAT(file_error([&] { Checkpoint::read(file); }),
               contains(file.string()) && contains("version 7; this program reads version 1"));
  }
  SECTION("another kind of file, even a good HDF5 one") {
    hdf5::Output(file).commit();
    CHECK_THAT(file_error([&] { Checkpoint::read(file); }), contains(file.string()) && contains("is not a checkpoint"));
  }
  SECTION("no file") {
    CHECK_THAT(file_error([&] { Checkpoint::read(scratch / "none.h5"); }), contains("none.h5: cannot open: No such file"));
  }
}

TEST_CASE("a name or type that a checkpoint does not have is an error that says so", "[io][checkpoint]") {
  const Scratch scratch;
  example().write(scratch / "c.h5");
  const auto back = Checkpoint::read(scratch / "c.h5");
  CHECK_THROWS_WITH(back.array<double>("strain"), contains("c.h5: there is no array 'strain'"));
  CHECK_THROWS_WITH(back.array<double>("cell"), contains("c.h5: array 'cell' has another type"));
  CHECK_THROWS_WITH(back.scalar<double>("step"), contains("c.h5: scalar 'step' has another type"));
  CHECK_THROWS_WITH(back.text("note"), contains("c.h5: there is no text 'note'"));

  auto checkpoint = example();
  CHECK_THROWS_AS(checkpoint.put_array("stress", std::vector<double>{}), std::invalid_argument);
  CHECK_THROWS_AS(checkpoint.put_scalar("a/b", 1.0), std::invalid_argument);
  CHECK_THROWS_AS(checkpoint.put_text("", "x"), std::invalid_argument);
  CHECK_THROWS_AS(checkpoint.put_text("zero", std::string("a\0b", 3)), std::invalid_argument);
}

TEST_CASE("write the checkpoint that test_h5py.py reads", "[.write-files]") {
  example().write(test::folder_of_python_tests() / "checkpoint.h5");
}
