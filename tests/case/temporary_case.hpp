#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "case/error.hpp"
#include "case/read_case.hpp"
#include "tests/temporary_folder.hpp"

namespace railwave::test {

/// A case file that lives as long as this object.
class TemporaryCase {
 public:
  explicit TemporaryCase(const std::string& text) { write("case.toml", text); }

  void write(const std::string& name, const std::string& text) const { folder_.write(name, text); }
  std::filesystem::path folder() const { return folder_.path(); }
  std::string path() const { return folder_ / "case.toml"; }

 private:
  TemporaryFolder folder_;
};

/// What InputError says when the file is read; "" when it is read without one.
inline std::string mistakes_of(const std::string& path, const std::vector<std::string>& overrides = {}) {
  try {
    read_case(path, overrides);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

/// A case with nothing but what is required: one block.
inline const std::string small_case =
    "[materials.steel]\nyoungs_modulus = 210e9\npoissons_ratio = 0.3\ndensity = 7800\n"
    "[meshes.cube]\ntype = \"box\"\n"
    "[parts.cube]\nmesh = \"cube\"\nmaterial = \"steel\"\n"
    "[time]\nend = 1e-3\n";

}  // namespace railwave::test
