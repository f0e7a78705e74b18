#pragma once

#include <memory>
#include <string>
#include <vector>

#include "case/scene.hpp"
#include "output/output_place.hpp"

namespace railwave {

/// How a run was asked for, as far as its files go.
struct RunFiles {
  bool restart = false;    ///< it goes on from its checkpoint and adds to its results
  bool overwrite = false;  ///< --overwrite
  bool logs = false;       ///< it writes log_path() and, as members of an ensemble do, no checkpoints
};

/// Where a member of an ensemble says how it goes on: beside its results.
std::string log_path(const std::string& results);
/// How a log begins.
inline constexpr const char* log_mark = "Railwave: a member of an ensemble";

/// Throws InputError where a run of this scene must not write its files, see OutputPlaces. Changes no file.
void check_run_places(const scene::Scene& scene, const RunFiles& asked);

/// Throws InputError where a new run would replace one that has not ended and can be taken up again by --restart, the
/// checkpoint of another run, or, in results/NAME, the results of another case; not with --overwrite. Changes no file.
void check_what_gets_lost(const scene::Scene& scene, const RunFiles& asked);

/// The same for `railwave mesh`, which writes `path` and its XDMF companion.
void check_model_places(const scene::Scene& scene, const std::string& path, bool overwrite);

/// The case file and all that it names: meshes, height maps, curves.
struct InputFile {
  std::string path, called;  ///< "the case file", for messages
};
std::vector<InputFile> input_files(const scene::Scene& scene);
void name_inputs(const scene::Scene& scene, OutputPlaces& places);

/// Keeps other runs off a file while a run writes it: PATH.lock is made beside it and locked (flock) as long as this
/// object lives, then removed. What a killed run left of it is no lock. Where the file system knows no locks there is
/// none.
class RunLock {
 public:
  /// Throws InputError if another run holds it, std::runtime_error if the system refuses.
  /// @param path of a file that need not be there yet; symbolic links are followed
  /// @param asked_by key of the case that names it, for messages
  RunLock(const std::string& path, const std::string& asked_by);
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;
  ~RunLock();

 private:
  std::string lock_;
  int descriptor_ = -1;
};

/// The files of a run while it lasts: makes the folder results/NAME where that is its place, and locks results and
/// checkpoint, or results and log. At the end the locks go, and so does a folder that has remained empty.
class HeldPlaces {
 public:
  /// Throws InputError where check_run_places() and check_what_gets_lost() do, and if another run writes one of the
  /// files now.
  HeldPlaces(const scene::Scene& scene, const RunFiles& asked);
  HeldPlaces(const HeldPlaces&) = delete;
  HeldPlaces& operator=(const HeldPlaces&) = delete;
  ~HeldPlaces();

 private:
  std::vector<std::string> made_;  ///< folders, the outer one first
  std::vector<std::unique_ptr<RunLock>> locks_;
};

/// Makes the folder results/NAME of a case if `path` lies in it. @return the folders made, the outer one first
std::vector<std::string> make_own_folder(const scene::Scene& scene, const std::string& path);

}  // namespace railwave
