#include "output/settled_file.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

#include "kernels/patches.hpp"
#include "output/hash.hpp"
#include "output/hdf5.hpp"
#include "output/seal.hpp"

namespace railwave {
namespace {

/// visit(name, vector) for every array of a state, in fixed order.
template <class State, class Visit>
void each_array(State& state, const Visit& visit) {
  visit("position", state.position);
  for (std::size_t p = 0; p < state.contacts.size(); ++p) {
    auto& contact = state.contacts[p];
    const std::string of_pair = fmt::format("contact_{}_", p);
    visit(of_pair + "tracked", contact.tracked);
    visit(of_pair + "status", contact.status);
    visit(of_pair + "place", contact.place);
    visit(of_pair + "gap", contact.gap);
    visit(of_pair + "normal_force", contact.normal_force);
    visit(of_pair + "tangential_force", contact.tangential_force);
    visit(of_pair + "way_since_stuck", contact.way_since_stuck);
  }
  for (std::size_t g = 0; g < state.plastic.size(); ++g) {
    visit(fmt::format("plastic_{}", g), state.plastic[g]);
    visit(fmt::format("back_stress_{}", g), state.back_stress[g]);
  }
  visit("beam_rotation", state.beam_rotation);
  visit("beam_stretch", state.beam_stretch);
  visit("end_support", state.end_support);
}

constexpr const char* format_name = "Railwave settled state 1";

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
  const double contacts = root.number_attribute("contacts"), groups = root.number_attribute("element_groups");
  if (!(contacts >= 0 && contacts < 1e6 && groups >= 0 && groups < 1e6))
    throw std::runtime_error("its numbers make no sense");
  state.contacts.resize(static_cast<std::size_t>(contacts));
  state.plastic.resize(static_cast<std::size_t>(groups));
  state.back_stress.resize(state.plastic.size());
  each_array(state, [&](const std::string& name, auto& values) {
    if (root.has(name))
      values = root.dataset(name).template read<typename std::decay_t<decltype(values)>::value_type>();
  });
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
  root.set_attribute("contacts", static_cast<long>(state.contacts.size()));
  root.set_attribute("element_groups", static_cast<long>(state.plastic.size()));
  each_array(state, [&](const std::string& name, const auto& values) {
    if (!values.empty()) root.write(name, values, {values.size()}, {}, hdf5::Check::by_seal);
  });
  file.close(seal);
}

}  // namespace

std::string SettledFiles::key(const Model& model) const {
  Hash hash;
  hash.add(format_name);
  hash.add(version_);
  hash.add(fmt::format("{} elements of a patch, {} in a pack", patch_size, lane_count<double>));
  hash.add(model.scene.static_text);
  hash.add(model.assembly.nodes);
  hash.add(model.assembly.elements);
  return hash.text();
}

std::string SettledFiles::path(const Model& model) const {
  const std::string& named = model.scene.settle.cache_folder;
  const std::filesystem::path folder =
      named.empty() ? std::filesystem::path(model.scene.output.file).parent_path() : std::filesystem::path(named);
  return (folder / ("settled-" + key(model) + ".h5")).string();
}

SettledStates::Found SettledFiles::find(const Model& model) {
  Found found;
  if (!model.scene.settle.cache || model.scene.static_text.empty()) return found;
  const std::string name = path(model);
  std::error_code ignored;
  if (!std::filesystem::exists(name, ignored)) return found;  // whatever else lies there is told below
  found.file = name;
  try {
    found.state = read_state(name, key(model));
  } catch (const std::runtime_error& error) {
    found.trouble = fmt::format("cannot be used: {}", error.what());
  }
  return found;
}

std::string SettledFiles::keep(const Model& model, const StaticState& state) {
  if (!model.scene.settle.cache || model.scene.static_text.empty()) return {};
  const std::string name = path(model);
  try {
    const std::filesystem::path folder = std::filesystem::path(name).parent_path();
    if (!folder.empty()) std::filesystem::create_directories(folder);
    write_state(name, key(model), version_, state);
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

}  // namespace railwave
