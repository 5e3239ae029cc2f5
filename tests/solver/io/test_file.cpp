// Old or new, never half: full disk, file size limit, missing folder, and kill -9 in the middle of a write.
#include "solver/io/file.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>

#include "tests/catch.hpp"
#include "tests/solver/io/scratch.hpp"

using namespace furrow;
using furrow::test::FileSizeLimit;
using furrow::test::Scratch;
using furrow::test::file_error;
using furrow::test::contains;

namespace {

std::vector<std::byte> some_bytes(std::size_t count, unsigned seed) {
  std::vector<std::byte> bytes(count);
  for (auto& b : bytes) b = static_cast<std::byte>((seed = seed * 1664525U + 1013904223U) >> 24);
  return bytes;
}

}  // namespace

TEST_CASE("a file is written whole, in pieces, and replaces the old one", "[io][file]") {
  const Scratch scratch;
  const auto file = scratch / "f";
  const auto first = some_bytes(100'000, 1), second = some_bytes(7, 2);
  write_atomically(file, {first, second});
  const auto both = read_bytes(file);
  REQUIRE(both.size() == first.size() + second.size());
  CHECK(std::equal(first.begin(), first.end(), both.begin()));
  CHECK(std::equal(second.begin(), second.end(), both.end() - 7));
  write_atomically(file, {second});
  CHECK(read_bytes(file) == second);
  CHECK(scratch.files() == 1);
}

TEST_CASE("a full disk is an exception that names file and cause, and leaves the old file", "[io][file]") {
  const Scratch scratch;
  const auto file = scratch / "f";
  const auto old = some_bytes(1000, 1), large = some_bytes(1'000'000, 2);
  write_atomically(file, {old});

  SECTION("no space left on the device") {
    // Whatever is written under the temporary name goes to a device that is always full.
    std::filesystem::create_symlink("/dev/full", temporary_name(file));
    const auto message = file_error([&] { write_atomically(file, {large}); });
    CHECK_THAT(message, contains(file.string()) && contains("No space left on device"));
  }
  SECTION("file size limit, met in the middle") {
    const FileSizeLimit limit(300'000);
    const auto message = file_error([&] { write_atomically(file, {large}); });
    CHECK_THAT(message, contains(file.string()) && contains("File too large"));
  }
  SECTION("something else has the temporary name") {
    std::filesystem::create_directories(temporary_name(file) / "full");
    const auto message = file_error([&] { write_atomically(file, {large}); });
    CHECK_THAT(message, contains(file.string()) && contains("Is a directory"));
    std::filesystem::remove_all(temporary_name(file));
  }
  CHECK(read_bytes(file) == old);
  CHECK(scratch.files() == 1);
}

TEST_CASE("a folder or file that is missing is named", "[io][file]") {
  const Scratch scratch;
  const auto file = scratch / "no-such-folder/f";
  CHECK_THAT(file_error([&] { write_atomically(file, {}); }), contains(file.string()) && contains("No such file or directory"));
  CHECK_THAT(file_error([&] { read_bytes(file); }), contains(file.string()) && contains("No such file or directory"));
}

TEST_CASE("kill -9 in the middle of a write leaves the old file, and the next write succeeds", "[io][file]") {
  const Scratch scratch;
  const auto file = scratch / "f";
  const auto old = some_bytes(1000, 1), large = some_bytes(1'000'000, 2);
  write_atomically(file, {old});

  // A pipe under the temporary name holds 64 KiB: the writer is certainly in the middle once it is full.
  REQUIRE(::mkfifo(temporary_name(file).c_str(), 0600) == 0);
  const pid_t writer = ::fork();
  REQUIRE(writer >= 0);
  if (writer == 0) {
    write_atomically(file, {large});
    ::_exit(0);
  }
  const int pipe = ::open(temporary_name(file).c_str(), O_RDONLY | O_NONBLOCK);
  pollfd readable = {pipe, POLLIN, 0};
  CHECK(::poll(&readable, 1, 10'000) == 1);   // ms; a writer that goes elsewhere must not make the test wait for ever
  std::byte seen{};
  CHECK(::read(pipe, &seen, 1) == 1);
  CHECK(seen == large.front());
  ::kill(writer, SIGKILL);
  int status = 0;
  ::waitpid(writer, &status, 0);
  ::close(pipe);
  CHECK(WIFSIGNALED(status));
  CHECK(read_bytes(file) == old);

  std::filesystem::remove(temporary_name(file));
  test::put_bytes(temporary_name(file), std::span(large).first(500'000));   // what the killed writer leaves on a disk
  write_atomically(file, {old, old});
  CHECK(read_bytes(file).size() == 2000);
  CHECK(scratch.files() == 1);
}
