#include "case/results_place.hpp"

#include <filesystem>

namespace railwave {
namespace {

std::string name_of(const std::string& case_path) {
  const std::string name = std::filesystem::path(case_path).stem().string();
  return name.empty() || name == "." || name == ".." ? "case" : name;
}

}  // namespace

std::string default_results_folder(const std::string& case_path) { return "results/" + name_of(case_path); }

std::string default_results_file(const std::string& case_path) {
  return default_results_folder(case_path) + '/' + name_of(case_path) + ".h5";
}

}  // namespace railwave
