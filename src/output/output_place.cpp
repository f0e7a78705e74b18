#include "output/output_place.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "case/error.hpp"
#include "mesh/files/text_file.hpp"

namespace railwave {
namespace {

namespace fs = std::filesystem;

using Identity = std::pair<dev_t, ino_t>;

std::optional<struct stat> facts_of(const std::string& path) {
  struct stat facts;
  if (stat(path.c_str(), &facts) != 0) return std::nullopt;
  return facts;
}

std::optional<Identity> identity(const std::string& path) {
  const auto facts = facts_of(path);
  return facts ? std::optional<Identity>({facts->st_dev, facts->st_ino}) : std::nullopt;
}

/// Files that may be replaced whatever they are, see give(). They are recognised by time and length too, because a new
/// file may get the inode number of one that is gone. The thread that writes results reads the list as well.
struct GivenFiles {
  using File = std::tuple<dev_t, ino_t, time_t, long, off_t>;
  static File file_of(const struct stat& facts) {
    return {facts.st_dev, facts.st_ino, facts.st_mtim.tv_sec, facts.st_mtim.tv_nsec, facts.st_size};
  }
  std::mutex mutex;
  std::set<File> files;
};

GivenFiles& given() {
  static GivenFiles all;
  return all;
}

bool is_given(const struct stat& facts) {
  const std::lock_guard<std::mutex> guard(given().mutex);
  return given().files.count(GivenFiles::file_of(facts)) != 0;
}

std::string folder_of(const std::string& path) {
  const fs::path parent = fs::path(path).parent_path();
  return parent.empty() ? "." : parent.string();
}

/// Root may write everything; that a file was protected is respected nevertheless.
bool is_read_only(const std::string& path, const struct stat& facts) {
  return !(facts.st_mode & S_IWUSR) || access(path.c_str(), W_OK) != 0;
}

/// Why what is there may not be replaced; empty: it may, or nothing is there.
std::string objection(const std::string& path, const FileKind& kind) {
  const auto facts = facts_of(path);
  if (!facts) return {};
  if (!S_ISREG(facts->st_mode))
    return fmt::format("{} is {}; name a file that can be made or replaced", path, seems_to_be(path));
  if (was_read(facts->st_dev, facts->st_ino))
    return fmt::format("{} is a file that this command has read and would destroy; name another file", path);
  if (is_given(*facts)) return {};
  const bool own = is_of_kind(path, kind);
  if (own && !is_read_only(path, *facts)) return {};
  const std::string why =
      own ? "may not be written (its mode protects it)" : fmt::format("is {}, not {}", seems_to_be(path), kind.called);
  return fmt::format(
      "{} is there already and {}; name another file, move that one away, or have it replaced by --overwrite", path,
      why);
}

}  // namespace

std::string target_of(const std::string& path) {
  constexpr int most_links = 40;
  fs::path now = path;
  std::error_code failed;
  for (int links = 0; fs::is_symlink(fs::symlink_status(now, failed)); ++links) {
    if (links == most_links) throw InputError(fmt::format("{}: its symbolic links lead in a circle", path));
    const fs::path next = fs::read_symlink(now, failed);
    if (failed) break;
    now = next.is_absolute() ? next : now.parent_path() / next;
  }
  return now.string();
}

void expect_replaceable(const std::string& path, const FileKind& kind) {
  const std::string why = objection(path, kind);
  if (!why.empty()) throw InputError(why);
}

void give(const std::string& path) {
  const auto facts = facts_of(target_of(path));
  const std::lock_guard<std::mutex> guard(given().mutex);
  if (facts && S_ISREG(facts->st_mode)) given().files.insert(GivenFiles::file_of(*facts));
}

void remove_own(const std::string& path, const FileKind& kind) {
  const std::string target = target_of(path);
  if (facts_of(target) && objection(target, kind).empty()) unlink(target.c_str());
}

void expect_regular_file(const std::string& path, const std::string& called) {
  const auto facts = facts_of(path);
  if (facts && !S_ISREG(facts->st_mode))
    throw InputError(fmt::format("{} is {}, not {}", path, seems_to_be(path), called));
}

void OutputPlaces::reads(const std::string& path, const std::string& called) { inputs_.push_back({path, called}); }

void OutputPlaces::writes(const std::string& path, const FileKind& kind, const std::string& asked_by,
                          const std::string& called) {
  outputs_.push_back({path, asked_by, called, kind, Use::replace});
}

void OutputPlaces::writes_with_companion(const std::string& path, const FileKind& kind, const FileKind& companion,
                                         const std::string& asked_by, const std::string& called) {
  writes(path, kind, asked_by, called);
  uses(path + ".new", asked_by, "where " + called + " is written first");
  writes(fs::path(path).replace_extension(".xdmf").string(), companion, asked_by, "the XDMF companion of " + called);
}

void OutputPlaces::adds_to(const std::string& path, const std::string& asked_by, const std::string& called) {
  outputs_.push_back({path, asked_by, called, {}, Use::add});
}

void OutputPlaces::uses(const std::string& path, const std::string& asked_by, const std::string& called) {
  outputs_.push_back({path, asked_by, called, {}, Use::name_only});
}

void OutputPlaces::makes_folder_of(const std::string& path) { own_folder_ = folder_of(path); }

void OutputPlaces::check_name(const Output& output) const {
  const std::string& path = output.path;
  if (path.empty()) throw InputError(fmt::format("{}: the file name is empty; name a file", output.asked_by));
  if (path.find('\0') != std::string::npos)
    throw InputError(fmt::format("{}: the file name has a zero byte; name a file", output.asked_by));
  if (path.back() == '/') throw InputError(fmt::format("{}: {} is a folder; name a file in it", output.asked_by, path));
  struct stat facts;
  if (lstat(path.c_str(), &facts) != 0 && errno != ENOENT && errno != ENOTDIR && errno != EACCES)
    throw InputError(fmt::format("{}: {}: {}; name another file", output.asked_by, path, std::strerror(errno)));
}

void OutputPlaces::check_folder(const Output& output) const {
  std::string folder = folder_of(target_of(output.path));
  // Of a folder that will be made, the lowest that is there.
  const bool own = !own_folder_.empty() && folder == own_folder_;
  while (own && !facts_of(folder) && folder != ".") folder = folder_of(folder);
  const auto facts = facts_of(folder);
  const std::string beginning =
      fmt::format("{}: {} goes to {}", output.asked_by, output.path, folder == "." ? "this folder" : folder);
  if (!facts) throw InputError(beginning + ", but there is no folder of that name; make it, or name another file");
  if (!S_ISDIR(facts->st_mode))
    throw InputError(fmt::format("{}, which is {}; name another file", beginning, seems_to_be(folder)));
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    throw InputError(
        fmt::format("{}, a folder that may not be written: {}; name another file", beginning, std::strerror(errno)));
}

void OutputPlaces::check_against_inputs(const Output& output) const {
  const auto there = identity(output.path);
  for (const Input& input : inputs_) {
    const auto its = identity(input.path);
    if (!its || !there || *its != *there) continue;
    const std::string other_name = input.path == output.path ? "" : fmt::format(", {}", input.path);
    throw InputError(fmt::format("{}: {} is {}{}, which this command reads and would destroy; name another file",
                                 output.asked_by, output.path, input.called, other_name));
  }
}

void OutputPlaces::check_against(const Output& output, const Output& other) const {
  const std::string one = target_of(output.path), two = target_of(other.path);
  const auto first = identity(one), second = identity(two);
  const auto folder = identity(folder_of(one)), its_folder = identity(folder_of(two));
  const bool in_one_folder = folder && its_folder ? *folder == *its_folder : folder_of(one) == folder_of(two);
  const bool same =
      (first && second && *first == *second) || (in_one_folder && fs::path(one).filename() == fs::path(two).filename());
  if (!same) return;
  const std::string which = output.asked_by == other.asked_by ? "" : fmt::format(" of {}", other.asked_by);
  throw InputError(fmt::format("{}: {} is {}{}; name another file", output.asked_by, output.path, other.called, which));
}

void OutputPlaces::check_what_is_there(const Output& output) const {
  const std::string target = target_of(output.path);
  const auto facts = facts_of(target);
  if (!facts || output.use == Use::name_only) return;
  const bool regular = S_ISREG(facts->st_mode);
  const bool is_input = was_read(facts->st_dev, facts->st_ino);  // of a mesh file that includes it
  if (regular && !is_input && (overwrite_ || output.use == Use::add)) return;
  const std::string why = output.use == Use::add
                              ? fmt::format("{} is {}, not {}", output.path, seems_to_be(target), output.called)
                              : objection(target, output.kind);
  if (why.empty()) return;
  const std::string leads =
      target == output.path || output.use == Use::add ? "" : output.path + " leads to another file: ";
  throw InputError(output.asked_by + ": " + leads + why);
}

void OutputPlaces::check() const {
  for (const Output& output : outputs_) {
    check_name(output);
    check_folder(output);
    check_against_inputs(output);
  }
  for (std::size_t i = 0; i < outputs_.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) check_against(outputs_[i], outputs_[k]);
  for (const Output& output : outputs_) check_what_is_there(output);
  if (!overwrite_) return;
  for (const Output& output : outputs_)
    if (output.use == Use::replace) give(output.path);
}

}  // namespace railwave
