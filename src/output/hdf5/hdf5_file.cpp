#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "output/atomic_file.hpp"
#include "output/disk.hpp"
#include "output/free_memory.hpp"
#include "output/hdf5/hdf5.hpp"
#include "output/hdf5/hdf5_journal.hpp"
#include "output/hdf5/hdf5_parts.hpp"
#include "output/output_place.hpp"

namespace railwave::hdf5 {
namespace {

using Words = std::array<char, 512>;

/// Throws nothing, though memory may be what is short: HDF5, which calls this, is C, and would keep its lock for ever.
herr_t keep_first_description(unsigned, const H5E_error2_t* entry, void* text) {
  auto& words = *static_cast<Words*>(text);
  if (words[0] == 0 && entry->desc) std::strncpy(words.data(), entry->desc, words.size() - 1);
  return 0;
}

/// At the program's exit HDF5 would try once more to write what a full disk has refused, and crash. It heeds this only
/// before anything else; all that we open we close.
void stay_out_of_exit() {
  static const herr_t said = H5dont_atexit();
  static_cast<void>(said);
}

/// The root's attributes stay in its header, however many: there read_root_attributes() looks for them.
Handle attributes_in_header(const std::string& what) {
  constexpr unsigned most = 1000;
  Handle creation(check(H5Pcreate(H5P_FILE_CREATE), what), H5Pclose);
  check(H5Pset_attr_phase_change(creation.get(), most, most), what);
  return creation;
}

/// What a file is called behind its name until it is whole.
constexpr const char* unfinished = ".new";

/// Between two flushes only array data reach the disk; the structure that HDF5 would write to make room would have to
/// be held back.
Handle access_by_journal(const std::string& what) {
  Handle access(check(H5Pcreate(H5P_FILE_ACCESS), what), H5Pclose);
  H5AC_cache_config_t cache;
  cache.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  check(H5Pget_mdc_config(access.get(), &cache), what);
  cache.evictions_enabled = false;  // and then HDF5 wants no automatic resizing either
  cache.incr_mode = H5C_incr__off;
  cache.flash_incr_mode = H5C_flash_incr__off;
  cache.decr_mode = H5C_decr__off;
  check(H5Pset_mdc_config(access.get(), &cache), what);
  // The superblock has a checksum from HDF5 1.8 on. That of 1.10 has a mark besides that the file is being written, by
  // which HDF5 would refuse what a kill leaves.
  check(H5Pset_libver_bounds(access.get(), H5F_LIBVER_V18, H5F_LIBVER_LATEST), what);
  use_journal(access.get());
  return access;
}

/// Bytes that flushing a file may take: its structure is put together, then gathered into a journal, in order, and with
/// its frame.
std::size_t need_of_flush(hid_t file) {
  std::size_t most = 0, least = 0, size = 0;
  int entries = 0;
  if (H5Fget_mdc_size(file, &most, &least, &size, &entries) < 0) return 0;
  constexpr std::size_t copies = 8;
  return copies * size;
}

/// With the formats of HDF5 1.10 all structure has checksums: headers, groups, indices of chunks. Only texts have none
/// (global heap).
void have_checksums(hid_t file, const std::string& what) {
  check(H5Fset_libver_bounds(file, H5F_LIBVER_V110, H5F_LIBVER_LATEST), what);
}

}  // namespace

std::string reason() {
  Words words{};
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first_description, &words);
  H5Eclear2(H5E_DEFAULT);
  return words[0] == 0 ? "HDF5 gives no reason" : words.data();
}

std::recursive_mutex& in_use() {
  static std::recursive_mutex mutex;
  return mutex;
}

void be_quiet() {
  expect_free_memory();  // HDF5 keeps something for each thread
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Handle& Handle::operator=(Handle&& other) noexcept {
  if (this != &other) {
    close();
    id_ = std::exchange(other.id_, -1);
    closer_ = other.closer_;
  }
  return *this;
}

void Handle::close() noexcept {
  const hid_t id = release();
  // Spaces, types and properties live within a call that has looked, and closing them writes nothing.
  const bool only_frees = closer_ == H5Sclose || closer_ == H5Tclose || closer_ == H5Pclose;
  if (id < 0 || !(only_frees || enough_to_close())) return;
  // A file that was closed has closed what was open in it; asked again, HDF5 notes an error that a thread never clears.
  if (H5Iis_valid(id) <= 0) return;
  // What can't be closed for want of memory is left as by a kill: as it was flushed last.
  if (closer_ == H5Fclose && !enough_to_close(need_of_flush(id))) return;
  closer_(id);
}

namespace {

/// Nobody has that name, or a killed run left a file of this kind there that nobody writes now.
bool is_free(const std::string& name, const FileKind& kind) {
  struct stat facts;
  if (lstat(name.c_str(), &facts) != 0) return errno == ENOENT;
  if (!S_ISREG(facts.st_mode) || !is_of_kind(name, kind)) return false;
  const disk::Descriptor file(::open(name.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  return file.get() >= 0 && (flock(file.get(), LOCK_SH | LOCK_NB) == 0 || errno != EWOULDBLOCK);
}

std::string name_beside(const std::string& path, const FileKind& kind) {
  constexpr int most = 1000;
  std::string name = path + unfinished;
  for (int n = 1; n < most && !is_free(name, kind); ++n) name = path + unfinished + '.' + std::to_string(n);
  return name;
}

/// A pipe would be waited for, perhaps for ever.
void expect_file(const std::string& path) {
  struct stat facts;
  if (stat(path.c_str(), &facts) == 0 && !S_ISREG(facts.st_mode))
    throw std::runtime_error("opening " + path + ": it is " + seems_to_be(path));
}

void before_a_file() {
  expect_free_memory();
  stay_out_of_exit();
  be_quiet();
}

}  // namespace

File File::create(const std::string& path, const FileKind& kind) {
  before_a_file();
  const std::string what = "making " + path, target = target_of(path), beside = name_beside(target, kind);
  const Handle access = access_by_journal(what), creation = attributes_in_header(what);
  File file({check(H5Fcreate(beside.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), what), H5Fclose}, target);
  file.name_ = Name::unfinished;
  file.beside_ = beside;
  file.kind_ = kind;
  note_unfinished(beside);
  have_checksums(file.id_.get(), what);
  file.root().set_attribute("format", kind.mark);
  file.flush();
  return file;
}

File File::open(const std::string& path) {
  const LimitedCall limited;
  before_a_file();
  expect_file(path);
  finish_journal(path);
  return {Handle(check(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "opening " + path), H5Fclose), path};
}

File File::extend(const std::string& path) {
  before_a_file();
  expect_file(path);
  finish_journal(path);
  const std::string what = "opening " + path;
  const Handle access = access_by_journal(what);
  File file({check(H5Fopen(path.c_str(), H5F_ACC_RDWR, access.get()), what), H5Fclose}, path);
  file.extends_ = true;
  have_checksums(file.id_.get(), what);
  return file;
}

File::File(File&& other) noexcept
    : id_(std::move(other.id_)),
      path_(std::move(other.path_)),
      name_(std::exchange(other.name_, Name::own)),
      beside_(std::move(other.beside_)),
      kind_(std::move(other.kind_)),
      extends_(other.extends_),
      threads_(std::move(other.threads_)) {}

File& File::operator=(File&& other) noexcept {
  if (this == &other) return *this;
  abandon();
  id_ = std::move(other.id_);
  path_ = std::move(other.path_);
  name_ = std::exchange(other.name_, Name::own);
  beside_ = std::move(other.beside_);
  kind_ = std::move(other.kind_);
  extends_ = other.extends_;
  threads_ = std::move(other.threads_);
  return *this;
}

File::~File() { abandon(); }

void File::abandon() noexcept {
  id_.close();
  if (name_ == Name::unfinished) {
    unlink(beside_.c_str());
    forget_unfinished(beside_);
  }
  name_ = Name::own;
}

Group File::root() const {
  expect_free_memory();
  return {Handle(check(H5Gopen2(id_.get(), "/", H5P_DEFAULT), "opening " + path_), H5Gclose), "/", extends_, threads_};
}

void File::flush() const {
  expect_free_memory();
  expect_free_memory(need_of_flush(id_.get()));
  check(H5Fflush(id_.get(), H5F_SCOPE_GLOBAL), "writing " + path_);
}

void File::take_name() {
  if (name_ == Name::own) return;
  name_ = Name::own;  // what is there stays, whatever comes
  forget_unfinished(beside_);
  try {
    expect_replaceable(path_, kind_);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(std::string(error.what()) + "; what was written is in " + beside_);
  }
  if (rename(beside_.c_str(), path_.c_str()) != 0)
    throw std::runtime_error("cannot give " + path_ + " its name: " + disk::reason() + "; what was written is in " +
                             beside_);
}

std::string File::keep_name() const {
  expect_free_memory();
  return name_ == Name::own ? hdf5::keep_name(id_.get(), path_) : std::string();
}

void File::close(const std::function<void(const std::string&)>& before_naming) {
  if (!is_open()) return;
  flush();
  const herr_t closed = H5Fclose(id_.release());
  check(closed, "writing " + path_);
  if (name_ == Name::own) return;
  disk::bring_to_disk(beside_);
  if (before_naming) before_naming(beside_);
  take_name();
  disk::bring_to_disk(std::filesystem::absolute(path_).parent_path().string());
}

}  // namespace railwave::hdf5
