#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cmath>
#include <sstream>

#include "case/error.hpp"
#include "case/read_case.hpp"
#include "sweep/member_row.hpp"
#include "sweep/overrides_of_members.hpp"
#include "sweep/run_members.hpp"
#include "sweep/study.hpp"
#include "tests/case/temporary_case.hpp"

using namespace railwave;
using namespace railwave::sweep;
using Catch::Matchers::ContainsSubstring;

namespace {

const std::string blocks = R"([materials.steel]
youngs_modulus = 210e9
poissons_ratio = 0.3
density = 7800
[meshes.cube]
type = "box"
[parts.lower]
mesh = "cube"
material = "steel"
[parts.upper]
mesh = "cube"
material = "steel"
position = [0, 0, 1.1]
[contacts.between]
slave = "upper.z_min"
master = "lower.z_max"
friction = 0.3
[time]
end = 1e-3
)";

/// A folder with blocks.toml and study.toml, whose case it is.
struct StudyFolder {
  explicit StudyFolder(const std::string& text, const std::string& csv = "") {
    folder.write("blocks.toml", blocks);
    folder.write("members.csv", csv);
    folder.write("study.toml", "case = \"blocks.toml\"\nfolder = \"" + folder.path().string() + "/out\"\n" + text);
  }
  Study read() const { return read_study(folder / "study.toml"); }
  std::string mistakes() const {
    try {
      read();
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  }
  TemporaryFolder folder;
};

std::vector<std::string> called(const Study& study) {
  std::vector<std::string> texts;
  for (const Member& member : study.members) texts.push_back(member.called);
  return texts;
}

}  // namespace

TEST_CASE("the grid's last key changes first, and a range has both its ends", "[sweep]") {
  const StudyFolder folder(
      "[grid]\ncontacts.between.friction = {from = 0.1, to = 0.3, count = 3}\n\"time.end\" = [1e-3, 2e-3]\n");
  const Study study = folder.read();
  CHECK(called(study) == std::vector<std::string>{"friction=0.1, end=0.001", "friction=0.1, end=0.002",
                                                  "friction=0.2, end=0.001", "friction=0.2, end=0.002",
                                                  "friction=0.3, end=0.001", "friction=0.3, end=0.002"});
  CHECK(study.members[3].overrides == std::vector<std::string>{"contacts.between.friction=0.2", "time.end=0.002"});
  CHECK(study.parameters[1].unit == "s");
  CHECK(study.parameters[0].unit == "1");
  CHECK(study.members[4].number == 5);
}

TEST_CASE("logarithmic ranges have even ratios", "[sweep]") {
  const StudyFolder folder("[grid]\ntime.end = {from = 1e-4, to = 1e-2, count = 3, spacing = \"logarithmic\"}\n");
  CHECK(called(folder.read()) == std::vector<std::string>{"end=0.0001", "end=0.001", "end=0.01"});
}

TEST_CASE("list, table and grid are combined; what a member does not say is as in the case", "[sweep]") {
  const StudyFolder folder(
      "table = \"members.csv\"\n[common]\ntitle = \"all\"\n[[list]]\ncontacts.between.friction = 0.1\n[[list]]\n"
      "time.step_scale = 0.5\n[grid]\n\"parts.upper.position[2]\" = [1.2, 1.3]\n",
      "# a remark\nmaterials.steel.density [kg/m3],\"parts.upper.hourglass\"\n7000,viscous\n, \"stiffness\"\n");
  const Study study = folder.read();
  REQUIRE(study.members.size() == 8);
  CHECK(study.members[0].called ==
        "friction=0.1, step_scale=as in the case, density=7000, hourglass=viscous, "
        "position[2]=1.2");
  CHECK(study.members[7].called == "friction=0.3, step_scale=0.5, density=7800, hourglass=stiffness, position[2]=1.3");
  CHECK(study.members[7].overrides == std::vector<std::string>{"title=\"all\"", "time.step_scale=0.5",
                                                               "parts.upper.hourglass=\"stiffness\"",
                                                               "parts.upper.position[2]=1.3"});
  CHECK(study.parameters[2].unit == "kg/m3");
  CHECK(study.parameters[4].unit == "m");
}

TEST_CASE("a member's folder depends on its case alone: a longer grid leaves it where it is", "[sweep]") {
  const StudyFolder one("[grid]\ntime.end = [1e-3, 2e-3]\n");
  const Study shorter = one.read();
  one.folder.write("study.toml", "case = \"blocks.toml\"\nfolder = \"" + one.folder.path().string() +
                                     "/out\"\n[grid]\ntime.end = [5e-4, 1e-3, 2e-3]\n");
  const Study longer = one.read();
  CHECK(longer.members[1].folder == shorter.members[0].folder);
  CHECK(longer.members[2].folder == shorter.members[1].folder);
  one.folder.write("blocks.toml", blocks + "# a remark\n");
  CHECK(one.read().members[1].folder == longer.members[1].folder);
  one.folder.write("blocks.toml", blocks + "step_scale = 0.8\n");
  CHECK(one.read().members[1].folder != longer.members[1].folder);
}

TEST_CASE("without figures those of each contact and the energies are collected", "[sweep]") {
  const Study study = StudyFolder("[grid]\ntime.end = [1e-3]\n").read();
  REQUIRE(study.figures.figures.size() == 14);
  CHECK(study.figures.figures[1].name == "between_peak_nodal_pressure");
  CHECK(study.figures.need_run());
  CHECK_FALSE(study.figures.need_modes());
}

TEST_CASE("mistakes of a study say where and how to mend", "[sweep]") {
  const auto mistakes = [](const std::string& text, const std::string& csv = "") {
    return StudyFolder(text, csv).mistakes();
  };
  CHECK_THAT(mistakes("gird = 1\n"), ContainsSubstring("study.toml:3: gird: unknown key; did you mean 'grid'?"));
  CHECK_THAT(mistakes("[grid]\ntime.end = 1e-3\n"), ContainsSubstring("study.toml:4: [grid] time.end: must be a list"));
  CHECK_THAT(mistakes("[grid]\ntime.edn = [1e-3]\n"), ContainsSubstring("member 1 (edn=0.001)"));
  CHECK_THAT(mistakes("[grid]\ntime.edn = [1e-3]\n"), ContainsSubstring("did you mean 'end'?"));
  CHECK_THAT(mistakes("[grid]\ntime.end = [1e-3, 1e-3]\n"), ContainsSubstring("members 1 and 2 are the same case"));
  CHECK_THAT(mistakes("[grid]\noutput.file = [\"a.h5\"]\n"), ContainsSubstring("files of its own"));
  CHECK_THAT(mistakes("[grid]\ntime.end = {from = 1, to = 2, count = 1}\n"), ContainsSubstring("count must be"));
  CHECK_THAT(mistakes("[[list]]\ntime.end = 1\n[grid]\ntime.end = [1]\n"), ContainsSubstring("both in [[list]] and"));
  CHECK_THAT(mistakes("table = \"none.csv\"\n"), ContainsSubstring("there is no such file"));
  CHECK_THAT(mistakes("table = \"members.csv\"\n", "time.end\n1e-3,2\n"),
             ContainsSubstring("members.csv:2: has 2 cells, the heading has 1"));
  CHECK_THAT(mistakes("table = \"members.csv\"\n", "time.end\n\"1e-3\n"), ContainsSubstring("is not closed"));
  for (const std::string by : {";", "\t"})
    CHECK_THAT(
        mistakes("table = \"members.csv\"\n", "time.end" + by + "contacts.between.friction\n1e-3" + by + "0,1\n"),
        ContainsSubstring("members.csv:1: the heading is one key") && ContainsSubstring("parted by commas"));
  CHECK_THAT(mistakes("[figures]\na = \"patch.between.peak_sheer\"\n"),
             ContainsSubstring("a patch has no 'peak_sheer'; did you mean 'peak_shear'?"));
  CHECK_THAT(mistakes("[figures]\na = {of = \"energy.kinetic\", take = \"maximun\"}\n"),
             ContainsSubstring("did you mean 'maximum'?"));
  CHECK_THAT(mistakes("[figures]\na = \"mode.0.frequency\"\n"), ContainsSubstring("such as mode.1.frequency"));
  CHECK_THAT(mistakes("[slurm]\noptions = [\"rm -rf\"]\n"), ContainsSubstring("must be an option of sbatch"));
  CHECK_THAT(mistakes("retries = -1\n"), ContainsSubstring("retries: must be a whole number from 0"));
  CHECK_THAT(mistakes("[grid]\n\"parts.upper.position[3]\" = [1]\n"), ContainsSubstring("there is no [3]"));
}

TEST_CASE("mistakes in overrides say where in the study or its table they stand", "[sweep]") {
  const auto mistakes = [](const std::string& text, const std::string& csv = "") {
    return StudyFolder(text, csv).mistakes();
  };
  CHECK_THAT(mistakes("[grid]\ntime.edn = [1e-3]\n"),
             ContainsSubstring("study.toml:4: [time] edn: unknown key; did you mean 'end'?"));
  CHECK_THAT(mistakes("[common]\ntime.end = 1e-3\ncontacts.betwen.friction = 1\n"),
             ContainsSubstring("study.toml:5: contacts.betwen.friction: the file has no contact 'betwen'"));
  CHECK_THAT(mistakes("[[list]]\ntime.end = 1e-3\n[[list]]\ntime.end = -1\n"), ContainsSubstring("study.toml:6: "));
  CHECK_THAT(mistakes("table = \"members.csv\"\n", "time.end,contacts.between.frction\n# none\n1e-3,0.1\n"),
             ContainsSubstring("members.csv:3: [contacts.between] frction: unknown key; did you mean 'friction'?"));
  CHECK_THAT(mistakes("table = \"members.csv\"\n", "time.end,time.edn\n1e-3,\n"),
             ContainsSubstring("members.csv:1: time.edn: no line has a value in this column"));
  CHECK_THAT(mistakes("table = \"members.csv\"\n", "time.end,\n1e-3,1\n"),
             ContainsSubstring("members.csv:1: column 2 has no heading"));
  CHECK_THAT(mistakes("table = \"members.csv\"\n", "time.end,time.end [s]\n1e-3,1e-4\n"),
             ContainsSubstring("members.csv:1: time.end: has two columns"));
  CHECK_THAT(mistakes("table = \"members.csv\"\n", "time.end [ms]\n1\n"),
             ContainsSubstring("members.csv:1: time.end: is in s, not in [ms]"));
}

TEST_CASE("figures that the case cannot have are mistakes of the study", "[sweep]") {
  const auto mistakes = [](const std::string& text) { return StudyFolder(text).mistakes(); };
  CHECK_THAT(mistakes("[figures]\nok = \"energy.kinetic\"\na = \"patch.betwen.area\"\n"),
             ContainsSubstring("study.toml:5: [figures] a: there is no contact 'betwen' in ") &&
                 ContainsSubstring("did you mean 'between'?"));
  CHECK_THAT(mistakes("[common]\noutput.contact_fields = [\"normal_force\"]\n[figures]\na = "
                      "\"patch.between.area\"\n"),
             ContainsSubstring("study.toml:6: [figures] a: ") && ContainsSubstring("leaves out 'tangential_force'"));
  CHECK_THAT(mistakes("[figures]\na = {of = \"energy.kinetic\", from = 2e-3}\n"),
             ContainsSubstring("study.toml:4: [figures] a: from is 0.002 s, after the end of the run"));
  CHECK_THAT(mistakes("[common]\noutput.history_interval = 1e-4\n[figures]\na = {of = \"energy.kinetic\", from = "
                      "8.5e-4}\n"),
             ContainsSubstring("there are 3 samples at most from 0.00085 s to 0.001 s, of which 4 are wanted"));
  CHECK(mistakes("[common]\noutput.history_interval = 1e-4\n[figures]\na = {of = \"energy.kinetic\", from = "
                 "7e-4}\n")
            .empty());
  const std::string amid = "[figures]\na = {of = \"patch.between.area\", from = 4e-4, to = 5e-4}\n";
  CHECK_THAT(mistakes(amid), ContainsSubstring("study.toml:4: [figures] a: no output lies from 0.0004 s to 0.0005 s"));
  CHECK(mistakes("[common]\noutput.field_interval = 1e-4\n" + amid).empty());
  CHECK(mistakes("[figures]\na = {of = \"patch.between.area\", from = 4e-4}\n").empty());
  CHECK_THAT(mistakes("[figures]\na = \"mode.1.frequency\"\n[modes]\nparts = [\"uper\"]\n"),
             ContainsSubstring("study.toml:5: [modes] parts: there is no part or point mass 'uper'") &&
                 ContainsSubstring("did you mean 'upper'?"));
  CHECK_THAT(mistakes("[grid]\ntime.end = [1e-3, 1e-4]\n[figures]\na = {of = \"energy.kinetic\", from = 5e-4}\n"),
             ContainsSubstring("member 2 (end=0.0001)"));
}

TEST_CASE("histories that no run will write are found with the case's meshes", "[sweep]") {
  const auto mistakes = [](const std::string& figure, const std::string& more = "") {
    const StudyFolder folder(
        "[common]\noutput.history_sets = [\"upper.z_max\", \"upper.z_min\"]\n[figures]\nfirst = "
        "\"energy.kinetic\"\na = \"" +
        figure + "\"\n" + more);
    const Study study = folder.read();
    case_file::Complaints complaints(study.path);
    check_histories(study.figures, read_case(study.case_file, study.members.front().overrides), complaints);
    return complaints.empty() ? std::string() : complaints.lines().front();
  };
  for (const char* good : {"upper.z_max.velocity.x", "energy.friction", "contact.between.normal_force.size",
                           "upper.z_max.displacement.0,1,1", "upper.z_max+upper.z_min.velocity.z"})
    CHECK(mistakes(good).empty());
  CHECK_THAT(mistakes("energy.frction"),
             ContainsSubstring("study.toml:7: [figures] a: ") && ContainsSubstring("did you mean 'friction'?"));
  CHECK_THAT(mistakes("contact.between.nodes"), ContainsSubstring("a contact has no 'nodes'"));
  CHECK_THAT(mistakes("contact.tread.normal_force.z"),
             ContainsSubstring("there is no such contact; known are: between"));
  CHECK_THAT(mistakes("upper.y_max.velocity.z"), ContainsSubstring("there is no history of a set 'upper.y_max'"));
  CHECK_THAT(mistakes("upper.z_max.stress.zz"), ContainsSubstring("the run wrote the stress or strain of no set"));
  CHECK_THAT(mistakes("upper.z_max.velocity"), ContainsSubstring("needs a direction at its end"));
  CHECK_THAT(mistakes("upper.z_*.velocity.z"), ContainsSubstring("finds 2 histories; name one"));
  CHECK_THAT(mistakes("load.push.force.z"), ContainsSubstring("the run has no load"));
  CHECK_THAT(mistakes("patch.between.area", "[patches]\naxle = \"upper.x_max\"\n"),
             ContainsSubstring("study.toml:8: [patches] axle: the run does not write the velocity of a set "
                               "'upper.x_max'"));
}

TEST_CASE("members are chosen by numbers and ranges, or as the share of a job", "[sweep]") {
  const Study study = StudyFolder("[grid]\ntime.end = {from = 1e-3, to = 7e-3, count = 7}\n").read();
  const auto numbers = [](const std::vector<const Member*>& members) {
    std::vector<int> all;
    for (const Member* member : members) all.push_back(member->number);
    return all;
  };
  CHECK(numbers(chosen_members(study, "6,2-4,3")) == std::vector<int>{2, 3, 4, 6});
  CHECK(numbers(share_of_job(study, 2, 3)) == std::vector<int>{2, 5});
  CHECK_THROWS_AS(chosen_members(study, "8"), InputError);
  CHECK_THROWS_AS(chosen_members(study, "4-2"), InputError);
  CHECK_THROWS_AS(chosen_members(study, "two"), InputError);
  CHECK_THROWS_AS(share_of_job(study, 4, 3), InputError);
}

TEST_CASE("a row is read as it was written; half of one is none", "[sweep]") {
  const StudyFolder folder("[grid]\ntime.end = [1e-3]\n");
  const Study study = folder.read();
  const Member& member = study.members.front();
  std::filesystem::create_directories(member.folder);
  MemberRow row;
  row.status = Status::completed;
  row.figures_key = study.figures.key();
  row.figures = {{"a", "Pa", 1.0 / 3}, {"b", "1", std::nan("")}};
  write_row(member, row);
  const auto read = read_row(member);
  REQUIRE(read);
  CHECK(read->figures[0].value == 1.0 / 3);
  CHECK(read->figures[0].unit == "Pa");
  CHECK(std::isnan(read->figures[1].value));
  CHECK(is_done(study, member));
  const std::string path = MemberFiles(member).row(), text = text_of(path);
  for (const std::size_t length : {text.size() - 2, text.size() / 2, std::size_t{0}}) {
    std::ofstream(path) << text.substr(0, length);
    CHECK_FALSE(read_row(member));
    CHECK_FALSE(is_done(study, member));
  }
}

TEST_CASE("one sweep has a member at a time", "[sweep]") {
  const TemporaryFolder folder;
  {
    const auto lock = MemberLock::take(folder / "member.lock");
    REQUIRE(lock);
    CHECK_FALSE(MemberLock::take(folder / "member.lock"));
  }
  CHECK_FALSE(std::filesystem::exists(folder / "member.lock"));
  CHECK(MemberLock::take(folder / "member.lock"));
}

TEST_CASE("processors go to members first, and to threads within them where members are fewer", "[sweep]") {
  RunOptions options;
  const auto shared = [&](int processors, std::size_t members) {
    const Sharing sharing = share_processors(processors, members, options);
    return std::pair(sharing.jobs, sharing.threads);
  };
  CHECK(shared(8, 200) == std::pair(8, 1));
  CHECK(shared(8, 3) == std::pair(3, 2));
  CHECK(shared(8, 1) == std::pair(1, 8));
  options.threads = 4;
  CHECK(shared(8, 200) == std::pair(2, 4));
  options.jobs = 3;
  CHECK(shared(8, 200) == std::pair(3, 4));
  options.threads = 0;
  CHECK(shared(8, 200) == std::pair(3, 2));
}
