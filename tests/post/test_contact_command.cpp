// railwave contact: its table, its CSV, and what it says of files that it cannot use.

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_exception.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <fstream>
#include <sstream>

#include "case/error.hpp"
#include "post/contact_command.hpp"
#include "post/contact_patch.hpp"
#include "post/contact_reader.hpp"
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

ContactRequest request_for(const std::string& path) {
  ContactRequest request;
  request.results = path;
  return request;
}

struct Csv {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  explicit Csv(const std::string& path) {
    std::ifstream file(path);
    std::string line;
    while (std::getline(file, line)) {
      std::vector<std::string> cells;
      std::istringstream text(line);
      std::string cell;
      while (std::getline(text, cell, ',')) cells.push_back(cell);
      if (line.back() == ',') cells.emplace_back();
      if (columns.empty())
        columns = cells;
      else
        rows.push_back(cells);
    }
  }
  const std::string& text(std::size_t row, const std::string& column) const {
    const auto place = std::find(columns.begin(), columns.end(), column) - columns.begin();
    return rows.at(row).at(place);
  }
  double number(std::size_t row, const std::string& column) const { return std::stod(text(row, column)); }
};

std::string complaint_of(const std::string& path) {
  std::ostringstream out;
  try {
    contact_command(request_for(path), out);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

}  // namespace

TEST_CASE("the table has a row for every output time and patch, and the CSV the same numbers") {
  const made_up::TemporaryFolder folder;
  write_run(folder / "run.h5");
  std::ostringstream out;
  ContactRequest request = request_for(folder / "run.h5");
  request.csv = folder / "run.csv";
  REQUIRE(contact_command(request, out) == 0);
  CHECK_THAT(out.str(), ContainsSubstring("contact tread, forces on wheel.tread"));

  const Csv csv(folder / "run.csv");
  CHECK(csv.columns.at(0) == "contact");
  REQUIRE(csv.rows.size() == 10);
  for (std::size_t row = 0; row < 10; ++row) {
    const ContactState state = made_up::Source(1e-4 * (row / 2)).contact(0);
    const ContactPatch expected = contact_solution(state).whole;
    CHECK(csv.rows[row].size() == csv.columns.size());
    CHECK(csv.text(row, "contact") == "tread");
    CHECK(csv.number(row, "patch") == row % 2);  // 0: all together
    CHECK_THAT(csv.number(row, "time"), WithinRel(1e-4 * (row / 2), 1e-12));
    CHECK(csv.number(row, "nodes_in_contact") == expected.touching.size());
    CHECK_THAT(csv.number(row, "area"), WithinRel(expected.area, 1e-8));
    CHECK_THAT(csv.number(row, "normal_force"), WithinRel(expected.normal_force, 1e-8));
    CHECK_THAT(csv.number(row, "creep_force"), WithinRel(expected.creep_force, 1e-8));
    CHECK(csv.number(row, "slipping_by_solver") == count_of(expected.regions.by_solver));
    CHECK_THAT(csv.number(row, "semi_axis_across"), WithinRel(expected.ellipse.semi_axis_across, 1e-8));
  }
}

TEST_CASE("output times can be chosen, and the rolling velocity") {
  const made_up::TemporaryFolder folder;
  write_run(folder / "run.h5");
  std::ostringstream out;
  ContactRequest request = request_for(folder / "run.h5");
  request.csv = folder / "run.csv";
  request.from = 1.5e-4;
  request.to = 3.5e-4;
  request.rolling_velocity = 25;
  request.ring = {0.5, 1.5};  // all that the made-up surfaces have
  contact_command(request, out);
  const Csv csv(folder / "run.csv");
  REQUIRE(csv.rows.size() == 4);
  CHECK_THAT(csv.number(0, "time"), WithinRel(2e-4, 1e-12));
  CHECK(csv.number(3, "rolling_velocity") == 25);
  CHECK_THAT(csv.number(3, "longitudinal_creepage"), WithinRel(csv.number(3, "rigid_slip_along") / 25, 1e-8));

  request.interval = 2e-4;
  contact_command(request, out);
  CHECK(Csv(folder / "run.csv").rows.size() == 2);
  request.interval = 1e-4;  // as they lie
  contact_command(request, out);
  CHECK(Csv(folder / "run.csv").rows.size() == 4);

  request.rolling_velocity.reset();
  request.axle = "block.corner";  // velocity (-s, 0, s) at step s
  contact_command(request, out);
  const Csv other(folder / "run.csv");
  CHECK_THAT(other.number(3, "rolling_velocity"), WithinRel(300 + other.number(3, "mean_velocity_along"), 1e-8));
}

TEST_CASE("nodes, cuts and the HDF5 file hold what the table sums up") {
  const made_up::TemporaryFolder folder;
  write_run(folder / "run.h5");
  std::ostringstream out;
  ContactRequest request = request_for(folder / "run.h5");
  request.nodes = folder / "nodes.csv";
  request.cuts = folder / "cuts.csv";
  request.hdf5 = folder / "contact.h5";
  request.csv = folder / "run.csv";
  contact_command(request, out);
  const Csv patches(folder / "run.csv"), nodes(folder / "nodes.csv"), cuts(folder / "cuts.csv");
  const double last = patches.number(9, "time");
  double force = 0;
  int touching = 0;
  for (std::size_t row = 0; row < nodes.rows.size(); ++row) {
    if (nodes.number(row, "time") != last) continue;
    force += nodes.number(row, "pressure") * nodes.number(row, "area");
    touching += nodes.number(row, "touching") > 0;
  }
  CHECK_THAT(force, WithinRel(patches.number(9, "normal_force"), 1e-8));
  CHECK(touching == patches.number(9, "nodes_in_contact"));
  CHECK(std::find(nodes.columns.begin(), nodes.columns.end(), "row") == nodes.columns.end());
  double peak = 0;
  for (std::size_t row = 0; row < cuts.rows.size(); ++row) peak = std::max(peak, cuts.number(row, "pressure"));
  CHECK_THAT(peak, WithinRel(patches.number(9, "peak_nodal_pressure"), 0.02));

  const hdf5::File file = hdf5::File::open(folder / "contact.h5");
  const hdf5::Group contact = file.root().group("contact").group("tread");
  CHECK(contact.group("nodes").dataset("pressure").shape().at(0) == nodes.rows.size());
  CHECK(contact.group("nodes").text_attribute("pressure") == "Pa");
  CHECK(contact.group("patches").dataset("area").shape().at(0) == 10);
  const hdf5::Group facets = contact.group("facets");
  const auto area = facets.dataset("area").read<double>(), pressure = facets.dataset("pressure").read<double>(),
             row_of = facets.dataset("row").read<double>();
  double facet_force = 0;
  for (std::size_t f = 0; f < area.size(); ++f)
    if (row_of[f] == 9) facet_force += area[f] * pressure[f];
  CHECK_THAT(facet_force, WithinRel(patches.number(9, "normal_force"), 1e-8));
}

TEST_CASE("nothing that a user computed gets lost") {
  const made_up::TemporaryFolder folder;
  write_run(folder / "run.h5");
  write_run(folder / "other.h5");
  std::ostringstream out;
  for (auto file : {&ContactRequest::csv, &ContactRequest::nodes, &ContactRequest::cuts, &ContactRequest::hdf5}) {
    ContactRequest request = request_for(folder / "run.h5");
    request.*file = folder / "run.h5";
    CHECK_THROWS_WITH(contact_command(request, out),
                      ContainsSubstring("is the results file, which this command reads"));
  }
  ContactRequest request = request_for(folder / "run.h5");
  request.hdf5 = folder / "other.h5";
  CHECK_THROWS_WITH(contact_command(request, out), ContainsSubstring("is there already"));
  CHECK(ContactReader(ResultsReader(folder / "other.h5"), "tread").times().size() == 5);
  request.hdf5 = folder / "contact.h5";
  CHECK(contact_command(request, out) == 0);
  CHECK(contact_command(request, out) == 0);  // its own files it replaces
  CHECK_FALSE(fs::exists(folder / "contact.h5.new"));
  CHECK(ResultsReader(folder / "run.h5").completed());
}

TEST_CASE("requests that cannot be met") {
  const made_up::TemporaryFolder folder;
  write_run(folder / "run.h5");
  std::ostringstream out;
  const auto complaint = [&](auto change) {
    ContactRequest request = request_for(folder / "run.h5");
    change(request);
    try {
      contact_command(request, out);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no complaint");
  };
  CHECK_THAT(complaint([](ContactRequest& r) {
               r.ring = {3, 2};
             }),
             ContainsSubstring("--ring 3,2") && ContainsSubstring("e.g."));
  CHECK_THAT(complaint([](ContactRequest& r) {
               r.rolling_direction = {0, 0, 0};
             }),
             ContainsSubstring("--rolling-direction"));
  CHECK_THAT(complaint([](ContactRequest& r) { r.rolling_velocity = -3; }), ContainsSubstring("above 0"));
  CHECK_THAT(complaint([](ContactRequest& r) { r.from = 2, r.to = 1; }), ContainsSubstring("--from 2 is after --to 1"));
  CHECK_THAT(complaint([](ContactRequest& r) { r.axle = "sprung_mas"; }),
             ContainsSubstring("did you mean 'sprung_mass'?"));
  CHECK_THAT(complaint([](ContactRequest& r) { r.axle = "a", r.rolling_velocity = 1; }),
             ContainsSubstring("exclude each other"));
  CHECK_THAT(complaint([](ContactRequest& r) { r.from = 1; }), ContainsSubstring("no output time from 1 s"));
}

TEST_CASE("a run that was stopped is read as far as it came") {
  const made_up::TemporaryFolder folder;
  write_run(folder / "run.h5", false);
  std::ostringstream out;
  CHECK(contact_command(request_for(folder / "run.h5"), out) == 0);
  CHECK_THAT(out.str(), ContainsSubstring("note: this run did not complete"));
  const ResultsReader results(folder / "run.h5");
  CHECK(ContactReader(results, "tread").times().size() == 2);
  CHECK_THROWS_WITH(ContactReader(results, "thread"), ContainsSubstring("did you mean 'tread'?"));
}

TEST_CASE("files that cannot be used") {
  const made_up::TemporaryFolder folder;
  CHECK_THAT(complaint_of(folder / "none.h5"), ContainsSubstring("cannot open") && ContainsSubstring("No such file"));
  CHECK_THAT(complaint_of(folder / ""), ContainsSubstring("is a folder"));

  std::ofstream(folder / "text.h5") << "time, force\n0, 1\n";
  CHECK_THAT(complaint_of(folder / "text.h5"), ContainsSubstring("no HDF5 file"));
  std::ofstream(folder / "empty.h5").flush();
  CHECK_THAT(complaint_of(folder / "empty.h5"), ContainsSubstring("no HDF5 file"));

  {
    hdf5::File other = hdf5::File::create(folder / "other.h5", kinds::model());
    other.root().set_attribute("format", "something else");
    other.close();
  }
  CHECK_THAT(complaint_of(folder / "other.h5"), ContainsSubstring("no results file of Railwave"));

  {
    hdf5::File newer = hdf5::File::create(folder / "newer.h5", kinds::results());
    newer.root().set_attribute("format", "Railwave results");
    newer.root().set_attribute("format_version", 99L);
    newer.root().set_attribute("program", "railwave 77");
    newer.close();
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

TEST_CASE("near nodes that no surface has, or rows out of order, are damage") {
  const made_up::TemporaryFolder folder;
  RunDescription run = made_up::description();
  run.contact_output.margin = 1e-3;
  for (const bool of_rows : {true, false}) {
    const std::string path = folder / (of_rows ? "rows.h5" : "nodes.h5");
    {
      ResultsWriter writer(path, run);
      made_up::feed(writer, made_up::steps);
      writer.end(made_up::summary());
    }
    CHECK(complaint_of(path) == "no complaint");
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT),
                array = H5Dopen2(file, of_rows ? "/contact/tread/slave/rows" : "/contact/tread/slave/near/node",
                                 H5P_DEFAULT),
                space = H5Dget_space(array);
    const hsize_t first = 0, one = 1;
    H5Sselect_hyperslab(space, H5S_SELECT_SET, &first, nullptr, &one, nullptr);
    const hid_t memory = H5Screate_simple(1, &one, nullptr);
    const long wrong = 100000000;
    REQUIRE(H5Dwrite(array, H5T_NATIVE_LONG, memory, space, H5P_DEFAULT, &wrong) >= 0);
    H5Sclose(memory), H5Sclose(space), H5Dclose(array), H5Fclose(file);
    CHECK_THAT(complaint_of(path), ContainsSubstring("is damaged") &&
                                       ContainsSubstring(of_rows ? "out of order" : "is no node of its surface"));
  }
}

TEST_CASE("a CSV that cannot be written is said, and leaves nothing behind") {
  const made_up::TemporaryFolder folder;
  write_run(folder / "run.h5");
  std::ostringstream out;
  ContactRequest request = request_for(folder / "run.h5");
  request.csv = folder / "none/run.csv";
  CHECK_THROWS_WITH(contact_command(request, out),
                    ContainsSubstring("none/run.csv") && ContainsSubstring("there is no folder of that name"));
}
