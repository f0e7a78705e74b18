#include "post/contact_file.hpp"

#include "post/own_file.hpp"

namespace railwave {
namespace {

constexpr OwnFormat format{"Railwave contact solution", 1, "railwave contact --hdf5"};

void fill(const hdf5::Group& root, const std::vector<std::pair<std::string, ContactTables>>& contacts,
          const std::vector<std::string>& surfaces) {
  const hdf5::Group group = root.create_group("contact");
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const auto& [name, tables] = contacts[i];
    const hdf5::Group contact = group.create_group(name);
    contact.set_attribute("surface", surfaces[i]);
    tables.patches.write(contact.create_group("patches"));
    tables.nodes.write(contact.create_group("nodes"));
    tables.facets.write(contact.create_group("facets"));
    tables.cuts.write(contact.create_group("cuts"));
  }
}

}  // namespace

FileKind contact_file_kind() { return format.kind(); }

void write_contact_file(const std::string& path, const ResultsReader& results,
                        const std::vector<std::pair<std::string, ContactTables>>& contacts,
                        const std::vector<std::string>& surfaces) {
  write_own_file(path, format, results, [&](const hdf5::Group& root) { fill(root, contacts, surfaces); });
}

}  // namespace railwave
