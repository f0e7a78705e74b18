#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <utility>

#include "case/error.hpp"
#include "mesh/face_table.hpp"
#include "mesh/files/abaqus_lines.hpp"
#include "mesh/files/abaqus_sets.hpp"
#include "mesh/files/mesh_file.hpp"
#include "mesh/files/numbered_mesh.hpp"
#include "mesh/files/text_file.hpp"

namespace railwave {
namespace {

constexpr std::int64_t largest_number = std::numeric_limits<std::int32_t>::max();

class AbaqusReader {
 public:
  AbaqusReader(const std::string& path, std::vector<std::string>& notes)
      : notes_(notes), lines_(path, numbered_.files) {}

  Mesh read() {
    read_all();
    return finish();
  }

  AbaqusNumbers read_numbers() {
    read_all();
    Mesh mesh = connect(true);
    for (auto& [name, faces] : mesh.surfaces) sort_unique(faces);
    numbered_.move_nodes([&](std::size_t i, const Vec3&) { return mesh.nodes[i]; });
    return {numbered_, std::move(mesh)};
  }

 private:
  void read_all() {
    while (lines_.has_line()) {
      if (lines_.has_data()) {
        const auto field = std::string(lines_.take_fields()[0]);
        fail(lines_.place(),
             "'{}' stands where a keyword is expected; an Abaqus input file begins with a line such as *NODE",
             for_message(field));
      }
      read_block(lines_.take_keyword());
    }
  }

  enum class Scope { flat, part, assembly };

  struct SurfaceEntry {
    std::string target;  // an element's number or an element set's name
    std::string face;    // as written, lower case
    FilePlace place;
  };
  struct Surface {
    FilePlace place;
    bool internal = false;
    std::vector<SurfaceEntry> entries;
  };
  struct NodesOfElements {
    std::string node_set, element_set;
    FilePlace place;
  };

  template <typename... Arguments>
  [[noreturn]] void fail(const FilePlace& place, const char* text, const Arguments&... arguments) const {
    throw InputError(numbered_.where(place) + " " + fmt::format(fmt::runtime(text), arguments...));
  }

  void read_block(const AbaqusKeyword& keyword) {
    const std::string& name = keyword.name;
    if (name == "NODE") return read_nodes(keyword);
    if (name == "ELEMENT") return read_elements(keyword);
    if (name == "NSET") return read_set(keyword, node_sets_, "NSET");
    if (name == "ELSET") return read_set(keyword, element_sets_, "ELSET");
    if (name == "SURFACE") return read_surface(keyword);
    if (name == "PART") return begin_part(keyword);
    if (name == "INSTANCE") return begin_instance(keyword);
    if (name == "ASSEMBLY") scope_ = Scope::assembly;
    if (name == "ENDPART" || name == "ENDASSEMBLY") scope_ = Scope::flat;
    if (name == "ENDINSTANCE") scope_ = Scope::assembly;
    // Passing over one of these would leave a mesh other than the one meant.
    for (const char* maker : {"NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM"})
      if (name == maker)
        fail(keyword.place,
             "*{} makes nodes or elements, which isn't supported; let the program that wrote the file write "
             "all nodes and elements out",
             name);
    const bool structure = name == "ASSEMBLY" || name.substr(0, 3) == "END" || name == "HEADING";
    if (!structure) skipped_.try_emplace(name, keyword.place);
    skip_data();
  }

  void skip_data() {
    while (lines_.has_data()) lines_.take_fields();
  }

  std::int64_t number(std::string_view field, const char* what) const {
    const auto value = parse_integer(field);
    if (!value || *value < 1 || *value > largest_number)
      fail(lines_.place(), "'{}' is no {}; give a whole number from 1 to {}, with commas between numbers",
           for_message(field), what, largest_number);
    return *value;
  }

  double coordinate(std::string_view field, const char* what) const {
    if (field.empty()) return 0;  // Abaqus takes an empty field as zero
    const auto value = parse_real(field);
    if (!value)
      fail(lines_.place(), "'{}' is no {}; give a number, with commas between numbers", for_message(field), what);
    return *value;
  }

  void read_nodes(const AbaqusKeyword& keyword) {
    if (scope_ == Scope::assembly) {
      note_assembly(keyword);
      return skip_data();
    }
    if (const auto system = keyword.value("SYSTEM"); !system.empty() && system != "r")
      fail(keyword.place, "*NODE, SYSTEM={}: only rectangular coordinates (SYSTEM=R) are read; export them so", system);
    if (keyword.has("INPUT")) lines_.include(keyword);
    const auto set = keyword.value("NSET");
    if (!set.empty()) node_sets_.open(set, false, false, keyword.place);
    while (lines_.has_data()) {
      const auto fields = lines_.take_fields();
      const auto node = number(fields[0], "node number");
      if (fields.size() < 4)
        fail(lines_.place(), "node {} has {} of its three coordinates; write number, x, y, z", node, fields.size() - 1);
      numbered_.add_node(node,
                         {coordinate(fields[1], "coordinate"), coordinate(fields[2], "coordinate"),
                          coordinate(fields[3], "coordinate")},
                         lines_.place());
      if (!set.empty()) node_sets_.add_number(set, node, lines_.place());
    }
  }

  void read_elements(const AbaqusKeyword& keyword) {
    if (scope_ == Scope::assembly) {
      note_assembly(keyword);
      return skip_data();
    }
    const auto type = keyword.value("TYPE");
    if (type != "c3d8" && type != "c3d8r" && type != "c3d8i")
      fail(keyword.place,
           "*ELEMENT, TYPE={}: only 8-node hexahedra (C3D8, C3D8R, C3D8I) are read; mesh the part with "
           "these, or take this block out",
           type.empty() ? "(none)" : for_message(keyword.parameters.at("TYPE")));
    if (keyword.has("INPUT")) lines_.include(keyword);
    const auto set = keyword.value("ELSET");
    if (!set.empty()) element_sets_.open(set, false, false, keyword.place);
    while (lines_.has_data()) read_element(set);
  }

  void read_element(const std::string& set) {
    std::array<std::int64_t, 9> numbers{};
    std::size_t count = 0;
    FilePlace place;
    while (count < numbers.size()) {
      if (!lines_.has_data())
        fail(lines_.place(), "element {} ends after {} of its 8 nodes; complete it, the file may have been cut short",
             numbers[0], count - 1);
      for (const auto field : lines_.take_fields()) {
        if (count == 0) place = lines_.place();
        if (count == numbers.size())
          fail(lines_.place(), "element {} has more than 8 nodes; C3D8 has 8, quadratic elements aren't read",
               numbers[0]);
        numbers[count] = number(field, count == 0 ? "element number" : "node number");
        ++count;
      }
    }
    std::array<std::int64_t, 8> nodes{};
    std::copy(numbers.begin() + 1, numbers.end(), nodes.begin());
    numbered_.add_element(numbers[0], nodes, place);
    if (!set.empty()) element_sets_.add_number(set, numbers[0], place);
  }

  void read_set(const AbaqusKeyword& keyword, AbaqusSets& sets, const char* key) {
    const auto name = keyword.value(key);
    if (name.empty()) fail(keyword.place, "*{} has no name; write *{}, {}=name", key, key, key);
    check_instance(keyword);
    sets.open(name, scope_ == Scope::assembly, keyword.has("INTERNAL"), keyword.place);
    if (&sets == &node_sets_ && keyword.has("ELSET"))
      nodes_of_elements_.push_back({name, keyword.value("ELSET"), keyword.place});
    if (keyword.has("INPUT")) lines_.include(keyword);
    // In an assembly plain numbers are those of the assembly's own nodes, which are no part of the mesh.
    const bool own_numbers = scope_ == Scope::assembly && !keyword.has("INSTANCE");
    while (lines_.has_data()) {
      const auto fields = lines_.take_fields();
      if (keyword.has("GENERATE")) {
        read_range(name, fields, sets, own_numbers);
        continue;
      }
      for (const auto field : fields) {
        if (field.empty()) continue;
        const auto member = without_instance(field);
        if (!parse_integer(member))
          sets.add_set(name, member, lines_.place());
        else if (!own_numbers || member.size() != field.size())
          sets.add_number(name, number(member, "number of a set"), lines_.place());
        else
          note_assembly(keyword);
      }
    }
  }

  void read_range(const std::string& name, const std::vector<std::string_view>& fields, AbaqusSets& sets,
                  bool own_numbers) {
    if (fields.size() < 2 || fields.size() > 3)
      fail(lines_.place(), "a GENERATE line of set '{}' has {} entries; write first, last or first, last, step",
           for_message(name), fields.size());
    const auto first = number(fields[0], "first number"), last = number(fields[1], "last number");
    const auto step = fields.size() == 3 && !fields[2].empty() ? number(fields[2], "step") : 1;
    if (last < first)
      fail(lines_.place(), "the range {} to {} of set '{}' runs backwards; write the lower number first", first, last,
           for_message(name));
    if (!own_numbers) sets.add_range(name, first, last, step, lines_.place());
  }

  void read_surface(const AbaqusKeyword& keyword) {
    const auto name = keyword.value("NAME");
    if (name.empty()) fail(keyword.place, "*SURFACE has no name; write *SURFACE, NAME=name");
    const auto type = keyword.has("TYPE") ? keyword.value("TYPE") : "element";
    if ((type != "element" && type != "node") || keyword.has("COMBINE"))
      fail(keyword.place, "*SURFACE '{}': only TYPE=ELEMENT and TYPE=NODE, without COMBINE, are read; define it so",
           for_message(name));
    if (type == "node") return read_node_surface(name, keyword);
    const auto [entry, is_new] = surfaces_.try_emplace(name);
    if (!is_new)
      fail(keyword.place, "*SURFACE '{}' is defined again (first at {}); give each its own name", for_message(name),
           numbered_.where(entry->second.place));
    entry->second.place = keyword.place;
    entry->second.internal = keyword.has("INTERNAL");
    while (lines_.has_data()) {
      const auto fields = lines_.take_fields();
      entry->second.entries.push_back(
          {without_instance(fields[0]), fields.size() > 1 ? lower_case(fields[1]) : "", lines_.place()});
    }
  }

  void read_node_surface(const std::string& name, const AbaqusKeyword& keyword) {
    node_sets_.open(name, scope_ == Scope::assembly, keyword.has("INTERNAL"), keyword.place);
    while (lines_.has_data()) {
      const auto member = without_instance(lines_.take_fields()[0]);
      if (parse_integer(member))
        node_sets_.add_number(name, number(member, "node number"), lines_.place());
      else if (member != name)  // a surface may have the name of the set that it is made of
        node_sets_.add_set(name, member, lines_.place());
    }
  }

  void begin_part(const AbaqusKeyword& keyword) {
    if (part_)
      fail(keyword.place, "*PART '{}' is a second part; a mesh file holds one: write each part to a file of its own",
           for_message(keyword.value("NAME")));
    part_ = keyword.value("NAME");
    scope_ = Scope::part;
    skip_data();
  }

  void begin_instance(const AbaqusKeyword& keyword) {
    if (instance_)
      fail(keyword.place,
           "*INSTANCE '{}' is a second instance; a mesh file holds one: place the mesh several times as "
           "parts of the case, each with its position",
           for_message(keyword.value("NAME")));
    instance_ = keyword.value("NAME");
    scope_ = Scope::part;
    int line = 0;
    while (lines_.has_data()) {
      const auto fields = lines_.take_fields();
      if (++line > 1)
        fail(lines_.place(), "the instance is rotated, which isn't supported; rotate the part itself before export");
      for (std::size_t i = 0; i < 3 && i < fields.size(); ++i)
        translation_[i] = coordinate(fields[i], "component of the instance's translation");
    }
  }

  void check_instance(const AbaqusKeyword& keyword) const {
    const auto instance = keyword.value("INSTANCE");
    if (!instance.empty() && instance_ && instance != *instance_)
      fail(keyword.place, "INSTANCE={} isn't the file's instance '{}'; mend the name", for_message(instance),
           for_message(*instance_));
  }

  // A member as `instance.member` is written without the instance; lower case.
  std::string without_instance(std::string_view field) const {
    auto member = lower_case(field);
    if (member.size() >= 2 && member.front() == '"' && member.back() == '"')
      member = member.substr(1, member.size() - 2);
    if (instance_ && member.compare(0, instance_->size() + 1, *instance_ + ".") == 0)
      member.erase(0, instance_->size() + 1);
    return member;
  }

  void note_assembly(const AbaqusKeyword& keyword) {
    if (!assembly_noted_)
      notes_.push_back(
          fmt::format("{} the assembly's own nodes and elements were left out", numbered_.where(keyword.place)));
    assembly_noted_ = true;
  }

  /// All nodes and elements by position, with their sets.
  Mesh connect(bool with_internal) {
    Mesh mesh = numbered_.connect();
    for (Vec3& node : mesh.nodes)
      for (int i = 0; i < 3; ++i) node[i] += translation_[i];
    std::set<std::pair<std::string, std::string>> done;
    for (const auto& [node_set, element_set, place] : nodes_of_elements_) {
      if (!done.insert({node_set, element_set}).second) continue;
      for (int element : element_sets_.positions(element_set, place))
        for (int node : mesh.elements[element]) node_sets_.add_number(node_set, numbered_.node_numbers()[node], place);
    }
    mesh.node_sets = node_sets_.all(with_internal);
    mesh.element_sets = element_sets_.all(with_internal);
    make_surfaces(mesh, with_internal);
    return mesh;
  }

  Mesh finish() {
    Mesh mesh = connect(false);
    numbered_.complete(mesh, notes_);
    if (!skipped_.empty()) {
      std::vector<std::string> names;
      for (const auto& [name, place] : skipped_)
        names.push_back(fmt::format("*{} ({})", for_message(name), place.position));
      notes_.push_back(fmt::format("{}: keywords passed over, with the line of the first: {}", numbered_.files.front(),
                                   fmt::join(names, ", ")));
    }
    return mesh;
  }

  void make_surfaces(Mesh& mesh, bool with_internal) {
    for (const auto& [name, surface] : surfaces_) {
      if (surface.internal && !with_internal) continue;
      auto& faces = mesh.surfaces[name];
      for (const SurfaceEntry& entry : surface.entries) {
        add_faces(mesh, entry, faces);
        // As for sets: the same named again and again takes no more room.
        if (faces.size() > 12 * mesh.elements.size()) sort_unique(faces);
      }
    }
  }

  // Abaqus numbers the faces S1 = 1-2-3-4, S2 = 5-8-7-6, S3 = 1-5-6-2, S4 = 2-6-7-3, S5 = 3-7-8-4, S6 = 4-8-5-1: our
  // sides 0 to 5 in this order.
  void add_faces(const Mesh& mesh, const SurfaceEntry& entry, std::vector<Face>& faces) {
    std::vector<int> elements;
    if (const auto element_number = parse_integer(entry.target)) {
      const auto element = numbered_.find_element(*element_number);
      if (!element)
        fail(entry.place, "the surface names element {}, which the file doesn't define; mend the number",
             *element_number);
      elements.push_back(*element);
    } else {
      elements = element_sets_.positions(entry.target, entry.place);
    }
    if (entry.face.empty()) {
      if (exterior_.empty()) exterior_ = FaceTable(mesh).exterior();
      std::vector<char> wanted(mesh.elements.size(), 0);
      for (int element : elements) wanted[element] = 1;
      for (const Face& face : exterior_)
        if (wanted[face.element]) faces.push_back(face);
      return;
    }
    if (entry.face.size() != 2 || entry.face[0] != 's' || entry.face[1] < '1' || entry.face[1] > '6')
      fail(entry.place, "'{}' is no face of a hexahedron; write S1, S2, S3, S4, S5 or S6", for_message(entry.face));
    for (int element : elements) faces.push_back({element, entry.face[1] - '1'});
  }

  std::vector<std::string>& notes_;
  NumberedMesh numbered_;
  AbaqusLines lines_;
  AbaqusSets node_sets_{AbaqusSets::Of::nodes, numbered_};
  AbaqusSets element_sets_{AbaqusSets::Of::elements, numbered_};
  std::map<std::string, Surface> surfaces_;
  std::vector<NodesOfElements> nodes_of_elements_;
  std::map<std::string, FilePlace> skipped_;
  Scope scope_ = Scope::flat;
  std::optional<std::string> part_, instance_;
  Vec3 translation_{0, 0, 0};
  std::vector<Face> exterior_;
  bool assembly_noted_ = false;
};

}  // namespace

Mesh read_abaqus_file(const std::string& path, std::vector<std::string>* notes) {
  std::vector<std::string> unread;
  return AbaqusReader(path, notes ? *notes : unread).read();
}

AbaqusNumbers read_abaqus_numbers(const std::string& path) {
  std::vector<std::string> unread;
  return AbaqusReader(path, unread).read_numbers();
}

}  // namespace railwave
