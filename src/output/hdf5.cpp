#include "output/hdf5.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <type_traits>

#include "case/memory.hpp"

namespace railwave::hdf5 {
namespace {

herr_t keep_first_description(unsigned, const H5E_error2_t* entry, void* text) {
  auto& reason = *static_cast<std::string*>(text);
  if (reason.empty() && entry->desc) reason = entry->desc;
  return 0;
}

/// The most specific entry of HDF5's error stack.
std::string reason() {
  std::string text;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first_description, &text);
  H5Eclear2(H5E_DEFAULT);
  return text.empty() ? "HDF5 gives no reason" : text;
}

template <class Result>
Result check(Result result, const std::string& what) {
  if (result < 0) throw std::runtime_error(what + ": " + reason());
  return result;
}

/// At the program's exit HDF5 would try once more to write what a full disk has refused, and crash. It heeds this only before
/// anything else; all that we open we close.
void stay_out_of_exit() {
  static const herr_t said = H5dont_atexit();
  static_cast<void>(said);
}

template <class T>
hid_t native_type() {
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  else if constexpr (std::is_same_v<T, int>) return H5T_NATIVE_INT;
  else if constexpr (std::is_same_v<T, long>) return H5T_NATIVE_LONG;
  else return H5T_NATIVE_SCHAR;
}

Handle text_type() {
  Handle type(check(H5Tcopy(H5T_C_S1), "making a text type"), H5Tclose);
  check(H5Tset_size(type.get(), H5T_VARIABLE), "making a text type");
  check(H5Tset_cset(type.get(), H5T_CSET_UTF8), "making a text type");
  return type;
}

Handle file_space(hid_t dataset, const std::string& name) {
  return {check(H5Dget_space(dataset), "asking for the shape of " + name), H5Sclose};
}

Handle space_of(const Shape& shape) {
  const hid_t id = shape.empty() ? H5Screate(H5S_SCALAR) : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
  return {check(id, "describing a shape"), H5Sclose};
}

hsize_t count_of(const Shape& shape) {
  hsize_t count = 1;
  for (const hsize_t extent : shape) count *= extent;
  return count;
}

}  // namespace

void be_quiet() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

Handle& Handle::operator=(Handle&& other) noexcept {
  if (this != &other) {
    close();
    id_ = std::exchange(other.id_, -1);
    closer_ = other.closer_;
  }
  return *this;
}

void Handle::close() noexcept {
  if (id_ >= 0) closer_(id_);
  id_ = -1;
}

Shape Dataset::shape() const {
  const Handle space = file_space(id_.get(), name_);
  Shape result(check(H5Sget_simple_extent_ndims(space.get()), "asking for the shape of " + name_));
  if (!result.empty()) check(H5Sget_simple_extent_dims(space.get(), result.data(), nullptr), "asking for the shape of " + name_);
  return result;
}

template <class T>
void Dataset::append(const T* rows, hsize_t count) {
  if (count == 0) return;
  Shape extent = shape(), start(extent.size(), 0), block = extent;
  start[0] = extent[0];
  block[0] = count;
  extent[0] += count;
  check(H5Dset_extent(id_.get(), extent.data()), "extending " + name_);
  if (count_of(block) == 0) return;  // a set without entries still counts its times
  const Handle space = file_space(id_.get(), name_);
  check(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr), "extending " + name_);
  const Handle memory = space_of(block);
  check(H5Dwrite(id_.get(), native_type<T>(), memory.get(), space.get(), H5P_DEFAULT, rows), "writing " + name_);
}

template <class T>
std::vector<T> Dataset::read() const {
  const hsize_t count = count_of(shape());
  // A damaged file may claim anything.
  expect_memory(static_cast<double>(count) * sizeof(T), name_ + ": has " + std::to_string(count) + " values, which need", "see whether the file is whole");
  std::vector<T> values(count);
  if (values.empty()) return values;
  check(H5Dread(id_.get(), native_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "reading " + name_);
  return values;
}

template <class T>
std::vector<T> Dataset::read_row(hsize_t row) const {
  Shape block = shape();
  if (block.empty() || row >= block[0]) throw std::runtime_error("reading " + name_ + ": it has no entry " + std::to_string(row));
  Shape start(block.size(), 0);
  start[0] = row;
  block[0] = 1;
  std::vector<T> values(count_of(block));
  if (values.empty()) return values;
  const Handle space = file_space(id_.get(), name_);
  check(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr), "reading " + name_);
  const Handle memory = space_of(block);
  check(H5Dread(id_.get(), native_type<T>(), memory.get(), space.get(), H5P_DEFAULT, values.data()), "reading " + name_);
  return values;
}

Group Group::create_group(const std::string& name) const {
  if (extends_ && has(name)) return group(name);
  const hid_t id = H5Gcreate2(id_.get(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  return {Handle(check(id, "making group " + name_ + name), H5Gclose), name_ + name + "/", extends_};
}

Group Group::group(const std::string& name) const {
  return {Handle(check(H5Gopen2(id_.get(), name.c_str(), H5P_DEFAULT), "opening group " + name_ + name), H5Gclose), name_ + name + "/", extends_};
}

Dataset Group::dataset(const std::string& name) const {
  return {Handle(check(H5Dopen2(id_.get(), name.c_str(), H5P_DEFAULT), "opening " + name_ + name), H5Dclose), name_ + name};
}

bool Group::has(const std::string& name) const { return check(H5Lexists(id_.get(), name.c_str(), H5P_DEFAULT), "looking for " + name_ + name) > 0; }

std::vector<std::string> Group::names() const {
  std::vector<std::string> result;
  const H5L_iterate_t visit = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->push_back(name);
    return 0;
  };
  check(H5Literate(id_.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, visit, &result), "listing " + name_);
  return result;
}

template <class T>
Dataset Group::create_growing(const std::string& name, const Shape& row, const Storage& storage) const {
  constexpr hsize_t largest_chunk = 65536;  // values: small enough for HDF5's chunk cache of 1 MiB
  const std::string what = "making " + name_ + name;
  if (extends_ && has(name)) {
    Dataset there = dataset(name);
    Shape found = there.shape();
    if (found.empty() || !std::equal(found.begin() + 1, found.end(), row.begin(), row.end()))
      throw std::runtime_error("extending " + name_ + name + ": it is there with another shape");
    return there;
  }
  Shape extent{0}, limit{H5S_UNLIMITED}, chunk{storage.rows_in_chunk};
  for (const hsize_t length : row) {
    extent.push_back(length);
    limit.push_back(length);
    chunk.push_back(std::max<hsize_t>(length, 1));
  }
  if (chunk.size() > 1) {
    const hsize_t values_of_one_entry = std::max<hsize_t>(count_of(chunk) / chunk[1], 1);
    chunk[1] = std::max<hsize_t>(1, std::min(chunk[1], largest_chunk / values_of_one_entry));
    if (row[0] == 0) limit[1] = 1;  // HDF5 wants room for a chunk
  }
  const Handle space(check(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), limit.data()), what), H5Sclose);
  const Handle properties(check(H5Pcreate(H5P_DATASET_CREATE), what), H5Pclose);
  check(H5Pset_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data()), what);
  if constexpr (std::is_same_v<T, double>) {
    // What a kill in the middle of a flush may have left out then reads as not-a-number, not as zero.
    const double nothing = std::nan("");
    check(H5Pset_fill_value(properties.get(), H5T_NATIVE_DOUBLE, &nothing), what);
  }
  if (storage.compressed && H5Zfilter_avail(H5Z_FILTER_DEFLATE) > 0) {
    check(H5Pset_shuffle(properties.get()), what);
    check(H5Pset_deflate(properties.get(), 1), what);
  }
  const hid_t id = H5Dcreate2(id_.get(), name.c_str(), native_type<T>(), space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT);
  return {Handle(check(id, what), H5Dclose), name_ + name};
}

template <class T>
void Group::write(const std::string& name, const std::vector<T>& values, const Shape& shape) const {
  const std::string what = "writing " + name_ + name;
  if (values.size() != count_of(shape)) throw std::logic_error(what + ": the number of values is not that of the shape");
  if (extends_ && has(name)) {
    if (dataset(name).shape() != shape) throw std::runtime_error(what + ": it is there with another shape");
    return;
  }
  const Handle space = space_of(shape);
  const hid_t id = H5Dcreate2(id_.get(), name.c_str(), native_type<T>(), space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  const Handle dataset(check(id, what), H5Dclose);
  if (!values.empty()) check(H5Dwrite(id, native_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), what);
}

template <class Do>
void Group::each_growing(const Do& one) const {
  for (const std::string& name : names()) {
    const Handle id(check(H5Oopen(id_.get(), name.c_str(), H5P_DEFAULT), "opening " + name_ + name), H5Oclose);
    const H5I_type_t type = H5Iget_type(id.get());
    if (type == H5I_GROUP) group(name).each_growing(one);
    if (type != H5I_DATASET) continue;
    const Handle space = file_space(id.get(), name_ + name);
    Shape extent(check(H5Sget_simple_extent_ndims(space.get()), "asking for the shape of " + name_ + name)), most = extent;
    if (extent.empty()) continue;
    check(H5Sget_simple_extent_dims(space.get(), extent.data(), most.data()), "asking for the shape of " + name_ + name);
    if (most[0] == H5S_UNLIMITED) one(id.get(), extent, name_ + name);
  }
}

std::optional<hsize_t> Group::least_entries() const {
  std::optional<hsize_t> least;
  each_growing([&](hid_t, const Shape& extent, const std::string&) { least = std::min(least.value_or(extent[0]), extent[0]); });
  return least;
}

void Group::cut(hsize_t entries) const {
  each_growing([&](hid_t id, Shape extent, const std::string& name) {
    if (extent[0] == entries) return;
    if (extent[0] < entries) throw std::runtime_error("cutting " + name + ": it has fewer entries");
    extent[0] = entries;
    check(H5Dset_extent(id, extent.data()), "cutting " + name);
  });
}

Handle Group::new_attribute(const std::string& name, hid_t type, hid_t space) const {
  const std::string what = "writing attribute " + name + " of " + name_;
  if (check(H5Aexists(id_.get(), name.c_str()), what) > 0) {
    Handle there(check(H5Aopen(id_.get(), name.c_str(), H5P_DEFAULT), what), H5Aclose);
    const Handle its_type(check(H5Aget_type(there.get()), what), H5Tclose), its_space(check(H5Aget_space(there.get()), what), H5Sclose);
    // In its place, so that a kill in the middle of a flush does not find it taken away and not yet put back.
    if (H5Tequal(its_type.get(), type) > 0 && H5Sextent_equal(its_space.get(), space) > 0) return there;
    there.close();
    check(H5Adelete(id_.get(), name.c_str()), what);
  }
  return {check(H5Acreate2(id_.get(), name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), what), H5Aclose};
}

void Group::set_attribute(const std::string& name, double value) const {
  const Handle space = space_of({});
  const Handle attribute = new_attribute(name, H5T_NATIVE_DOUBLE, space.get());
  check(H5Awrite(attribute.get(), H5T_NATIVE_DOUBLE, &value), "writing attribute " + name);
}

void Group::set_attribute(const std::string& name, long value) const {
  const Handle space = space_of({});
  const Handle attribute = new_attribute(name, H5T_NATIVE_LONG, space.get());
  check(H5Awrite(attribute.get(), H5T_NATIVE_LONG, &value), "writing attribute " + name);
}

void Group::set_attribute(const std::string& name, const std::string& value) const {
  const Handle space = space_of({}), type = text_type();
  const Handle attribute = new_attribute(name, type.get(), space.get());
  const char* text = value.c_str();
  check(H5Awrite(attribute.get(), type.get(), &text), "writing attribute " + name);
}

void Group::set_attribute(const std::string& name, const std::vector<std::string>& values) const {
  const Handle space = space_of({values.size()}), type = text_type();
  const Handle attribute = new_attribute(name, type.get(), space.get());
  if (values.empty()) return;
  std::vector<const char*> texts;
  for (const auto& value : values) texts.push_back(value.c_str());
  check(H5Awrite(attribute.get(), type.get(), texts.data()), "writing attribute " + name);
}

bool Group::has_attribute(const std::string& name) const { return check(H5Aexists(id_.get(), name.c_str()), "looking for attribute " + name) > 0; }

double Group::number_attribute(const std::string& name) const {
  const std::string what = "reading attribute " + name + " of " + name_;
  const Handle attribute(check(H5Aopen(id_.get(), name.c_str(), H5P_DEFAULT), what), H5Aclose);
  const Handle space(check(H5Aget_space(attribute.get()), what), H5Sclose);
  if (H5Sget_simple_extent_npoints(space.get()) != 1) throw std::runtime_error(what + ": it is not one number");
  double value = 0;
  check(H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, &value), what);
  return value;
}

std::string Group::text_attribute(const std::string& name) const {
  const std::string what = "reading attribute " + name + " of " + name_;
  const Handle attribute(check(H5Aopen(id_.get(), name.c_str(), H5P_DEFAULT), what), H5Aclose);
  const Handle stored(check(H5Aget_type(attribute.get()), what), H5Tclose);
  const Handle space(check(H5Aget_space(attribute.get()), what), H5Sclose);
  if (H5Tis_variable_str(stored.get()) <= 0 || H5Sget_simple_extent_npoints(space.get()) != 1)
    throw std::runtime_error(what + ": it is not a text");
  const Handle type = text_type();
  char* text = nullptr;
  check(H5Aread(attribute.get(), type.get(), &text), what);
  const std::string value = text ? text : "";
  H5free_memory(text);
  return value;
}

namespace {

/// Between two flushes only array data reach the disk.
Handle access_without_eviction(const std::string& what) {
  Handle access(check(H5Pcreate(H5P_FILE_ACCESS), what), H5Pclose);
  H5AC_cache_config_t cache;
  cache.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  check(H5Pget_mdc_config(access.get(), &cache), what);
  cache.evictions_enabled = false;  // and then HDF5 wants no automatic resizing either
  cache.incr_mode = H5C_incr__off;
  cache.flash_incr_mode = H5C_flash_incr__off;
  cache.decr_mode = H5C_decr__off;
  check(H5Pset_mdc_config(access.get(), &cache), what);
  return access;
}

/// A killed program may have left a file that is shorter or longer than its superblock says: HDF5 refuses the one, and what
/// its structure says of the other's end is out of reach. The superblock of version 0 says it in eight bytes.
void mend_length(const std::string& path) {
  constexpr unsigned char begins[9] = {0x89, 'H', 'D', 'F', 13, 10, 0x1a, 10, 0};
  constexpr long place_of_length = 40;
  const auto fail = [&] { throw std::runtime_error("mending " + path + ": " + std::strerror(errno)); };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "r+b"), std::fclose);
  if (!file) fail();
  unsigned char head[place_of_length + 8];
  if (std::fread(head, 1, sizeof head, file.get()) != sizeof head || std::memcmp(head, begins, sizeof begins) != 0 || head[13] != 8) return;
  std::uint64_t said = 0;
  for (int k = 7; k >= 0; --k) said = said << 8 | head[place_of_length + k];
  if (std::fseek(file.get(), 0, SEEK_END) != 0) fail();
  const auto length = static_cast<std::uint64_t>(std::ftell(file.get()));
  if (length == said) return;
  if (length < said) {
    if (said - length > (std::uint64_t{1} << 32) || truncate(path.c_str(), static_cast<off_t>(said)) != 0) fail();
    return;
  }
  unsigned char bytes[8];
  for (int k = 0; k < 8; ++k) bytes[k] = static_cast<unsigned char>(length >> 8 * k);
  if (std::fseek(file.get(), place_of_length, SEEK_SET) != 0 || std::fwrite(bytes, 1, 8, file.get()) != 8 || std::fflush(file.get()) != 0) fail();
}

}  // namespace

File File::create(const std::string& path) {
  stay_out_of_exit();
  be_quiet();
  const std::string what = "making results file " + path;
  const Handle access = access_without_eviction(what);
  return {Handle(check(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), what), H5Fclose), path};
}

File File::open(const std::string& path) {
  stay_out_of_exit();
  be_quiet();
  return {Handle(check(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "opening " + path), H5Fclose), path};
}

File File::extend(const std::string& path) {
  stay_out_of_exit();
  be_quiet();
  mend_length(path);
  const std::string what = "opening " + path;
  const Handle access = access_without_eviction(what);
  return {Handle(check(H5Fopen(path.c_str(), H5F_ACC_RDWR, access.get()), what), H5Fclose), path, true};
}

Group File::root() const { return {Handle(check(H5Gopen2(id_.get(), "/", H5P_DEFAULT), "opening " + path_), H5Gclose), "/", extends_}; }

void File::flush() const { check(H5Fflush(id_.get(), H5F_SCOPE_GLOBAL), "writing " + path_); }

void File::close() {
  if (!is_open()) return;
  flush();
  id_.close();
}

void bring_to_disk(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool done = file >= 0 && fsync(file) == 0;
  const std::string reason = std::strerror(errno);
  if (file >= 0) close(file);
  if (!done) throw std::runtime_error("writing " + path + ": " + reason);
}

#define RAILWAVE_FOR_TYPE(T)                                                                          \
  template void Dataset::append<T>(const T*, hsize_t);                                                \
  template std::vector<T> Dataset::read<T>() const;                                                   \
  template std::vector<T> Dataset::read_row<T>(hsize_t) const;                                        \
  template Dataset Group::create_growing<T>(const std::string&, const Shape&, const Storage&) const;  \
  template void Group::write<T>(const std::string&, const std::vector<T>&, const Shape&) const;

RAILWAVE_FOR_TYPE(double)
RAILWAVE_FOR_TYPE(int)
RAILWAVE_FOR_TYPE(long)
RAILWAVE_FOR_TYPE(signed char)

}  // namespace railwave::hdf5
