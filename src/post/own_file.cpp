#include "post/own_file.hpp"

#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "case/error.hpp"
#include "output/atomic_file.hpp"
#include "output/hdf5.hpp"

namespace railwave {
namespace {

bool is_of(const OwnFormat& format, const std::string& path) {
  try {
    const hdf5::File file = hdf5::File::open(path);
    return file.root().has_attribute("format") && file.root().text_attribute("format") == format.name;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    return false;
  }
}

bool is_hdf5(const std::string& path) {
  std::string mark(8, ' ');
  return std::ifstream(path, std::ios::binary).read(mark.data(), 8) && mark == "\211HDF\r\n\032\n";
}

}  // namespace

void write_own_file(const std::string& path, const OwnFormat& format, const ResultsReader& results,
                    const std::function<void(const hdf5::Group&)>& fill) {
  namespace fs = std::filesystem;
  if (fs::exists(path) && !is_of(format, path))
    throw InputError(fmt::format("{} is there already and is no file that '{}' wrote: name another, or remove it", path,
                                 format.command));
  try {
    hdf5::File file = hdf5::File::create(path);
    const hdf5::Group root = file.root();
    root.set_attribute("format", format.name);
    root.set_attribute("format_version", format.version);
    root.set_attribute("results_file", results.path());
    root.set_attribute("title", results.title());
    fill(root);
    file.close();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(fmt::format("{} was not written: {}", path, error.what()));
  }
}

void check_is_not(const std::string& results, const std::optional<std::string>& file) {
  std::error_code none;
  if (file && std::filesystem::equivalent(*file, results, none))
    throw InputError(fmt::format("{} is the results file itself, which would be lost: name another file", *file));
}

void write_table(const std::string& path, const std::string& text) {
  if (is_hdf5(path))
    throw InputError(fmt::format("{} is an HDF5 file, which would be lost: name another for the table", path));
  try {
    write_whole_file(path, text);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(fmt::format("the table was not written: {}", error.what()));
  }
}

}  // namespace railwave
