#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include <cstdint>
#include <cstring>
#include <random>

#include "case/error.hpp"
#include "mesh/build_mesh.hpp"
#include "tests/mesh_files/mesh_checks.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;

namespace {

// Whether the mesh can be used without reading outside its arrays.
bool sound(const Mesh& mesh) {
  const auto in = [](int i, std::size_t size) { return i >= 0 && static_cast<std::size_t>(i) < size; };
  if (mesh.elements.empty()) return false;
  for (const auto& element : mesh.elements)
    for (int node : element)
      if (!in(node, mesh.nodes.size())) return false;
  for (const auto& [name, set] : mesh.node_sets)
    for (int node : set)
      if (!in(node, mesh.nodes.size())) return false;
  for (const auto& [name, set] : mesh.element_sets)
    for (int element : set)
      if (!in(element, mesh.elements.size())) return false;
  for (const auto& [name, faces] : mesh.surfaces)
    for (const Face& face : faces)
      if (!in(face.element, mesh.elements.size()) || !in(face.side, 6)) return false;
  return true;
}

// Reads damaged bytes: a sound mesh or an InputError with a text are the only ways out.
class Damage {
 public:
  explicit Damage(std::string ending) : ending_(std::move(ending)) {}

  void read(const std::string& bytes) {
    const scene::MeshSource source = source_of_file(folder_.write("damaged" + ending_, bytes));
    try {
      if (!sound(build_mesh(source))) ++unsound_;
    } catch (const InputError& error) {
      ++refused_;
      if (std::strlen(error.what()) < 20) ++unsound_;
    }
    ++tried_;
  }

  void check() const {
    CAPTURE(tried_, refused_);
    CHECK(unsound_ == 0);
    CHECK(refused_ > tried_ / 4);
  }

 private:
  TemporaryFolder folder_;
  std::string ending_;
  int tried_ = 0, refused_ = 0, unsound_ = 0;
};

const std::string small_deck =
    "*NODE, NSET=Nall\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n"
    "*ELEMENT, TYPE=C3D8, ELSET=Eall\n1,1,2,3,4,\n5,6,7,8\n*NSET, NSET=a, GENERATE\n1,4,1\n*NSET, NSET=b\na, 5\n"
    "*SURFACE, NAME=s\nEall, S1\n1, S2\n*SURFACE, NAME=t, TYPE=NODE\nb\n*MATERIAL, NAME=m\n*ELASTIC\n1., .3\n";

std::string ending_of(const std::string& name) { return name.substr(name.rfind('.')); }

std::string good_file(const std::string& name) { return name == "deck.inp" ? small_deck : text_of(test_data + name); }

}  // namespace

TEST_CASE("files cut short anywhere are refused or read, never worse") {
  const std::string name = GENERATE_COPY("small_ascii.msh", "small_binary.msh", "deck.inp", "block_ascii.msh",
                                         "block_binary.msh", "cantilever.inp");
  const auto bytes = good_file(name);
  const std::size_t step = bytes.size() > 10000 ? 997 : 1;
  CAPTURE(name);
  Damage damage(ending_of(name));
  for (std::size_t length = 0; length < bytes.size(); length += step) damage.read(bytes.substr(0, length));
  damage.check();
}

TEST_CASE("a Gmsh file cut before its elements' end is never taken for whole") {
  const std::string name = GENERATE_COPY("small_ascii.msh", "small_binary.msh");
  const TemporaryFolder folder;
  const auto bytes = text_of(test_data + name);
  const auto end = bytes.rfind("$EndElements") + std::string("$EndElements").size();
  for (std::size_t length = 0; length < end; ++length) {
    CAPTURE(name, length);
    CHECK_THROWS_AS(build_mesh(source_of_file(folder.write("cut.msh", bytes.substr(0, length)))), InputError);
  }
}

TEST_CASE("files with one byte changed are refused or read, never worse") {
  const std::string name = GENERATE_COPY("small_ascii.msh", "small_binary.msh", "deck.inp");
  const auto bytes = good_file(name);
  CAPTURE(name);
  Damage damage(ending_of(name));
  std::mt19937 random(20240229);
  for (std::size_t position = 0; position < bytes.size(); ++position) {
    auto flipped = bytes;
    flipped[position] = static_cast<char>(flipped[position] ^ (1 << random() % 8));
    damage.read(flipped);
    auto replaced = bytes;
    replaced[position] = "0-9$*,\n \xff"[random() % 9];
    damage.read(replaced);
  }
  CAPTURE(name);
  damage.check();
}

TEST_CASE("random bytes are no mesh") {
  std::mt19937 random(7);
  const std::string ending = GENERATE(".inp", ".msh");
  Damage damage(ending);
  for (int i = 0; i < 50; ++i) {
    std::string bytes(1 + random() % 500, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random() % 256);
    damage.read(bytes);
    damage.read("$MeshFormat\n4.1 1 8\n" + bytes);
  }
  damage.check();
}

TEST_CASE("a binary header that promises more than the file holds is refused before memory is asked for") {
  const auto bytes = text_of(test_data + "small_binary.msh");
  const std::string section = GENERATE("$Entities\n", "$Nodes\n", "$Elements\n");
  const int field = GENERATE(0, 1);
  const TemporaryFolder folder;
  auto damaged = bytes;
  const std::uint64_t count = std::uint64_t(1) << 61;
  std::memcpy(damaged.data() + damaged.find(section) + section.size() + 8 * field, &count, 8);
  const scene::MeshSource source = source_of_file(folder.write("huge.msh", damaged));
  CAPTURE(section, field);
  CHECK_THROWS_WITH(build_mesh(source), ContainsSubstring("huge.msh: byte ") &&
                                            ContainsSubstring("the header promises 2305843009213693952"));
}

TEST_CASE("a binary file of the other byte order, and one with a number that isn't finite, are refused") {
  const TemporaryFolder folder;
  auto swapped = text_of(test_data + "small_binary.msh");
  const auto mark = swapped.find("4.1 1 8\n") + 8;
  std::swap(swapped[mark], swapped[mark + 3]);
  CHECK_THROWS_WITH(build_mesh(source_of_file(folder.write("swapped.msh", swapped))),
                    ContainsSubstring("save the file as ASCII"));

  auto endless = text_of(test_data + "small_binary.msh");
  const double infinity = HUGE_VAL;
  // Header 4 x 8 bytes, block 3 x 4 + 8, one tag of 8: then the first coordinate.
  std::memcpy(endless.data() + endless.find("$Nodes\n") + 7 + 32 + 20 + 8, &infinity, 8);
  CHECK_THROWS_WITH(build_mesh(source_of_file(folder.write("endless.msh", endless))),
                    ContainsSubstring("node's coordinate isn't a finite number"));
}
