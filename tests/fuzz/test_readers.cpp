#include <catch2/catch_test_macros.hpp>

#include <algorithm>
#include <filesystem>

#include "source_folder.hpp"
#include "tests/fuzz/readers.hpp"
#include "tests/temporary_folder.hpp"

using namespace railwave;
namespace fs = std::filesystem;

namespace {

std::vector<fs::path> files_of(const std::string& folder, const std::string& reader) {
  std::vector<fs::path> paths;
  const fs::path path = fs::path(source_folder) / "tests/fuzz" / folder / reader;
  if (fs::exists(path))
    for (const auto& entry : fs::directory_iterator(path)) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

/// What goes wrong with a file that must be read or refused; "" when nothing does.
std::string fault(const fuzz::Reader& reader, const fs::path& path) {
  try {
    reader.read(text_of(path));
    return "";
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("files with which fuzzing once broke a reader are read or refused", "[fuzz]") {
  int count = 0;
  for (const auto& reader : fuzz::readers())
    for (const auto& path : files_of("regressions", reader.name)) {
      INFO(path.string());
      CHECK(fault(reader, path) == "");
      ++count;
    }
  CHECK(count > 0);
}

TEST_CASE("the files that fuzzing has collected are read or refused", "[fuzz]") {
  for (const auto& reader : fuzz::readers()) {
    const auto paths = files_of("corpus", reader.name);
    INFO(reader.name);
    CHECK(paths.size() > 10);
    for (const auto& path : paths) {
      INFO(path.string());
      CHECK(fault(reader, path) == "");
    }
  }
}
