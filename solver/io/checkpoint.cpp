#include "solver/io/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "solver/io/hdf5.hpp"

namespace furrow {
namespace {

/// HDF5 looks for its signature at byte 0, 512, 1024, ...: what lies before is a user block.
constexpr std::size_t header_size = 512;
constexpr std::string_view magic = "furrow checkpoint\nversion ";

std::string header(std::size_t length, std::uint64_t checksum) {
  auto text = fmt::format("{}{}\nlength {}\nfnv1a64 {:016x}\n", magic, Checkpoint::format_version, length, checksum);
  text.resize(header_size - 1, ' ');
  return text + '\n';
}

std::string_view as_text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// The number that follows `key` in the header.
template <class T>
std::optional<T> number_after(std::string_view text, std::string_view key, int base = 10) {
  const auto at = text.find(key);
  if (at == std::string_view::npos) return std::nullopt;
  const auto digits = text.substr(at + key.size());
  T value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
  if (error != std::errc()) return std::nullopt;
  return value;
}

/// The HDF5 part, after header, length and checksum have been found right.
std::span<const std::byte> verified(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  const auto head = as_text(bytes.first(std::min(header_size, bytes.size())));
  const auto version = number_after<int>(head, magic);
  if (!head.starts_with(magic.substr(0, head.size())) || head.empty())
    throw FileError(file, "is not a checkpoint: it does not begin with \"furrow checkpoint\"");
  if (bytes.size() < header_size)
    throw FileError(file, fmt::format("is cut short: {} bytes, the header alone has {}", bytes.size(), header_size));
  if (version != Checkpoint::format_version)
    throw FileError(file, version ? fmt::format("has checkpoint version {}; this program reads version {}", *version,
                                                Checkpoint::format_version)
                                  : "has a damaged header: no version");
  const auto content = bytes.subspan(header_size);
  const auto length = number_after<std::size_t>(head, "\nlength ");
  const auto checksum = number_after<std::uint64_t>(head, "\nfnv1a64 ", 16);
  if (!length || !checksum) throw FileError(file, "has a damaged header: no length or no checksum");
  if (content.size() != *length)
    throw FileError(file, fmt::format("is {}: {} bytes after the header, which promises {}",
                                      content.size() < *length ? "cut short" : "too long", content.size(), *length));
  const auto computed = fnv1a64(content);
  if (computed != *checksum)
    throw FileError(file, fmt::format("is damaged: bytes {} to {} have the checksum {:016x}, the header says {:016x}",
                                      header_size, bytes.size(), computed, *checksum));
  if (head != header(*length, *checksum))
    throw FileError(file, fmt::format("is damaged in bytes 0 to {}, its header", header_size));
  return content;
}

template <class... T>
void write_values(hdf5::Group group, const std::map<std::string, std::variant<T...>>& entries) {
  for (const auto& [name, values] : entries)
    std::visit([&group, &name = name](const auto& numbers) { group.write(name, numbers); }, values);
}

template <class Values>
std::map<std::string, Values> read_values(const std::filesystem::path& file, const hdf5::Group& group) {
  std::map<std::string, Values> entries;
  for (const auto& name : group.names()) {
    const auto dataset = group.dataset(name);
    const auto read_as = [&]<class T>(T) {
      if (!dataset.holds<T>()) return false;
      return entries.emplace(name, dataset.read<T>()).second;
    };
    if (!read_as(double{}) && !read_as(std::int32_t{}) && !read_as(std::int64_t{}) && !read_as(std::uint32_t{}))
      throw FileError(file, dataset.path() + " holds numbers of a type that checkpoints do not have");
  }
  return entries;
}

template <class T>
std::vector<std::string> keys(const std::map<std::string, T>& entries) {
  std::vector<std::string> names;
  for (const auto& [name, value] : entries) names.push_back(name);
  return names;
}

}  // namespace

std::uint64_t fnv1a64(std::span<const std::byte> bytes) {
  std::uint64_t hash = 14695981039346656037U;
  for (const std::byte b : bytes) hash = (hash ^ std::to_integer<std::uint64_t>(b)) * 1099511628211U;
  return hash;
}

void Checkpoint::check_name(bool taken, const char* kind, const std::string& name) {
  if (name.empty() || name.find_first_of(std::string_view("/\0", 2)) != std::string::npos)
    throw std::invalid_argument(fmt::format("checkpoint: '{}' cannot name a {}: it is empty or has a slash", name, kind));
  if (taken) throw std::invalid_argument(fmt::format("checkpoint: two {}s '{}'", kind, name));
}

void Checkpoint::missing(const char* kind, const std::string& name, bool other_type) const {
  throw std::out_of_range(other_type ? fmt::format("{}: {} '{}' has another type than the one asked for", origin_, kind, name)
                                     : fmt::format("{}: there is no {} '{}'", origin_, kind, name));
}

void Checkpoint::put_text(const std::string& name, const std::string& text) {
  check_name(texts_.contains(name), "text", name);
  if (text.find('\0') != std::string::npos)
    throw std::invalid_argument(fmt::format("checkpoint: text '{}' contains a null character", name));
  texts_.emplace(name, text);
}

const std::string& Checkpoint::text(const std::string& name) const {
  const auto found = texts_.find(name);
  if (found == texts_.end()) missing("text", name, false);
  return found->second;
}

void Checkpoint::put_all(const std::string& prefix, const Checkpoint& other) {
  for (const auto& [name, values] : other.arrays_) insert(arrays_, "array", prefix + name, values);
  for (const auto& [name, values] : other.scalars_) insert(scalars_, "scalar", prefix + name, values);
  for (const auto& [name, text] : other.texts_) put_text(prefix + name, text);
}

Checkpoint Checkpoint::part(const std::string& prefix) const {
  Checkpoint found;
  found.origin_ = origin_;
  const auto take = [&prefix](const auto& from, auto& to) {
    for (const auto& [name, value] : from)
      if (name.starts_with(prefix)) to.emplace(name.substr(prefix.size()), value);
  };
  take(arrays_, found.arrays_);
  take(scalars_, found.scalars_);
  take(texts_, found.texts_);
  return found;
}

std::vector<std::string> Checkpoint::array_names() const { return keys(arrays_); }
std::vector<std::string> Checkpoint::scalar_names() const { return keys(scalars_); }
std::vector<std::string> Checkpoint::text_names() const { return keys(texts_); }

void Checkpoint::write(const std::filesystem::path& file) const {
  hdf5::Output output(file);
  write_values(output.root().create_group("arrays"), arrays_);
  write_values(output.root().create_group("scalars"), scalars_);
  auto texts = output.root().create_group("texts");
  for (const auto& [name, text] : texts_) texts.write_text(name, text);
  const auto content = output.image();
  const auto head = header(content.size(), fnv1a64(content));
  write_atomically(file, {std::as_bytes(std::span(head)), content});
}

Checkpoint Checkpoint::read(const std::filesystem::path& file) { return from_bytes(file, read_bytes(file)); }

Checkpoint Checkpoint::from_bytes(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  const hdf5::Input input(file, verified(file, bytes));
  Checkpoint checkpoint;
  checkpoint.origin_ = file.string();
  checkpoint.arrays_ = read_values<Values>(file, input.root().group("arrays"));
  checkpoint.scalars_ = read_values<Values>(file, input.root().group("scalars"));
  const auto texts = input.root().group("texts");
  for (const auto& name : texts.names()) checkpoint.texts_.emplace(name, texts.dataset(name).read_text());
  return checkpoint;
}

}  // namespace furrow
