#include <fmt/format.h>

#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "case/error.hpp"
#include "mesh/face_table.hpp"
#include "mesh/files/gmsh_tokens.hpp"
#include "mesh/files/mesh_file.hpp"
#include "mesh/files/numbered_mesh.hpp"
#include "mesh/files/text_file.hpp"

namespace railwave {
namespace {

using Group = std::pair<int, std::int64_t>;  // dimension, physical tag

struct ElementType {
  const char* name;
  int dimension;
  int nodes;
};

// Element types by Gmsh's numbers (Gmsh reference manual, "MSH file format"). Only first-order ones can stand beside
// 8-node hexahedra, so the others serve messages.
const std::map<std::int64_t, ElementType> element_types = {
    {1, {"2-node lines", 1, 2}},        {2, {"3-node triangles", 2, 3}},     {3, {"4-node quadrangles", 2, 4}},
    {4, {"4-node tetrahedra", 3, 4}},   {5, {"8-node hexahedra", 3, 8}},     {6, {"6-node prisms", 3, 6}},
    {7, {"5-node pyramids", 3, 5}},     {8, {"3-node lines", 1, 3}},         {9, {"6-node triangles", 2, 6}},
    {10, {"9-node quadrangles", 2, 9}}, {11, {"10-node tetrahedra", 3, 10}}, {12, {"27-node hexahedra", 3, 27}},
    {13, {"18-node prisms", 3, 18}},    {14, {"14-node pyramids", 3, 14}},   {15, {"points", 0, 1}},
    {16, {"8-node quadrangles", 2, 8}}, {17, {"20-node hexahedra", 3, 20}},  {18, {"15-node prisms", 3, 15}},
    {19, {"13-node pyramids", 3, 13}},
};

constexpr const char* how_to_export =
    "in Gmsh set Mesh.MshFileVersion = 4.1 (or export as \"Version 4 ASCII\") and save again";

class GmshReader {
 public:
  GmshReader(const std::string& path, std::vector<std::string>& notes)
      : notes_(notes), path_(path), bytes_(read_whole_file(path)), tokens_(bytes_, path) {
    numbered_.files.push_back(path);
  }

  Mesh read() {
    read_format();
    for (auto heading = tokens_.text_line(); !heading.empty(); heading = tokens_.text_line())
      read_section(std::string(heading));
    for (const char* section : {"$Nodes", "$Elements"})
      if (!sections_.count(section))
        tokens_.fail(
            fmt::format("the file ends without a {} section: it has no mesh or was cut short; mesh in 3D and save "
                        "again",
                        section));
    return finish();
  }

 private:
  struct Quadrangle {
    std::int64_t number;
    std::array<std::int64_t, 4> nodes;
    FilePlace place;
  };
  struct NamedNode {
    std::int64_t number;
    FilePlace place;
  };

  [[noreturn]] void fail(const FilePlace& place, const std::string& text) const {
    throw InputError(numbered_.where(place) + " " + text);
  }

  void read_format() {
    const auto heading = tokens_.text_line();
    if (heading != "$MeshFormat")
      tokens_.fail(
          fmt::format("'{}' stands where $MeshFormat is expected; this is no Gmsh mesh file of version 4.1: {}",
                      for_message(heading), how_to_export));
    const auto version = tokens_.real("version of the format");
    if (version != 4.1)
      tokens_.fail(fmt::format("the format's version is {}, but only 4.1 is read; {}", version, how_to_export));
    const auto binary = tokens_.integer("file type");
    if (binary != 0 && binary != 1)
      tokens_.fail(fmt::format("the file type is {}; 0 (ASCII) or 1 (binary) are known", binary));
    const auto data_size = tokens_.integer("data size");
    if (data_size != 8)
      tokens_.fail(fmt::format("the data size is {}, but only 8 bytes are read; {}", data_size, how_to_export));
    if (binary == 1) {
      tokens_.end_line();
      read_byte_order();
    }
    end_section("$MeshFormat");
  }

  void read_byte_order() {
    numbered_.binary = true;
    tokens_.set_binary(true);
    if (tokens_.raw_integer("byte order mark") != 1)
      tokens_.fail("the bytes run in another order than on this machine; save the file as ASCII (Mesh.Binary = 0)");
  }

  void end_section(const std::string& heading) {
    const auto line = tokens_.text_line();
    const auto ending = "$End" + heading.substr(1);
    if (line == ending) return;
    if (line.empty())
      tokens_.fail(
          fmt::format("the file ends inside {}, before {}: it was cut short; write it again", heading, ending));
    tokens_.fail(
        fmt::format("'{}' stands where {} is expected: the section has more entries than its counts say, or is "
                    "damaged; write the file again",
                    for_message(line), ending));
  }

  void read_section(const std::string& heading) {
    if (heading[0] != '$' || heading.compare(0, 4, "$End") == 0)
      tokens_.fail(
          fmt::format("'{}' stands where a section such as $Nodes is expected; the file is damaged, write it again",
                      for_message(heading)));
    const bool known = heading == "$PhysicalNames" || heading == "$Entities" || heading == "$Nodes" ||
                       heading == "$Elements" || heading == "$MeshFormat";
    if (known && (!sections_.insert(heading).second || heading == "$MeshFormat"))
      tokens_.fail(fmt::format("there is a second {} section; keep one", heading));
    if (heading == "$PartitionedEntities")
      tokens_.fail("the mesh is partitioned, which isn't read; save it before partitioning");
    if (heading == "$PhysicalNames") read_physical_names();
    // From here on the known sections' bytes are numbers, beginning after the heading's line break.
    else if (known && tokens_.binary())
      tokens_.end_line();
    if (heading == "$Entities") read_entities();
    if (heading == "$Nodes") read_nodes();
    if (heading == "$Elements") {
      if (!sections_.count("$Nodes"))
        tokens_.fail("$Elements stands before $Nodes; Gmsh writes $Nodes first: put the sections in this order");
      read_elements();
    }
    if (known)
      end_section(heading);
    else if (!tokens_.skip_past("$End" + heading.substr(1)))
      tokens_.fail(fmt::format("section '{}' has no $End{}: the file was cut short; write it again",
                               for_message(heading), for_message(heading.substr(1))));
  }

  // This section is text in binary files too.
  void read_physical_names() {
    const auto count = parse_integer(tokens_.text_line());
    if (!count || *count < 0) tokens_.fail("the number of physical names is expected here");
    for (std::int64_t i = 0; i < *count; ++i) {
      const auto line = tokens_.text_line();
      if (line.empty()) tokens_.fail("the file ends inside $PhysicalNames: it was cut short; write it again");
      const auto blank = line.find(' '), first_quote = line.find('"'), last_quote = line.rfind('"');
      const bool formed =
          blank != line.npos && first_quote != line.npos && blank < first_quote && first_quote < last_quote;
      const auto dimension = formed ? parse_integer(line.substr(0, blank)) : std::nullopt;
      const auto tag = formed ? parse_integer(trim(line.substr(blank, first_quote - blank))) : std::nullopt;
      if (!dimension || !tag || *dimension < 0 || *dimension > 3)
        tokens_.fail(fmt::format("'{}' is no physical name; dimension (0 to 3), tag and \"name\" are expected",
                                 for_message(line)));
      const auto name = line.substr(first_quote + 1, last_quote - first_quote - 1);
      if (!name.empty()) names_[{static_cast<int>(*dimension), *tag}] = std::string(name);
    }
  }

  void read_entities() {
    std::int64_t counts[4];
    for (auto& count : counts) count = tokens_.size("number of entities");
    for (int dimension = 0; dimension < 4; ++dimension) {
      tokens_.expect_numbers(counts[dimension], 5, "entities");
      for (std::int64_t i = 0; i < counts[dimension]; ++i) {
        const auto tag = tokens_.integer("entity's tag");
        const int coordinates = dimension == 0 ? 3 : 6;
        for (int c = 0; c < coordinates; ++c) tokens_.real("entity's coordinate");
        const auto groups = tokens_.size("number of physical tags");
        tokens_.expect_numbers(groups, 1, "physical tags");
        for (std::int64_t g = 0; g < groups; ++g) {
          // A minus sign only says that the group turns the entity round.
          const auto group = tokens_.integer("physical tag");
          groups_[{dimension, tag}].push_back({dimension, group < 0 ? -group : group});
        }
        if (dimension == 0) continue;
        const auto boundaries = tokens_.size("number of bounding entities");
        tokens_.expect_numbers(boundaries, 1, "bounding entities");
        for (std::int64_t b = 0; b < boundaries; ++b) tokens_.integer("bounding entity's tag");
      }
    }
  }

  int dimension() {
    const auto value = tokens_.integer("entity's dimension");
    if (value < 0 || value > 3) tokens_.fail(fmt::format("{} is no dimension; 0 to 3 are known", value));
    return static_cast<int>(value);
  }

  void read_nodes() {
    const auto blocks = tokens_.size("number of node blocks"), total = tokens_.size("number of nodes");
    tokens_.size("lowest node tag");
    tokens_.size("highest node tag");
    tokens_.expect_numbers(blocks, 4, "node blocks");
    tokens_.expect_numbers(total, 4, "nodes");
    if (total > std::numeric_limits<int>::max()) tokens_.fail("more nodes than can be numbered; split the mesh");
    std::vector<std::pair<std::int64_t, FilePlace>> tags;
    for (std::int64_t block = 0; block < blocks; ++block) {
      const int entity_dimension = dimension();
      tokens_.integer("entity's tag");
      const auto parametric = tokens_.integer("parametric flag");
      if (parametric != 0 && parametric != 1)
        tokens_.fail(fmt::format("the parametric flag is {}; 0 and 1 are known", parametric));
      const auto count = tokens_.size("number of nodes in the block");
      tokens_.expect_numbers(count, 4, "nodes in this block");
      tags.clear();
      for (std::int64_t i = 0; i < count; ++i) {
        const auto tag = tokens_.size("node tag");
        tags.emplace_back(tag, tokens_.place());
      }
      for (const auto& [tag, place] : tags) {
        Vec3 position;
        for (double& coordinate : position) coordinate = tokens_.real("node's coordinate");
        if (parametric == 1)
          for (int i = 0; i < entity_dimension; ++i) tokens_.real("node's parameter");
        numbered_.add_node(tag, position, place);
      }
    }
    if (static_cast<std::int64_t>(numbered_.node_count()) != total)
      tokens_.fail(fmt::format("$Nodes promises {} nodes, but its blocks hold {}; the file is damaged, write it again",
                               total, numbered_.node_count()));
  }

  void read_elements() {
    const auto blocks = tokens_.size("number of element blocks"), total = tokens_.size("number of elements");
    tokens_.size("lowest element tag");
    tokens_.size("highest element tag");
    tokens_.expect_numbers(blocks, 4, "element blocks");
    tokens_.expect_numbers(total, 2, "elements");
    std::int64_t found = 0;
    for (std::int64_t block = 0; block < blocks; ++block) {
      const int entity_dimension = dimension();
      const auto entity = tokens_.integer("entity's tag");
      const auto type = element_type();
      const auto count = tokens_.size("number of elements in the block");
      tokens_.expect_numbers(count, type.nodes + 1, "elements in this block");
      if (type.dimension != entity_dimension)
        tokens_.fail(fmt::format("an entity of dimension {} can't hold {}; the file is damaged, write it again",
                                 entity_dimension, type.name));
      const auto groups = groups_.find({entity_dimension, entity});
      read_block(type, count, groups == groups_.end() ? std::vector<Group>() : groups->second);
      found += count;
    }
    if (found != total)
      tokens_.fail(fmt::format(
          "$Elements promises {} elements, but its blocks hold {}; the file is damaged, write it again", total, found));
  }

  ElementType element_type() {
    const auto number = tokens_.integer("element type");
    const auto entry = element_types.find(number);
    if (entry == element_types.end())
      tokens_.fail(fmt::format("element type {} isn't known; save a first-order mesh of 8-node hexahedra", number));
    const ElementType& type = entry->second;
    const bool first_order = number <= 7 || number == 15;
    if (!first_order)
      tokens_.fail(
          fmt::format("there are {}, but only first-order elements are read; set Mesh.ElementOrder = 1 and mesh "
                      "again",
                      type.name));
    if (type.dimension == 3 && number != 5)
      tokens_.fail(
          fmt::format("there are {}, but solids must be 8-node hexahedra; use transfinite or extruded volumes with "
                      "Recombine, or Mesh.SubdivisionAlgorithm = 2",
                      type.name));
    return type;
  }

  void read_block(const ElementType& type, std::int64_t count, const std::vector<Group>& groups) {
    std::array<std::int64_t, 8> nodes{};
    for (std::int64_t i = 0; i < count; ++i) {
      const auto number = tokens_.size("element tag");
      const auto place = tokens_.place();
      for (int n = 0; n < type.nodes; ++n) nodes[n] = tokens_.size("element's node tag");
      if (type.dimension == 3) {
        numbered_.add_element(number, nodes, place);
        for (const Group& group : groups) volumes_[group].push_back(static_cast<int>(numbered_.element_count()) - 1);
      } else if (type.dimension == 2) {
        if (type.nodes != 4 && !groups.empty())
          fail(place,
               fmt::format("surface '{}' has triangles, which are no faces of hexahedra; set Recombine Surface and "
                           "mesh again",
                           name_of(groups.front())));
        for (const Group& group : groups)
          quadrangles_[group].push_back({number, {nodes[0], nodes[1], nodes[2], nodes[3]}, place});
      } else {
        for (const Group& group : groups)
          for (int n = 0; n < type.nodes; ++n) node_groups_[group].push_back({nodes[n], place});
      }
    }
  }

  std::string name_of(const Group& group) const {
    const auto entry = names_.find(group);
    return entry != names_.end() ? entry->second : fmt::format("physical_{}", group.second);
  }

  int node(std::int64_t number, const FilePlace& place, const std::string& owner) const {
    const auto position = numbered_.find_node(number);
    if (!position)
      fail(place, fmt::format("{} names node {}, which the file doesn't define; write the file again", owner, number));
    return *position;
  }

  Mesh finish() {
    Mesh mesh = numbered_.connect();
    for (const auto& [group, elements] : volumes_) {
      auto& set = mesh.element_sets[name_of(group)];
      set.insert(set.end(), elements.begin(), elements.end());
    }
    if (!quadrangles_.empty()) make_surfaces(mesh);
    make_node_sets(mesh);
    if (volumes_.empty() && quadrangles_.empty() && node_groups_.empty())
      notes_.push_back(
          fmt::format("{}: no physical groups, so the only set is 'exterior'; add Physical Surface and "
                      "Physical Volume in Gmsh to name parts of the mesh",
                      path_));
    numbered_.complete(mesh, notes_);
    return mesh;
  }

  // Points before curves, so that a name shared by both means the points. Surfaces and volumes add theirs in
  // complete().
  void make_node_sets(Mesh& mesh) {
    std::map<std::string, int> dimension_of;
    for (const auto& [group, members] : node_groups_) {
      const auto name = name_of(group);
      if (dimension_of.try_emplace(name, group.first).first->second != group.first) {
        notes_.push_back(
            fmt::format("{}: physical curve '{}' was left out: a physical point has that name", path_, name));
        continue;
      }
      auto& set = mesh.node_sets[name];
      for (const auto& [number, place] : members) set.push_back(node(number, place, fmt::format("group '{}'", name)));
    }
  }

  void make_surfaces(Mesh& mesh) {
    const FaceTable table(mesh);
    for (const auto& [group, quadrangles] : quadrangles_) {
      auto& surface = mesh.surfaces[name_of(group)];
      for (const Quadrangle& quadrangle : quadrangles) surface.push_back(face_of(mesh, table, quadrangle, group));
    }
  }

  Face face_of(const Mesh& mesh, const FaceTable& table, const Quadrangle& quadrangle, const Group& group) const {
    const auto owner = fmt::format("quadrangle {} of surface '{}'", quadrangle.number, name_of(group));
    std::array<int, 4> nodes;
    for (int i = 0; i < 4; ++i) nodes[i] = node(quadrangle.nodes[i], quadrangle.place, owner);
    const auto faces = table.find(nodes);
    if (faces.empty())
      fail(quadrangle.place,
           fmt::format("{} is no face of a hexahedron; mesh the volume behind this surface too, or take "
                       "the surface out of the physical group",
                       owner));
    for (const Face& face : faces) {
      const auto outward = mesh.face_nodes(face);
      for (int start = 0; start < 4; ++start)
        if (outward[start] == nodes[0] && outward[(start + 1) % 4] == nodes[1]) return face;
    }
    return faces.front();
  }

  std::vector<std::string>& notes_;
  std::string path_;
  std::string bytes_;
  GmshTokens tokens_;
  NumberedMesh numbered_;
  std::set<std::string> sections_;
  std::map<Group, std::string> names_;
  std::map<Group, std::vector<Group>> groups_;  // of an entity: dimension and tag -> physical groups
  std::map<Group, std::vector<int>> volumes_;
  std::map<Group, std::vector<Quadrangle>> quadrangles_;
  std::map<Group, std::vector<NamedNode>> node_groups_;
};

}  // namespace

Mesh read_gmsh_file(const std::string& path, std::vector<std::string>* notes) {
  std::vector<std::string> unread;
  return GmshReader(path, notes ? *notes : unread).read();
}

}  // namespace railwave
