#include "output/paraview_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "model/time_step/stable_step.hpp"
#include "output/grid_writer.hpp"
#include "output/results_writer.hpp"

namespace railwave {
namespace {

class ModelFileWriter {
 public:
  ModelFileWriter(const AssembledScene& assembled, const AbsorbingLayers& absorbing,
                  const std::vector<ConnectorCell>& connectors, const std::string& path, const std::vector<int>& ranks)
      : assembled_(assembled),
        absorbing_(absorbing),
        connectors_(connectors),
        ranks_(ranks),
        file_(hdf5::File::create(path, kinds::model())),
        name_(escaped(std::filesystem::path(path).filename().string())) {
    write_parts();
    write_sets();
    write_connectors();
    write_beams();
    write_names();
    file_.close();
  }

  const std::string& grids() const { return grids_; }

 private:
  void write_parts() {
    const hdf5::Group group = file_.root().create_group("parts");
    const auto steps = own_steps(assembled_, absorbing_);
    const double least = steps.empty() ? 1 : *std::min_element(steps.begin(), steps.end());
    for (std::size_t p = 0; p < assembled_.assembly.parts.size(); ++p) {
      const auto& part = assembled_.assembly.parts[p];
      std::vector<int> corners;
      std::vector<double> step, ratio;
      for (int e = part.first_element; e < part.first_element + part.element_count; ++e) {
        corners.insert(corners.end(), assembled_.assembly.elements[e].begin(), assembled_.assembly.elements[e].end());
        step.push_back(steps[e]);
        ratio.push_back(steps[e] / least);
      }
      const Piece piece(assembled_.assembly.nodes, corners);
      GridWriter grid(group, "/parts", part.name, name_, 8);
      grid.cells(piece.nodes, piece.connectivity);
      grid.values("part", std::vector<int>(step.size(), static_cast<int>(p)));
      grid.values("material", std::vector<int>(step.size(), part.material));
      grid.values("stable_step", step);
      grid.values("step_ratio", ratio);
      if (!ranks_.empty()) {
        const auto first = ranks_.begin() + part.first_element;
        grid.values("rank", std::vector<int>(first, first + part.element_count));
      }
      grids_ += grid.text();
    }
  }

  void write_sets() {
    const hdf5::Group surfaces = file_.root().create_group("surfaces"), sets = file_.root().create_group("node_sets");
    for (const auto& [name, faces] : assembled_.assembly.surfaces) {
      std::vector<int> corners;
      for (const Face& face : faces)
        for (int n : assembled_.assembly.face_nodes(face)) corners.push_back(n);
      if (!corners.empty()) write_piece(surfaces, "/surfaces", name, corners, 4);
    }
    for (const auto& [name, nodes] : assembled_.assembly.node_sets) {
      const bool whole = name.find('.') == std::string::npos;
      if (!whole && !nodes.empty() && assembled_.assembly.surfaces.count(name) == 0)
        write_piece(sets, "/node_sets", name, nodes, 1);
    }
    write_element_sets();
  }

  /// Those that the case picks by place; a mesh's own cover most of it.
  void write_element_sets() {
    if (assembled_.scene.element_sets.empty()) return;
    const hdf5::Group sets = file_.root().create_group("element_sets");
    for (const scene::ElementSet& set : assembled_.scene.element_sets) {
      const std::string name = set.part + "." + set.name;
      std::vector<int> corners;
      for (int e : assembled_.assembly.element_sets.at(name))
        corners.insert(corners.end(), assembled_.assembly.elements[e].begin(), assembled_.assembly.elements[e].end());
      write_piece(sets, "/element_sets", name, corners, 8);
    }
  }

  void write_piece(const hdf5::Group& group, const std::string& path, const std::string& name,
                   const std::vector<int>& corners, int count) {
    const Piece piece(assembled_.assembly.nodes, corners);
    GridWriter grid(group, path, name, name_, count);
    grid.cells(piece.nodes, piece.connectivity);
    grids_ += grid.text();
  }

  void write_connectors() {
    if (connectors_.empty()) return;
    std::vector<Vec3> places;
    std::vector<int> lines, number;
    std::vector<double> stiffness, damping;
    for (const ConnectorCell& cell : connectors_) {
      const scene::Connector& connector = assembled_.scene.connectors[cell.connector];
      Vec3 from = mean_place(cell.from, assembled_.assembly.nodes), to = mean_place(cell.to, assembled_.assembly.nodes);
      const auto stiffest =
          std::max_element(connector.stiffness.begin(), connector.stiffness.end()) - connector.stiffness.begin();
      constexpr double length = 0.1;
      for (int i = 0; i < 3; ++i) {
        if (cell.from.ground()) from[i] = to[i] - length * connector.axes[stiffest][i];
        if (cell.to.ground()) to[i] = from[i] - length * connector.axes[stiffest][i];
      }
      for (const Vec3& place : {from, to}) {
        lines.push_back(static_cast<int>(places.size()));
        places.push_back(place);
      }
      number.push_back(cell.connector);
      stiffness.push_back(cell.share * *std::max_element(connector.stiffness.begin(), connector.stiffness.end()));
      damping.push_back(cell.share * *std::max_element(connector.damping.begin(), connector.damping.end()));
    }
    GridWriter grid(file_.root(), "", "connectors", name_, 2);
    grid.cells(places, lines);
    grid.values("connector", number);
    grid.values("stiffness", stiffness);
    grid.values("damping", damping);
    grids_ += grid.text();
  }

  void write_beams() {
    std::vector<int> corners, number;
    std::vector<double> pretension;
    for (const Assembly::BeamChain& chain : assembled_.assembly.beam_chains)
      for (std::size_t k = 0; k + 1 < chain.nodes.size(); ++k) {
        corners.insert(corners.end(), {chain.nodes[k], chain.nodes[k + 1]});
        number.push_back(chain.beam);
        pretension.push_back(assembled_.scene.beams[chain.beam].pretension.value_or(0));
      }
    if (corners.empty()) return;
    const Piece piece(assembled_.assembly.nodes, corners);
    GridWriter grid(file_.root(), "", "beams", name_, 2);
    grid.cells(piece.nodes, piece.connectivity);
    grid.values("beam", number);
    grid.values("pretension", pretension);
    grids_ += grid.text();
  }

  void write_names() {
    const hdf5::Group root = file_.root();
    const auto names = [](const auto& entries) {
      std::vector<std::string> result;
      for (const auto& entry : entries) result.push_back(entry.name);
      return result;
    };
    root.set_attribute("title", assembled_.scene.title);
    root.set_attribute("part_names", names(assembled_.scene.parts));
    root.set_attribute("material_names", names(assembled_.scene.materials));
    if (!assembled_.scene.connectors.empty()) root.set_attribute("connector_names", names(assembled_.scene.connectors));
    if (!assembled_.scene.beams.empty()) root.set_attribute("beam_names", names(assembled_.scene.beams));
  }

  const AssembledScene& assembled_;
  const AbsorbingLayers& absorbing_;
  const std::vector<ConnectorCell>& connectors_;
  const std::vector<int>& ranks_;
  hdf5::File file_;
  std::string name_, grids_;
};

}  // namespace

void write_model_file(const AssembledScene& assembled, const AbsorbingLayers& absorbing,
                      const std::vector<ConnectorCell>& connectors, const std::string& path,
                      const std::vector<int>& ranks) {
  check_results_place(path);
  const ModelFileWriter writer(assembled, absorbing, connectors, path, ranks);
  write_grids(xdmf_path(path), writer.grids(), kinds::model_xdmf());
}

}  // namespace railwave
