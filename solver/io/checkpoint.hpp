// Checkpoints: named arrays, numbers and texts from which a run goes on bit for bit.
// A file is 512 bytes of header in plain text (HDF5's "user block": h5dump, h5py and HDFView skip it) with version, length and
// checksum, then an HDF5 file with /arrays, /scalars and /texts. The checksum covers every byte after the header and is verified
// before HDF5 sees any of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

namespace furrow {

/// 64-bit FNV-1a of the bytes (Fowler, Noll and Vo; offset basis 14695981039346656037, prime 1099511628211). Each step is one to
/// one in the hash and in the byte, so any single changed byte changes the result.
std::uint64_t fnv1a64(std::span<const std::byte> bytes);

class Checkpoint {
 public:
  static constexpr int format_version = 1;

  template <class T>
  static constexpr bool is_element = std::is_same_v<T, double> || std::is_same_v<T, std::int32_t> ||
                                     std::is_same_v<T, std::int64_t> || std::is_same_v<T, std::uint32_t>;

  /// Takes in a value under a name that is new among its kind (arrays, scalars, texts).
  /// T: double, int32, int64 or uint32. Arrays are flat; their shape belongs to whoever writes and reads them.
  /// @throws std::invalid_argument for a name that is taken, empty or has a slash, and for a text with a null character
  template <class T>
    requires is_element<T>
  void put_array(const std::string& name, std::vector<T> values) {
    insert(arrays_, "array", name, std::move(values));
  }
  template <class T>
    requires is_element<T>
  void put_scalar(const std::string& name, T value) {
    insert(scalars_, "scalar", name, std::vector<T>{value});
  }
  void put_text(const std::string& name, const std::string& text);
  /// Takes in everything of another checkpoint, with `prefix` before each name.
  void put_all(const std::string& prefix, const Checkpoint& other);
  /// What was taken in with this prefix, without it.
  Checkpoint part(const std::string& prefix) const;

  /// What was put in under that name.
  /// @throws std::out_of_range if there is none of that name and type; the message names the file it was read from
  template <class T>
    requires is_element<T>
  const std::vector<T>& array(const std::string& name) const {
    return get<T>(arrays_, "array", name);
  }
  template <class T>
    requires is_element<T>
  T scalar(const std::string& name) const {
    return get<T>(scalars_, "scalar", name).front();
  }
  const std::string& text(const std::string& name) const;

  std::vector<std::string> array_names() const;
  std::vector<std::string> scalar_names() const;
  std::vector<std::string> text_names() const;

  /// Atomic as in write_atomically.
  void write(const std::filesystem::path& file) const;
  /// @throws FileError naming what is wrong: not a checkpoint, another version, cut short, or damaged (with both checksums)
  static Checkpoint read(const std::filesystem::path& file);
  /// The same from bytes in memory; `file` names their origin in errors.
  static Checkpoint from_bytes(const std::filesystem::path& file, std::span<const std::byte> bytes);

 private:
  using Values =
      std::variant<std::vector<double>, std::vector<std::int32_t>, std::vector<std::int64_t>, std::vector<std::uint32_t>>;
  using Entries = std::map<std::string, Values>;

  static void check_name(bool taken, const char* kind, const std::string& name);
  [[noreturn]] void missing(const char* kind, const std::string& name, bool other_type) const;

  static void insert(Entries& entries, const char* kind, const std::string& name, Values values) {
    check_name(entries.contains(name), kind, name);
    entries.emplace(name, std::move(values));
  }
  template <class T>
  const std::vector<T>& get(const Entries& entries, const char* kind, const std::string& name) const {
    const auto found = entries.find(name);
    if (found == entries.end()) missing(kind, name, false);
    const auto* values = std::get_if<std::vector<T>>(&found->second);
    if (values == nullptr) missing(kind, name, true);
    return *values;
  }

  std::string origin_ = "checkpoint";
  Entries arrays_, scalars_;
  std::map<std::string, std::string> texts_;
};

}  // namespace furrow
