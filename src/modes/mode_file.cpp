#include "modes/modes.hpp"

#include <filesystem>

#include "output/hdf5/hdf5.hpp"
#include "output/output_place.hpp"
#include "output/results_writer.hpp"

namespace railwave {
namespace {

std::vector<OutputSet> part_sets(const AssembledScene& assembled) {
  scene::Scene scene = assembled.scene;
  scene.beams.clear();
  scene.output.field_sets.clear();
  for (const scene::Part& part : scene.parts) scene.output.field_sets.push_back(part.name);
  return resolve_output_sets(scene, assembled.assembly);
}

void write_modes(const hdf5::Group& group, const std::vector<Mode>& modes) {
  std::vector<double> frequency, mass;
  std::vector<int> rigid, part, kind, diameters, circles;
  for (const Mode& mode : modes) {
    frequency.push_back(mode.frequency);
    mass.push_back(mode.modal_mass);
    rigid.push_back(mode.rigid);
    part.push_back(mode.part);
    kind.push_back(mode.round ? static_cast<int>(mode.round->kind) : -1);
    diameters.push_back(mode.round ? mode.round->diameters : -1);
    circles.push_back(mode.round ? mode.round->circles : -1);
  }
  const hdf5::Shape shape{modes.size()};
  group.write("frequency", frequency, shape);
  group.write("modal_mass", mass, shape);
  group.write("rigid", rigid, shape);
  group.write("part", part, shape);
  group.write("kind", kind, shape);
  group.write("nodal_diameters", diameters, shape);
  group.write("nodal_circles", circles, shape);
}

}  // namespace

void write_mode_file(const AssembledScene& assembled, const ModeList& list, const std::string& path) {
  check_results_place(path);
  auto file = hdf5::File::create(path, kinds::modes());
  const hdf5::Group root = file.root();
  root.set_attribute("title", assembled.scene.title);
  std::vector<std::string> names;
  for (const scene::Part& part : assembled.scene.parts) names.push_back(part.name);
  root.set_attribute("part_names", names);
  write_modes(root.create_group("modes"), list.modes);

  const auto sets = part_sets(assembled);
  const hdf5::Group fields = root.create_group("fields");
  for (std::size_t p = 0; p < sets.size(); ++p) {
    const OutputSet& set = sets[p];
    const hdf5::Group group = fields.create_group(set.name);
    group.write("coordinates", set.coordinates, {set.nodes.size(), 3});
    group.write("connectivity", set.corners, {set.elements.size(), static_cast<hsize_t>(set.corner_count)});
    std::vector<double> displacement;
    for (const Mode& mode : list.modes)
      for (int n : set.nodes)
        for (int i = 0; i < 3; ++i) displacement.push_back(mode.shape[3 * n + i]);
    group.write("displacement", displacement, {list.modes.size(), set.nodes.size(), 3}, "1");
    if (const auto body = RoundBody::of_part(assembled, static_cast<int>(p)))
      for (int i = 0; i < 3; ++i) group.set_attribute(std::string("axis_") + "xyz"[i], body -> axis()[i]);
  }
  file.close();
  const std::string companion = xdmf_path(path);
  remove_own(companion, kinds::modes_xdmf());
  XdmfFile xdmf(companion, std::filesystem::path(path).filename().string(), {"displacement"}, kinds::modes_xdmf());
  for (std::size_t k = 0; k < list.modes.size(); ++k) {
    XdmfGrids grids;
    for (const OutputSet& set : sets) grids.sets.emplace_back(&set, k);
    if (!xdmf.add(static_cast<double>(k + 1), k, grids))
      throw std::runtime_error(companion + " was removed while it was written");
  }
}

}  // namespace railwave
