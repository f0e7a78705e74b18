#include "output/settled_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>

#include <cerrno>

#include <filesystem>
#include <stdexcept>

#include "kernels/elements/element_blocks.hpp"
#include "model/contact/contact_law.hpp"
#include "output/atomic_file.hpp"
#include "output/disk.hpp"
#include "output/hash.hpp"
#include "output/hdf5/hdf5.hpp"

namespace railwave {
namespace {

constexpr const char* format_name = "Railwave settled state 2";

StaticState read_state(const std::string& path, const std::string& key) {
  check_seal(path);
  const hdf5::File file = hdf5::File::open(path);
  const hdf5::Group root = file.root();
  if (root.text_attribute("format") != format_name || root.text_attribute("key") != key)
    throw std::runtime_error("it is of another case or of another version of the program");
  StaticState state;
  state.settled = root.number_attribute("settled") != 0;
  state.unbalance = root.number_attribute("unbalance");
  state.steps = static_cast<int>(root.number_attribute("steps"));
  state.iterations = static_cast<int>(root.number_attribute("iterations"));
  for (const std::string& name : root.names())
    state.arrays.values.push_back({name, root.dataset(name).read<signed char>()});
  return state;
}

void write_state(const std::string& path, const std::string& key, const std::string& version,
                 const StaticState& state) {
  hdf5::File file = hdf5::File::create(path, kinds::settled_state());
  const hdf5::Group root = file.root();
  root.set_attribute("format", format_name);
  root.set_attribute("key", key);
  root.set_attribute("program", "railwave " + version);
  root.set_attribute("settled", state.settled ? 1L : 0L);
  root.set_attribute("unbalance", state.unbalance);
  root.set_attribute("steps", static_cast<long>(state.steps));
  root.set_attribute("iterations", static_cast<long>(state.iterations));
  for (const RunState::Values& one : state.arrays.values)
    root.write(one.name, one.bytes, {one.bytes.size()}, {}, hdf5::Check::by_seal);
  file.close(seal);
}

/// Runs of one case that settle side by side, as those of a sweep, keep the same file: each waits until another has
/// written it whole. Where the file system has no locks there is none.
disk::Descriptor locked_folder(const std::string& folder) {
  disk::Descriptor descriptor(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (descriptor.get() >= 0)
    while (flock(descriptor.get(), LOCK_EX) != 0 && errno == EINTR) {
    }
  return descriptor;
}

}  // namespace

std::string SettledFiles::key(const AssembledScene& assembled) const {
  Hash hash;
  hash.add(format_name);
  hash.add(version_);
  hash.add(fmt::format("{} elements of a block, {} in a pack", elements_of_block, lane_count<double>));
  hash.add(assembled.scene.static_text);
  hash.add(chosen_algorithms(assembled.scene));
  hash.add(assembled.assembly.nodes);
  hash.add(assembled.assembly.elements);
  return hash.text();
}

std::string SettledFiles::path(const AssembledScene& assembled) const {
  const std::string& named = assembled.scene.settle.cache_folder;
  const std::filesystem::path folder =
      named.empty() ? std::filesystem::path(assembled.scene.output.file).parent_path() : std::filesystem::path(named);
  return (folder / ("settled-" + key(assembled) + ".h5")).string();
}

SettledStates::Found SettledFiles::find(const AssembledScene& assembled) {
  Found found;
  if (!assembled.scene.settle.cache || assembled.scene.static_text.empty()) return found;
  const std::string name = path(assembled);
  std::error_code ignored;
  if (!std::filesystem::exists(name, ignored)) return found;  // whatever else lies there is reported below
  found.file = name;
  const std::lock_guard<std::recursive_mutex> holding(hdf5::in_use());
  try {
    found.state = read_state(name, key(assembled));
  } catch (const std::runtime_error& error) {
    found.trouble = fmt::format("cannot be used: {}", error.what());
  }
  return found;
}

std::string SettledFiles::keep(const AssembledScene& assembled, const StaticState& state) {
  if (!assembled.scene.settle.cache || assembled.scene.static_text.empty()) return {};
  const std::string name = path(assembled);
  const std::lock_guard<std::recursive_mutex> holding(hdf5::in_use());
  try {
    const std::filesystem::path folder = std::filesystem::path(name).parent_path();
    if (!folder.empty()) std::filesystem::create_directories(folder);
    const disk::Descriptor one_at_a_time = locked_folder(folder.empty() ? "." : folder.string());
    write_state(name, key(assembled), version_, state);
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

}  // namespace railwave
