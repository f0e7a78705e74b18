#include <hdf5.h>
#include <unistd.h>

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include <cstdio>

#include "case/error.hpp"
#include "output/hdf5/hdf5.hpp"
#include "output/results_file.hpp"
#include "tests/output/made_up_run.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;

namespace {

scene::Scene some_scene() {
  scene::Scene scene;
  scene.path = "a.toml";
  scene.output.file = "results.h5";
  return scene;
}

}  // namespace

TEST_CASE("results that no disk holds are refused with what each output takes, and what the disk has") {
  ResultsSize size;
  size.field_outputs = 1e6;
  size.samples = 1e6;
  size.field_bytes = 3e15;
  size.history_bytes = 1e9;
  CHECK_THROWS_WITH(
      check_results_disk_space(size, some_scene(), 80e9),
      ContainsSubstring(
          "a.toml: [output] field_interval makes 1e+06 outputs of fields of 3 GB each: 3 PB before compression, but "
          "results.h5 has 80 GB free; give a longer field_interval"));
  size.field_bytes = 0;
  size.history_bytes = 1e12;
  CHECK_THROWS_WITH(check_results_disk_space(size, some_scene(), 80e9),
                    ContainsSubstring("[output] history_interval makes 1e+06 samples of histories of 1 MB each"));
}

TEST_CASE("results that compression may make small enough are not refused") {
  ResultsSize size;
  size.field_outputs = 1000;
  size.field_bytes = 200e9;
  size.samples = 1000;
  size.history_bytes = 1e6;
  CHECK_NOTHROW(check_results_disk_space(size, some_scene(), 80e9));
  CHECK(free_bytes_at("results.h5") > 0);
}

TEST_CASE("a file that claims more values than fit into memory is refused before they are asked for") {
  const std::string path = "railwave-claim-" + std::to_string(getpid()) + ".h5";
  {
    const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT),
                list = H5Pcreate(H5P_DATASET_CREATE);
    const hsize_t count = hsize_t(1) << 50, chunk = 1024;
    H5Pset_chunk(list, 1, &chunk);
    const hid_t space = H5Screate_simple(1, &count, nullptr);
    H5Dclose(H5Dcreate2(file, "claim", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, list, H5P_DEFAULT));
    H5Sclose(space), H5Pclose(list), H5Fclose(file);
  }
  {
    const hdf5::File file = hdf5::File::open(path);
    CHECK_THROWS_WITH(file.root().dataset("claim").read<double>(),
                      ContainsSubstring("has 1125899906842624 values, which need about 9.01 PB of memory"));
  }
  std::remove(path.c_str());
}
