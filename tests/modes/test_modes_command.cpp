#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_exception.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <sstream>

#include "modes/modes_command.hpp"
#include "tests/case/temporary_case.hpp"

using namespace railwave;
using namespace railwave::test;
using Catch::Matchers::ContainsSubstring;

namespace {

const std::string two_blocks =
    "[materials.steel]\nyoungs_modulus = 210e9\npoissons_ratio = 0.3\ndensity = 7800\n"
    "[meshes.cube]\ntype = \"box\"\nsize = [0.1, 0.1, 0.1]\ndivisions = [4, 4, 4]\n"
    "[parts.lower]\nmesh = \"cube\"\nmaterial = \"steel\"\nhourglass = \"viscous\"\n"
    "[parts.upper]\nmesh = \"cube\"\nmaterial = \"steel\"\nposition = [0, 0, 0.2]\nhourglass = \"stiffness\"\n"
    "[connectors.pad]\nfrom = \"lower.z_max\"\nto = \"upper.z_min\"\nstiffness = [1e8, 1e8, 1e8]\ndamping = [1, 1, 1]\n"
    "[constraints.foot]\ntarget = \"lower.z_min\"\nfixed = [\"x\", \"y\", \"z\"]\n"
    "[contacts.fall]\nslave = \"upper.z_min\"\nmaster = \"lower.z_max\"\nclose_gap = [0, 0, -1]\n"
    "[loads.weight]\ntype = \"nodal_force\"\ntarget = \"upper.z_max\"\nforce = [0, 0, -1]\n"
    "[time]\nend = 1e-3\n[output]\nhistory_sets = [\"upper.z_max\"]\n";

std::string report(const TemporaryCase& file, ModesRequest request) {
  std::ostringstream out;
  modes_command(read_case(file.path()), request, out);
  return out.str();
}

}  // namespace

TEST_CASE("railwave modes tells what it leaves out and how it counts", "[modes]") {
  const TemporaryCase file(two_blocks);
  ModesRequest request;
  request.up_to = 3000;
  request.csv = (file.folder() / "modes.csv").string();
  request.shapes = (file.folder() / "modes.h5").string();
  const std::string text = report(file, request);
  CHECK_THAT(text, ContainsSubstring("contacts are left out: fall"));
  CHECK_THAT(text, ContainsSubstring("hourglass control of lower is viscous in a run"));
  CHECK_THAT(text, ContainsSubstring("damping is left out"));
  CHECK_THAT(
      text,
      ContainsSubstring(
          "all 6 modes below 3000 Hz, counted by inertia; 3 of them rigid motions\n"));  // it turns about the spring
  CHECK_THAT(text, ContainsSubstring("upper 100 %"));
  CHECK_THAT(text_of(*request.csv), ContainsSubstring("mode,frequency,rigid,modal_mass,part"));
  CHECK_THAT(text_of(file.folder() / "modes.xdmf"), ContainsSubstring("modes.h5:/fields/upper/displacement"));
}

TEST_CASE("railwave modes of one part", "[modes]") {
  const TemporaryCase file(two_blocks);
  ModesRequest request;
  request.up_to = 3000;
  request.parts = {"upper"};
  const std::string text = report(file, request);
  CHECK_THAT(text, ContainsSubstring("64 elements, 125 nodes\n") && ContainsSubstring("375 free directions"));
  CHECK_THAT(text, ContainsSubstring("connectors to what is not named are left out: pad"));
  CHECK_THAT(text, ContainsSubstring("all 6 modes below 3000 Hz, counted by inertia; 6 of them rigid motions"));
}

TEST_CASE("railwave modes refuses what it can't serve", "[modes]") {
  const TemporaryCase file(two_blocks);
  const auto complaint = [&](const ModesRequest& request) {
    try {
      report(file, request);
      return std::string();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
  };
  ModesRequest request;
  request.parts = {"uper"};
  CHECK_THAT(complaint(request), ContainsSubstring("--part uper: there is no part or point mass of that name") &&
                                     ContainsSubstring("upper"));
  request = {};
  request.up_to = -1;
  CHECK_THAT(complaint(request), ContainsSubstring("--up-to -1: a frequency above 0 is wanted"));
  request = {};
  request.parts = {"upper"};
  std::ostringstream none;
  try {
    modes_command(read_case(file.path(), {"parts.upper.hourglass_coefficient=0"}), request, none);
    FAIL("a part without hourglass stiffness was taken");
  } catch (const InputError& error) {
    CHECK_THAT(error.what(), ContainsSubstring("[parts.upper] hourglass_coefficient: is 0"));
  }
  const TemporaryCase held(std::string(two_blocks).replace(two_blocks.find("[4, 4, 4]"), 9, "[1, 1, 1]") +
                           "[constraints.head]\ntarget = \"lower.z_max\"\nfixed = [\"x\", \"y\", \"z\"]\n");
  request = {};
  request.parts = {"lower"};
  CHECK_THROWS_WITH(report(held, request), ContainsSubstring("nothing can move: all nodes are held"));
  request = {};
  request.shapes = (file.folder() / "no" / "modes.h5").string();
  CHECK_FALSE(complaint(request).empty());
}
