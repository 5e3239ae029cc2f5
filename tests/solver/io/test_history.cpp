// Histories: what is appended is what is read, a killed run keeps what was flushed, and a restart goes on where it was.
#include "solver/io/history.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <bit>
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

using namespace std::chrono_literals;
constexpr History::Interval never = 24h;

const std::vector<HistoryColumn> columns = {{"tip_displacement", "u", "m", "Displacement of the tip."},
                                            {"kinetic_energy", "E_k", "J", "Kinetic energy."}};

void append_rows(History& history, int first, int last) {
  for (int i = first; i < last; ++i) history.append(0.1 * i, std::array{std::sin(0.1 * i), 1.0 / (i + 1)});
}

}  // namespace

TEST_CASE("a history comes back with its columns in order, units and values", "[io][history]") {
  const Scratch scratch;
  const auto file = scratch / "history.h5";
  History history(file, columns, never);
  CHECK(read_history(file).rows() == 0);
  append_rows(history, 0, 1000);
  history.append(100.0, std::array{std::numeric_limits<double>::quiet_NaN(), -0.0});
  history.flush();

  const auto back = read_history(file);
  REQUIRE(back.columns.size() == 3);
  CHECK(back.columns[0] == HistoryColumn{"time", "t", "s", "Simulated time."});
  CHECK(back.columns[1] == columns[0]);
  CHECK(back.columns[2] == columns[1]);
  REQUIRE(back.rows() == 1001);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t r = 0; r < back.rows(); ++r)
      REQUIRE(std::bit_cast<std::uint64_t>(back.values[c][r]) == std::bit_cast<std::uint64_t>(history.table().values[c][r]));
}

TEST_CASE("rows reach the file after the flush interval, at a flush, and at the end", "[io][history]") {
  const Scratch scratch;
  const auto file = scratch / "history.h5";
  SECTION("an interval of zero flushes each row") {
    History history(file, columns, 0s);
    append_rows(history, 0, 3);
    CHECK(read_history(file).rows() == 3);
  }
  SECTION("a long interval keeps rows in memory until the history ends") {
    {
      History history(file, columns, never);
      append_rows(history, 0, 3);
      CHECK(read_history(file).rows() == 0);
    }
    CHECK(read_history(file).rows() == 3);
  }
}

TEST_CASE("a killed run keeps the rows that were flushed", "[io][history]") {
  const Scratch scratch;
  const auto file = scratch / "history.h5";
  const pid_t run = ::fork();
  REQUIRE(run >= 0);
  if (run == 0) {
    History history(file, columns, never);
    append_rows(history, 0, 5);
    history.flush();
    append_rows(history, 5, 9);
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ::waitpid(run, &status, 0);
  CHECK(WIFSIGNALED(status));
  CHECK(read_history(file).rows() == 5);
}

TEST_CASE("a resumed history is byte for byte the one that was never stopped", "[io][history]") {
  const Scratch scratch;
  {
    History whole(scratch / "whole.h5", columns, never);
    append_rows(whole, 0, 50);
  }
  {
    History first(scratch / "parts.h5", columns, never);
    append_rows(first, 0, 30);   // 20 rows are known to the checkpoint, 10 more are on disk
  }
  {
    auto second = History::resume(scratch / "parts.h5", columns, 20, never);
    CHECK(second.rows() == 20);
    append_rows(second, 20, 50);
  }
  CHECK(read_bytes(scratch / "parts.h5") == read_bytes(scratch / "whole.h5"));

  CHECK_THAT(file_error([&] { History::resume(scratch / "whole.h5", columns, 51, never); }),
             contains("whole.h5") && contains("has 50 rows; the run that shall go on had written 51"));
  CHECK_THAT(file_error([&] { History::resume(scratch / "whole.h5", {columns[0]}, 10, never); }), contains("other columns"));
}

TEST_CASE("a full disk during a history is an exception, and the rows flushed before stay", "[io][history]") {
  const Scratch scratch;
  const auto file = scratch / "history.h5";
  History history(file, columns, never);
  append_rows(history, 0, 3);
  history.flush();
  std::filesystem::create_symlink("/dev/full", temporary_name(file));
  append_rows(history, 3, 6);
  CHECK_THAT(file_error([&] { history.flush(); }), contains(file.string()) && contains("No space left on device"));
  CHECK(read_history(file).rows() == 3);
  history.flush();   // the disk has room again: nothing was lost
  CHECK(read_history(file).rows() == 6);
}

TEST_CASE("wrong use of a history is refused", "[io][history]") {
  const Scratch scratch;
  const auto file = scratch / "history.h5";
  CHECK_THROWS_AS(History(file, {{"time", "t", "s", ""}}), std::invalid_argument);
  CHECK_THROWS_AS(History(file, {{"a", "a", "", ""}}), std::invalid_argument);
  CHECK_THROWS_AS(History(file, {{"a/b", "a", "1", ""}}), std::invalid_argument);
  CHECK(scratch.files() == 0);
  History history(file, columns, never);
  CHECK_THROWS_AS(history.append(0.0, std::array{1.0}), std::invalid_argument);
  CHECK(history.rows() == 0);
  CHECK_THAT(file_error([&] { History(scratch / "none/history.h5", columns); }), contains("none/history.h5"));
}

TEST_CASE("a file that is no history is named with what it is", "[io][history]") {
  const Scratch scratch;
  const auto file = scratch / "history.h5";
  SECTION("not HDF5") {
    test::put_bytes(file, std::as_bytes(std::span("time,u\n0,1\n")));
    CHECK_THAT(file_error([&] { read_history(file); }), contains(file.string()) && contains("file signature not found"));
  }
  SECTION("truncated") {
    History(file, columns).flush();
    const auto bytes = read_bytes(file);
    test::put_bytes(file, std::span(bytes).first(bytes.size() / 2));
    CHECK_THAT(file_error([&] { read_history(file); }), contains(file.string()) && contains("truncated file"));
  }
  SECTION("empty") {
    test::put_bytes(file, {});
    CHECK_THAT(file_error([&] { read_history(file); }), contains(file.string()) && contains("is empty"));
  }
  SECTION("another version") {
    hdf5::Output output(file);
    output.root().set_attribute("format", "furrow history");
    output.root().set_attribute("version", std::vector<std::int64_t>{2});
    output.commit();
    CHECK_THAT(file_error([&] { read_history(file); }), contains("has history version 2; this program reads version 1"));
  }
  SECTION("another HDF5 file") {
    hdf5::Output(file).commit();
    CHECK_THAT(file_error([&] { read_history(file); }), contains(file.string()) && contains("attribute 'format'"));
  }
}

TEST_CASE("write the history that test_h5py.py reads", "[.write-files]") {
  History history(test::folder_of_python_tests() / "history.h5", columns, never);
  for (int i = 0; i < 10; ++i) history.append(0.25 * i, std::array{-1.0 * i, 100.0 + i});
  history.flush();
}
