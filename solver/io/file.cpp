#include "solver/io/file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace furrow {
namespace {

std::string system_cause(const std::string& action, int error) {
  return "cannot " + action + ": " + std::generic_category().message(error);
}

/// A file descriptor that is closed when its scope ends.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }

  int number() const { return number_; }
  bool valid() const { return number_ >= 0; }
  int close() { return valid() ? ::close(std::exchange(number_, -1)) : 0; }

 private:
  int number_;
};

void write_all(int descriptor, std::span<const std::byte> bytes, const std::filesystem::path& file) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw FileError(file, system_cause("write", errno));
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void write_temporary(const std::filesystem::path& temporary, const std::filesystem::path& file,
                     std::initializer_list<std::span<const std::byte>> pieces) {
  Descriptor out(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (!out.valid()) throw FileError(file, system_cause("open '" + temporary.string() + "' for writing", errno));
  for (const auto piece : pieces) write_all(out.number(), piece, file);
  if (::fsync(out.number()) != 0) throw FileError(file, system_cause("bring to the disk", errno));
  // Some file systems report a full disk only here.
  if (out.close() != 0) throw FileError(file, system_cause("close", errno));
}

}  // namespace

FileError::FileError(std::filesystem::path file, const std::string& cause)
    : std::runtime_error(file.string() + ": " + cause), file_(std::move(file)) {}

std::filesystem::path temporary_name(const std::filesystem::path& file) {
  auto name = file;
  name += ".part";
  return name;
}

void write_atomically(const std::filesystem::path& file, std::initializer_list<std::span<const std::byte>> pieces) {
  const auto temporary = temporary_name(file);
  try {
    write_temporary(temporary, file, pieces);
    if (::rename(temporary.c_str(), file.c_str()) != 0) throw FileError(file, system_cause("rename into place", errno));
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
  // The name itself must survive a power cut too. File systems that cannot sync a folder (EINVAL) keep names on their own terms.
  const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  const Descriptor names(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (names.valid() && ::fsync(names.number()) != 0 && errno != EINVAL)
    throw FileError(file, system_cause("bring its name to the disk", errno));
}

std::vector<std::byte> read_bytes(const std::filesystem::path& file) {
  const Descriptor in(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (!in.valid()) throw FileError(file, system_cause("open", errno));
  struct stat status = {};
  if (::fstat(in.number(), &status) != 0) throw FileError(file, system_cause("find its size", errno));
  std::vector<std::byte> bytes(static_cast<std::size_t>(status.st_size));
  for (std::size_t filled = 0; filled < bytes.size();) {
    const ssize_t got = ::read(in.number(), bytes.data() + filled, bytes.size() - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw FileError(file, system_cause("read", errno));
    if (got == 0) throw FileError(file, "ends early: another program shortened it while it was read");
    filled += static_cast<std::size_t>(got);
  }
  return bytes;
}

}  // namespace furrow
