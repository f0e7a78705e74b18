#include <catch2/catch_test_macros.hpp>

#include <algorithm>
#include <sstream>

#include "source_folder.hpp"
#include "tests/case/temporary_case.hpp"

using namespace railwave;
using namespace railwave::test;
namespace fs = std::filesystem;

namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> expected_of(const fs::path& path) {
  const std::string mark = "# expect: ";
  std::vector<std::string> expected;
  for (const auto& line : lines_of(text_of(path))) {
    if (line.rfind(mark, 0) == 0) expected.push_back(line.substr(mark.size()));
  }
  return expected;
}

}  // namespace

TEST_CASE("each broken case gets its messages, and no others", "[case]") {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(fs::path(source_folder) / "tests/case/bad"))
    paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  REQUIRE(paths.size() >= 35);
  for (const auto& path : paths) {
    const auto expected = expected_of(path);
    const auto said = mistakes_of(path.string());
    INFO(path.filename().string() << " says:\n" << said);
    REQUIRE_FALSE(expected.empty());
    for (const auto& one : expected) {
      INFO("expected: " << one);
      CHECK(said.find(one) != std::string::npos);
    }
    CHECK(lines_of(said).size() == expected.size());
  }
}

TEST_CASE("mistakes of the command line are reported as such", "[case]") {
  TemporaryCase file(small_case);
  const auto said = [&](const std::string& override_text) { return mistakes_of(file.path(), {override_text}); };
  CHECK(said("time.end") == "command line: 'time.end' must be section.key=value, such as time.end=1e-3");
  CHECK(said("time.end=") == "command line: time.end: the value after '=' is missing");
  CHECK(said("time.end=1ms") == "command line: [time] end: is text, must be a number in s");
  CHECK(said("time.end=-1") == "command line: [time] end: is -1, must be above 0 s");
  CHECK(said("time.ende=1") == "command line: [time] ende: unknown key; did you mean 'end'?");
  CHECK(said("tine.end=1") == "command line: tine.end: there is no section [tine]; did you mean [time]?");
  CHECK(said("time=1") == "command line: time: names a section; write time.key=value");
  CHECK(said("parts=1") == "command line: parts: names a section; write parts.NAME.key=value");
  CHECK(said("parts.hourglass=viscous") == "command line: parts.hourglass: must be parts.NAME.key=value");
  CHECK(said("parts.cub.hourglass=viscous") ==
        "command line: parts.cub.hourglass: the file has no part 'cub'; did you mean 'cube'?");
  CHECK(said("parts.cube.hourglass=soft") ==
        "command line: [parts.cube] hourglass: is 'soft', must be 'viscous' or 'stiffness'");
  CHECK(said("parts.cube.position=[0, 0") ==
        "command line: parts.cube.position: the value is not valid TOML; lists stand in brackets, [x, y, z], and text "
        "in quotes");
  CHECK(said("parts.cube.material=stel") ==
        "command line: [parts.cube] material: there is no material 'stel'; did you mean 'steel'?");
  CHECK(said("titel=x") == "command line: titel: unknown key; did you mean 'title'?");
  CHECK(said("=1").find("command line: ") == 0);
  CHECK(said("..=1").find("command line: ") == 0);
  CHECK(said("time.end=1\n[gravity]").find("command line: ") == 0);
}

TEST_CASE("mistakes of the command line come after the file's", "[case]") {
  TemporaryCase file(small_case + "step_scale = 2\n");
  const auto lines = lines_of(mistakes_of(file.path(), {"meshes.cube.sise=[1,1,1]"}));
  REQUIRE(lines.size() == 2);
  CHECK(lines[0].find(":12: [time] step_scale") != std::string::npos);
  CHECK(lines[1] == "command line: [meshes.cube] sise: unknown key; did you mean 'size'?");
}

TEST_CASE("a file that cannot be a case says what it is", "[case]") {
  TemporaryCase file(small_case);
  const auto folder = file.folder().string();
  CHECK(mistakes_of(folder + "/cas.toml") ==
        folder + "/cas.toml: there is no such file; did you mean '" + folder + "/case.toml'?");
  CHECK(mistakes_of(folder + "/nowhere/at.toml") == folder + "/nowhere/at.toml: there is no such file");
  CHECK(mistakes_of(folder).find(folder + ": is a folder; give a case file") == 0);
  CHECK(mistakes_of("").find("no case file was named") == 0);
  file.write("results.h5", "\x89HDF\r\n\x1a\n");
  CHECK(mistakes_of(folder + "/results.h5").find("results.h5: is an HDF5 file") != std::string::npos);
  file.write("binary.toml", std::string("title = \"a\0b\"\n", 14));
  CHECK(mistakes_of(folder + "/binary.toml").find("binary.toml: is not text") != std::string::npos);
  file.write("latin1.toml",
             "title = \"Schienenst\xF6\xDF"
             "e\"\n");
  CHECK(mistakes_of(folder + "/latin1.toml").find("latin1.toml:1: not valid TOML") != std::string::npos);
  file.write("empty.toml", "");
  CHECK(
      mistakes_of(folder + "/empty.toml").find("empty.toml: [parts.NAME] is missing; add it, with mesh and material") !=
      std::string::npos);
}

TEST_CASE("a file that may not be read is reported", "[case]") {
  TemporaryCase file(small_case);
  fs::permissions(file.path(), fs::perms::none);
  if (std::ifstream(file.path()).good())
    SUCCEED("this user may read everything");
  else
    CHECK(mistakes_of(file.path()) == file.path() + ": cannot be opened; check that you may read it");
}

TEST_CASE("a flood of mistakes is cut", "[case]") {
  std::string text = small_case;
  for (int i = 0; i < 200; ++i) text += "wrong_" + std::to_string(i) + " = 1\n";
  TemporaryCase file(text);
  const auto lines = lines_of(mistakes_of(file.path()));
  REQUIRE(lines.size() == 51);
  CHECK(lines.back() == file.path() + ": and 150 more mistakes");
}

TEST_CASE("hostile names and texts stay on one line of the message", "[case]") {
  TemporaryCase file(small_case + "\"a\\nb\" = 1\n[parts.\"x\\ny\"]\nmesh = \"cube\\u0007\"\nmaterial = \"" +
                     std::string(5000, 's') + "\"\n");
  const auto lines = lines_of(mistakes_of(file.path()));
  CHECK(lines.size() == 4);
  for (const auto& line : lines) {
    CHECK(line.size() < 500);
    CHECK(line.find('\a') == std::string::npos);
  }
}
