#include "post/contact_file.hpp"

#include "post/own_file.hpp"

namespace railwave {
namespace {

constexpr const char* format = "Railwave contact solution";
constexpr long format_version = 1;

void fill(const hdf5::Group& root, const std::vector<std::pair<std::string, ContactTables>>& contacts, const ResultsReader& results) {
  const hdf5::Group group = root.create_group("contact");
  for (const auto& [name, tables] : contacts) {
    const hdf5::Group contact = group.create_group(name);
    contact.set_attribute("surface", results.slave_surface(name));
    tables.patches.write(contact.create_group("patches"));
    tables.nodes.write(contact.create_group("nodes"));
    tables.facets.write(contact.create_group("facets"));
    tables.cuts.write(contact.create_group("cuts"));
  }
}

}  // namespace

void write_contact_file(const std::string& path, const ResultsReader& results, const std::vector<std::pair<std::string, ContactTables>>& contacts) {
  write_own_file(path, {format, format_version, "railwave contact --hdf5"}, results, [&](const hdf5::Group& root) { fill(root, contacts, results); });
}

}  // namespace railwave
