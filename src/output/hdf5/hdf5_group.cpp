#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "case/memory.hpp"
#include "output/free_memory.hpp"
#include "output/hdf5/hdf5.hpp"
#include "output/hdf5/hdf5_chunks.hpp"
#include "output/hdf5/hdf5_parts.hpp"

namespace railwave::hdf5 {
namespace {

constexpr hsize_t largest_chunk = 65536;  // values: small enough for HDF5's chunk cache of 1 MiB

/// Fletcher32 takes a chunk of zeros for sound, which is what a file system leaves of a lost block; a zlib stream, even
/// one that is not compressed, it cannot be. Without compression all chunks of a dataset have one size, which those
/// that grow row by row need; what is written at once is compressed.
void add_checks(hid_t properties, bool compressed, const std::string& what) {
  if (H5Zfilter_avail(H5Z_FILTER_DEFLATE) > 0) {
    if (compressed) check(H5Pset_shuffle(properties), what);
    check(H5Pset_deflate(properties, compressed ? 1 : 0), what);
  }
  check(H5Pset_fletcher32(properties), what);
}

/// Chunks of rows, or of parts of one where rows are long.
Shape chunk_of(Shape shape) {
  const hsize_t row = std::max<hsize_t>(count_of(shape) / shape[0], 1);
  shape[0] = std::clamp<hsize_t>(largest_chunk / row, 1, shape[0]);
  if (shape.size() > 1 && row > largest_chunk) shape[1] = std::max<hsize_t>(1, largest_chunk / (row / shape[1]));
  return shape;
}

/// Gives a dataset that was just made its unit.
void set_unit(hid_t dataset, const std::string& unit, const std::string& what) {
  if (unit.empty()) return;
  const Handle space = space_of({}), type = text_type();
  const Handle attribute(check(H5Acreate2(dataset, "unit", type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT), what),
                         H5Aclose);
  const char* text = unit.c_str();
  check(H5Awrite(attribute.get(), type.get(), &text), what);
}

}  // namespace

Group Group::create_group(const std::string& name) const {
  if (extends_ && has(name)) return group(name);
  expect_free_memory();
  const hid_t id = H5Gcreate2(id_.get(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  return {Handle(check(id, "making group " + name_ + name), H5Gclose), name_ + name + "/", extends_, threads_};
}

Group Group::group(const std::string& name) const {
  expect_free_memory();
  const LimitedCall limited;
  return {Handle(check(H5Gopen2(id_.get(), name.c_str(), H5P_DEFAULT), "opening group " + name_ + name), H5Gclose),
          name_ + name + "/", extends_, threads_};
}

Dataset Group::dataset(const std::string& name) const {
  expect_free_memory();
  const LimitedCall limited;
  return {Handle(check(H5Dopen2(id_.get(), name.c_str(), H5P_DEFAULT), "opening " + name_ + name), H5Dclose),
          name_ + name, threads_};
}

bool Group::has(const std::string& name) const {
  expect_free_memory();
  const LimitedCall limited;
  return check(H5Lexists(id_.get(), name.c_str(), H5P_DEFAULT), "looking for " + name_ + name) > 0;
}

std::vector<std::string> Group::names() const {
  const LimitedCall limited;
  std::vector<std::string> result;
  const H5L_iterate_t visit = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    try {
      static_cast<std::vector<std::string>*>(list)->push_back(name);
    } catch (const std::exception&) {
      return -1;  // HDF5 is C: nothing may be thrown through it
    }
    return 0;
  };
  expect_free_memory();
  check(H5Literate(id_.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, visit, &result), "listing " + name_);
  return result;
}

template <class T>
Dataset Group::create_growing(const std::string& name, const Shape& row, const Storage& storage) const {
  const std::string what = "making " + name_ + name;
  if (extends_ && has(name)) {
    Dataset there = dataset(name);
    Shape found = there.shape();
    if (found.empty() || !std::equal(found.begin() + 1, found.end(), row.begin(), row.end()))
      throw std::runtime_error("extending " + name_ + name + ": it is there with another shape");
    there.find_layout();
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
  expect_free_memory();
  const Handle space(check(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), limit.data()), what),
                     H5Sclose);
  const Handle properties(check(H5Pcreate(H5P_DATASET_CREATE), what), H5Pclose);
  check(H5Pset_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data()), what);
  if constexpr (std::is_floating_point_v<T>) {
    // What a kill in the middle of a flush may have left out then reads as not-a-number, not as zero.
    const double nothing = std::nan("");
    check(H5Pset_fill_value(properties.get(), H5T_NATIVE_DOUBLE, &nothing), what);
  }
  add_checks(properties.get(), storage.compressed, what);
  const hid_t id =
      H5Dcreate2(id_.get(), name.c_str(), native_type<T>(), space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT);
  Handle made(check(id, what), H5Dclose);
  set_unit(id, unit_of(name_ + name), what);
  Dataset dataset(std::move(made), name_ + name, threads_);
  dataset.find_layout();
  return dataset;
}

template <class T>
void Group::write(const std::string& name, const std::vector<T>& values, const Shape& shape, const std::string& unit,
                  Check by) const {
  const std::string what = "writing " + name_ + name;
  if (values.size() != count_of(shape))
    throw std::logic_error(what + ": the number of values is not that of the shape");
  if (extends_ && has(name)) {
    if (dataset(name).shape() != shape) throw std::runtime_error(what + ": it is there with another shape");
    return;
  }
  expect_free_memory();
  const Handle space = space_of(shape), properties(check(H5Pcreate(H5P_DATASET_CREATE), what), H5Pclose);
  if (by == Check::by_chunk && !values.empty() && !shape.empty()) {
    const Shape chunk = chunk_of(shape);
    check(H5Pset_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data()), what);
    add_checks(properties.get(), true, what);
  }
  const hid_t id =
      H5Dcreate2(id_.get(), name.c_str(), native_type<T>(), space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT);
  const Handle dataset(check(id, what), H5Dclose);
  set_unit(id, unit.empty() ? unit_of(name_ + name) : unit, what);
  if (values.empty() || write_chunks(id, name_ + name, 0, shape, values.data(), threads_)) return;
  check(H5Dwrite(id, native_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), what);
}

template <class Do>
void Group::each_growing(const Do& one, bool with_near_nodes) const {
  for (const std::string& name : names()) {
    if (name == near_nodes && !with_near_nodes) continue;
    expect_free_memory();
    const Handle id(check(H5Oopen(id_.get(), name.c_str(), H5P_DEFAULT), "opening " + name_ + name), H5Oclose);
    const H5I_type_t type = H5Iget_type(id.get());
    if (type == H5I_GROUP) group(name).each_growing(one, with_near_nodes);
    if (type != H5I_DATASET) continue;
    const Handle space = file_space(id.get(), name_ + name);
    Shape extent(check(H5Sget_simple_extent_ndims(space.get()), "asking for the shape of " + name_ + name)),
        most = extent;
    if (extent.empty()) continue;
    check(H5Sget_simple_extent_dims(space.get(), extent.data(), most.data()),
          "asking for the shape of " + name_ + name);
    if (most[0] == H5S_UNLIMITED) one(id.get(), extent, name_ + name);
  }
}

std::optional<hsize_t> Group::least_entries() const {
  std::optional<hsize_t> least;
  each_growing(
      [&](hid_t, const Shape& extent, const std::string&) { least = std::min(least.value_or(extent[0]), extent[0]); },
      false);
  return least;
}

void Group::cut(hsize_t entries) const {
  cut_near_nodes(entries);
  each_growing(
      [&](hid_t id, Shape extent, const std::string& name) {
        if (extent[0] == entries) return;
        if (extent[0] < entries) throw std::runtime_error("cutting " + name + ": it has fewer entries");
        extent[0] = entries;
        expect_free_memory();
        check(H5Dset_extent(id, extent.data()), "cutting " + name);
      },
      false);
}

void Group::cut_near_nodes(hsize_t outputs) const {
  for (const std::string& name : names()) {
    if (name == near_nodes) {
      const std::vector<long> rows = dataset("rows").read<long>();
      if (rows.size() < outputs) throw std::runtime_error("cutting " + name_ + name + ": it has fewer outputs");
      group(name).cut(outputs == 0 ? 0 : static_cast<hsize_t>(rows[outputs - 1]));
      continue;
    }
    expect_free_memory();
    const Handle id(check(H5Oopen(id_.get(), name.c_str(), H5P_DEFAULT), "opening " + name_ + name), H5Oclose);
    if (H5Iget_type(id.get()) == H5I_GROUP) group(name).cut_near_nodes(outputs);
  }
}

void Group::check_last() const {
  const LimitedCall limited;
  const H5A_operator2_t visit = [](hid_t, const char*, const H5A_info_t*, void*) -> herr_t { return 0; };
  check(H5Aiterate2(id_.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, visit, nullptr),
        "reading the attributes of " + name_);
  each_growing(
      [&](hid_t id, Shape extent, const std::string& name) {
        if (count_of(extent) == 0) return;
        Shape start(extent.size(), 0);
        start[0] = extent[0] - 1;
        extent[0] = 1;
        const Handle space = file_space(id, name);
        check(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr),
              "reading " + name);
        const Handle memory = space_of(extent), type(check(H5Dget_type(id), "reading " + name), H5Tclose);
        const double bytes = static_cast<double>(count_of(extent)) * static_cast<double>(H5Tget_size(type.get()));
        expect_memory(bytes, name + ": has rows that need", "see whether the file is whole");
        std::vector<char> row(static_cast<std::size_t>(bytes));
        check(H5Dread(id, type.get(), memory.get(), space.get(), H5P_DEFAULT, row.data()), "reading " + name);
      },
      true);
}

#define RAILWAVE_FOR_TYPE(T)                                                                                        \
  template Dataset Group::create_growing<T>(const std::string&, const Shape&, const Storage&) const;                \
  template void Group::write<T>(const std::string&, const std::vector<T>&, const Shape&, const std::string&, Check) \
      const;

RAILWAVE_EACH_VALUE_TYPE(RAILWAVE_FOR_TYPE)
#undef RAILWAVE_FOR_TYPE

}  // namespace railwave::hdf5
