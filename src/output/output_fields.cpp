#include "output/output_fields.hpp"

#include <cstring>
#include <stdexcept>

namespace railwave {
namespace {

constexpr OutputField fields[] = {
    // Histories: an entry is a sample.
    {"/history/time", 1, "s"},
    {"/history/step", 1, "1"},
    {"/history/energy/*", 1, "J"},
    {"/history/contact/*/normal_force", 3, "N"},
    {"/history/contact/*/tangential_force", 3, "N"},
    {"/history/contact/*/master_force", 3, "N"},
    {"/history/contact/*/nodes_in_contact", 1, "1"},
    {"/history/contact/*/nodes_slipping", 1, "1"},
    {"/history/set/*/displacement", 3, "m"},
    {"/history/set/*/velocity", 3, "m/s"},
    {"/history/set/*/acceleration", 3, "m/s2"},
    {"/history/set/*/stress", 6, "Pa"},
    {"/history/set/*/strain", 6, "1"},
    {"/history/set/*/plastic_strain", 1, "1"},
    {"/history/set/*/position", 3, "m"},
    {"/history/set/*/asked_position", 3, "m"},
    {"/history/set/*/element_centre", 3, "m"},
    {"/history/set/*/elements", 1, "1"},
    {"/history/load/*/force", 3, "N"},
    {"/history/load/*/moment", 1, "N m"},
    {"/history/load/*/direction", 3, "1"},
    {"/history/beam/*/force", 0, "N"},
    {"/history/beam/*/moment", 0, "N m"},
    // Meshes of any file.
    {"/*/nodes", 1, "1"},
    {"/*/elements", 1, "1"},
    {"/*/facets", 4, "1"},
    {"/*/connectivity", 0, "1"},
    {"/*coordinates", 3, "m"},
    // Fields: an entry is a node or a cell at an output time.
    {"/*/time", 1, "s"},
    {"/*/step", 1, "1"},
    {"/*/displacement", 3, "m"},
    {"/*/velocity", 3, "m/s"},
    {"/*/acceleration", 3, "m/s2"},
    {"/*/stress", 6, "Pa"},
    {"/*/plastic_strain", 1, "1"},
    {"/beams/*/force", 3, "N"},
    {"/beams/*/moment", 3, "N m"},
    // Sides of contacts.
    {"/contact/*/surface_of_facet", 1, "1"},
    {"/contact/*/area", 1, "m2"},
    {"/contact/*/position", 3, "m"},
    {"/contact/*/normal", 3, "1"},
    {"/contact/*/normal_force", 3, "N"},
    {"/contact/*/tangential_force", 3, "N"},
    {"/contact/*/pressure", 1, "Pa"},
    {"/contact/*/shear", 3, "Pa"},
    {"/contact/*/gap", 1, "m"},
    {"/contact/*/slip_velocity", 3, "m/s"},
    {"/contact/*/friction", 1, "1"},
    {"/contact/*/slipping", 1, "1"},
    // The model before a run, and the surroundings of a fault.
    {"/parts/*/part", 1, "1"},
    {"/parts/*/material", 1, "1"},
    {"/parts/*/stable_step", 1, "s"},
    {"/parts/*/step_ratio", 1, "1"},
    {"/parts/*/element", 1, "1"},
    {"/parts/*/culprit", 1, "1"},
    {"/connectors/connector", 1, "1"},
    {"/connectors/stiffness", 1, "N/m"},
    {"/connectors/damping", 1, "N s/m"},
    {"/beams/beam", 1, "1"},
    {"/beams/pretension", 1, "N"},
    // Natural modes; their displacements are relative to the largest.
    {"/modes/frequency", 1, "Hz"},
    {"/modes/modal_mass", 1, "kg"},
    {"/modes/rigid", 1, "1"},
    {"/modes/part", 1, "1"},
    {"/modes/kind", 1, "1"},
    {"/modes/nodal_diameters", 1, "1"},
    {"/modes/nodal_circles", 1, "1"},
};

/// A place with at most one *, which stands for any text but none.
bool fits(const char* place, const std::string& path) {
  const char* star = std::strchr(place, '*');
  if (star == nullptr) return path == place;
  const std::size_t before = static_cast<std::size_t>(star - place), after = std::strlen(star + 1);
  return path.size() > before + after && path.compare(0, before, place, before) == 0 &&
         path.compare(path.size() - after, after, star + 1) == 0;
}

}  // namespace

const OutputField* output_field(const std::string& path) {
  for (const OutputField& field : fields)
    if (fits(field.place, path)) return &field;
  return nullptr;
}

std::string unit_of(const std::string& path) {
  const OutputField* field = output_field(path);
  return field ? field->unit : "";
}

int components_of(const std::string& field) {
  const OutputField* found = output_field("/fields/*/" + field);
  if (found == nullptr) throw std::logic_error("there is no field " + field);
  return found->components;
}

}  // namespace railwave
