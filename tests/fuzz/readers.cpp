#include "tests/fuzz/readers.hpp"

#include <cstring>
#include <stdexcept>

#include "case/error.hpp"
#include "case/read_case.hpp"
#include "deck/import_deck.hpp"
#include "mesh/files/mesh_file.hpp"
#include "mesh/height_map.hpp"
#include "tests/temporary_folder.hpp"

namespace railwave::fuzz {
namespace {

/// With files that what is read may name: half of a case is in what it refers to.
struct Folder : TemporaryFolder {
  Folder() {
    write("mesh.inp",
          "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n"
          "*ELEMENT, TYPE=C3D8\n1,1,2,3,4,5,6,7,8\n");
    write("nodes.inp", "1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n");
    write("part.k",
          "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n"
          "*ELEMENT_SOLID\n1,1,1,2,3,4,5,6,7,8\n*PART\nbody\n1,1,1\n*SECTION_SOLID\n1,1\n"
          "*MAT_ELASTIC\n1,7800,2.1e11,.3\n");
    write("curve.csv", "time,force\n0,0\n1e-3,2\n");
  }
};

const Folder& folder() {
  static const Folder own;
  return own;
}

/// A message is worth the name when it begins with the file and says something.
void check_message(const char* message, const std::string& path) {
  if (std::strncmp(message, path.c_str(), path.size()) != 0 || std::strlen(message) < path.size() + 10)
    throw std::logic_error(std::string("a message that doesn't name the file: ") + message);
}

void check(bool good, const char* what) {
  if (!good) throw std::logic_error(what);
}

void check_sound(const Mesh& mesh) {
  const auto in = [](int i, std::size_t size) { return i >= 0 && static_cast<std::size_t>(i) < size; };
  check(!mesh.elements.empty(), "a mesh without elements");
  for (const auto& element : mesh.elements)
    for (int node : element) check(in(node, mesh.nodes.size()), "an element names a node that isn't there");
  for (const auto& [name, set] : mesh.node_sets)
    for (int node : set) check(in(node, mesh.nodes.size()), "a set names a node that isn't there");
  for (const auto& [name, set] : mesh.element_sets)
    for (int element : set) check(in(element, mesh.elements.size()), "a set names an element that isn't there");
  for (const auto& [name, faces] : mesh.surfaces)
    for (const Face& face : faces)
      check(in(face.element, mesh.elements.size()) && in(face.side, 6), "a surface has a face that isn't there");
}

void feed_case(std::string_view bytes) {
  const auto path = folder().write("case.toml", bytes);
  try {
    read_case(path);
  } catch (const InputError& error) {
    check_message(error.what(), path);
  }
}

template <Mesh (*read)(const std::string&, std::vector<std::string>*)>
void feed_mesh(std::string_view bytes, const char* name) {
  const auto path = folder().write(name, bytes);
  try {
    std::vector<std::string> notes;
    check_sound(read(path, &notes));
  } catch (const InputError&) {
  }
}

void feed_abaqus(std::string_view bytes) { feed_mesh<read_abaqus_file>(bytes, "case.inp"); }
void feed_gmsh(std::string_view bytes) { feed_mesh<read_gmsh_file>(bytes, "case.msh"); }

/// A deck that is taken gives a mesh and a case that are read again.
void feed_model(std::string_view bytes, const char* name) {
  const auto path = folder().write(name, bytes);
  deck::ImportOptions options;
  options.mesh_file = "imported.inp";
  if (bytes.size() % 4 != 0) options.units = "mm,t,s";  // else they are judged by the materials
  try {
    const deck::Import import = deck::import_deck(path, options);
    check(import.elements > 0, "a deck without elements is taken");
    const auto mesh = folder().write("imported.inp", import.mesh);
    const auto text = folder().write("imported.toml", import.text);
    std::vector<std::string> notes;
    try {
      check_sound(read_abaqus_file(mesh, &notes));
    } catch (const InputError& error) {
      throw std::logic_error(std::string("the mesh of a deck is refused: ") + error.what());
    }
    try {
      read_case(text);
    } catch (const InputError& error) {
      check_message(error.what(), text);
    }
  } catch (const InputError& error) {
    check(std::strlen(error.what()) > 10, "a message that says nothing");
  }
}

void feed_deck(std::string_view bytes) { feed_model(bytes, "case.k"); }
void feed_abaqus_model(std::string_view bytes) { feed_model(bytes, "case.inp"); }

/// Height maps, and the same bytes as the file of a curve.
void feed_tables(std::string_view bytes) {
  const auto path = folder().write("table.csv", bytes);
  try {
    const HeightMap map(path);
    for (const double x : {-1.0, 0.0, 0.01, 1e300})
      for (const double y : {-0.02, 0.0, 1.0}) map.at(x, y);
  } catch (const InputError& error) {
    check_message(error.what(), path);
  }
  static const std::string user =
      folder().write("table.toml",
                     "[materials.m]\nyoungs_modulus = 1\npoissons_ratio = 0\ndensity = 1\n[meshes.m]\n"
                     "type = \"box\"\n[parts.m]\nmesh = \"m\"\nmaterial = \"m\"\n[time]\nend = 1\n"
                     "[curves.c]\ntype = \"table\"\nfile = \"table.csv\"\n");
  try {
    read_case(user);
  } catch (const InputError&) {
  }
}

}  // namespace

const std::vector<Reader>& readers() {
  static const std::vector<Reader> all{
      {"case", feed_case},     {"abaqus", feed_abaqus}, {"gmsh", feed_gmsh},
      {"tables", feed_tables}, {"deck", feed_deck},     {"abaqus_model", feed_abaqus_model},
  };
  return all;
}

const Reader& find_reader(const std::string& name) {
  for (const Reader& reader : readers())
    if (reader.name == name) return reader;
  throw std::invalid_argument("there is no reader " + name);
}

}  // namespace railwave::fuzz
