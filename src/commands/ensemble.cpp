#include "commands/ensemble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <ostream>
#include <stdexcept>

#include "case/error.hpp"
#include "case/read_case.hpp"
#include "commands/process.hpp"
#include "commands/threads.hpp"
#include "mesh/contact_zone.hpp"
#include "model/assembly.hpp"
#include "model/ranks/transport.hpp"
#include "output/checkpoint_file.hpp"
#include "output/progress.hpp"
#include "output/results_file.hpp"
#include "output/run_places.hpp"
#include "output/settled_file.hpp"
#include "solve/time_loop.hpp"

namespace railwave {
namespace {

/// A member from its case to its end.
struct Member {
  std::string name;
  scene::Scene scene;
  std::vector<std::string> notes;
  std::unique_ptr<HeldPlaces> places;
  Model model;
  std::unique_ptr<ResultsFile> results;
  std::ofstream log;
  std::unique_ptr<Progress> progress;
};

std::string results_of_member(const scene::Scene& scene, std::size_t number) {
  return fmt::format("{}/member_{}.h5", default_results_folder(scene.path), number);
}

/// With or without blanks around the key, as `run --set` takes it.
bool names_results(const std::vector<std::string>& overrides) {
  return std::any_of(overrides.begin(), overrides.end(), [](const std::string& one) {
    std::string key = one.substr(0, one.find('='));
    key.erase(std::remove_if(key.begin(), key.end(), [](char c) { return c == ' ' || c == '\t'; }), key.end());
    return key == "output.file";
  });
}

/// Reads a member's case.
void read_member(const EnsembleRequest& request, std::size_t m, Member& member) {
  std::vector<std::string> overrides = request.overrides;
  overrides.insert(overrides.end(), request.members[m].begin(), request.members[m].end());
  member.name = fmt::format("member {}", m + 1);
  try {
    member.scene = read_case(request.case_file, overrides, &member.notes);
    if (!names_results(overrides)) member.scene.output.file = results_of_member(member.scene, m + 1);
    const auto bands = place_contact_zones(member.scene);
    member.notes.insert(member.notes.end(), bands.begin(), bands.end());
    member.places = std::make_unique<HeldPlaces>(member.scene, RunFiles{false, request.overwrite, true});
  } catch (const InputError& error) {
    throw InputError(fmt::format("{} of the ensemble: {}", member.name, error.what()));
  }
}

void build_member(Member& member) {
  try {
    build_model(member.scene, assemble(member.scene, member.notes), member.model);
    check_run_places(member.scene, {false, false, true});
    member.results = std::make_unique<ResultsFile>(member.model.scene, member.model.assembly, RAILWAVE_VERSION);
    member.results->check_disk_space(member.model, member.model);
    member.results->fail_alone();
  } catch (const InputError& error) {
    throw InputError(fmt::format("{} of the ensemble: {}", member.name, error.what()));
  }
}

/// After all members' models have been made: until then older logs stay.
void begin_log(Member& member) {
  const std::string path = log_path(member.scene.output.file);
  member.log.open(path);
  member.log << log_mark << ", whose results are " << member.scene.output.file << '\n' << std::flush;
  if (!member.log) throw std::runtime_error(fmt::format("{}: {} cannot be written", member.name, path));
  for (const std::string& note : member.notes) member.log << "note: " << note << '\n';
  member.progress = std::make_unique<Progress>(member.log);
}

/// What all members' elements came to until the last had taken his last step.
void report_speed(const std::vector<RunOutcome>& outcomes, std::ostream& out) {
  double element_steps = 0, seconds = 0;
  for (const RunOutcome& outcome : outcomes) {
    if (!outcome.summary) continue;
    element_steps += outcome.summary->element_steps_per_second * outcome.summary->wall_seconds;
    seconds = std::max(seconds, outcome.summary->wall_seconds);
  }
  if (seconds > 0)
    out << fmt::format("{} members together: {:.2f} million element-steps per second\n", outcomes.size(),
                       1e-6 * element_steps / seconds);
}

EnsembleEnd report_ends(const std::vector<std::unique_ptr<Member>>& members, const std::vector<RunOutcome>& outcomes,
                        std::ostream& out) {
  EnsembleEnd end;
  for (std::size_t m = 0; m < members.size(); ++m) {
    const RunOutcome& outcome = outcomes[m];
    const std::string where = members[m]->name + ", " + members[m]->scene.output.file + ": ";
    if (!outcome.summary) {
      ++end.failed;
      out << where << "failed: " << outcome.error << '\n';
    } else if (!outcome.summary->completed) {
      ++end.ended_early;
      out << where << "ended early: " << outcome.summary->reason << '\n';
    } else {
      ++end.completed;
      out << where << "completed\n";
    }
  }
  if (outcomes.size() > 1) report_speed(outcomes, out);
  return end;
}

using Members = std::vector<std::unique_ptr<Member>>;

/// Those whose numbers are `first`, `first + every`, ...
Members read_members(const EnsembleRequest& request, std::size_t first, std::size_t every) {
  Members members;
  for (std::size_t m = first; m < request.members.size(); m += every) {
    members.push_back(std::make_unique<Member>());
    read_member(request, m, *members.back());
  }
  return members;
}

/// Models go before Kokkos does, also where a mistake ends all.
class ModelsEnd {
 public:
  explicit ModelsEnd(const Members& members) : members_(members) {}
  ModelsEnd(const ModelsEnd&) = delete;
  ModelsEnd& operator=(const ModelsEnd&) = delete;
  ~ModelsEnd() {
    for (const auto& member : members_) {
      member->results.reset();
      member->model = Model{};
    }
  }

 private:
  const Members& members_;
};

EnsembleEnd run_members(const Members& members, std::ostream& out) {
  // On a GPU of NVIDIA, launches of different members that share one of its queues wait for each other; 8 are usual.
  setenv("CUDA_DEVICE_MAX_CONNECTIONS", "32", 0);
  const KokkosScope kokkos;
  const ModelsEnd models_end(members);
  std::vector<EnsembleMember> runs;
  SettledFiles settled(RAILWAVE_VERSION);
  for (const auto& member : members) build_member(*member);
  for (const auto& member : members) {
    begin_log(*member);
    runs.push_back({&member->model, {member->results.get(), member->progress.get()}, &settled, {}});
  }
  stop_on_signals();
  return report_ends(members, run_together(runs), out);
}

}  // namespace

void add_ensemble_command(CLI::App& app, EnsembleRequest& request, const std::function<void()>& run) {
  CLI::App* command = app.add_subcommand("ensemble", "run several variants of a case at once in one process");
  command->add_option("case", request.case_file, "case file (TOML); docs/case-file.md lists its keys")->required();
  command
      ->add_option("--set", request.overrides,
                   "section.key=value in place of what the case file says, for all members; may be repeated")
      ->allow_extra_args(false);
  command
      ->add_option("--member", request.members,
                   "section.key=value ... of one member; output.file among them is where its results go, else "
                   "results/NAME/member_NUMBER.h5; once for each member")
      ->required();
  command->add_flag("--overwrite", request.overwrite,
                    "replace files that are there even if railwave has not written them; never what the command reads");
  command->callback(run);
}

EnsembleEnd run_ensemble(const EnsembleRequest& request, std::ostream& out) {
  const auto others = transport_of_processes();
  if (others == nullptr) return run_members(read_members(request, 0, 1), out);
  // Members are dealt out in turn. A launcher of MPI ends all processes when one ends with an error: each waits for the
  // others before it does.
  const auto together = [&others](const auto& work) {
    try {
      auto result = work();
      if (others->all_agree(true)) return result;
    } catch (...) {
      others->all_agree(false);
      throw;
    }
    throw std::runtime_error("another process of this ensemble has failed: it says why");
  };
  const Members members = together([&] { return read_members(request, others->rank(), others->ranks()); });
  return together([&] { return run_members(members, out); });
}

}  // namespace railwave
