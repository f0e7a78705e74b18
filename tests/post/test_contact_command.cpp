// railwave contact: its table, its CSV, and what it says of files that it cannot use.

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_exception.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <fstream>
#include <sstream>

#include "case/error.hpp"
#include "post/contact_solution.hpp"
#include "post/results_reader.hpp"
#include "tests/output/made_up_run.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinRel;
namespace fs = std::filesystem;

namespace {

void write_run(const std::string& path, bool to_the_end = true) {
  ResultsWriter writer(path, made_up::description());
  made_up::feed(writer, to_the_end ? made_up::steps : 150);
  if (to_the_end) writer.end(made_up::summary());
}

std::string complaint_of(const std::string& path) {
  std::ostringstream out;
  try {
    contact_command(path, {}, out);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

}  // namespace

TEST_CASE("the table has a line for every output time, and the CSV the same numbers") {
  const made_up::TemporaryFolder folder;
  write_run(folder / "run.h5");
  std::ostringstream out;
  REQUIRE(contact_command(folder / "run.h5", folder / "run.csv", out) == 0);
  CHECK_THAT(out.str(), ContainsSubstring("contact tread, forces on wheel.tread"));

  std::ifstream csv(folder / "run.csv");
  std::string line;
  std::getline(csv, line);
  CHECK_THAT(line, ContainsSubstring("contact,time,nodes_in_contact,area_by_count,area,"));
  std::vector<std::vector<double>> rows;
  while (std::getline(csv, line)) {
    rows.emplace_back();
    std::istringstream cells(line);
    std::string cell;
    std::getline(cells, cell, ',');
    CHECK(cell == "tread");
    while (std::getline(cells, cell, ',')) rows.back().push_back(std::stod(cell));
  }
  REQUIRE(rows.size() == 5);
  for (int i = 0; i < 5; ++i) {
    const ContactSolution expected = contact_solution(made_up::Source(1e-4 * i).contact(0));
    CHECK_THAT(rows[i].at(0), WithinRel(1e-4 * i, 1e-12));
    CHECK(rows[i].at(1) == expected.nodes);
    CHECK_THAT(rows[i].at(3), WithinRel(expected.area, 1e-8));
    CHECK_THAT(rows[i].at(7), WithinRel(expected.normal_force, 1e-8));
    CHECK_THAT(rows[i].at(8), WithinRel(expected.creep_force, 1e-8));
    CHECK(rows[i].at(19) == expected.slipping_by_solver);
  }
}

TEST_CASE("a run that was stopped is read as far as it came") {
  const made_up::TemporaryFolder folder;
  write_run(folder / "run.h5", false);
  std::ostringstream out;
  CHECK(contact_command(folder / "run.h5", {}, out) == 0);
  CHECK_THAT(out.str(), ContainsSubstring("note: this run did not complete"));
  const ResultsReader results(folder / "run.h5");
  CHECK(results.contact_times("tread").size() == 2);
  CHECK_THROWS_WITH(results.contact_times("thread"), ContainsSubstring("did you mean 'tread'?"));
}

TEST_CASE("files that cannot be used") {
  const made_up::TemporaryFolder folder;
  CHECK_THAT(complaint_of(folder / "none.h5"), ContainsSubstring("cannot open") && ContainsSubstring("No such file"));
  CHECK_THAT(complaint_of(folder / ""), ContainsSubstring("is a folder"));

  std::ofstream(folder / "text.h5") << "time, force\n0, 1\n";
  CHECK_THAT(complaint_of(folder / "text.h5"), ContainsSubstring("no HDF5 file"));
  std::ofstream(folder / "empty.h5").flush();
  CHECK_THAT(complaint_of(folder / "empty.h5"), ContainsSubstring("no HDF5 file"));

  hdf5::File::create(folder / "other.h5").root().set_attribute("format", "something else");
  CHECK_THAT(complaint_of(folder / "other.h5"), ContainsSubstring("no results file of Railwave"));

  {
    const hdf5::File newer = hdf5::File::create(folder / "newer.h5");
    newer.root().set_attribute("format", "Railwave results");
    newer.root().set_attribute("format_version", 99L);
    newer.root().set_attribute("program", "railwave 77");
  }
  CHECK_THAT(complaint_of(folder / "newer.h5"), ContainsSubstring("written by a newer program (railwave 77)"));

  {
    RunDescription description = made_up::description();
    description.contacts.clear();
    ResultsWriter writer(folder / "free.h5", description);
    HistorySample sample = made_up::sample(0);
    sample.contacts.clear();
    writer.history(sample);
    writer.end(made_up::summary());
  }
  CHECK_THAT(complaint_of(folder / "free.h5"), ContainsSubstring("holds no contact"));

  write_run(folder / "cut.h5");
  fs::resize_file(folder / "cut.h5", fs::file_size(folder / "cut.h5") / 2);
  CHECK_THAT(complaint_of(folder / "cut.h5"), ContainsSubstring("is cut short"));
}

TEST_CASE("a file without one of its arrays is damaged, and says which") {
  const made_up::TemporaryFolder folder;
  write_run(folder / "run.h5");
  const hid_t file = H5Fopen((folder / "run.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  REQUIRE(H5Ldelete(file, "/contact/tread/slave/gap", H5P_DEFAULT) >= 0);
  H5Fclose(file);
  CHECK_THAT(complaint_of(folder / "run.h5"), ContainsSubstring("is damaged") && ContainsSubstring("slave/gap"));
}

TEST_CASE("a CSV that cannot be written is said, and leaves nothing behind") {
  const made_up::TemporaryFolder folder;
  write_run(folder / "run.h5");
  std::ostringstream out;
  CHECK_THROWS_WITH(contact_command(folder / "run.h5", folder / "none/run.csv", out), ContainsSubstring("none/run.csv") && ContainsSubstring("No such file"));
}
