#include "post/contact_file.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "case/error.hpp"
#include "output/hdf5.hpp"

namespace railwave {
namespace {

constexpr const char* format = "Railwave contact solution";
constexpr long format_version = 1;

bool is_contact_file(const std::string& path) {
  try {
    const hdf5::File file = hdf5::File::open(path);
    return file.root().has_attribute("format") && file.root().text_attribute("format") == format;
  } catch (const std::exception&) {
    return false;
  }
}

void write_to(const std::string& path, const ResultsReader& results, const std::vector<std::pair<std::string, ContactTables>>& contacts) {
  hdf5::File file = hdf5::File::create(path);
  const hdf5::Group root = file.root();
  root.set_attribute("format", format);
  root.set_attribute("format_version", format_version);
  root.set_attribute("results_file", results.path());
  root.set_attribute("title", results.title());
  const hdf5::Group group = root.create_group("contact");
  for (const auto& [name, tables] : contacts) {
    const hdf5::Group contact = group.create_group(name);
    contact.set_attribute("surface", results.slave_surface(name));
    tables.patches.write(contact.create_group("patches"));
    tables.nodes.write(contact.create_group("nodes"));
    tables.facets.write(contact.create_group("facets"));
    tables.cuts.write(contact.create_group("cuts"));
  }
  file.close();
}

}  // namespace

void write_contact_file(const std::string& path, const ResultsReader& results, const std::vector<std::pair<std::string, ContactTables>>& contacts) {
  namespace fs = std::filesystem;
  if (fs::exists(path) && !is_contact_file(path))
    throw InputError(fmt::format("{} is there already and is no file that 'railwave contact --hdf5' wrote: name another, or remove it", path));
  const std::string beside = path + ".new";
  try {
    write_to(beside, results, contacts);
    fs::rename(beside, path);
  } catch (const std::exception& error) {
    std::error_code none;
    fs::remove(beside, none);
    throw InputError(fmt::format("the contact solution was not written: {}", error.what()));
  }
}

}  // namespace railwave
