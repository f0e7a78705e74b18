#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "case/memory.hpp"
#include "output/free_memory.hpp"
#include "output/hdf5/hdf5.hpp"
#include "output/hdf5/hdf5_chunks.hpp"
#include "output/hdf5/hdf5_parts.hpp"

namespace railwave::hdf5 {
namespace {

/// A damaged file may claim anything.
void expect_claimed_memory(const Shape& shape, std::size_t size, const std::string& name) {
  double values = 1;
  for (const hsize_t extent : shape) values *= static_cast<double>(extent);
  expect_memory(values * static_cast<double>(size), fmt::format("{}: has {:.0f} values, which need", name, values),
                "see whether the file is whole");
}

}  // namespace

Shape Dataset::shape() const {
  expect_free_memory();
  return extent();
}

bool Dataset::is_single() const {
  expect_free_memory();
  const LimitedCall limited;
  const Handle type(check(H5Dget_type(id_.get()), "asking for the type of " + name_), H5Tclose);
  return H5Tget_class(type.get()) == H5T_FLOAT && H5Tget_size(type.get()) == sizeof(float);
}

Shape Dataset::extent() const {
  const Handle space = file_space(id_.get(), name_);
  Shape result(check(H5Sget_simple_extent_ndims(space.get()), "asking for the shape of " + name_));
  if (!result.empty())
    check(H5Sget_simple_extent_dims(space.get(), result.data(), nullptr), "asking for the shape of " + name_);
  return result;
}

template <class T>
void Dataset::append(const T* rows, hsize_t count) {
  if (count == 0) return;
  expect_free_memory();
  Shape whole = extent(), start(whole.size(), 0), block = whole;
  start[0] = whole[0];
  block[0] = count;
  whole[0] += count;
  check(H5Dset_extent(id_.get(), whole.data()), "extending " + name_);
  if (count_of(block) == 0) return;  // a set without entries still counts its times
  if (write_chunks(id_.get(), name_, start[0], block, rows, threads_)) return;
  const Handle space = file_space(id_.get(), name_);
  check(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr),
        "extending " + name_);
  const Handle memory = space_of(block);
  check(H5Dwrite(id_.get(), native_type<T>(), memory.get(), space.get(), H5P_DEFAULT, rows), "writing " + name_);
}

void Dataset::find_layout() {
  if (threads_) layout_ = row_layout(id_.get(), name_);
}

PackedRow Dataset::pack(const double* row) const { return layout_ ? pack_row(*layout_, row) : PackedRow(); }

void Dataset::append(const PackedRow& row) {
  expect_free_memory();
  Shape whole = extent(), start(whole.size(), 0);
  start[0] = whole[0]++;
  check(H5Dset_extent(id_.get(), whole.data()), "extending " + name_);
  write_chunk(id_.get(), name_, start, row.data(), row.size());
}

template <class T>
std::vector<T> Dataset::read() const {
  const LimitedCall limited;
  const Shape extent = shape();
  expect_claimed_memory(extent, sizeof(T), name_);
  std::vector<T> values(count_of(extent));
  if (values.empty()) return values;
  expect_free_memory();
  check(H5Dread(id_.get(), native_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "reading " + name_);
  return values;
}

template <class T>
std::vector<T> Dataset::read_row(hsize_t row) const {
  return read_rows<T>(row, 1);
}

template <class T>
std::vector<T> Dataset::read_rows(hsize_t row, hsize_t count) const {
  const LimitedCall limited;
  Shape block = shape();
  if (block.empty() || row > block[0] || count > block[0] - row)
    throw std::runtime_error("reading " + name_ + ": it has no entry " + std::to_string(row + count - 1));
  Shape start(block.size(), 0);
  start[0] = row;
  block[0] = count;
  expect_claimed_memory(block, sizeof(T), name_);
  std::vector<T> values(count_of(block));
  if (values.empty()) return values;
  expect_free_memory();
  const Handle space = file_space(id_.get(), name_);
  check(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr),
        "reading " + name_);
  const Handle memory = space_of(block);
  check(H5Dread(id_.get(), native_type<T>(), memory.get(), space.get(), H5P_DEFAULT, values.data()),
        "reading " + name_);
  return values;
}

#define RAILWAVE_FOR_TYPE(T)                                   \
  template void Dataset::append<T>(const T*, hsize_t);         \
  template std::vector<T> Dataset::read<T>() const;            \
  template std::vector<T> Dataset::read_row<T>(hsize_t) const; \
  template std::vector<T> Dataset::read_rows<T>(hsize_t, hsize_t) const;

RAILWAVE_EACH_VALUE_TYPE(RAILWAVE_FOR_TYPE)
#undef RAILWAVE_FOR_TYPE

}  // namespace railwave::hdf5
