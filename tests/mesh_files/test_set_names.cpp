#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include <string>
#include <vector>

#include "case/error.hpp"
#include "mesh/files/mesh_file.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;

TEST_CASE("names of sets are made fit for paths, channels and columns") {
  CHECK(fit_set_name("top") == "top");
  CHECK(fit_set_name("PART-1.top face") == "PART-1.top face");
  CHECK(fit_set_name("Stra\xc3\x9f"
                     "e") ==
        "Stra\xc3\x9f"
        "e");
  CHECK(fit_set_name("to/p") == "to_p");
  CHECK(fit_set_name("/") == "_");
  CHECK(fit_set_name("a\"b'c<d>&e,f;g:h*i?j\\k") == "a_b_c_d__e_f_g_h_i_j_k");
  CHECK(fit_set_name("bell\a\n") == "bell__");
  CHECK(fit_set_name(" blank ") == "blank");
  CHECK(fit_set_name("") == "unnamed");
  CHECK(fit_set_name(".") == "unnamed");
  CHECK(fit_set_name("..") == "unnamed");
  CHECK(fit_set_name("half \xc3") == "half _");
  CHECK(fit_set_name("\xed\xa0\x80") == "___");  // half of a UTF-16 pair
  CHECK(fit_set_name(std::string(5000, 'x')).size() == 100);
  CHECK(fit_set_name(std::string(99, 'x') + "\xc3\xa9") == std::string(99, 'x'));  // no half letter at the end
}

TEST_CASE("what was renamed is reported once, and two names that become one are refused") {
  Mesh mesh;
  mesh.node_sets["to/p"] = {0};
  mesh.surfaces["to/p"] = {{0, 0}};
  mesh.node_sets["bottom"] = {1};
  std::vector<std::string> notes;
  fit_set_names(mesh, "block.msh", &notes);
  CHECK(notes == std::vector<std::string>{"block.msh: set 'to/p' is called 'to_p' here"});
  CHECK(mesh.node_sets.count("to_p") == 1);
  CHECK(mesh.surfaces.count("to_p") == 1);
  CHECK(mesh.node_sets.count("bottom") == 1);
  for (const char* other : {"to:p", "to_p"}) {
    Mesh doubled;
    doubled.node_sets["to/p"] = {0};
    doubled.node_sets[other] = {1};
    CHECK_THROWS_WITH(fit_set_names(doubled, "block.msh", nullptr),
                      ContainsSubstring("'to_p'") && ContainsSubstring("rename one"));
  }
}
