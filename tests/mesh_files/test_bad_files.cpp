#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include <algorithm>
#include <vector>

#include "source_folder.hpp"
#include "tests/mesh/complaint.hpp"
#include "tests/mesh_files/mesh_checks.hpp"

using namespace railwave;

// Each file of bad/ has one mistake. What its message must say stands in its first line (`** expect: ...`) or, for
// .msh, in a file of the same name with .expect after it: from the file's name and line on, " ... " standing for any
// text.
TEST_CASE("each broken mesh file is refused with its message") {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(source_folder + "/tests/mesh_files/bad"))
    if (const auto ending = entry.path().extension(); ending == ".inp" || ending == ".msh")
      paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  REQUIRE(paths.size() >= 40);

  for (const auto& path : paths) {
    const bool abaqus = path.extension() == ".inp";
    const auto text = text_of(abaqus ? path.string() : path.string() + ".expect");
    const std::string prefix = abaqus ? "** expect: " : "";
    CAPTURE(path.filename());
    REQUIRE(text.compare(0, prefix.size(), prefix) == 0);
    const auto expected = text.substr(prefix.size(), text.find('\n') - prefix.size());
    REQUIRE(expected.size() > 20);

    const std::string message = complaint_of(source_of_file(path.string()));
    std::string rest = path.filename().string() + expected;
    for (std::size_t gap; (gap = rest.find(" ... ")) != std::string::npos; rest.erase(0, gap + 5))
      CHECK_THAT(message, Catch::Matchers::ContainsSubstring(rest.substr(0, gap)));
    CHECK_THAT(message, Catch::Matchers::ContainsSubstring(rest));
  }
}
