#include "output/run_places.hpp"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "case/error.hpp"
#include "case/read_case.hpp"
#include "output/checkpoint_file.hpp"
#include "output/file_kind.hpp"
#include "output/paraview_files.hpp"
#include "output/results_writer.hpp"

namespace railwave {
namespace {

namespace fs = std::filesystem;

bool in_own_folder(const scene::Scene& scene, const std::string& path) {
  return fs::path(path).parent_path() == fs::path(default_results_folder(scene.path));
}

hdf5::RootAttributes inspect(const std::string& path, const FileKind& kind) {
  if (!is_of_kind(path, kind)) return {};
  return hdf5::read_root_attributes(path).value_or(hdf5::RootAttributes{});
}

/// A run that was stopped, or is complete but may go on, and that a new run would put an end to.
void check_unfinished(const scene::Scene& scene) {
  const std::string& results_path = scene.output.file;
  const std::string checkpoint = target_of(checkpoint_path(scene));
  const auto results = inspect(results_path, kinds::results());
  const std::string run = results.text("run");
  for (const std::string& file : {checkpoint, checkpoint + ".previous"}) {
    const auto state = inspect(file, kinds::checkpoint());
    const std::string of = state.text("run");
    if (of.empty()) continue;
    if (of != run)
      throw InputError(
          fmt::format("checkpoint.file: {} is the checkpoint of another run, at its step {}, which {}; move it away, "
                      "name another file, or have it "
                      "replaced by --overwrite",
                      file, state.number("step", 0),
                      run.empty() ? fmt::format("has its results elsewhere than in {}", results_path)
                                  : fmt::format("is not that of {}", results_path)));
    if (results.number("completed", 0) == 0)
      throw InputError(
          fmt::format("output.file: {} holds a run that has not ended, and {} its state at step {}: go on with it by "
                      "--restart, or have both replaced "
                      "by --overwrite",
                      results_path, file, state.number("step", 0)));
  }
}

/// Cases of the same name share results/NAME.
void check_other_case(const scene::Scene& scene) {
  if (!in_own_folder(scene, scene.output.file)) return;
  const std::string other = inspect(scene.output.file, kinds::results()).text("case_file");
  std::error_code failed;
  if (other.empty() || !fs::exists(other, failed) || !fs::exists(scene.path, failed) ||
      fs::equivalent(other, scene.path, failed) || failed)
    return;
  throw InputError(
      fmt::format("output.file: {} holds the results of another case, {}; name another file, such as --set "
                  "output.file=other.h5, or have them "
                  "replaced by --overwrite",
                  scene.output.file, other));
}

OutputPlaces places_of(const scene::Scene& scene, const RunFiles& asked) {
  OutputPlaces places(asked.overwrite);
  name_inputs(scene, places);
  const std::string& results = scene.output.file;
  const std::string key = "output.file";
  if (in_own_folder(scene, results)) places.makes_folder_of(results);
  if (asked.restart) {
    places.adds_to(results, key, "the results file");
    places.writes(xdmf_path(results), kinds::results_xdmf(), key, "the XDMF companion of the results file");
  } else {
    places.writes_with_companion(results, kinds::results(), kinds::results_xdmf(), key, "the results file");
  }
  if (results.empty()) return places;
  places.writes_with_companion(fault_path(results), kinds::fault(), kinds::fault_xdmf(), key,
                               "where the surroundings of a fault are written");
  if (asked.logs) {
    places.writes(log_path(results), {FileKind::Form::text, "the log of an ensemble's member", log_mark, ""}, key,
                  "the log beside the results");
    return places;
  }
  const std::string checkpoint = checkpoint_path(scene);
  const std::string before = target_of(checkpoint) + ".previous", of_checkpoint = "checkpoint.file",
                    called = "the checkpoint";
  if (asked.restart) {
    places.adds_to(checkpoint, of_checkpoint, called);  // find_restart() looks at them
    places.adds_to(before, of_checkpoint, called + " before the last");
  } else {
    places.writes(checkpoint, kinds::checkpoint(), of_checkpoint, called);
    places.writes(before, kinds::checkpoint(), of_checkpoint, called + " before the last");
  }
  places.uses(target_of(checkpoint) + ".new", "checkpoint.file", "where a checkpoint is written first");
  return places;
}

}  // namespace

std::vector<InputFile> input_files(const scene::Scene& scene) {
  std::vector<InputFile> files{{scene.path, "the case file"}};
  for (const auto& mesh : scene.meshes) {
    if (!mesh.file.path.empty())
      files.push_back({mesh.file.path, fmt::format("the mesh file of [meshes.{}]", mesh.name)});
    if (!mesh.rail.height_map.empty())
      files.push_back({mesh.rail.height_map, fmt::format("the height map of [meshes.{}]", mesh.name)});
  }
  for (const auto& curve : scene.curves)
    if (!curve.file.empty()) files.push_back({curve.file, fmt::format("the file of [curves.{}]", curve.name)});
  return files;
}

void name_inputs(const scene::Scene& scene, OutputPlaces& places) {
  for (const InputFile& file : input_files(scene)) places.reads(file.path, file.called);
}

std::string log_path(const std::string& results) { return fs::path(results).replace_extension(".log"); }

void check_run_places(const scene::Scene& scene, const RunFiles& asked) { places_of(scene, asked).check(); }

void check_what_gets_lost(const scene::Scene& scene, const RunFiles& asked) {
  if (asked.restart || asked.overwrite) return;
  check_unfinished(scene);
  check_other_case(scene);
}
void check_model_places(const scene::Scene& scene, const std::string& path, bool overwrite) {
  OutputPlaces places(overwrite);
  name_inputs(scene, places);
  if (in_own_folder(scene, path)) places.makes_folder_of(path);
  places.writes_with_companion(path, kinds::model(), kinds::model_xdmf(), "--out", "the file of the model");
  places.check();
}

std::vector<std::string> make_own_folder(const scene::Scene& scene, const std::string& path) {
  std::vector<std::string> made;
  if (!in_own_folder(scene, path)) return made;
  const fs::path folder = fs::path(path).parent_path();
  for (const fs::path& one : {folder.parent_path(), folder}) {
    std::error_code failed;
    if (fs::create_directory(one, failed)) made.push_back(one.string());
    if (failed)
      throw InputError(fmt::format("the folder {} for results cannot be made: {}; name another place by output.file",
                                   one.string(), failed.message()));
  }
  return made;
}

HeldPlaces::HeldPlaces(const scene::Scene& scene, const RunFiles& asked) {
  check_run_places(scene, asked);
  made_ = make_own_folder(scene, scene.output.file);
  locks_.push_back(std::make_unique<RunLock>(scene.output.file, "output.file"));
  const std::string beside = asked.logs ? log_path(scene.output.file) : checkpoint_path(scene);
  locks_.push_back(std::make_unique<RunLock>(beside, asked.logs ? "output.file" : "checkpoint.file"));
  check_run_places(scene, asked);  // again, now that no other run changes anything
  check_what_gets_lost(scene, asked);
}

HeldPlaces::~HeldPlaces() {
  while (!locks_.empty()) locks_.pop_back();
  std::for_each(made_.rbegin(), made_.rend(), [](const std::string& folder) { rmdir(folder.c_str()); });
}

}  // namespace railwave
