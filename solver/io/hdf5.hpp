// HDF5 with handles that close themselves and errors that are exceptions. A file to be written is built in memory and reaches
// the disk in one atomic step, so a full disk is met by our own write, never inside the library's closing.
// HDF5 keeps global state: use this from one thread at a time.
#pragma once

#include <hdf5.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "solver/io/file.hpp"

namespace furrow::hdf5 {

/// A named place inside a file: "density" in "/VTKHDF/PointData". Everything thrown from here is a FileError that names the file,
/// the object and what HDF5 said.
class Location {
 public:
  using Handle = std::shared_ptr<const hid_t>;
  Location(Handle handle, std::filesystem::path file, std::string path);

  /// Attributes. Texts are stored with fixed length (UTF-8, null-padded), as VTKHDF wants them.
  void set_attribute(const std::string& name, const std::string& text);
  void set_attribute(const std::string& name, std::span<const std::int64_t> values);
  void set_attribute(const std::string& name, const std::vector<std::string>& texts);
  std::string text_attribute(const std::string& name) const;
  std::vector<std::string> texts_attribute(const std::string& name) const;
  std::vector<std::int64_t> integer_attribute(const std::string& name) const;

  const std::string& path() const { return path_; }

 protected:
  hid_t id() const { return *handle_; }
  [[noreturn]] void fail(const std::string& action) const;
  Handle check(hid_t result, herr_t (*close)(hid_t), const std::string& action) const;
  void check(herr_t result, const std::string& action) const;
  const std::filesystem::path& file() const { return file_; }
  std::string child(const std::string& name) const;

 private:
  Handle handle_;
  std::filesystem::path file_;
  std::string path_;
};

/// An array with its extents, slowest index first. T: double, int32, int64, uint32, uint64, uint8; the type in the file must be
/// exactly T (no silent conversion), so values come back bit for bit.
class Dataset : public Location {
 public:
  using Location::Location;
  std::vector<std::size_t> extents() const;

  template <class T>
  bool holds() const;
  template <class T>
  std::vector<T> read() const;
  /// For a dataset written by Group::write_text.
  bool holds_text() const;
  std::string read_text() const;
};

class Group : public Location {
 public:
  using Location::Location;

  Group create_group(const std::string& name);
  Group group(const std::string& name) const;

  /// values.size() must be the product of the extents; no extents means one scalar.
  template <class T>
  Dataset write(const std::string& name, std::span<const T> values, const std::vector<std::size_t>& extents);
  template <class T>
  Dataset write(const std::string& name, const std::vector<T>& values) {
    return write(name, std::span<const T>(values), {values.size()});
  }
  Dataset write_text(const std::string& name, const std::string& text);
  Dataset dataset(const std::string& name) const;

  /// Names of groups and datasets, by alphabet.
  std::vector<std::string> names() const;
};

/// A new HDF5 file in memory, without time stamps: same content, same bytes.
class Output {
 public:
  /// `file` names the destination in errors; nothing is touched before commit().
  explicit Output(std::filesystem::path file);

  Group& root() { return *root_; }
  /// The bytes of the file so far.
  std::vector<std::byte> image() const;
  /// Writes the file as write_atomically does.
  void commit() const;

 private:
  std::filesystem::path file_;
  Location::Handle handle_;
  std::unique_ptr<Group> root_;
};

/// An existing HDF5 file, for reading.
class Input {
 public:
  explicit Input(const std::filesystem::path& file);
  /// From bytes already read; `file` names their origin in errors.
  Input(std::filesystem::path file, std::span<const std::byte> image);

  const Group& root() const { return *root_; }

 private:
  Location::Handle handle_;
  std::unique_ptr<const Group> root_;
};

}  // namespace furrow::hdf5
