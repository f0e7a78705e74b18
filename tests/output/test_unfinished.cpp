#include <catch2/catch_test_macros.hpp>
#include <filesystem>

#include "output/atomic_file.hpp"
#include "output/file_kind.hpp"
#include "output/hdf5/hdf5.hpp"
#include "tests/temporary_folder.hpp"

using namespace railwave;

TEST_CASE("files that have no names yet go, those that were given names stay") {
  const TemporaryFolder folder;
  const auto is_there = [&](const char* name) { return std::filesystem::exists(folder / name); };
  for (const char* name : {"a", "b", "c"}) note_unfinished(folder.write(name, "half"));
  forget_unfinished(folder / "b");
  remove_unfinished();
  CHECK_FALSE(is_there("a"));
  CHECK(is_there("b"));
  CHECK_FALSE(is_there("c"));
  folder.write("a", "whole");
  remove_unfinished();
  CHECK(is_there("a"));
  for (int i = 0; i < 100; ++i) {  // places are given back
    note_unfinished(folder / "d");
    forget_unfinished(folder / "d");
  }
  note_unfinished(folder.write("e", "half"));
  remove_unfinished();
  CHECK_FALSE(is_there("e"));
}

TEST_CASE("an HDF5 file is noted until it has its name") {
  const TemporaryFolder folder;
  const auto is_there = [&](const char* name) { return std::filesystem::exists(folder / name); };
  {
    hdf5::File file = hdf5::File::create(folder / "a.h5", kinds::results());
    file.flush();
    CHECK(is_there("a.h5.new"));
    remove_unfinished();
    CHECK_FALSE(is_there("a.h5.new"));
  }
  hdf5::File file = hdf5::File::create(folder / "b.h5", kinds::results());
  file.flush();
  file.take_name();
  remove_unfinished();
  CHECK(is_there("b.h5"));
}
