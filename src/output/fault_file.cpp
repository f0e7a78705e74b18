#include "output/paraview_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "model/fields.hpp"
#include "output/grid_writer.hpp"
#include "output/output_place.hpp"
#include "output/results_writer.hpp"

namespace railwave {
namespace {

constexpr double elements_about = 6;

bool in_box(const Assembly& assembly, int element, const Vec3& centre, double half_edge) {
  for (int n : assembly.elements[element])
    for (int i = 0; i < 3; ++i)
      if (std::fabs(assembly.nodes[n][i] - centre[i]) > half_edge) return false;
  return true;
}

std::string write_part(const Assembly& assembly, const ElementModel& elements, const NodalState& nodal,
                       const Ties& ties, const Fault& fault, const hdf5::Group& parts, const std::string& file,
                       const std::string& name, const std::vector<int>& numbers) {
  std::vector<int> corners, nodes, culprit;
  for (int e : numbers) {
    corners.insert(corners.end(), assembly.elements[e].begin(), assembly.elements[e].end());
    culprit.push_back(e == fault.element ? 1 : 0);
  }
  nodes = corners;
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  const Piece piece(assembly.nodes, corners);
  GridWriter grid(parts, "/parts", name, file, 8);
  grid.cells(piece.nodes, piece.connectivity);
  for (const FieldRow* row : fields_for(FieldRow::fields)) {
    const std::vector<double> values =
        output_field(elements, nodal, ties, *row, row->of_nodes() ? nodes : numbers).values;
    if (row->of_nodes())
      grid.node_values(row->name, values, row->components);
    else if (row->components > 1)
      grid.cell_values(row->name, values, row->components);
    else
      grid.values(row->name, values);
  }
  grid.values("element", numbers);
  grid.values("culprit", culprit);
  return grid.text();
}

void write_files(const AssembledScene& assembled, const ElementModel& elements, const NodalState& nodal,
                 const Ties& ties, const Fault& fault, const std::string& path) {
  const double half_edge =
      assembled.scene.monitor.box > 0 ? assembled.scene.monitor.box : elements_about * std::cbrt(fault.element_volume);
  check_results_place(path);
  hdf5::File file = hdf5::File::create(path, kinds::fault());
  const hdf5::Group root = file.root(), parts = root.create_group("parts");
  root.set_attribute("fault", fault.summary());
  root.set_attribute("time", nodal.time);
  root.set_attribute("step", nodal.step);
  std::string grids;
  for (const auto& part : assembled.assembly.parts) {
    std::vector<int> numbers;
    for (int e = part.first_element; e < part.first_element + part.element_count; ++e)
      if (e == fault.element || in_box(assembled.assembly, e, fault.place, half_edge)) numbers.push_back(e);
    if (!numbers.empty())
      grids += write_part(assembled.assembly, elements, nodal, ties, fault, parts,
                          escaped(std::filesystem::path(path).filename().string()), part.name, numbers);
  }
  file.close();
  write_grids(xdmf_path(path), grids, kinds::fault_xdmf());
}

}  // namespace

std::string fault_path(const std::string& results_path) {
  return std::filesystem::path(results_path).replace_extension(".fault.h5").string();
}

void remove_fault_file(const std::string& path) {
  remove_own(path, kinds::fault());
  remove_own(xdmf_path(path), kinds::fault_xdmf());
}

bool write_fault_file(const AssembledScene& assembled, const ElementModel& elements, const NodalState& nodal,
                      const Ties& ties, const Fault& fault, const std::string& path) {
  remove_fault_file(path);  // an older run's
  if (fault.element < 0) return false;
  try {
    write_files(assembled, elements, nodal, ties, fault, path);
    return true;
  } catch (const std::exception& error) {
    remove_fault_file(path);
    std::fputs(fmt::format("railwave: warning: the surroundings of the fault could not be written: {}\n", error.what())
                   .c_str(),
               stderr);
    return false;
  }
}

}  // namespace railwave
