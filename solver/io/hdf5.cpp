#include "solver/io/hdf5.hpp"

#include <algorithm>
#include <atomic>
#include <functional>
#include <numeric>
#include <string_view>
#include <type_traits>
#include <utility>

namespace furrow::hdf5 {
namespace {

using Handle = Location::Handle;

/// Memory of a file under construction grows in steps of this size.
constexpr std::size_t image_increment = std::size_t{1} << 20;

Handle own(hid_t id, herr_t (*close)(hid_t)) {
  return Handle(new hid_t(id), [close](const hid_t* owned) {
    close(*owned);
    delete owned;
  });
}

/// HDF5 wants a name even for a file in memory, one that no file on disk has (nothing lies below /dev/null) and no other open
/// file: else it would take the two for the same.
std::string name_in_memory() {
  static std::atomic<unsigned long> count = 0;
  return "/dev/null/" + std::to_string(count++);
}

/// HDF5 reports a failed system call with its time, buffer address and sizes; a reader wants the system's own words.
std::string without_noise(std::string_view message) {
  constexpr std::string_view mark = "error message = '";
  const auto begin = message.find(mark);
  if (begin == std::string_view::npos) return std::string(message);
  const auto words = message.substr(begin + mark.size());
  return std::string(message.substr(0, message.find(':'))) + ": " + std::string(words.substr(0, words.find('\'')));
}

/// What HDF5 says about the last failed call: the call's own complaint, and the cause at the bottom of its error stack.
std::string library_error() {
  std::vector<std::string> messages;
  const auto collect = [](unsigned, const H5E_error2_t* error, void* list) -> herr_t {
    if (error->desc != nullptr) static_cast<std::vector<std::string>*>(list)->push_back(without_noise(error->desc));
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, collect, &messages);
  H5Eclear2(H5E_DEFAULT);
  if (messages.empty()) return "HDF5 gives no cause";
  return messages.size() == 1 ? messages.front() : messages.front() + ": " + messages.back();
}

/// Errors become exceptions; HDF5 must not print them as well.
void silence() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

Handle check_file(hid_t id, herr_t (*close)(hid_t), const std::filesystem::path& file, const std::string& action) {
  if (id < 0) throw FileError(file, "cannot " + action + ": " + library_error());
  return own(id, close);
}

void check_file(herr_t result, const std::filesystem::path& file, const std::string& action) {
  if (result < 0) throw FileError(file, "cannot " + action + ": " + library_error());
}

template <class T>
hid_t native_type() {
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
  if constexpr (std::is_same_v<T, std::int64_t>) return H5T_NATIVE_INT64;
  if constexpr (std::is_same_v<T, std::uint32_t>) return H5T_NATIVE_UINT32;
  if constexpr (std::is_same_v<T, std::uint64_t>) return H5T_NATIVE_UINT64;
  if constexpr (std::is_same_v<T, std::uint8_t>) return H5T_NATIVE_UINT8;
}

/// HDF5 has no text of length zero: an empty one is stored as a single null, which the padding rule reads back as empty.
std::size_t stored_length(const std::string& text) { return std::max<std::size_t>(text.size(), 1); }

std::string strip_padding(std::string text) {
  text.erase(text.find_last_not_of('\0') + 1);
  return text;
}

Handle text_type(std::size_t length) {
  const auto type = own(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(*type, length);
  H5Tset_strpad(*type, H5T_STR_NULLPAD);
  H5Tset_cset(*type, H5T_CSET_UTF8);
  return type;
}

/// Objects carry no time stamps, so that the same content gives the same bytes.
Handle creation_list(hid_t kind) {
  const auto list = own(H5Pcreate(kind), H5Pclose);
  H5Pset_obj_track_times(*list, false);
  return list;
}

/// Null inside a text would be taken for padding.
void refuse_null(const std::filesystem::path& file, const std::string& where, const std::string& text) {
  if (text.find('\0') != std::string::npos)
    throw FileError(file, "cannot store the text " + where + ": it contains a null character");
}

}  // namespace

Location::Location(Handle handle, std::filesystem::path file, std::string path)
    : handle_(std::move(handle)), file_(std::move(file)), path_(std::move(path)) {}

void Location::fail(const std::string& action) const { throw FileError(file_, "cannot " + action + ": " + library_error()); }

Location::Handle Location::check(hid_t result, herr_t (*close)(hid_t), const std::string& action) const {
  if (result < 0) fail(action);
  return own(result, close);
}

void Location::check(herr_t result, const std::string& action) const {
  if (result < 0) fail(action);
}

std::string Location::child(const std::string& name) const { return path_ == "/" ? "/" + name : path_ + "/" + name; }

void Location::set_attribute(const std::string& name, const std::string& text) {
  const std::string action = "write attribute '" + name + "' of " + path_;
  refuse_null(file_, "attribute '" + name + "' of " + path_, text);
  const auto type = text_type(stored_length(text));
  const auto space = check(H5Screate(H5S_SCALAR), H5Sclose, action);
  const auto attribute = check(H5Acreate2(id(), name.c_str(), *type, *space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, action);
  check(H5Awrite(*attribute, *type, text.c_str()), action);
}

void Location::set_attribute(const std::string& name, std::span<const std::int64_t> values) {
  const std::string action = "write attribute '" + name + "' of " + path_;
  const hsize_t count = values.size();
  const auto space = check(H5Screate_simple(1, &count, nullptr), H5Sclose, action);
  const auto attribute =
      check(H5Acreate2(id(), name.c_str(), H5T_STD_I64LE, *space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, action);
  check(H5Awrite(*attribute, H5T_NATIVE_INT64, values.data()), action);
}

void Location::set_attribute(const std::string& name, const std::vector<std::string>& texts) {
  const std::string action = "write attribute '" + name + "' of " + path_;
  std::size_t length = 1;
  for (const auto& text : texts) {
    refuse_null(file_, "attribute '" + name + "' of " + path_, text);
    length = std::max(length, text.size());
  }
  std::string padded;
  for (const auto& text : texts) padded += text + std::string(length - text.size(), '\0');
  const auto type = text_type(length);
  const hsize_t count = texts.size();
  const auto space = check(H5Screate_simple(1, &count, nullptr), H5Sclose, action);
  const auto attribute = check(H5Acreate2(id(), name.c_str(), *type, *space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, action);
  check(H5Awrite(*attribute, *type, padded.data()), action);
}

std::string Location::text_attribute(const std::string& name) const {
  const auto texts = texts_attribute(name);
  if (texts.size() != 1) throw FileError(file_, "attribute '" + name + "' of " + path_ + " is not one text");
  return texts.front();
}

std::vector<std::string> Location::texts_attribute(const std::string& name) const {
  const std::string action = "read attribute '" + name + "' of " + path_;
  const auto attribute = check(H5Aopen(id(), name.c_str(), H5P_DEFAULT), H5Aclose, action);
  const auto type = check(H5Aget_type(*attribute), H5Tclose, action);
  if (H5Tget_class(*type) != H5T_STRING || H5Tis_variable_str(*type) > 0)
    throw FileError(file_, "attribute '" + name + "' of " + path_ + " is not a text of fixed length");
  const auto space = check(H5Aget_space(*attribute), H5Sclose, action);
  const auto count = static_cast<std::size_t>(H5Sget_simple_extent_npoints(*space));
  const std::size_t length = H5Tget_size(*type);
  std::string padded(count * length, '\0');
  check(H5Aread(*attribute, *type, padded.data()), action);
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < count; ++i) texts.push_back(strip_padding(padded.substr(i * length, length)));
  return texts;
}

std::vector<std::int64_t> Location::integer_attribute(const std::string& name) const {
  const std::string action = "read attribute '" + name + "' of " + path_;
  const auto attribute = check(H5Aopen(id(), name.c_str(), H5P_DEFAULT), H5Aclose, action);
  const auto type = check(H5Aget_type(*attribute), H5Tclose, action);
  if (H5Tget_class(*type) != H5T_INTEGER) throw FileError(file_, "attribute '" + name + "' of " + path_ + " is not an integer");
  const auto space = check(H5Aget_space(*attribute), H5Sclose, action);
  std::vector<std::int64_t> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(*space)));
  check(H5Aread(*attribute, H5T_NATIVE_INT64, values.data()), action);
  return values;
}

std::vector<std::size_t> Dataset::extents() const {
  const auto space = check(H5Dget_space(id()), H5Sclose, "read the extents of " + path());
  const int rank = H5Sget_simple_extent_ndims(*space);
  if (rank < 0) fail("read the extents of " + path());
  std::vector<hsize_t> counts(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(*space, counts.data(), nullptr);
  return {counts.begin(), counts.end()};
}

template <class T>
bool Dataset::holds() const {
  const auto type = check(H5Dget_type(id()), H5Tclose, "read the type of " + path());
  return H5Tequal(*type, native_type<T>()) > 0;
}

template <class T>
std::vector<T> Dataset::read() const {
  if (!holds<T>()) throw FileError(file(), path() + " holds numbers of another type than the reader expects");
  const auto shape = extents();
  std::vector<T> values(std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>()));
  if (!values.empty())
    check(H5Dread(id(), native_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "read " + path());
  return values;
}

bool Dataset::holds_text() const {
  const auto type = check(H5Dget_type(id()), H5Tclose, "read the type of " + path());
  return H5Tget_class(*type) == H5T_STRING && H5Tis_variable_str(*type) == 0 && extents().empty();
}

std::string Dataset::read_text() const {
  if (!holds_text()) throw FileError(file(), path() + " is not a text of fixed length");
  const auto type = check(H5Dget_type(id()), H5Tclose, "read the type of " + path());
  std::string text(H5Tget_size(*type), '\0');
  check(H5Dread(id(), *type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), "read " + path());
  return strip_padding(std::move(text));
}

Group Group::create_group(const std::string& name) {
  const auto list = creation_list(H5P_GROUP_CREATE);
  return {check(H5Gcreate2(id(), name.c_str(), H5P_DEFAULT, *list, H5P_DEFAULT), H5Gclose, "create group " + child(name)), file(),
          child(name)};
}

Group Group::group(const std::string& name) const {
  return {check(H5Gopen2(id(), name.c_str(), H5P_DEFAULT), H5Gclose, "open group " + child(name)), file(), child(name)};
}

template <class T>
Dataset Group::write(const std::string& name, std::span<const T> values, const std::vector<std::size_t>& extents) {
  const std::string action = "write " + child(name);
  if (std::accumulate(extents.begin(), extents.end(), std::size_t{1}, std::multiplies<>()) != values.size())
    throw FileError(file(), "cannot " + action + ": its extents do not hold " + std::to_string(values.size()) + " values");
  const std::vector<hsize_t> counts(extents.begin(), extents.end());
  const auto space = check(counts.empty() ? H5Screate(H5S_SCALAR) :
                                            H5Screate_simple(static_cast<int>(counts.size()), counts.data(), nullptr),
                           H5Sclose, action);
  const auto list = creation_list(H5P_DATASET_CREATE);
  const auto dataset =
      check(H5Dcreate2(id(), name.c_str(), native_type<T>(), *space, H5P_DEFAULT, *list, H5P_DEFAULT), H5Dclose, action);
  if (!values.empty()) check(H5Dwrite(*dataset, native_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), action);
  return {dataset, file(), child(name)};
}

Dataset Group::write_text(const std::string& name, const std::string& text) {
  const std::string action = "write " + child(name);
  refuse_null(file(), child(name), text);
  const auto type = text_type(stored_length(text));
  const auto space = check(H5Screate(H5S_SCALAR), H5Sclose, action);
  const auto list = creation_list(H5P_DATASET_CREATE);
  const auto dataset = check(H5Dcreate2(id(), name.c_str(), *type, *space, H5P_DEFAULT, *list, H5P_DEFAULT), H5Dclose, action);
  check(H5Dwrite(*dataset, *type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()), action);
  return {dataset, file(), child(name)};
}

Dataset Group::dataset(const std::string& name) const {
  return {check(H5Dopen2(id(), name.c_str(), H5P_DEFAULT), H5Dclose, "open " + child(name)), file(), child(name)};
}

std::vector<std::string> Group::names() const {
  std::vector<std::string> found;
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  check(H5Literate(id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &found), "list " + path());
  return found;
}

Output::Output(std::filesystem::path file) : file_(std::move(file)) {
  silence();
  const auto access = check_file(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, file_, "prepare an HDF5 file");
  check_file(H5Pset_fapl_core(*access, image_increment, false), file_, "prepare an HDF5 file in memory");
  const auto list = creation_list(H5P_FILE_CREATE);
  handle_ = check_file(H5Fcreate(name_in_memory().c_str(), H5F_ACC_TRUNC, *list, *access), H5Fclose, file_,
                       "create an HDF5 file in memory");
  const auto root = check_file(H5Gopen2(*handle_, "/", H5P_DEFAULT), H5Gclose, file_, "open its root");
  root_ = std::make_unique<Group>(root, file_, "/");
}

std::vector<std::byte> Output::image() const {
  check_file(H5Fflush(*handle_, H5F_SCOPE_GLOBAL), file_, "complete the HDF5 file in memory");
  const ssize_t size = H5Fget_file_image(*handle_, nullptr, 0);
  check_file(size < 0 ? -1 : 0, file_, "find the size of the HDF5 file in memory");
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  check_file(H5Fget_file_image(*handle_, bytes.data(), bytes.size()) < 0 ? -1 : 0, file_, "copy the HDF5 file from memory");
  return bytes;
}

void Output::commit() const {
  const auto bytes = image();
  write_atomically(file_, {bytes});
}

Input::Input(const std::filesystem::path& file) : Input(file, read_bytes(file)) {}

Input::Input(std::filesystem::path file, std::span<const std::byte> image) {
  silence();
  if (image.empty()) throw FileError(file, "is empty, not an HDF5 file");
  const auto access = check_file(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, file, "prepare an HDF5 file");
  check_file(H5Pset_fapl_core(*access, image_increment, false), file, "prepare an HDF5 file in memory");
  // HDF5 copies the image and only reads the buffer it is given; its interface lacks the const.
  check_file(H5Pset_file_image(*access, const_cast<std::byte*>(image.data()), image.size()), file, "hand its bytes to HDF5");
  handle_ = check_file(H5Fopen(name_in_memory().c_str(), H5F_ACC_RDONLY, *access), H5Fclose, file, "open as HDF5");
  const auto root = check_file(H5Gopen2(*handle_, "/", H5P_DEFAULT), H5Gclose, file, "open its root");
  root_ = std::make_unique<const Group>(root, file, "/");
}

#define FURROW_HDF5_TYPE(T)                                                                                       \
  template bool Dataset::holds<T>() const;                                                                        \
  template std::vector<T> Dataset::read<T>() const;                                                               \
  template Dataset Group::write<T>(const std::string&, std::span<const T>, const std::vector<std::size_t>&);
FURROW_HDF5_TYPE(double)
FURROW_HDF5_TYPE(std::int32_t)
FURROW_HDF5_TYPE(std::int64_t)
FURROW_HDF5_TYPE(std::uint32_t)
FURROW_HDF5_TYPE(std::uint64_t)
FURROW_HDF5_TYPE(std::uint8_t)
#undef FURROW_HDF5_TYPE

}  // namespace furrow::hdf5
