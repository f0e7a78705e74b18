#pragma once

#include <string>
#include <vector>

#include "output/file_kind.hpp"

namespace railwave {

/// Who may write where. A command names everything that it reads and everything that it will write before it begins its
/// work; check() then refuses what would destroy something. The rule:
/// - a file is replaced or removed only if this program wrote it as that kind (see FileKind), or if --overwrite allows
/// it;
/// - never an input of the same command, by whatever name, link or hard link; never one of its other outputs;
/// - symbolic links are followed: their target is judged and replaced, the link stays;
/// - what is not a regular file (folder, pipe, device, socket) is neither replaced nor opened;
/// - a file that may not be written, or that is empty, is somebody's too: it needs --overwrite.
/// What writes files asks expect_replaceable() again at the moment it gives a file its name, so that nothing is lost
/// that came meanwhile.
class OutputPlaces {
 public:
  /// @param overwrite regular files that are no inputs may be replaced
  explicit OutputPlaces(bool overwrite) : overwrite_(overwrite) {}

  /// @param called "the case file", for messages
  void reads(const std::string& path, const std::string& called);

  /// @param asked_by the option or key that names it: "--csv", "output.file"
  /// @param called "the results file", for messages of other outputs
  void writes(const std::string& path, const FileKind& kind, const std::string& asked_by, const std::string& called);

  /// An HDF5 file and the XDMF companion beside it.
  void writes_with_companion(const std::string& path, const FileKind& kind, const FileKind& companion,
                             const std::string& asked_by, const std::string& called);

  /// A file that is there and is added to.
  void adds_to(const std::string& path, const std::string& asked_by, const std::string& called);

  /// A name that is taken for a while: no other output may have it, and whose it is otherwise does not matter.
  void uses(const std::string& path, const std::string& asked_by, const std::string& called);

  /// The folder that the outputs at this place lie in, and those above it, are made where they are missing.
  void makes_folder_of(const std::string& path);

  /// Throws InputError for the first output that must not be written, saying what is there and how to mend; changes no
  /// file. With --overwrite what is there may be replaced from now on.
  void check() const;

 private:
  enum class Use { replace, add, name_only };
  struct Output {
    std::string path, asked_by, called;
    FileKind kind;
    Use use;
  };
  struct Input {
    std::string path, called;
  };
  void check_name(const Output& output) const;
  void check_folder(const Output& output) const;
  void check_against_inputs(const Output& output) const;
  void check_against(const Output& output, const Output& other) const;
  void check_what_is_there(const Output& output) const;

  bool overwrite_;
  std::string own_folder_;
  std::vector<Input> inputs_;
  std::vector<Output> outputs_;
};

/// Where the symbolic links of a path lead to; the path itself if it is no link. Throws InputError for links in a
/// circle.
std::string target_of(const std::string& path);

/// Throws InputError if what is at `path` may not be replaced by a file of that kind; nothing there is fine.
void expect_replaceable(const std::string& path, const FileKind& kind);

/// A regular file that may be replaced from now on, whatever it is: the user or what lies beside it says that it is
/// this program's.
void give(const std::string& path);

/// Removes a file of that kind that this program wrote, or that --overwrite gave to it; leaves everything else.
void remove_own(const std::string& path, const FileKind& kind);

/// Throws InputError unless `path` is a regular file, by links or not: a pipe would be waited for, perhaps for ever.
/// Does not open it.
void expect_regular_file(const std::string& path, const std::string& called);

}  // namespace railwave
