// Arrays that several threads compress: the file has the very chunks that HDF5's own filters make, and HDF5 reads them.

#include <hdf5.h>

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "output/fields/compressed_rows.hpp"
#include "output/file_kind.hpp"
#include "output/hdf5/hdf5.hpp"
#include "output/hdf5/hdf5_chunks.hpp"
#include "tests/output/full_disk.hpp"
#include "tests/temporary_folder.hpp"

#if defined(RAILWAVE_ZLIB) && H5_VERSION_GE(1, 10, 3)

using namespace railwave;
using Catch::Matchers::ContainsSubstring;

namespace {

/// Smooth in the first half, noise in the second, and a gap of zeros between.
template <class T>
std::vector<T> made_up_values(hsize_t count, unsigned seed) {
  std::vector<T> values(count);
  std::uint32_t noise = seed;
  for (hsize_t i = 0; i < count; ++i) {
    noise = 1664525u * noise + 1013904223u;
    if (i < count * 2 / 5)
      values[i] = static_cast<T>(60 + 60 * std::sin(1e-3 * static_cast<double>(i) + seed));
    else if (i > count / 2)
      values[i] = static_cast<T>(1e-8 * noise);
  }
  return values;
}

hsize_t count_of(const hdf5::Shape& shape) {
  hsize_t count = 1;
  for (const hsize_t extent : shape) count *= extent;
  return count;
}

/// Counts how often it was asked; more threads come in the middle of an array.
struct Asked {
  int times = 0;
  hdf5::ThreadCount threads() {
    return [this] { return ++times < 3 ? 1 : 4; };
  }
};

/// Bytes of each chunk as they are in the file.
std::vector<std::vector<unsigned char>> raw_chunks(const std::string& path, const std::string& name) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t dataset = H5Dopen2(file, name.c_str(), H5P_DEFAULT), space = H5Dget_space(dataset);
  const hid_t properties = H5Dget_create_plist(dataset);
  hdf5::Shape extent(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, extent.data(), nullptr);
  std::vector<std::vector<unsigned char>> chunks;
  if (H5Pget_layout(properties) == H5D_CHUNKED && count_of(extent) > 0) {
    hdf5::Shape chunk(extent.size()), offset(extent.size(), 0);
    H5Pget_chunk(properties, static_cast<int>(chunk.size()), chunk.data());
    while (offset[0] < extent[0]) {
      hsize_t size = 0;
      REQUIRE(H5Dget_chunk_storage_size(dataset, offset.data(), &size) >= 0);
      std::uint32_t left_out = 0;
      auto& bytes = chunks.emplace_back(size);
      REQUIRE(H5Dread_chunk(dataset, H5P_DEFAULT, offset.data(), &left_out, bytes.data()) >= 0);
      CHECK(left_out == 0);
      for (std::size_t d = extent.size(); d-- > 0;) {
        offset[d] += chunk[d];
        if (offset[d] < extent[d] || d == 0) break;
        offset[d] = 0;
      }
    }
  }
  H5Pclose(properties);
  H5Sclose(space);
  H5Dclose(dataset);
  H5Fclose(file);
  return chunks;
}

/// What write(group) makes of "values", by several threads and by HDF5 alone.
/// @return how often was asked for the number of threads
template <class Write>
int check_same_chunks(const Write& write) {
  const TemporaryFolder folder;
  const std::string by_threads = folder / "threads.h5", by_hdf5 = folder / "hdf5.h5";
  Asked asked;
  for (const std::string& path : {by_threads, by_hdf5}) {
    hdf5::File file = hdf5::File::create(path, kinds::results());
    if (path == by_threads) file.compress_on(asked.threads());
    write(file.root());
    file.close();
  }
  const auto chunks = raw_chunks(by_threads, "values");
  CHECK(chunks == raw_chunks(by_hdf5, "values"));
  CHECK((asked.times == 0 || chunks.size() >= 2));
  return asked.times;
}

/// Rows one by one, then read back by HDF5, which checks their sums.
template <class T, class Given = T>
int check_rows(const hdf5::Shape& row, int rows = 2) {
  return check_same_chunks([&](const hdf5::Group& group) {
    hdf5::Dataset dataset = group.create_growing<T>("values", row, {1, true});
    std::vector<T> wanted;
    for (int r = 0; r < rows; ++r) {
      const std::vector<Given> values = made_up_values<Given>(count_of(row), 7u + static_cast<unsigned>(r));
      dataset.append(values.data(), 1);
      for (const Given value : values) wanted.push_back(static_cast<T>(value));
    }
    CHECK(dataset.read<T>() == wanted);
  });
}

template <class T>
int check_whole(const hdf5::Shape& shape) {
  return check_same_chunks([&](const hdf5::Group& group) {
    const std::vector<T> values = made_up_values<T>(count_of(shape), 3);
    group.write("values", values, shape);
    CHECK(group.dataset("values").read<T>() == values);
  });
}

}  // namespace

TEST_CASE("arrays that grow have HDF5's own chunks") {
  CHECK(check_rows<double>({300001}) > 0);
  CHECK(check_rows<double>({262144}) > 0);
  CHECK(check_rows<double>({50001, 6}) > 0);
  CHECK(check_rows<float>({50001, 6}) > 0);
  CHECK(check_rows<float, double>({50001, 6}) > 0);
  CHECK(check_rows<int>({300001}) > 0);
  CHECK(check_rows<long>({200001}) > 0);
  CHECK(check_rows<signed char>({300001}) > 0);
  CHECK(check_rows<unsigned char>({300001}) > 0);
  CHECK(check_rows<double>({5, 30000, 2}) > 0);
}

TEST_CASE("rows that are compressed before HDF5 is asked for have its own chunks") {
  const auto check_packed = [](const hdf5::Shape& row, auto in_file) {
    using T = decltype(in_file);
    check_same_chunks([&](const hdf5::Group& group) {
      hdf5::Dataset dataset = group.create_growing<T>("values", row, {1, true});
      std::vector<T> wanted;
      for (unsigned r = 0; r < 3; ++r) {
        const std::vector<double> values = made_up_values<double>(count_of(row), 3 + r);
        const hdf5::PackedRow packed = dataset.pack(values.data());
        CHECK(packed.empty() != dataset.packs());
        if (packed.empty())
          dataset.append(values.data(), 1);
        else
          dataset.append(packed);
        for (const double value : values) wanted.push_back(static_cast<T>(value));
      }
      CHECK(dataset.read<T>() == wanted);
    });
  };
  check_packed({1}, 0.0);
  check_packed({1860, 3}, 0.0);
  check_packed({65536}, 0.0);
  check_packed({1748, 6}, 0.0F);
}

TEST_CASE("rows that are not one chunk of numbers each are not compressed before") {
  const TemporaryFolder folder;
  hdf5::File file = hdf5::File::create(folder / "run.h5", kinds::results());
  CHECK_FALSE(file.root().create_growing<double>("nobody asked for threads", {10}, {1, true}).packs());
  file.compress_on([] { return 2; });
  const hdf5::Group group = file.root();
  CHECK(group.create_growing<double>("one", {10}, {1, true}).packs());
  CHECK_FALSE(group.create_growing<double>("two", {65537}, {1, true}).packs());
  CHECK_FALSE(group.create_growing<double>("none", {0}, {1, true}).packs());
  CHECK_FALSE(group.create_growing<double>("many in a chunk", {}, {1024, true}).packs());
  CHECK_FALSE(group.create_growing<double>("plain", {10}, {1, false}).packs());
  CHECK_FALSE(group.create_growing<signed char>("bytes", {10}, {1, true}).packs());
}

TEST_CASE("of rows that are compressed together those are left out whose values are not to be had") {
  for (const int threads : {1, 4}) {
    const TemporaryFolder folder;
    hdf5::File file = hdf5::File::create(folder / "run.h5", kinds::results());
    file.compress_on([threads] { return threads; });
    std::vector<hdf5::Dataset> datasets;
    for (const char* name : {"a", "b", "c", "d", "e"})
      datasets.push_back(file.root().create_growing<double>(name, {500}, {1, true}));
    CompressedRows rows;
    for (unsigned k = 0; k < 5; ++k)
      rows.add(datasets[k], [k] {
        if (k == 1) throw std::runtime_error("made up");
        return made_up_values<double>(k == 3 ? 499 : 500, k);
      });
    rows.pack(threads);
    for (unsigned k = 0; k < 5; ++k) {
      CHECK(rows.append_to(datasets[k]) == (k != 1 && k != 3));
      CHECK(datasets[k].shape()[0] == (k != 1 && k != 3 ? 1 : 0));
    }
    CHECK(datasets[4].read<double>() == made_up_values<double>(500, 4));
  }
}

TEST_CASE("arrays that are written at once have HDF5's own chunks") {
  CHECK(check_whole<double>({100001, 3}) > 0);
  CHECK(check_whole<int>({80001, 4}) > 0);
  CHECK(check_whole<float>({3, 200001}) > 0);
  CHECK(check_whole<long>({2, 60001, 3}) > 0);
}

TEST_CASE("small arrays, and those that HDF5 has to convert, are left to HDF5") {
  CHECK(check_rows<double>({0}) == 0);
  CHECK(check_rows<double>({1}) == 0);
  CHECK(check_rows<double>({0, 6}) == 0);
  CHECK(check_rows<double>({1000, 6}) == 0);
  CHECK(check_rows<double>({}) == 0);
  CHECK(check_rows<signed char, double>({300001}) == 0);
  CHECK(check_rows<double, float>({300001}) == 0);
  CHECK(check_whole<double>({0, 3}) == 0);
  CHECK(check_whole<double>({1}) == 0);
  CHECK(check_whole<int>({1000, 4}) == 0);
}

TEST_CASE("rows of which many lie in a chunk are left to HDF5 where they begin amid one") {
  const auto asked = [](hsize_t first) {
    return check_same_chunks([&](const hdf5::Group& group) {
      hdf5::Dataset dataset = group.create_growing<double>("values", {}, {16384, true});
      std::vector<double> wanted;
      for (const hsize_t rows : {first, hsize_t{90000}}) {
        const std::vector<double> values = made_up_values<double>(rows, 5);
        dataset.append(values.data(), rows);
        wanted.insert(wanted.end(), values.begin(), values.end());
      }
      CHECK(dataset.read<double>() == wanted);
    });
  };
  CHECK(asked(100) == 0);
  CHECK(asked(16384) > 0);
  CHECK(asked(40000) > 0);  // of which a part of the last chunk is written again
}

TEST_CASE("a full disk says the same whoever compresses") {
  const TemporaryFolder folder;
  const std::vector<double> values = made_up_values<double>(600000, 9);
  const auto complaint = [&](const hdf5::ThreadCount& threads) {
    hdf5::File file = hdf5::File::create(folder / "run.h5", kinds::results());
    file.compress_on(threads);
    hdf5::Dataset dataset = file.root().create_growing<double>("values", {600000}, {1, true});
    const FullDisk full(200000);
    try {
      dataset.append(values.data(), 1);
      file.close();
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const std::string expected = complaint({});
  CHECK_THAT(expected, ContainsSubstring("File too large"));
  CHECK(complaint([] { return 3; }) == expected);
}

// Hidden: prints how long the stresses of a large scene take, by HDF5 and by several threads (docs/performance.md).
TEST_CASE("time of a large array", "[.compression-times]") {
  constexpr hsize_t elements = 490000;
  const std::vector<double> values = made_up_values<double>(6 * elements, 1);
  const TemporaryFolder folder;
  for (const int threads : {0, 1, 2, 4, 8, 16}) {
    hdf5::File file = hdf5::File::create(folder / "run.h5", kinds::results());
    if (threads > 0) file.compress_on([threads] { return threads; });
    hdf5::Dataset dataset = file.root().create_growing<double>("values", {elements, 6}, {1, true});
    double best = INFINITY;
    for (int i = 0; i < 5; ++i) {
      const auto begin = std::chrono::steady_clock::now();
      dataset.append(values.data(), 1);
      file.flush();
      best = std::fmin(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    std::printf("%2d threads (0: HDF5): %4.0f ms\n", threads, 1e3 * best);
  }
}

TEST_CASE("the checksum of nothing and of zeros is zero, of other bytes it never is") {
  const std::vector<unsigned char> zeros(1001, 0), ones(65535 * 2 + 1, 0xff);
  CHECK(hdf5::fletcher32(zeros.data(), 0) == 0);
  CHECK(hdf5::fletcher32(zeros.data(), zeros.size()) == 0);
  CHECK(hdf5::fletcher32(ones.data(), 2) == 0xffffffff);
  CHECK(hdf5::fletcher32(ones.data(), 1) == 0xff00ff00);
  CHECK(hdf5::fletcher32(ones.data(), ones.size() - 1) == 0xffffffff);
}

#endif
