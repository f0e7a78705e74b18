#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <type_traits>
#include <vector>

#include "mesh/mesh.hpp"
#include "output/atomic_file.hpp"
#include "output/hdf5/hdf5.hpp"

/// Grids of one instant for ParaView: arrays in an HDF5 file, and the XDMF text that names them.
namespace railwave {

inline std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
  return result;
}

/// A grid's name for ParaView.
inline std::string shown(const std::string& parent, const std::string& name) {
  return parent.empty() || parent == "/parts" ? name : parent.substr(1) + " " + name;
}

/// One grid: a group of the HDF5 file and the XDMF text that names its arrays.
class GridWriter {
 public:
  /// @param corners of a cell; 1: points
  GridWriter(const hdf5::Group& parent, const std::string& parent_path, const std::string& name,
             const std::string& file, int corners)
      : group_(parent.create_group(name)),
        path_(file + ":" + escaped(parent_path + "/" + name) + "/"),
        corners_(corners) {
    text_ = fmt::format("   <Grid Name=\"{}\" GridType=\"Uniform\">\n", escaped(shown(parent_path, name)));
  }

  void cells(const std::vector<Vec3>& nodes, std::vector<int> connectivity) {
    std::vector<double> flat;
    for (const Vec3& x : nodes) flat.insert(flat.end(), x.begin(), x.end());
    group_.write("coordinates", flat, {nodes.size(), 3});
    count_ = connectivity.size() / corners_;
    group_.write("connectivity", connectivity, {count_, static_cast<hsize_t>(corners_)});
    const char* type = corners_ == 8   ? "Hexahedron"
                       : corners_ == 4 ? "Quadrilateral"
                       : corners_ == 2 ? "Polyline"
                                       : "Polyvertex";
    text_ += fmt::format("    <Topology TopologyType=\"{}\" NodesPerElement=\"{}\" NumberOfElements=\"{}\">\n", type,
                         corners_, count_) +
             item("connectivity", fmt::format("{} {}", count_, corners_), "Int", 4) +
             "    </Topology>\n    <Geometry GeometryType=\"XYZ\">\n" +
             item("coordinates", fmt::format("{} 3", nodes.size()), "Float", 8) + "    </Geometry>\n";
  }

  /// @param components by node: 1, 3 or 6
  void node_values(const std::string& name, const std::vector<double>& by_node, int components) {
    write(name, by_node, components, "Node");
  }

  /// The same by cell.
  void cell_values(const std::string& name, const std::vector<double>& by_cell, int components) {
    write(name, by_cell, components, "Cell");
  }

  template <class Number>
  void values(const std::string& name, const std::vector<Number>& by_cell) {
    group_.write(name, by_cell, {by_cell.size()});
    const bool whole = std::is_same_v<Number, int>;
    text_ += fmt::format("    <Attribute Name=\"{}\" AttributeType=\"Scalar\" Center=\"Cell\">\n", name) +
             item(name, fmt::format("{}", by_cell.size()), whole ? "Int" : "Float", whole ? 4 : 8) +
             "    </Attribute>\n";
  }

  std::string text() const { return text_ + "   </Grid>\n"; }

 private:
  void write(const std::string& name, const std::vector<double>& values, int components, const char* centre) {
    const std::size_t count = values.size() / components;
    group_.write(name, values, {count, static_cast<hsize_t>(components)});
    text_ += fmt::format("    <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">\n", name,
                         components == 6   ? "Tensor6"
                         : components == 3 ? "Vector"
                                           : "Scalar",
                         centre) +
             item(name, fmt::format("{} {}", count, components), "Float", 8) + "    </Attribute>\n";
  }

  std::string item(const std::string& name, const std::string& shape, const char* number, int bytes) const {
    return fmt::format(
        "     <DataItem Format=\"HDF\" NumberType=\"{}\" Precision=\"{}\" Dimensions=\"{}\">{}{}</DataItem>\n", number,
        bytes, shape, path_, name);
  }

  hdf5::Group group_;
  std::string path_;
  int corners_;
  hsize_t count_ = 0;
  std::string text_;
};

/// Cells that use some of the model's nodes, with a numbering of their own.
struct Piece {
  std::vector<Vec3> nodes;
  std::vector<int> connectivity;

  Piece(const std::vector<Vec3>& all, const std::vector<int>& corners) {
    std::vector<int> used = corners;
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (int n : used) nodes.push_back(all[n]);
    for (int n : corners)
      connectivity.push_back(static_cast<int>(std::lower_bound(used.begin(), used.end(), n) - used.begin()));
  }
};

/// Writes the XDMF file of such grids, all of them one collection.
inline void write_grids(const std::string& path, const std::string& grids, const FileKind& kind) {
  write_whole_file(path,
                   "<?xml version=\"1.0\" ?>\n<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n" + xdmf_mark(kind) +
                       "<Xdmf Version=\"2.0\">\n <Domain>\n"
                       "  <Grid Name=\"model\" GridType=\"Collection\" CollectionType=\"Spatial\">\n" +
                       grids + "  </Grid>\n </Domain>\n</Xdmf>\n",
                   kind);
}

}  // namespace railwave
