#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <filesystem>
#include <fstream>
#include <random>

#include "output/checkpoint_file.hpp"
#include "output/hdf5/hdf5.hpp"
#include "tests/temporary_folder.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;

namespace {

struct Folder : TemporaryFolder {
  std::string file() const { return *this / "run.checkpoint.h5"; }
};

RunState state_at(long step) {
  RunState state;
  state.step = step;
  state.time = 0.1 * static_cast<double>(step);
  state.history_rows = 2 * step;
  state.field_outputs = step / 2;
  state.back_end = "abacus";
  StateSaver saver(state);
  saver.values("numbers", std::vector<double>{1.5, -0.0, 1e-310, 3});
  saver.values("none", std::vector<int>{});
  saver.value("step", step);
  return state;
}

void damage(const std::string& path, std::size_t place) {
  std::string bytes = text_of(path);
  bytes.at(place) = static_cast<char>(bytes[place] ^ 4);
  std::ofstream(path, std::ios::binary) << bytes;
}

/// Where a double lies in a file.
std::size_t place_of(const std::string& path, double value) {
  return text_of(path).find(std::string(reinterpret_cast<const char*>(&value), sizeof value));
}

}  // namespace

TEST_CASE("a state comes back from its file as it was") {
  const Folder folder;
  const CheckpointFile file(folder.file(), "key");
  CHECK_FALSE(file.find("run").state);
  CHECK(file.find("run").troubles.empty());
  file.write(state_at(6), "run");
  const CheckpointFile::Found found = file.find("run");
  REQUIRE(found.state);
  CHECK(found.file == folder.file());
  CHECK(found.state->step == 6);
  CHECK(found.state->time == 0.1 * 6);
  CHECK(found.state->history_rows == 12);
  CHECK(found.state->field_outputs == 3);
  CHECK(found.state->back_end == "abacus");
  const RunState wanted = state_at(6);
  REQUIRE(found.state->values.size() == wanted.values.size());
  for (std::size_t k = 0; k < wanted.values.size(); ++k) {
    CHECK(found.state->values[k].name == wanted.values[k].name);
    CHECK(found.state->values[k].bytes == wanted.values[k].bytes);
  }
  StateRestorer restorer(*found.state);
  long step = 0;
  restorer.value("step", step);
  CHECK(step == 6);
  CHECK_THROWS_WITH(restorer.value("unheard of", step), ContainsSubstring("unheard of is missing"));
}

TEST_CASE("a damaged state is refused and the one before it taken") {
  const Folder folder;
  const CheckpointFile file(folder.file(), "key");
  file.write(state_at(6), "run");
  file.write(state_at(8), "run");
  CHECK(file.find("run").state->step == 8);
  damage(folder.file(), place_of(folder.file(), 1.5));
  CheckpointFile::Found found = file.find("run");
  REQUIRE(found.state);
  CHECK(found.state->step == 6);
  CHECK(found.file == folder.file() + ".previous");
  REQUIRE(found.troubles.size() == 1);
  CHECK_THAT(found.troubles[0], ContainsSubstring("its checksum is not that of what it holds"));
  damage(folder.file() + ".previous", place_of(folder.file() + ".previous", 1.5));
  found = file.find("run");
  CHECK_FALSE(found.state);
  CHECK(found.troubles.size() == 2);
}

TEST_CASE("a state of another case or run is refused") {
  const Folder folder;
  CheckpointFile(folder.file(), "key").write(state_at(6), "run");
  const CheckpointFile::Found of_case = CheckpointFile(folder.file(), "other").find("run"),
                              of_run = CheckpointFile(folder.file(), "key").find("other");
  CHECK_FALSE(of_case.state);
  CHECK_THAT(of_case.troubles.at(0), ContainsSubstring("of another case"));
  CHECK_FALSE(of_run.state);
  CHECK_THAT(of_run.troubles.at(0), ContainsSubstring("of another run"));
}

TEST_CASE("what a kill leaves of the next state harms nothing") {
  const Folder folder;
  const CheckpointFile file(folder.file(), "key");
  file.write(state_at(6), "run");
  std::filesystem::copy(folder.file(),
                        folder.file() + ".new");  // one of the same kind: not whole, or without a name yet
  std::filesystem::resize_file(folder.file() + ".new", std::filesystem::file_size(folder.file()) - 100);
  CHECK(file.find("run").state->step == 6);
  // Between the two renamings only the one before has its name.
  std::filesystem::rename(folder.file(), folder.file() + ".previous");
  CHECK(file.find("run").state->step == 6);
  file.write(state_at(8), "run");
  CHECK(file.find("run").state->step == 8);
  file.remove();
  CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("what is not of a checkpoint's kind is neither replaced nor removed") {
  const Folder folder;
  const CheckpointFile file(folder.file(), "key");
  for (const char* ending : {"", ".previous", ".new"}) {
    INFO("a text " << folder.file() << ending);
    std::ofstream(folder.file() + ending) << "notes";
    if (std::string(ending) == ".new")
      CHECK_NOTHROW(file.write(state_at(6), "run"));
    else
      CHECK_THROWS_WITH(file.write(state_at(6), "run"), ContainsSubstring("is there already"));
    file.remove();
    std::string text;
    std::getline(std::ifstream(folder.file() + ending), text);
    CHECK(text == "notes");
    std::filesystem::remove(folder.file() + ending);
    CHECK(std::filesystem::is_empty(folder.path()));
  }
}

TEST_CASE("a checkpoint behind a symbolic link is written where the link leads to") {
  const Folder folder;
  const std::string elsewhere = folder.file() + ".elsewhere";
  std::filesystem::create_symlink(elsewhere, folder.file());
  const CheckpointFile file(folder.file(), "key");
  file.write(state_at(6), "run");
  file.write(state_at(8), "run");
  CHECK(std::filesystem::is_symlink(folder.file()));
  CHECK(std::filesystem::exists(elsewhere + ".previous"));
  CHECK(file.find("run").state->step == 8);
  file.remove();
  CHECK(std::filesystem::is_symlink(folder.file()));
  CHECK_FALSE(std::filesystem::exists(elsewhere));
}

TEST_CASE("no damage is taken for a state") {
  const Folder folder;
  const CheckpointFile file(folder.file(), "key");
  file.write(state_at(6), "run");
  const std::string sound = text_of(folder.file());
  const auto refused = [&](const std::string& bytes) {
    std::ofstream(folder.file(), std::ios::binary | std::ios::trunc) << bytes;
    const CheckpointFile::Found found = file.find("run");
    return !found.state && found.troubles.size() == 1;
  };
  std::mt19937 random(5);
  for (int trial = 0; trial < 2000; ++trial) {
    std::string bytes = sound;
    const std::size_t place = random() % bytes.size();
    bytes[place] = static_cast<char>(bytes[place] ^ (1 << random() % 8));
    INFO("bit at " << place);
    CHECK(refused(bytes));
  }
  std::vector<std::size_t> lengths{
      0, 1, 7, 8, 23, 24, 25, 96, sound.size() - 1, sound.size() - 8, sound.size() - 24, sound.size() - 25};
  for (std::size_t length = 2; length < sound.size(); length = length * 3 / 2 + 1) lengths.push_back(length);
  for (const std::size_t length : lengths) {
    INFO("cut to " << length);
    CHECK(refused(sound.substr(0, length)));
    // A disk that had no time. The seal at the end may itself end with a zero: once in 256 runs.
    const std::string zeroed = sound.substr(0, length) + std::string(sound.size() - length, '\0');
    if (zeroed != sound) CHECK(refused(zeroed));
  }
  CHECK(refused(sound + "x"));
  CHECK(refused("a text of somebody else's"));
  std::filesystem::remove(folder.file());
  {
    hdf5::File other = hdf5::File::create(folder.file(), kinds::checkpoint());
    other.root().set_attribute("title", "another program's");
    other.close();
  }
  CHECK(file.find("run").troubles.size() == 1);
  CHECK_FALSE(refused(sound));
}
