#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include <cmath>
#include <limits>

#include <sys/resource.h>

#include "case/memory.hpp"
#include "tests/case/temporary_case.hpp"

using namespace railwave;
using namespace railwave::test;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::Equals;

TEST_CASE("numbers of bytes are written for people", "[case]") {
  CHECK(bytes_text(0) == "0 bytes");
  CHECK(bytes_text(999) == "999 bytes");
  CHECK(bytes_text(1000) == "1 kB");
  CHECK(bytes_text(3.2e12) == "3.2 TB");
  CHECK(bytes_text(1e30) == "1e+12 EB");
}

TEST_CASE("what Kokkos could not have is reported in words of ours, whatever its version", "[case]") {
  const std::string older =
      "Kokkos failed to allocate memory for label \"position\".  Allocation using MemorySpace named \"Host\" failed "
      "with the "
      "following error:  Allocation of size 3.725 G failed, likely due to insufficient memory.";
  const std::string later =
      "Kokkos ERROR: Cuda memory space failed to allocate 39.55 MiB (label=\"tangent corner force\").";
  CHECK(is_refusal_of_kokkos(older.c_str()));
  CHECK(is_refusal_of_kokkos(later.c_str()));
  CHECK_FALSE(is_refusal_of_kokkos("Kokkos ERROR: a view was used after its end"));
  CHECK(refused_by_kokkos(older) == "3.725 GiB for the array position, in memory of Host");
  CHECK(refused_by_kokkos(later) == "39.55 MiB for the array tangent corner force, in memory of Cuda");
  CHECK(refused_by_kokkos("Kokkos ERROR: ") == "memory");
}

TEST_CASE("what needs more memory than there is is refused with both figures", "[case]") {
  CHECK_NOTHROW(expect_memory(1e9, "reading it needs", "split it", 1e9));
  CHECK_NOTHROW(expect_memory(1e30, "reading it needs", "split it", std::numeric_limits<double>::infinity()));
  CHECK_THROWS_WITH(
      expect_memory(3.2e12, "a.inp: reading it needs", "split it", 22e9),
      Equals("a.inp: reading it needs about 3.2 TB of memory, but this machine has 22 GB left; split it"));
}

TEST_CASE("the memory that is left is known, and a limit set for the process counts", "[case]") {
  const double all = available_memory();
  CHECK(all > 1e6);
  rlimit before{};
  REQUIRE(getrlimit(RLIMIT_AS, &before) == 0);
  // Only looked at: what is taken already lies far above under a sanitizer.
  const rlimit small{rlim_t(1) << 20, before.rlim_max};
  if (setrlimit(RLIMIT_AS, &small) != 0) SKIP("no limit can be set here");
  const double left = available_memory();
  setrlimit(RLIMIT_AS, &before);
  CHECK(left == 0);
}

TEST_CASE("a track of sleepers without number is refused before they are laid", "[case]") {
  const std::string rest = "rail_distance = 0.75\nstart = 0\n";
  const auto said = [&](const std::string& keys) {
    TemporaryCase file("[tracks.t]\n" + rest + keys + "[time]\nend = 1e-3\n");
    return mistakes_of(file.path());
  };
  CHECK_THAT(said("end = 1\npitch = 1e-12\n"), ContainsSubstring("[tracks.t] pitch: is 1e-12, must be at least 0.2 m"));
  CHECK_THAT(said("end = 9e4\n"), ContainsSubstring("sleepers under a rail of 9e+04 m, at most 10000 are made"));
}

TEST_CASE("a curve is read from a file of ordinary size only", "[case]") {
  TemporaryCase file(small_case + "[curves.c]\ntype = \"table\"\nfile = \"long.csv\"\n");
  file.write("long.csv", "0,0\n1,1\n");
  CHECK(mistakes_of(file.path()) == "");
  std::filesystem::resize_file(file.folder() / "long.csv", std::uintmax_t(20) << 30);  // a hole: takes no room
  CHECK_THAT(mistakes_of(file.path()), ContainsSubstring("has 21.5 GB, at most 268 MB are read; give fewer points"));
  TemporaryCase endless(small_case + "[curves.c]\ntype = \"table\"\nfile = \"/dev/zero\"\n");
  CHECK_THAT(mistakes_of(endless.path()), ContainsSubstring("'/dev/zero' is no regular file"));
}
