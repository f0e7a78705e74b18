// The results file: what it holds, that an older one survives a failing start, and that a killed run leaves a readable
// file.

#include <fcntl.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <csignal>
#include <fstream>

#include "case/error.hpp"
#include "output/output_sets.hpp"
#include "tests/output/made_up_run.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;
namespace fs = std::filesystem;

namespace {

void put(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

/// Equal to rounding: the compiler may contract the made-up formulas differently here and in the writer's source.
bool same_to_rounding(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!(std::fabs(a[i] - b[i]) <= 1e-12 * std::fabs(b[i]) + 1e-9)) return false;
  return true;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

}  // namespace

// Hidden: makes the file that the Python tests read. RAILWAVE_SAMPLE names it; RAILWAVE_SAMPLE_KILL_AFTER is a step
// after which the program kills itself.
TEST_CASE("write the made-up run", "[.write-sample]") {
  const char* path = std::getenv("RAILWAVE_SAMPLE");
  REQUIRE(path);
  ResultsWriter writer(path, made_up::description());
  if (const char* last = std::getenv("RAILWAVE_SAMPLE_KILL_AFTER")) {
    made_up::feed(writer, std::atol(last));
    std::raise(SIGKILL);
  }
  made_up::feed(writer, made_up::steps);
  writer.end(made_up::summary());
}

TEST_CASE("every history sample and field is read back") {
  const made_up::TemporaryFolder folder;
  const std::string path = folder / "run.h5";
  {
    ResultsWriter writer(path, made_up::description());
    made_up::feed(writer, made_up::steps);
    writer.end(made_up::summary());
  }
  const hdf5::File file = hdf5::File::open(path);
  const hdf5::Group root = file.root();
  CHECK(root.text_attribute("format") == "Railwave results");
  CHECK(root.text_attribute("title") == made_up::description().title);
  CHECK(root.text_attribute("case_text") == made_up::description().case_text);
  CHECK(root.text_attribute("reason") == "completed");
  CHECK(root.number_attribute("completed") == 1);
  CHECK(root.number_attribute("wall_seconds") == 1.5);

  const auto times = root.group("history").dataset("time").read<double>();
  REQUIRE(times.size() == made_up::steps + 1);
  const auto error = root.group("history").group("energy").dataset("balance_error").read<double>();
  const auto motion = root.group("history").group("set").group("block.corner").dataset("displacement").read<double>();
  for (long step = 0; step <= made_up::steps; ++step) {
    const HistorySample sample = made_up::sample(step);
    CHECK(times[step] == sample.time);
    CHECK(error[step] == sample.energy.balance_error);
    CHECK(motion[3 * step + 1] == sample.sets[0].displacement[1]);
  }

  const hdf5::Group top = root.group("fields").group("block.top");
  CHECK(top.dataset("connectivity").shape() == hdf5::Shape{12, 4});
  CHECK(top.dataset("stress").shape() == hdf5::Shape{5, 12, 6});
  const OutputSet set = made_up::description().sets[2];
  CHECK(top.dataset("nodes").read<int>() == set.nodes);
  CHECK(same_to_rounding(top.dataset("velocity").read_row<double>(3),
                         made_up::Source(1e-6 * 300).field(field_named("velocity"), set.nodes).values));
  CHECK(same_to_rounding(top.dataset("stress").read_row<double>(4),
                         made_up::Source(1e-6 * 400).field(field_named("stress"), set.elements).values));
  CHECK_THROWS_WITH(top.dataset("stress").read_row<double>(5), ContainsSubstring("/fields/block.top/stress"));

  const ContactState state = made_up::Source(1e-6 * 200).contact(0);
  const hdf5::Group contact = root.group("contact").group("tread");
  CHECK(contact.number_attribute("friction") == state.friction);
  CHECK(same_to_rounding(contact.group("master").dataset("tangential_force").read_row<double>(2),
                         state.master.tangential_force));
  CHECK(contact.group("slave").dataset("slipping").read_row<int>(2) == state.slipping);
}

TEST_CASE("a surface's facets lie on the elements under them, and are turned outwards") {
  const OutputSet set = made_up::description().sets[2];
  REQUIRE(set.is_surface());
  const Assembly assembly = made_up::block();
  for (std::size_t f = 0; f < set.elements.size(); ++f) {
    CHECK(set.elements[f] >= 12);
    const auto point = [&](int corner) { return set.coordinates.data() + 3 * set.corners[4 * f + corner]; };
    const double up = (point(1)[0] - point(0)[0]) * (point(3)[1] - point(0)[1]) -
                      (point(1)[1] - point(0)[1]) * (point(3)[0] - point(0)[0]);
    CHECK(up > 0);
    CHECK(point(0)[2] == 0.01);
  }
}

TEST_CASE("output sets that do not exist are named, all of them") {
  scene::Scene scene;
  scene.path = "case.toml";
  scene.output.field_sets = {"block.topp", "block.corner", "block"};
  try {
    resolve_output_sets(scene, made_up::block());
    FAIL("no error");
  } catch (const InputError& error) {
    CHECK_THAT(error.what(), ContainsSubstring("case.toml: output.field_sets: there is no part, element set or surface "
                                               "'block.topp'; did you mean 'block.top'?"));
    CHECK_THAT(error.what(), ContainsSubstring("'block.corner' is a set of nodes"));
  }
}

TEST_CASE("an older results file stays until the new run has brought data") {
  const made_up::TemporaryFolder folder;
  const std::string path = folder / "run.h5", xdmf = folder / "run.xdmf";
  {
    ResultsWriter writer(path, made_up::description());
    made_up::feed(writer, 0);
    made_up::feed(writer, 1);
    writer.end(made_up::summary());
  }
  const std::string older = text_of(path), older_companion = text_of(xdmf);
  REQUIRE(count(older_companion, "<Time ") > 1);
  {
    ResultsWriter writer(path, made_up::description());
    CHECK(text_of(path) == older);
  }  // the start failed
  CHECK(text_of(path) == older);
  CHECK(text_of(xdmf) == older_companion);
  CHECK_FALSE(fs::exists(path + ".new"));
  {
    ResultsWriter writer(path, made_up::description());
    writer.history(made_up::sample(0));
    CHECK(text_of(path) == older);
    writer.fields(made_up::Source(0), 0, 0);
    CHECK(text_of(path) != older);
    CHECK(count(text_of(xdmf), "<Time ") == 1);
  }
  CHECK_FALSE(fs::exists(path + ".new"));
  CHECK(hdf5::File::open(path).root().number_attribute("completed") == 0);
}

TEST_CASE("a file of somebody else that comes while a run begins stays") {
  const made_up::TemporaryFolder folder;
  const std::string path = folder / "run.h5", xdmf = folder / "run.xdmf";
  {
    ResultsWriter writer(path, made_up::description());
    put(path, "notes");
    put(xdmf, "<Xdmf of another program/>");
    writer.history(made_up::sample(0));
    CHECK_THROWS_WITH(
        writer.fields(made_up::Source(0), 0, 0),
        ContainsSubstring("is there already") && ContainsSubstring("what was written is in " + path + ".new"));
  }
  CHECK(text_of(path) == "notes");
  CHECK(text_of(xdmf) == "<Xdmf of another program/>");
}

TEST_CASE("an unfinished file of somebody else stays") {
  const made_up::TemporaryFolder folder;
  const std::string path = folder / "run.h5";
  put(path + ".new", "notes");
  {
    ResultsWriter writer(path, made_up::description());
    made_up::feed(writer, 0);
    writer.end(made_up::summary());
  }
  CHECK(text_of(path + ".new") == "notes");
  CHECK(hdf5::File::open(path).root().number_attribute("completed") == 1);
  CHECK_FALSE(fs::exists(path + ".new.1"));
}

TEST_CASE("a place where no results can go is said before the run") {
  const made_up::TemporaryFolder folder;
  CHECK_THROWS_WITH(check_results_place(folder / "none/run.h5"), ContainsSubstring("there is no folder"));
  CHECK_THROWS_WITH(check_results_place(folder / ""), ContainsSubstring("is a folder"));
  const std::string path = folder / "run.h5";
  ResultsWriter writer(path, made_up::description());
  CHECK_THROWS_WITH(ResultsWriter(path, made_up::description()), ContainsSubstring("another run is writing"));
  made_up::feed(writer, 0);
  CHECK_THROWS_AS(ResultsWriter(path, made_up::description()), InputError);
  writer.end(made_up::summary());
  CHECK_NOTHROW(check_results_place(path));
}

TEST_CASE("a killed run leaves what it had written") {
  const made_up::TemporaryFolder folder;
  const std::string path = folder / "run.h5";
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    ResultsWriter writer(path, made_up::description());
    made_up::feed(writer, 250);
    std::raise(SIGKILL);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WIFSIGNALED(status));

  const hdf5::File file = hdf5::File::open(path);
  const hdf5::Group root = file.root();
  CHECK(root.number_attribute("completed") == 0);
  CHECK_THAT(root.text_attribute("reason"), ContainsSubstring("killed"));
  CHECK(root.group("history").dataset("time").shape() ==
        hdf5::Shape{201});  // all until the last flush, with the fields at 200
  CHECK(root.group("fields").group("block").dataset("displacement").shape()[0] == 3);
  CHECK(root.group("contact").group("tread").dataset("time").read<double>().back() == 1e-6 * 200);
  const std::string xdmf = text_of(folder / "run.xdmf");
  CHECK(count(xdmf, "<Time ") == 3);
  CHECK(xdmf.substr(xdmf.size() - 8) == "</Xdmf>\n");
}

TEST_CASE("arrays that do not fit are refused") {
  const made_up::TemporaryFolder folder;
  ResultsWriter writer(folder / "run.h5", made_up::description());
  HistorySample sample = made_up::sample(0);
  sample.contacts.clear();
  CHECK_THROWS_AS(writer.history(sample), std::logic_error);
}

TEST_CASE("section forces of beams are in the histories, element by element") {
  const made_up::TemporaryFolder folder;
  RunDescription description = made_up::description();
  description.beams = {{"spokes", 2}};
  {
    ResultsWriter writer(folder / "run.h5", description);
    HistorySample sample = made_up::sample(0);
    CHECK_THROWS_AS(writer.history(sample), std::logic_error);
    sample.beams = {{{1, 2, 3, 4, 5, 6}, {7, 8, 9, 10, 11, 12}}};
    writer.history(sample);
    writer.history(sample);
    writer.end(made_up::summary());
  }
  const hdf5::File file = hdf5::File::open(folder / "run.h5");
  const hdf5::Group beam = file.root().group("history").group("beam").group("spokes");
  CHECK(beam.dataset("force").shape() == hdf5::Shape{2, 2, 3});
  CHECK(beam.dataset("moment").read<double>()[6 + 4] == 11);
}
