#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include <map>
#include <string>

#include "case/error.hpp"
#include "case/read_case.hpp"
#include "deck/import_deck.hpp"
#include "mesh/files/mesh_file.hpp"
#include "source_folder.hpp"
#include "tests/temporary_folder.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;

namespace {

const std::string nodes = "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n";
const std::string solid = "*ELEMENT_SOLID\n1,1,1,2,3,4,5,6,7,8\n";
const std::string steel = "*MAT_ELASTIC\n1,7800,2.1e11,.3\n";
const std::string part = "*PART\nbody\n1,1,1\n*SECTION_SOLID\n1,1\n";
const std::string end = "*CONTROL_TERMINATION\n1e-4\n";
const std::string cube = "*KEYWORD\n" + nodes + solid + steel + part + end;

class Decks {
 public:
  deck::Import take(const std::string& text, const std::string& units = "", std::vector<std::string> drop = {},
                    const std::string& name = "deck.k") {
    deck::ImportOptions options;
    options.units = units;
    options.drop = std::move(drop);
    return deck::import_deck(folder_.write(name, text), options);
  }
  /// Why it is refused, without the folder's name; "" when it is taken.
  std::string refusal(const std::string& text, std::vector<std::string> drop = {}, const std::string& name = "deck.k") {
    try {
      take(text, "", std::move(drop), name);
      return "";
    } catch (const InputError& error) {
      const std::string said = error.what();
      const auto begin = said.find(name + ":");
      return begin == std::string::npos ? said : said.substr(begin);
    }
  }
  void add(const std::string& name, const std::string& text) { folder_.write(name, text); }

  /// The case as it is read, with the mesh beside it.
  scene::Scene scene_of(const deck::Import& import) {
    folder_.write("deck.inp", import.mesh);
    return read_case(folder_.write("deck.toml", import.text));
  }
  Mesh mesh_of(const deck::Import& import) { return read_abaqus_file(folder_.write("deck.inp", import.mesh)); }

 private:
  TemporaryFolder folder_;
};

/// A line of fields of so many columns each.
std::string columns(std::initializer_list<const char*> fields, std::size_t width) {
  std::string line;
  for (const std::string field : fields) line += std::string(width - field.size(), ' ') + field;
  return line + "\n";
}

}  // namespace

TEST_CASE("one cube by commas, by columns, by ten columns and in the long format is the same") {
  Decks decks;
  const auto expected = decks.take(cube);
  const std::string tail = steel + part + end;
  std::string by_columns = "*KEYWORD\n*NODE\n", ten = "*KEYWORD I10=Y\n*NODE\n", twenty = "*KEYWORD LONG=Y\n*NODE\n",
              marked = "*KEYWORD\n*NODE %\n", mixed = "*KEYWORD LONG=Y\n*NODE +\n";
  const char* x[8][4] = {{"1", "0", "0", "0"}, {"2", "1", "0", "0"}, {"3", "1", "1.", "0"}, {"4", "0", "1", "0"},
                         {"5", "0", "0", "1"}, {"6", "1", "0", "1"}, {"7", "1", "1", "1"},  {"8", "0", "1.0+0", "1"}};
  for (const auto& row : x) {
    const std::string rest = columns({row[1], row[2], row[3]}, 16);
    by_columns += std::string(7, ' ') + row[0] + rest;
    ten += std::string(9, ' ') + row[0] + rest;
    marked += std::string(9, ' ') + row[0] + rest;
    twenty += columns({row[0], row[1], row[2], row[3]}, 20);
    mixed += columns({row[0], row[1], row[2], row[3]}, 20);
  }
  const std::initializer_list<const char*> element = {"1", "1", "1", "2", "3", "4", "5", "6", "7", "8"};
  by_columns += "*ELEMENT_SOLID (one line)\n" + columns(element, 8);
  ten += "*ELEMENT_SOLID\n" + columns(element, 10);
  marked +=
      "*ELEMENT_SOLID\n" + columns({"1", "1"}, 8) + columns({"1", "2", "3", "4", "5", "6", "7", "8", "0", "0"}, 8);
  twenty += "*ELEMENT_SOLID\n" + columns(element, 20);
  mixed += "*ELEMENT_SOLID -\n" + columns(element, 8);
  for (const std::string& text : {by_columns, ten, twenty, marked, mixed}) {
    CAPTURE(text);
    const auto import = decks.take(text + tail);
    CHECK(import.mesh == expected.mesh);
    CHECK(import.text == expected.text);
  }
}

TEST_CASE("Windows line ends, comments, empty lines and small letters change nothing") {
  Decks decks;
  const auto expected = decks.take(cube);
  std::string text = cube;
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.replace(at, 1, "\r\n");
  CHECK(decks.take(text).text == expected.text);
  CHECK(decks.take("$ a remark\n" + cube + "\n\n*END\nanything\n").mesh == expected.mesh);
  CHECK(decks.take("*keyword\n" + nodes + "$ here too\n*element_solid\n1,1,1,2,3,4,5,6,7,8\n\n\n" + steel + part + end)
            .mesh == expected.mesh);
}

TEST_CASE("parameters, expressions and included files stand for numbers") {
  Decks decks;
  decks.add("solid.k", solid + "*END\n*BLABLA\n");
  decks.add("folder/part.k", part);
  const auto import = decks.take(
      "*KEYWORD\n*PARAMETER\nR youngs      2.1e11I mat              1\n"
      "*PARAMETER_EXPRESSION\nR half    &youngs/2*(1+0**2)\n*INCLUDE_PATH\nfolder\n" +
      nodes + "*INCLUDE\nsolid.k\n*MAT_ELASTIC\n&mat,7800,<&half*2>,.3\n*INCLUDE\npart.k\n" + end);
  const auto scene = decks.scene_of(import);
  REQUIRE(scene.materials.size() == 1);
  CHECK(scene.materials[0].youngs_modulus == 2.1e11);
  CHECK(import.files.size() == 3);
}

TEST_CASE("an included file is moved, turned and numbered anew") {
  Decks decks;
  decks.add("cube.k", nodes + solid + steel + part);
  const std::string transformed =
      "*INCLUDE_TRANSFORM\ncube.k\n       100       200        10        20\n        30\n\n"
      "         7\n";
  const auto import = decks.take("*KEYWORD\n*INCLUDE\ncube.k\n" + transformed +
                                 "*DEFINE_TRANSFORMATION\n7\nTRANSL,5,0,0\nROTATE,0,0,1,0,0,0,90\n" + end);
  CHECK(import.elements == 2);
  const auto mesh = decks.mesh_of(import);
  // Turned first: node 102 comes from (1, 0, 0) to (0, 1, 0), then 5 along x.
  REQUIRE(mesh.nodes.size() == 16);
  CHECK(std::abs(mesh.nodes[9][0] - 5) < 1e-12);
  CHECK(std::abs(mesh.nodes[9][1] - 1) < 1e-12);
  CHECK_THAT(import.text, ContainsSubstring("[parts.body]") && ContainsSubstring("[parts.body_part_11]"));
}

TEST_CASE("everything that is taken comes into a case that can be read, in SI units") {
  Decks decks;
  const auto import = decks.take(text_of(std::string(source_folder) + "/tests/deck/data/everything.k"), "mm,kg,ms");
  const auto scene = decks.scene_of(import);
  REQUIRE(scene.parts.size() == 3);
  CHECK(scene.materials[1].yield_stress == 250e6);
  CHECK(scene.materials[1].density == 7850);
  CHECK(scene.parts[0].mass_damping == 500);
  CHECK(scene.parts[0].stiffness_damping == 1e-9);
  CHECK(scene.parts[1].hourglass == scene::HourglassType::stiffness);
  CHECK(scene.parts[1].quadratic_bulk_viscosity == 1.4);
  CHECK(scene.time.end == 1e-6);
  CHECK(scene.time.step_scale == 0.8);
  REQUIRE(scene.connectors.size() == 2);
  CHECK(scene.connectors[0].stiffness[0] == 1e6);
  CHECK(scene.connectors[1].damping[0] == 10);
  CHECK(scene.connectors[0].to == "ground");
  REQUIRE(scene.loads.size() == 3);
  CHECK(scene.loads[0].force[2] == -40);  // -0.01 kN on each of four nodes
  CHECK(scene.loads[1].pressure == 1e6);
  CHECK(scene.gravity[2] == -9.81);
  CHECK(scene.contacts[0].friction_decay == 1);
  CHECK(scene.contacts[0].dynamic_friction == 0.2);
  CHECK(scene.initial_motions.size() == 2);
  CHECK(scene.prescribed_motions[0].velocity[1] == -1);
  CHECK(scene.ties.size() == 1);  // parts of two materials that share nodes
  CHECK(scene.beams[0].radius == 1e-3);
  CHECK(scene.points[0].mass == 5e-4);
  CHECK(scene.non_reflecting.size() == 1);
  CHECK(scene.curves[0].points.size() == 3);
  CHECK_THAT(import.report, ContainsSubstring("deck.k:148: *LOAD_SEGMENT_SET: taken: [loads.pressure_1]"));
}

TEST_CASE("parts that share nodes and settings are one part") {
  Decks decks;
  const std::string second =
      "*NODE\n9,2,0,0\n10,2,1,0\n11,2,0,1\n12,2,1,1\n*ELEMENT_SOLID\n2,2,2,9,10,3,6,11,12,7\n"
      "*PART\nother\n2,1,1\n";
  const auto import = decks.take(cube + second);
  CHECK(import.parts == 1);
  CHECK_THAT(import.report, ContainsSubstring("part 2 is within [parts.body]"));
  const auto tied = decks.take(cube + second + "*PART\nthird\n3,1,1\n*MAT_ELASTIC\n2,7800,1e11,.3\n*NODE\n");
  CHECK(tied.parts == 1);
}

TEST_CASE("a pressure on segments that look inwards pulls") {
  Decks decks;
  const std::string curve = "*DEFINE_CURVE\n1\n0,1\n1,2\n";
  const auto out = decks.scene_of(decks.take(cube + curve + "*LOAD_SEGMENT\n1,2.0,0,5,6,7,8\n"));
  const auto in = decks.scene_of(decks.take(cube + curve + "*LOAD_SEGMENT\n1,2.0,0,8,7,6,5\n"));
  CHECK(out.loads[0].pressure == 2);
  CHECK(in.loads[0].pressure == -2);
}

TEST_CASE("a node or segment that is loaded twice has both loads") {
  Decks decks;
  const std::string curve = "*DEFINE_CURVE\n1\n0,1\n1,2\n";
  // 4 N and 2 N of nodes 5 and 6, by loads of 2 N each.
  const auto import = decks.take(cube + curve + "*LOAD_NODE_POINT\n5,3,1,2.0\n5,3,1,2.0\n6,3,1,2.0\n");
  const auto forces = decks.scene_of(import).loads;
  REQUIRE(forces.size() == 2);
  const Mesh mesh = decks.mesh_of(import);
  std::map<int, double> at_node;
  for (const auto& load : forces) {
    const auto& nodes = mesh.node_sets.at(load.target.substr(std::string("body.").size()));
    for (const int n : nodes) at_node[n] += load.force[2] / nodes.size();
  }
  CHECK(at_node == std::map<int, double>{{4, 4}, {5, 2}});
  double pressure = 0;
  const auto loads = decks.scene_of(decks.take(cube + curve + "*LOAD_SEGMENT\n1,2,0,5,6,7,8\n1,2,0,6,7,8,5\n")).loads;
  for (const auto& load : loads) pressure += load.pressure;
  CHECK(pressure == 4);
}

TEST_CASE("a curve of DAMPING_GLOBAL stands in place of its constant") {
  Decks decks;
  const auto damped = [&](const std::string& card) {
    return decks.scene_of(decks.take(cube + "*DAMPING_GLOBAL\n" + card + "*DEFINE_CURVE\n1\n0,30\n1,30\n"))
        .parts[0]
        .mass_damping;
  };
  CHECK(damped("1\n") == 30);
  CHECK(damped("1,5\n") == 30);
  CHECK(damped("0,5\n") == 5);
}

TEST_CASE("an empty line is a card: a title, a wall for all nodes; cards that nothing reads are refused") {
  Decks decks;
  const auto scene = decks.scene_of(
      decks.take(cube + "*SECTION_SOLID_TITLE\n\n2,1\nsecond\n3,1\n*RIGIDWALL_PLANAR\n\n0,0,-.1,0,0,1,.3\n"));
  REQUIRE(scene.contacts.size() == 1);
  CHECK(scene.contacts[0].friction == 0.3);
  const std::string systems = "*DEFINE_COORDINATE_VECTOR\n4,0,1,0,-1,0,0\n5,0,0,1,0,1,0\n";
  const auto turned = decks.scene_of(decks.take(cube + systems + "*INITIAL_VELOCITY\n,,,,5\n3,0,0\n"));
  CHECK(turned.initial_motions[0].velocity[2] == 3);
}

TEST_CASE("an initial velocity along axes of its own is turned") {
  Decks decks;
  const std::string axes = "*DEFINE_COORDINATE_SYSTEM\n4,0,0,0,0,1,0\n-1,0,0\n";  // x' along y, y' along -x
  const auto generated = decks.scene_of(decks.take(cube + axes + "*INITIAL_VELOCITY_GENERATION\n1,2,0,3,5,7,0,4\n\n"));
  CHECK(generated.initial_motions[0].velocity == std::array<double, 3>{-5, 3, 7});
  const auto all = decks.scene_of(decks.take(cube + axes + "*INITIAL_VELOCITY\n0,0,0,0,4\n3,5,7\n"));
  CHECK(all.initial_motions[0].velocity == std::array<double, 3>{-5, 3, 7});
  CHECK_THAT(decks.refusal(cube + axes + "*INITIAL_VELOCITY_GENERATION\n1,2,9,3,5,7,0,4\n\n"),
             ContainsSubstring("a rotation in other axes"));
}

TEST_CASE("the step is left to the program, which follows squeezed elements, however fast the bodies are") {
  Decks decks;
  std::string text = cube;
  text.replace(text.find(steel), steel.size(), "*MAT_PLASTIC_KINEMATIC\n1,7800,2.1e11,.3,4e8,1e9,1\n0\n");
  const auto scene = decks.scene_of(decks.take(text + "*INITIAL_VELOCITY\n\n0,0,-200\n"));
  CHECK(scene.initial_motions[0].velocity == std::array<double, 3>{0, 0, -200});
  CHECK(scene.solver.step_estimate == scene::StepEstimate::automatic);
}

TEST_CASE("a set has the nodes within boxes, their faces included") {
  Decks decks;
  const std::string set = "*SET_NODE_GENERAL\n6\nBOX,2\n*BOUNDARY_SPC_SET\n6,0,1,1,1\n";
  const auto import = decks.take(cube + set + "*DEFINE_BOX\n2,-1,1,-1,0.5,0,0.5\n");
  const Mesh mesh = decks.mesh_of(import);
  CHECK(mesh.node_sets.at("nodes_6") == std::vector<int>{0, 1});  // of the lower face, those at y = 0
  CHECK_THAT(decks.refusal(cube + set), ContainsSubstring("there is no box 2"));
}

TEST_CASE("units are asked for where SI cannot be meant") {
  Decks decks;
  std::string text = cube;
  text.replace(text.find("7800,2.1e11"), 11, "7.8e-9,2.1e5");
  CHECK_THAT(decks.refusal(text), ContainsSubstring("deck.k:14: *MAT_ELASTIC") && ContainsSubstring("--units mm,t,s"));
  const auto scene = decks.scene_of(decks.take(text, "mm,t,s"));
  CHECK(scene.materials[0].density == 7800);
  CHECK(scene.materials[0].youngs_modulus == 2.1e11);
  CHECK(scene.meshes[0].file.scale == 1e-3);
  CHECK_THROWS_AS(decks.take(cube, "mm,t"), InputError);
  CHECK_THROWS_AS(decks.take(cube, "mm,t,s,s"), InputError);
  CHECK_THROWS_AS(decks.take(cube, "mm,parsec,s"), InputError);
}

TEST_CASE("what would change the result is refused with its line, and --drop leaves it out") {
  struct Row {
    std::string cards, expected, key;
  };
  const Row row = GENERATE(
      Row{"*MAT_ADD_EROSION\n1,0.3\n", "deck.k:22: *MAT_ADD_EROSION", "MAT_ADD_EROSION"},
      Row{"*RIGIDWALL_GEOMETRIC_SPHERE\n0\n0,0,0,0,0,1\n", "rigid walls", "RIGIDWALL*"},
      Row{"*SET_NODE_LIST\n1\n1\n*SET_NODE_LIST_COLLECT\n1\n2\n", "SET_NODE_LIST_COLLECT", "SET_NODE_LIST_COLLECT"},
      Row{"*BLABLA\n", "may change what is computed", "BLABLA"},
      Row{"*ELEMENT_SHELL\n2,1,1,2,3,4\n", "elements of this kind", "ELEMENT_SHELL"},
      Row{"*CONTROL_IMPLICIT_GENERAL\n1,.1\n", "implicitly", "CONTROL_IMPLICIT_GENERAL"},
      Row{"*CONTACT_ERODING_SURFACE_TO_SURFACE\n1,2,3,3\n", "contacts of this kind", "CONTACT_ERODING*"},
      Row{"*ELEMENT_MASS\n1,1,0.5\n", "no point masses", "ELEMENT_MASS"},
      Row{"*DEFINE_CURVE\n1,1\n0,1\n1,1\n", "dynamic relaxation alone", "DEFINE_CURVE.SIDR"},
      Row{"*CONTACT_AUTOMATIC_SINGLE_SURFACE\n0\n\n\n\n0,0,0,0,0,0,0.1\n", "SLDTHK", "CONTACT_AUTOMATIC*"},
      Row{"*DAMPING_PART_STIFFNESS\n1,0.1\n", "highest frequencies", "DAMPING_PART_STIFFNESS.COEF"},
      Row{"*INITIAL_VELOCITY\n1,2\n0,0,1\n*SET_NODE_LIST\n1\n1,2,3,4,5,6,7,8\n", "NSIDEX", "INITIAL_VELOCITY.NSIDEX"});
  Decks decks;
  CAPTURE(row.cards);
  CHECK_THAT(decks.refusal(cube + row.cards), ContainsSubstring(row.expected) && ContainsSubstring("--drop"));
  CHECK(decks.refusal(cube + row.cards, {row.key}).empty());
}

TEST_CASE("mistakes are refused with file and line") {
  struct Row {
    std::string text, expected;
  };
  const std::string bad_element = "*KEYWORD\n" + nodes + steel + part + end + "*ELEMENT_SOLID\n";
  const Row row = GENERATE_COPY(
      Row{"*KEYWORD\n" + nodes + solid + steel + part, "no end time"},
      Row{bad_element + "1,1,1,2,3,4,5,5,5,5\n", "deck.k:21: *ELEMENT_SOLID: pyramids: 1"},
      Row{bad_element + "1,1,1,2,3,3,5,6,7,7\n2,1,1,2,3,3,5,6,7,7\n", "wedges: 2"},
      Row{bad_element + "1,1,1,2,3,4,4,4,4,4\n", "tetrahedra: 1"},
      Row{bad_element + "1,1\n1,2,3,4,5,6,7,8,9,10\n", "quadratic tetrahedra"},
      Row{bad_element + "1,1,1,2,3,4,5,6,7,99\n", "deck.k:21: element 1 names node 99"},
      Row{bad_element + "1,1,1,4,3,2,5,8,7,6\n", "mirrored"},
      Row{bad_element + "1,9,1,2,3,4,5,6,7,8\n", "there is no part 9"},
      Row{bad_element + "1,1,1,2,3,4,5,6,7,8\n1,1,1,2,3,4,5,6,7,8\n", "defined again"},
      Row{cube + "*NODE\n1,0,0,0\n", "node 1 is defined again"}, Row{cube + "*NODE\n9,nan,0,0\n", "'nan' is no number"},
      Row{cube + "*NODE\n9,1e999,0,0\n", "'1e999' is no number"},
      Row{cube + "*NODE\n99999999999999999999,0,0,0\n", "is no whole number"},
      Row{cube + "*NODE\n  1.5\n", "is no whole number"},
      Row{cube + "*CONTROL_TIMESTEP\n       0.0        0.9\n", "goes on beyond the columns"},
      Row{cube + "*BOUNDARY_SPC_SET\n7,0,1,1,1\n", "deck.k:23: *BOUNDARY_SPC_SET: there is no node set 7"},
      Row{cube + "*SET_NODE_LIST\n7\n1,2,77\n*BOUNDARY_SPC_SET\n7,0,1,1,1\n", "there is no node 77"},
      Row{cube + "*LOAD_NODE_POINT\n1,1,3\n", "there is no curve 3"},
      Row{cube + "*DEFINE_CURVE\n3\n0,0\n-1,0\n", "is below the one before"},
      Row{cube + "*PART\nname\n", "deck.k:22: *PART ends after"},
      Row{cube + "*SECTION_BEAM\n2,1\n", "ends after 1 of its cards"},
      Row{cube + "*INITIAL_VELOCITY\n0\n\n0,0,-3\n", "deck.k:25: *INITIAL_VELOCITY: this card is one more"},
      Row{cube + "*DAMPING_GLOBAL\n0,5\n0,6\n", "one more than the keyword has"},
      Row{cube + "*CONTACT_AUTOMATIC_SINGLE_SURFACE\n0\n\n", "contact with itself"},
      Row{cube + "*MAT_ELASTIC\n&undefined,1,1\n", "there is no parameter 'undefined'"},
      Row{cube + "*PARAMETER_EXPRESSION\nR a       1/0\n", "no finite number"},
      Row{cube + "*PARAMETER_EXPRESSION\nR a       ((((1)\n", "')' is missing"},
      Row{cube + "*INCLUDE\ndeck.k\n", "can't include itself"}, Row{cube + "*INCLUDE\nnowhere.k\n", "no such file"},
      Row{"anything\n", "stands where a keyword is expected"},
      Row{std::string("*KEYWORD\n\x01\x02"), "isn't a text file"},
      Row{"*KEYWORD\n-----BEGIN PGP MESSAGE-----\n", "encrypted"},
      Row{cube + "*INITIAL_VELOCITY_NODE\n1,0,0,1\n", "moves some nodes"});
  Decks decks;
  CAPTURE(row.text);
  CHECK_THAT(decks.refusal(row.text), ContainsSubstring(row.expected));
}

TEST_CASE("directions of one set follow curves of their own, and sets with common nodes move along different ones") {
  Decks decks;
  const std::string curves =
      "*DEFINE_CURVE\n1,0\n0,0\n1e-6,1\n*DEFINE_CURVE\n2,0\n0,0\n5e-7,1\n*SET_NODE_LIST\n1\n1,2,3,4\n"
      "*SET_NODE_LIST\n2\n1,5\n";
  const auto motion = [](int set, int direction, int kind, int curve, double scale) {
    return "*BOUNDARY_PRESCRIBED_MOTION_SET\n" + std::to_string(set) + ',' + std::to_string(direction) + ',' +
           std::to_string(kind) + ',' + std::to_string(curve) + ',' + std::to_string(scale) + '\n';
  };
  // x and y by one curve of velocity, z by another, and what two of the nodes share with another set.
  const auto import =
      decks.take(cube + curves + motion(1, 1, 0, 1, 3) + motion(1, 3, 0, 2, 5) + motion(2, 2, 2, 2, 1e-3), "m,kg,s");
  const auto scene = decks.scene_of(import);
  REQUIRE(scene.prescribed_motions.size() == 3);
  const auto& x = scene.prescribed_motions[0];
  const auto& z = scene.prescribed_motions[1];
  const auto& y = scene.prescribed_motions[2];
  CHECK(x.target == z.target);
  CHECK(x.directions == std::array<bool, 3>{true, false, false});
  CHECK(z.directions == std::array<bool, 3>{false, false, true});
  CHECK(y.directions == std::array<bool, 3>{false, true, false});
  CHECK(x.velocity == std::array<double, 3>{3, 0, 0});
  CHECK(z.velocity == std::array<double, 3>{0, 0, 5});
  CHECK(y.displacement == std::array<double, 3>{0, 1e-3, 0});
  CHECK(x.curve != z.curve);
  CHECK_THAT(decks.refusal(cube + curves + motion(1, 1, 0, 1, 3) + motion(1, 1, 0, 2, 3)),
             ContainsSubstring("a direction of these nodes has a motion already"));
  CHECK_THAT(decks.refusal(cube + curves + motion(1, 1, 0, 1, 3) + motion(2, 1, 0, 2, 3)),
             ContainsSubstring("node 1 is moved along x by another set's motion already"));
}

TEST_CASE("conditions of Abaqus that move nodes by amplitudes of their own are as many motions") {
  Decks decks;
  std::string text = text_of(std::string(source_folder) + "/tests/deck/data/everything.inp");
  const std::string before = "*CLOAD, AMPLITUDE=Ramp\n";
  text.insert(text.find(before), "*BOUNDARY, AMPLITUDE=Ramp, TYPE=VELOCITY\n8, 1, 1, 5.\n8, 3, 3, 7.\n");
  const auto scene = decks.scene_of(decks.take(text, "mm,t,s", {}, "deck_.inp"));
  // One entry has the displacement along y and the velocities, whose curves are one: they exclude nothing.
  REQUIRE(scene.prescribed_motions.size() == 1);
  CHECK(scene.prescribed_motions[0].directions == std::array<bool, 3>{true, true, true});
  text.insert(text.find("*BOUNDARY, AMPLITUDE=Ramp"), "*AMPLITUDE, NAME=Slow\n0., 0., 2e-3, 1.\n");
  text.replace(text.find("8, 3, 3, 7.\n"), 12, "*BOUNDARY, AMPLITUDE=Slow, TYPE=VELOCITY\n8, 3, 3, 7.\n");
  const auto two = decks.scene_of(decks.take(text, "mm,t,s", {}, "deck_.inp"));
  REQUIRE(two.prescribed_motions.size() == 2);
  CHECK(two.prescribed_motions[0].directions == std::array<bool, 3>{true, true, false});
  CHECK(two.prescribed_motions[1].directions == std::array<bool, 3>{false, false, true});
  CHECK(two.prescribed_motions[1].velocity[2] == 7e-3);
  CHECK(two.prescribed_motions[0].curve != two.prescribed_motions[1].curve);
}

TEST_CASE("a rigid part is refused with a mend; one without elements does no harm") {
  Decks decks;
  std::string text = cube;
  text.replace(text.find("MAT_ELASTIC"), 11, "MAT_RIGID");
  CHECK_THAT(decks.refusal(text), ContainsSubstring("no rigid bodies") && ContainsSubstring("BOUNDARY_SPC_SET"));
  CHECK(decks.refusal(cube + "*MAT_THERMAL_ISOTROPIC\n1,0,0,0\n0,0\n*MAT_ELASTIC\n3,1,1,0\n").empty());
  CHECK(decks.refusal(cube + "*PART\nunused\n2,1,2\n*MAT_RIGID\n2,7800,2e11,.3\n\n\n").empty());
}

TEST_CASE("a deck cut short anywhere is refused or taken, never worse") {
  const std::string name = GENERATE("deck.k", "deck.inp");
  const std::string whole = text_of(std::string(source_folder) + "/tests/deck/data/everything" + name.substr(4));
  Decks decks;
  int refused = 0, taken = 0;
  for (std::size_t length = 0; length < whole.size(); length += 7)
    (decks.refusal(whole.substr(0, length), {}, name).empty() ? taken : refused)++;
  CHECK(refused > 100);
}

TEST_CASE("an Abaqus input of an explicit step becomes a case, names and all") {
  Decks decks;
  const auto import =
      decks.take(text_of(std::string(source_folder) + "/tests/deck/data/everything.inp"), "mm,t,s", {}, "deck_.inp");
  const auto scene = decks.scene_of(import);
  REQUIRE(scene.parts.size() == 3);
  CHECK(scene.parts[1].name == "upper");
  CHECK(scene.parts[0].mass_damping == 50);
  CHECK(scene.parts[0].quadratic_bulk_viscosity == 1.0);  // b2^2
  CHECK(scene.materials[1].yield_stress == 250e6);
  CHECK(std::abs(scene.materials[1].tangent_modulus / (210e9 * 1e9 / 211e9) - 1) < 1e-12);
  CHECK(scene.constraints[0].target == "lower.lower_floor");
  CHECK(scene.prescribed_motions[0].displacement[1] == 1e-5);
  CHECK(scene.initial_motions[0].velocity[0] == 5e-3);
  CHECK(scene.initial_motions[0].velocity[2] == -0.5);
  CHECK(scene.loads[0].force[0] == 4);  // 2 N on each of two nodes
  CHECK(scene.loads[1].pressure == 1.5e6);
  CHECK(scene.loads[2].pressure == 0.5e6);
  CHECK(scene.gravity[2] == -9.81);
  CHECK(scene.contacts[0].friction == 0.3);
  CHECK(scene.ties[0].name == "glue");
  CHECK(scene.time.end == 1e-6);
  CHECK(scene.output.field_interval == 5e-7);
  CHECK(scene.output.history_sets[0] == "upper.upper_edge");
}

TEST_CASE("what of Abaqus would change the result is refused with its line") {
  const std::string cube_of_abaqus =
      "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n"
      "*ELEMENT, TYPE=C3D8R, ELSET=E\n1,1,2,3,4,5,6,7,8\n*MATERIAL, NAME=M\n*DENSITY\n7800\n*ELASTIC\n2.1e11,.3\n";
  const std::string section = "*SOLID SECTION, ELSET=E, MATERIAL=M\n", step = "*STEP\n*DYNAMIC, EXPLICIT\n, 1e-4\n";
  struct Row {
    std::string text, expected;
  };
  const Row row = GENERATE_COPY(
      Row{cube_of_abaqus + step, "is in no *SOLID SECTION"}, Row{cube_of_abaqus + section, "no step with a time"},
      Row{cube_of_abaqus + section + "*STEP\n*STATIC\n", "*STATIC"},
      Row{cube_of_abaqus + section + "*RIGID BODY, REF NODE=1, ELSET=E\n" + step, "deck.inp:18: *RIGIDBODY"},
      Row{cube_of_abaqus + section + step + "*BOUNDARY\n1,1,1,0.5\n", "jumps at the start"},
      Row{cube_of_abaqus + section + step + "*BOUNDARY\nnowhere,1\n", "there is no node set 'nowhere'"},
      Row{cube_of_abaqus + section + step + "*BOUNDARY, OP=NEW\n1,1\n", "OP=NEW"},
      Row{cube_of_abaqus + section + step + "*CLOAD\n99,1,2\n", "there is no node 99"},
      Row{cube_of_abaqus + section + step + "*CLOAD, AMPLITUDE=A\n1,1,2\n", "there is no curve"},
      Row{cube_of_abaqus + section + step + "*DLOAD\nE,CENTRIF,1\n", "load 'centrif' isn't read"},
      Row{cube_of_abaqus + section + step + "*CONTACT PAIR\na,b\n", "there is no surface 'a'"},
      Row{cube_of_abaqus + "*USER MATERIAL, CONSTANTS=1\n1\n" + section + step, "*USERMATERIAL"},
      Row{cube_of_abaqus + section + step + step, "second step"});
  Decks decks;
  CAPTURE(row.text);
  CHECK_THAT(decks.refusal(row.text, {}, "deck.inp"), ContainsSubstring(row.expected));
}
