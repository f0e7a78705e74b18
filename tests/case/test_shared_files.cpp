#include "case/shared_files.hpp"

#include <catch2/catch_test_macros.hpp>
#include <filesystem>
#include <fstream>

#include "tests/temporary_folder.hpp"

using namespace railwave;
namespace fs = std::filesystem;

TEST_CASE("what is installed is looked for beside the program, then in the source tree") {
  const std::string installed = installed_file("report.html");
  const fs::path program = fs::read_symlink("/proc/self/exe");
  CHECK(installed == program.parent_path().parent_path() / "share/railwave/report.html");
  CHECK(places_of("report.html", "source/report.html") == std::vector<std::string>{installed, "source/report.html"});
  CHECK(places_of("report.html", "") == std::vector<std::string>{installed});
}

TEST_CASE("the first place that exists is taken") {
  const TemporaryFolder folder;
  const std::string first = (folder.path() / "first").string(), second = (folder.path() / "second").string();
  CHECK(first_present({first, second}).empty());
  std::ofstream(second) << "here";
  CHECK(first_present({first, second}) == second);
  std::ofstream(first) << "here";
  CHECK(first_present({first, second}) == first);
  CHECK(first_present({}).empty());
}

TEST_CASE("a program that is not installed names the scripts of its source tree") {
  CHECK(script_command("picture") == "scripts/picture");
}
