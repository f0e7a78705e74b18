#include "output/results_file.hpp"

#include <fmt/format.h>

#include <Kokkos_Core.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <new>
#include <sstream>
#include <stdexcept>

#include "case/error.hpp"
#include "case/suggest.hpp"
#include "kernels/support/spaces.hpp"
#include "model/contact/contact_pair.hpp"
#include "model/fields.hpp"
#include "model/host_copy.hpp"
#include "model/model.hpp"
#include "output/hdf5/hdf5.hpp"
#include "output/paraview_files.hpp"
#include "solve/statics/settle.hpp"
#include "solve/tasks/beam_forces.hpp"
#include "solve/time_loop.hpp"

namespace railwave {
namespace {

class ModelFields : public FieldSource {
 public:
  ModelFields(const Model& model, const ContactOutput& contacts) : model_(model), wish_(contacts.wish()) {}
  HostField field(const FieldRow& row, const std::vector<int>& numbers) const override {
    return output_field(model_, model_, model_.ties, row, numbers);
  }
  ContactState contact(int number) const override {
    return contact_state(model_, model_.ties, model_.contacts, number, wish_);
  }
  HostField beams() const override {
    HostField all{6, {}};
    for (const BeamResultants& beam : beam_resultants(*model_.beams, model_.nodes))
      for (std::size_t e = 0; 3 * e < beam.force.size(); ++e) {
        all.values.insert(all.values.end(), beam.force.begin() + 3 * e, beam.force.begin() + 3 * e + 3);
        all.values.insert(all.values.end(), beam.moment.begin() + 3 * e, beam.moment.begin() + 3 * e + 3);
      }
    return all;
  }

 private:
  const Model& model_;
  ContactWish wish_;
};

/// m, 3 of each node.
std::vector<double> undeformed_places(const NodalState& nodal, const Ties& ties, const std::vector<int>& nodes) {
  auto fields = node_fields(nodal, ties, {NodeField::position, NodeField::displacement}, nodes);
  std::vector<double>& place = fields[0].values;
  const std::vector<double>& moved = fields[1].values;
  for (std::size_t i = 0; i < moved.size(); ++i) place[i] -= moved[i];
  return std::move(place);
}

ContactSurface surface_of(const NodalState& nodal, const Ties& ties, const std::vector<int>& nodes,
                          const std::vector<std::array<int, 4>>& facets) {
  return {nodes, facets, undeformed_places(nodal, ties, nodes)};
}

/// Numbers of the beams that output.history_beams names.
std::vector<int> wanted_beams(const scene::Scene& scene) {
  std::vector<int> wanted;
  std::vector<std::string> known;
  for (std::size_t b = 0; b < scene.beams.size(); ++b) {
    known.push_back(scene.beams[b].name);
    if (scene::is_among(known.back(), scene.output.history_beams)) wanted.push_back(static_cast<int>(b));
  }
  for (const std::string& name : scene.output.history_beams.value_or(std::vector<std::string>{}))
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError(fmt::format("{}: [output] history_beams: there is no beam '{}'; {}", scene.path, name,
                                   suggestion(name, known)));
  return wanted;
}

/// What a window writes; without lists of names all.
OutputChoice choice_of(const scene::OutputWindow& window, const RunDescription& description) {
  OutputChoice choice = OutputChoice::all(description.sets.size(), description.contacts.size());
  for (std::size_t s = 0; s < choice.sets.size(); ++s) choice.sets[s] = window.has_set(description.sets[s].name);
  for (std::size_t c = 0; c < choice.contacts.size(); ++c)
    choice.contacts[c] = window.has_contact(description.contacts[c].name);
  return choice;
}

LoadNames names_of(const scene::Scene& scene, const scene::Load& load) {
  const bool torque = load.type == scene::LoadType::torque;
  Vec3 direction = torque                                      ? load.axis
                   : load.type == scene::LoadType::nodal_force ? load.force
                   : load.type == scene::LoadType::traction    ? load.traction
                                                               : Vec3{};
  const double length =
      std::sqrt(direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2]);
  if (length > 0)
    for (double& one : direction) one /= length;
  return {load.name, load.target, torque, find_entry(scene.hammers, load.name) != nullptr, direction};
}

/// Mean by mass of the undeformed places of a set's nodes, m: the set's displacements in the history count from it.
Vec3 undeformed_position(const NodalState& nodal, const Ties& ties, const LoadModel& loads, int set) {
  const int begin = loads.first_of_set[set], end = loads.first_of_set[set + 1];
  const auto all = to_host(loads.sets.nodes);
  const auto weight = to_host(loads.sets.weight);
  const std::vector<int> nodes(all.data() + begin, all.data() + end);
  const std::vector<double> place = undeformed_places(nodal, ties, nodes);
  Vec3 mean{};
  for (std::size_t k = 0; k < nodes.size(); ++k)
    for (int i = 0; i < 3; ++i) mean[i] += weight(begin + static_cast<int>(k)) * place[3 * k + i];
  return mean;
}

/// A run on the host needs the processors, one on a GPU few of them. More threads than these wait for each other's
/// chunks to be written.
CompressionThreads compression_threads() {
  constexpr int most = 16, most_beside_device = 8;
#ifdef RAILWAVE_SERIAL
  const int all = 1;
#else
  const int all = Kokkos::DefaultHostExecutionSpace().concurrency();
#endif
  const int beside = on_device ? std::clamp(all - 1, 1, most_beside_device) : std::min(all, 2);
  return {beside, std::min(all, most)};
}

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace

ResultsFile::ResultsFile(const scene::Scene& scene, const Assembly& assembly, const std::string& program_version)
    : stop_loops_(request_stop), path_(scene.output.file) {
  description_.program_version = program_version;
  description_.title = scene.title;
  description_.case_path = scene.path;
  description_.case_text = text_of(scene.path);
  description_.end_time = scene.time.end;
  description_.node_count = static_cast<long>(assembly.nodes.size());
  description_.element_count = static_cast<long>(assembly.elements.size());
  for (const auto& contact : scene.contacts) {
    description_.contacts.push_back({contact.name, contact.slave, contact.master});
    description_.contacts.back().friction = contact.friction;
    description_.contacts.back().falling_friction = contact.falling_friction();
    for (const std::string& master : contact.master)
      description_.contacts.back().master_facets.push_back(
          static_cast<int>(find_surface(scene, assembly, contact, "master", master).size()));
  }
  for (const HistorySet& set : resolve_history_sets(scene, assembly)) {
    if (set.motion()) {
      description_.history_sets.push_back(set.name);
      description_.history_askers.push_back(set.asked_by);
      description_.history_motions.push_back(set.quantities_of(FieldRow::Place::node));
    }
    if (set.inside()) description_.element_histories.push_back(set);
  }
  history_beams_ = wanted_beams(scene);
  std::vector<int> beam_elements(scene.beams.size());
  for (const auto& chain : assembly.beam_chains) beam_elements[chain.beam] += scene.beams[chain.beam].divisions;
  for (const int beam : history_beams_) description_.beams.emplace_back(scene.beams[beam].name, beam_elements[beam]);
  for (const auto& load : scene.loads) description_.loads.push_back(names_of(scene, load));
  for (const auto& motion : scene.prescribed_motions) description_.prescribed_motions.push_back(motion.name);
  description_.fields = scene.output.fields;
  ContactOutput& contacts = description_.contact_output;
  contacts.margin = scene.output.contact_margin;
  if (scene.output.contact_fields) contacts.fields = *scene.output.contact_fields;
  contacts.slave = scene::is_among("slave", scene.output.contact_sides);
  contacts.master = scene::is_among("master", scene.output.contact_sides);
  contacts.format = description_.format = NumberFormat(scene.output);
  description_.sets = resolve_output_sets(scene, assembly);
  for (const scene::OutputWindow& window : scene.output_windows)
    description_.windows.push_back(railwave::choice_of(window, description_));
}

ResultsSize ResultsFile::size(const AssembledScene& assembled, const StepSizes& sizes) const {
  return results_size(description_, assembled, sizes);
}

void ResultsFile::check_disk_space(const AssembledScene& assembled, const StepSizes& sizes) const {
  check_results_disk_space(size(assembled, sizes), assembled.scene, free_bytes_at(path_));
}

void ResultsFile::begin(const Model& model) {
  description_.step_size = model.step_size;
  for (const int set : model.history_sets)
    description_.history_positions.push_back(undeformed_position(model, model.ties, model, set));
  for (std::size_t c = 0; c < description_.contacts.size(); ++c) {
    const ContactPair& pair = model.contacts[c];
    description_.contacts[c].slave_surface = surface_of(model, model.ties, pair.slave_nodes, pair.slave_facets);
    description_.contacts[c].master_surface = surface_of(model, model.ties, pair.master_nodes, pair.master_segments);
  }
  writing([&] {
    writer_ = std::make_unique<BackgroundWriter>(path_, description_, so_far_, stop_loops_, compression_threads());
  });
}

template <class Do>
void ResultsFile::writing(const Do& one) {
  try {
    one();
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;  // is no fault of the disk's
  } catch (const std::exception& error) {
    std::error_code ignored;
    const bool can_go_on = checkpoint_ && std::filesystem::exists(checkpoint_->path(), ignored);
    const bool taken = dynamic_cast<const hdf5::NameTaken*>(&error) != nullptr;
    const std::string what_is_left = taken ? fmt::format("the file {} is not this run's", path_)
                                     : std::filesystem::exists(path_, ignored)
                                         ? fmt::format("the results {} hold what was written before", path_)
                                         : "no results were written";
    throw std::runtime_error(fmt::format(
        "{}; {}{}{}", error.what(), what_is_left, can_go_on ? ", and --restart goes on from the last checkpoint" : "",
        can_go_on && taken ? fmt::format(" when what was written has the name {} again", path_) : ""));
  }
}

void ResultsFile::settled(const Model&, const SettleReport& report) {
  const int evaluations = report.taken_from.empty() ? report.steps : 0;
  writing([&] { writer_->settled(report.unbalance, evaluations); });
}

void ResultsFile::history(const Model&, const HistorySample& sample) {
  if (history_beams_.size() == sample.beams.size()) return writing([&] { writer_->history(sample); });
  HistorySample chosen = sample;
  chosen.beams.clear();
  for (const int beam : history_beams_) chosen.beams.push_back(sample.beams[beam]);
  writing([&] { writer_->history(chosen); });
}

OutputChoice ResultsFile::choice_of(const DueFields& due) const {
  if (due.all) return OutputChoice::all(description_.sets.size(), description_.contacts.size());
  OutputChoice choice = OutputChoice::none(description_.sets.size(), description_.contacts.size());
  for (std::size_t w = 0; w < description_.windows.size(); ++w)
    if (due.windows[w]) choice.add(description_.windows[w]);
  return choice;
}

void ResultsFile::fields(const Model& model, const HistorySample& sample, const DueFields& due) {
  writing([&] {
    writer_->fields(ModelFields(model, description_.contact_output), sample.time, sample.step, choice_of(due));
  });
}

void ResultsFile::end(const Model& model, const RunSummary& summary) {
  writing([&] { writer_->end(summary); });
  writer_.reset();
  if (checkpoint_ && summary.completed && !keeps_end_) checkpoint_->remove();
  // Only now does nobody else touch HDF5.
  const std::string beside = fault_path(path_);
  if (summary.fault)
    write_fault_file(model, model, model, model.ties, *summary.fault, beside);
  else
    remove_fault_file(beside);
}

void ResultsFile::keep_checkpoints(CheckpointFile file, bool also_at_end) {
  keeps_end_ = also_at_end;
  description_.key = file.key();
  checkpoint_ = std::move(file);
}

void ResultsFile::keep(RunState state) {
  if (checkpoint_) writing([&] { writer_->checkpoint(std::move(state), *checkpoint_); });
}

std::string ResultsFile::trouble() {
  std::string trouble;
  writing([&] { trouble = writer_->checkpoint_trouble(); });
  return trouble;
}

}  // namespace railwave
