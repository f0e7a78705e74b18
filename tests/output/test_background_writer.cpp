// Results written by a thread of their own: the same file as written directly, and the same errors.

#include <fcntl.h>
#include <unistd.h>

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cstring>
#include <fstream>
#include <map>

#include "output/background_writer.hpp"
#include "tests/output/full_disk.hpp"
#include "tests/output/made_up_run.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;
namespace fs = std::filesystem;

namespace {

/// Every dataset below a group, by its path.
void collect(const hdf5::Group& group, const std::string& path,
             std::map<std::string, std::pair<hdf5::Shape, std::vector<double>>>& found) {
  for (const std::string& name : group.names()) {
    bool is_group = true;
    try {
      collect(group.group(name), path + "/" + name, found);
    } catch (const std::runtime_error&) {
      is_group = false;
    }
    if (!is_group) found[path + "/" + name] = {group.dataset(name).shape(), group.dataset(name).read<double>()};
  }
}

std::map<std::string, std::pair<hdf5::Shape, std::vector<double>>> datasets_of(const std::string& path) {
  std::map<std::string, std::pair<hdf5::Shape, std::vector<double>>> found;
  collect(hdf5::File::open(path).root(), "", found);
  return found;
}

/// The same bits: the gap is not-a-number here and there.
bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

void check_same_results(const std::string& path, const std::string& expected_path) {
  const auto results = datasets_of(path), expected = datasets_of(expected_path);
  CHECK(expected.size() > 60);
  REQUIRE(results.size() == expected.size());
  for (const auto& [name, dataset] : expected) {
    INFO(name);
    REQUIRE(results.count(name) == 1);
    CHECK(results.at(name).first == dataset.first);
    CHECK(same_bits(results.at(name).second, dataset.second));
  }
}

/// What goes to the error stream as long as it lives goes to a file instead.
class ErrorStream {
 public:
  explicit ErrorStream(const std::string& path) : kept_(dup(STDERR_FILENO)) {
    const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(file, STDERR_FILENO);
    close(file);
  }
  ErrorStream(const ErrorStream&) = delete;
  ~ErrorStream() {
    dup2(kept_, STDERR_FILENO);
    close(kept_);
  }

 private:
  int kept_;
};

/// What a run says that writes to a full disk, without HDF5's address of the data.
template <class Writer>
std::string complaint_of_full_disk(const std::string& path) {
  Writer writer(path, made_up::description());
  const FullDisk full(40000);
  try {
    made_up::feed(writer, made_up::steps);
    writer.end(made_up::summary());
  } catch (const std::runtime_error& error) {
    const std::string text = error.what();
    return text.substr(0, text.find("buf = "));
  }
  return "no error";
}

/// Counts what is fetched, and has nothing any more once the writer's call has returned.
class Passing : public made_up::Source {
 public:
  using Source::Source;
  HostField field(const FieldRow& row, const std::vector<int>& numbers) const override {
    ++(row.of_nodes() ? of_nodes : of_elements);
    return present(Source::field(row, numbers));
  }
  mutable int of_nodes = 0, of_elements = 0;
  bool gone = false;

 private:
  HostField present(HostField field) const { return gone ? throw std::logic_error("fetched too late") : field; }
};

}  // namespace

TEST_CASE("results written beside the run are those written between its steps") {
  const made_up::TemporaryFolder folder, other_folder;
  const std::string direct = folder / "run.h5", beside = other_folder / "run.h5";
  {
    ResultsWriter writer(direct, made_up::description());
    made_up::feed(writer, made_up::steps);
    writer.end(made_up::summary());
  }
  BackgroundWriter writer(beside, made_up::description());
  made_up::feed(writer, made_up::steps);
  writer.end(made_up::summary());

  // All is on the disk when end() returns.
  check_same_results(beside, direct);
  CHECK(text_of(other_folder / "run.xdmf") == text_of(folder / "run.xdmf"));
  CHECK(hdf5::File::open(beside).root().text_attribute("reason") == "completed");
  CHECK_FALSE(fs::exists(beside + ".new"));
}

TEST_CASE("a large output is the same whether one thread compresses it or several") {
  const made_up::TemporaryFolder folder, other_folder;
  const std::string direct = folder / "run.h5", beside = other_folder / "run.h5";
  RunDescription run = made_up::description();
  OutputSet& set = run.sets[0];
  const std::vector<int> corners(set.corners.begin(), set.corners.begin() + set.corner_count);
  while (set.elements.size() < 50000) {  // whose stress is five chunks
    set.elements.push_back(static_cast<int>(set.elements.size()));
    set.corners.insert(set.corners.end(), corners.begin(), corners.end());
  }
  {
    ResultsWriter writer(direct, run);
    made_up::feed(writer, made_up::steps);
    writer.end(made_up::summary());
  }
  BackgroundWriter writer(beside, run, {}, {}, {2, 4});
  made_up::feed(writer, made_up::steps);
  writer.end(made_up::summary());
  check_same_results(beside, direct);
}

TEST_CASE("a run that fails without an end leaves what it had given") {
  const made_up::TemporaryFolder folder, other_folder;
  const std::string direct = folder / "run.h5", beside = other_folder / "run.h5";
  {
    ResultsWriter writer(direct, made_up::description());
    made_up::feed(writer, 200);
  }
  const auto failing_run = [&] {
    BackgroundWriter writer(beside, made_up::description());
    made_up::feed(writer, 200);
    throw std::domain_error("an element turned inside out");
  };
  CHECK_THROWS_WITH(failing_run(), "an element turned inside out");
  check_same_results(beside, direct);
  CHECK(hdf5::File::open(beside).root().number_attribute("completed") == 0);
}

TEST_CASE("a background writer without data leaves the older results") {
  const made_up::TemporaryFolder folder;
  const std::string path = folder / "run.h5";
  std::ofstream(path) << "older results";
  { const BackgroundWriter writer(path, made_up::description()); }
  CHECK(text_of(path) == "older results");
  CHECK_FALSE(fs::exists(path + ".new"));
  CHECK_THROWS_WITH(BackgroundWriter(folder / "none/run.h5", made_up::description()),
                    ContainsSubstring("there is no folder"));
}

TEST_CASE("what the disk refuses comes to the run in the same words") {
  const made_up::TemporaryFolder folder;
  const std::string path = folder / "run.h5";
  std::string expected, complaint;
  {
    const ErrorStream printed(folder / "printed");
    expected = complaint_of_full_disk<ResultsWriter>(path);
    complaint = complaint_of_full_disk<BackgroundWriter>(path);
  }
  const auto but_for_the_time = [](std::string text) {
    const auto from = text.find("time = ");
    return from == std::string::npos ? text : text.erase(from, text.find('\n', from) - from);
  };
  CHECK_THAT(expected, ContainsSubstring(folder / "run.") && ContainsSubstring("File too large") &&
                           ContainsSubstring("ulimit -f"));
  CHECK(but_for_the_time(complaint) == but_for_the_time(expected));
  CHECK(text_of(folder / "printed").empty());  // HDF5 itself keeps quiet in both threads
}

TEST_CASE("the writer's exception comes at the next output, and at the end") {
  const made_up::TemporaryFolder folder;
  BackgroundWriter writer(folder / "run.h5", made_up::description());
  HistorySample wrong = made_up::sample(0);
  wrong.contacts.clear();
  writer.history(wrong);
  const auto long_run = [&] {
    for (long step = 1; step < 1000000; ++step) writer.history(made_up::sample(step));
  };
  CHECK_THROWS_AS(long_run(), std::logic_error);
  CHECK_THROWS_AS(writer.fields(made_up::Source(0), 0, 0), std::logic_error);
  CHECK_THROWS_WITH(writer.end(made_up::summary()), ContainsSubstring("other contacts, sets, beams"));
}

TEST_CASE("an output is fetched before the call returns, each field once") {
  const made_up::TemporaryFolder folder;
  const std::string path = folder / "run.h5";
  BackgroundWriter writer(path, made_up::description());
  for (long step = 0; step < 5; ++step) {
    Passing source(1e-6 * step);
    writer.history(made_up::sample(step));
    writer.fields(source, 1e-6 * step, step);
    source.gone = true;
    CHECK(source.of_nodes == 3);
    CHECK(source.of_elements == 2);
  }
  writer.end(made_up::summary());
  CHECK(hdf5::File::open(path).root().group("fields").group("block").dataset("stress").shape() ==
        hdf5::Shape{5, 24, 6});
}

TEST_CASE("a snapshot has what was selected, and says so of the rest") {
  const RunDescription run = made_up::description();
  const made_up::Source source(2e-4);
  const auto selection = std::make_shared<const FieldSelection>(
      select_fields({run.sets[1]}, {"velocity", "stress"}, OutputChoice::all(1, 0)));
  const FieldSnapshot snapshot(source, selection);
  const std::vector<int> some{7, 0, 7, 11};
  const FieldRow &stress = field_named("stress"), &velocity = field_named("velocity");
  CHECK(snapshot.field(stress, some).values == source.field(stress, some).values);
  CHECK(snapshot.field(stress, some).components == 6);
  CHECK(snapshot.field(velocity, {3, 1}).values == source.field(velocity, {3, 1}).values);
  CHECK_THROWS_AS(snapshot.field(stress, {12}), std::logic_error);  // of the upper layer
  CHECK_THROWS_AS(snapshot.field(stress, {-1}), std::logic_error);
  CHECK_THROWS_AS(snapshot.field(stress, {100000}), std::logic_error);
  CHECK_THROWS_AS(snapshot.field(field_named("displacement"), {3}), std::logic_error);
  CHECK_THROWS_AS(snapshot.field(field_named("plastic_strain"), {0}), std::logic_error);
}
