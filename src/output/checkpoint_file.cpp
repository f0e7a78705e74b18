#include "output/checkpoint_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <stdexcept>

#include "kernels/elements/element_blocks.hpp"
#include "model/contact/contact_law.hpp"
#include "output/atomic_file.hpp"
#include "output/hash.hpp"
#include "output/hdf5/hdf5.hpp"
#include "output/output_place.hpp"

namespace railwave {
namespace {

constexpr const char* format_name = "Railwave checkpoint 2";

/// All numbers of a state in one dataset, one after the other; `sizes` tells the arrays apart, `names` what they are.
RunState read(const std::string& path, const std::string& key, const std::string& run) {
  check_seal(path);
  const hdf5::File file = hdf5::File::open(path);
  const hdf5::Group root = file.root();
  if (!root.has_attribute("format") || root.text_attribute("format") != format_name)
    throw std::runtime_error("it is no checkpoint of this version of the program");
  if (root.text_attribute("key") != key)
    throw std::runtime_error(
        "it is of another case, of this case before it was changed, or of another version of the program");
  RunState state;
  state.step = static_cast<long>(root.number_attribute("step"));
  state.time = root.number_attribute("time");
  state.history_rows = static_cast<long>(root.number_attribute("history_rows"));
  state.field_outputs = static_cast<long>(root.number_attribute("field_outputs"));
  state.back_end = root.text_attribute("back_end");
  const auto sizes = root.dataset("sizes").read<long>();
  const auto bytes = root.dataset("values").read<signed char>();
  const std::string names = root.text_attribute("names");
  std::size_t from = 0, name = 0;
  for (const long size : sizes) {
    const std::size_t end = names.find('\n', name);
    if (end == std::string::npos || size < 0 || static_cast<std::size_t>(size) > bytes.size() - from)
      throw std::runtime_error("its numbers make no sense");
    const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(from);
    state.values.push_back({names.substr(name, end - name), {first, first + size}});
    from += static_cast<std::size_t>(size);
    name = end + 1;
  }
  const std::string of = root.text_attribute("run");
  if (from != bytes.size()) throw std::runtime_error("its numbers make no sense");
  if (of != run) throw std::runtime_error("it is of another run than the one whose results are there");
  return state;
}

}  // namespace

CheckpointFile::CheckpointFile(const std::string& path, std::string key)
    : path_(target_of(path)), key_(std::move(key)) {}

void CheckpointFile::write(const RunState& state, const std::string& run) const {
  hdf5::File file = hdf5::File::create(path_, kinds::checkpoint());
  const hdf5::Group root = file.root();
  root.set_attribute("format", format_name);
  root.set_attribute("key", key_);
  root.set_attribute("run", run);
  root.set_attribute("step", state.step);
  root.set_attribute("time", state.time);
  root.set_attribute("history_rows", state.history_rows);
  root.set_attribute("field_outputs", state.field_outputs);
  root.set_attribute("back_end", state.back_end);
  std::string names;
  std::vector<long> sizes;
  std::vector<signed char> bytes;
  for (const RunState::Values& one : state.values) {
    names += one.name + '\n';
    sizes.push_back(static_cast<long>(one.bytes.size()));
    bytes.insert(bytes.end(), one.bytes.begin(), one.bytes.end());
  }
  root.set_attribute("names", names);
  root.write("sizes", sizes, {sizes.size()}, {}, hdf5::Check::by_seal);
  root.write("values", bytes, {bytes.size()}, {}, hdf5::Check::by_seal);
  file.close([this](const std::string& written) {
    seal(written);
    std::error_code none_before;
    expect_replaceable(path_ + ".previous", kinds::checkpoint());
    expect_replaceable(path_, kinds::checkpoint());
    std::filesystem::rename(path_, path_ + ".previous", none_before);
  });
}

CheckpointFile::Found CheckpointFile::find(const std::string& run) const {
  Found found;
  for (const std::string& name : {path_, path_ + ".previous"}) {
    std::error_code ignored;
    if (!std::filesystem::exists(name, ignored)) continue;
    try {
      found.state = read(name, key_, run);
      found.file = name;
      // The other one may be damaged beyond recognition.
      for (const char* ending : {"", ".previous"}) give(path_ + ending);
      return found;
    } catch (const std::bad_alloc&) {
      throw;  // is no fault of the file's
    } catch (const std::exception& error) {
      found.troubles.push_back(fmt::format("{} cannot be used: {}", name, error.what()));
    }
  }
  return found;
}

void CheckpointFile::remove() const {
  for (const char* ending : {"", ".previous"}) remove_own(path_ + ending, kinds::checkpoint());
}

std::string checkpoint_key(const AssembledScene& assembled, const std::string& program_version) {
  const scene::Scene& scene = assembled.scene;
  Hash hash;
  hash.add(format_name);
  hash.add(program_version);
  hash.add(fmt::format("{} elements of a block", elements_of_block));
  hash.add(scene.static_text);
  hash.add(chosen_algorithms(scene));
  hash.add(
      fmt::format("time {:.17g} {:.17g}, settled {}", scene.time.step_scale, scene.time.step, scene.settle.active));
  hash.add(fmt::format("solver {} {} {} {}", static_cast<int>(scene.solver.precision),
                       static_cast<int>(scene.solver.step_estimate), scene.solver.subcycling,
                       scene.solver.renew_steps));
  hash.add(fmt::format("output {:.17g} {:.17g} {} {} {}", scene.output.history_interval, scene.output.field_interval,
                       fmt::join(scene.output.field_sets, ","), fmt::join(scene.output.fields, ","),
                       fmt::join(scene.output.history_sets, ",")));
  if (scene.output.contact_margin) hash.add(fmt::format("contact margin {:.17g}", *scene.output.contact_margin));
  const auto listed = [](const std::optional<std::vector<std::string>>& names) {
    return names ? fmt::format("{}", fmt::join(*names, ",")) : "all";
  };
  hash.add(fmt::format("histories of beams {}", listed(scene.output.history_beams)));
  hash.add(fmt::format("contact fields {} of {}, precision {}", listed(scene.output.contact_fields),
                       fmt::join(scene.output.contact_sides, ","), static_cast<int>(scene.output.precision)));
  if (scene.output.significant_digits) hash.add(fmt::format("{} digits", *scene.output.significant_digits));
  for (const scene::OutputWindow& window : scene.output_windows)
    hash.add(fmt::format("window {:.17g} {:.17g} {:.17g} {} {}", window.start, window.end.value_or(-1), window.interval,
                         listed(window.field_sets), listed(window.contacts)));
  for (const auto& motion : scene.initial_motions) hash.add(fmt::format("{:.17g}", fmt::join(motion.velocity, ",")));
  for (const auto& motion : scene.prescribed_motions)
    hash.add(fmt::format("{:.17g} {:.17g}", fmt::join(motion.velocity, ","), fmt::join(motion.displacement, ",")));
  hash.add(assembled.assembly.nodes);
  hash.add(assembled.assembly.elements);
  return hash.text();
}

std::string checkpoint_path(const scene::Scene& scene) {
  if (!scene.checkpoint.file.empty()) return scene.checkpoint.file;
  return std::filesystem::path(scene.output.file).replace_extension(".checkpoint.h5").string();
}

}  // namespace railwave
