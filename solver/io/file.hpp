// Whole files, read and written so that a reader never meets half of one.
#pragma once

#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace furrow {

/// A file that could not be read or written: what() names the file first, then the cause.
class FileError : public std::runtime_error {
 public:
  FileError(std::filesystem::path file, const std::string& cause);
  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
};

/// The name under which a file is written before it gets its own: the same folder (rename cannot cross file systems), and the
/// same name each time, so that what a killed run left behind is overwritten by the next one.
std::filesystem::path temporary_name(const std::filesystem::path& file);

/// Writes the pieces one after the other to temporary_name(file), brings them to the disk, and renames. Whatever happens, `file`
/// is afterwards either what it was or complete; after an exception the temporary is gone.
/// @throws FileError with the system's cause ("No space left on device")
void write_atomically(const std::filesystem::path& file, std::initializer_list<std::span<const std::byte>> pieces);

/// All bytes of a file.
/// @throws FileError
std::vector<std::byte> read_bytes(const std::filesystem::path& file);

}  // namespace furrow
