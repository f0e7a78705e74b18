#include "output/hdf5/hdf5.hpp"

#include <cstring>

#include "case/field_table.hpp"

namespace railwave {
namespace {

struct DatasetUnit {
  const char* place;  ///< path in the file; * stands for a name
  const char* unit;   ///< SI; "1" of numbers, counts and shares
};

constexpr DatasetUnit datasets[] = {
    // Histories.
    {"/history/time", "s"},
    {"/history/step", "1"},
    {"/history/energy/*", "J"},
    {"/history/contact/*/normal_force", "N"},
    {"/history/contact/*/tangential_force", "N"},
    {"/history/contact/*/master_force", "N"},
    {"/history/contact/*/nodes_in_contact", "1"},
    {"/history/contact/*/nodes_slipping", "1"},
    {"/history/set/*/position", "m"},
    {"/history/set/*/asked_position", "m"},
    {"/history/set/*/element_centre", "m"},
    {"/history/set/*/elements", "1"},
    {"/history/load/*/force", "N"},
    {"/history/load/*/moment", "N m"},
    {"/history/load/*/direction", "1"},
    {"/history/load/*/work", "J"},
    {"/history/prescribed_motion/*/reaction", "N"},
    {"/history/prescribed_motion/*/work", "J"},
    {"/history/beam/*/force", "N"},
    {"/history/beam/*/moment", "N m"},
    // Meshes of any file.
    {"/*/nodes", "1"},
    {"/*/elements", "1"},
    {"/*/facets", "1"},
    {"/*/connectivity", "1"},
    {"/*coordinates", "m"},
    // Fields; those of nodes and elements are in case/field_table.cpp.
    {"/*/time", "s"},
    {"/*/step", "1"},
    {"/beams/*/force", "N"},
    {"/beams/*/moment", "N m"},
    {"/VTKHDF/CellData/beam_force", "N"},
    {"/VTKHDF/CellData/beam_moment", "N m"},
    // Sides of contacts.
    {"/contact/*/surface_of_facet", "1"},
    {"/contact/*/rows", "1"},
    {"/contact/*/node", "1"},
    {"/contact/*/area", "m2"},
    {"/contact/*/position", "m"},
    {"/contact/*/normal", "1"},
    {"/contact/*/normal_force", "N"},
    {"/contact/*/tangential_force", "N"},
    {"/contact/*/pressure", "Pa"},
    {"/contact/*/shear", "Pa"},
    {"/contact/*/gap", "m"},
    {"/contact/*/slip_velocity", "m/s"},
    {"/contact/*/friction", "1"},
    {"/contact/*/slipping", "1"},
    // The model before a run, and the surroundings of a fault.
    {"/parts/*/part", "1"},
    {"/parts/*/material", "1"},
    {"/parts/*/stable_step", "s"},
    {"/parts/*/step_ratio", "1"},
    {"/parts/*/rank", "1"},
    {"/parts/*/element", "1"},
    {"/parts/*/culprit", "1"},
    {"/connectors/connector", "1"},
    {"/connectors/stiffness", "N/m"},
    {"/connectors/damping", "N s/m"},
    {"/beams/beam", "1"},
    {"/beams/pretension", "N"},
    // Natural modes; their displacements are relative to the largest.
    {"/modes/frequency", "Hz"},
    {"/modes/modal_mass", "kg"},
    {"/modes/rigid", "1"},
    {"/modes/part", "1"},
    {"/modes/kind", "1"},
    {"/modes/nodal_diameters", "1"},
    {"/modes/nodal_circles", "1"},
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

std::string unit_of(const std::string& path) {
  for (const DatasetUnit& dataset : datasets)
    if (fits(dataset.place, path)) return dataset.unit;
  for (const FieldRow& row : field_table()) {
    const std::string place = row.serves(FieldRow::fields) ? "/*/" : "/history/set/*/";
    if (fits((place + row.name).c_str(), path)) return row.unit;
  }
  return "";
}

}  // namespace railwave
