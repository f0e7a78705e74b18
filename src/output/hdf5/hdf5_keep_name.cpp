#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <vector>

#include "output/disk.hpp"
#include "output/hdf5/hdf5.hpp"
#include "output/hdf5/hdf5_journal.hpp"

namespace railwave::hdf5 {
namespace {

bool copy_all(int from, int to) {
  std::vector<char> bytes(std::size_t{1} << 20);
  const off_t length = disk::length_of(from);
  for (off_t at = 0; at < length;) {
    const auto size = static_cast<std::size_t>(std::min<off_t>(length - at, static_cast<off_t>(bytes.size())));
    if (!disk::read_at(from, bytes.data(), size, at) || !disk::write_at(to, bytes.data(), size, at)) return false;
    at += static_cast<off_t>(size);
  }
  return length >= 0;
}

/// The file goes on under this new name, with the same descriptor.
bool write_anew(int descriptor, const std::string& path) {
  disk::Descriptor copy(open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (copy.get() < 0) return false;
  static_cast<void>(flock(copy.get(), LOCK_EX | LOCK_NB));
  if (copy_all(descriptor, copy.get()) && dup3(copy.get(), descriptor, O_CLOEXEC) >= 0) return true;
  const int reason = errno;
  unlink(path.c_str());
  errno = reason;
  return false;
}

/// The file gets this name beside those that it has; it is refused where it has none left.
bool link_as(int descriptor, const std::string& path) {
  return linkat(AT_FDCWD, ("/proc/self/fd/" + std::to_string(descriptor)).c_str(), AT_FDCWD, path.c_str(),
                AT_SYMLINK_FOLLOW) == 0;
}

/// The first name beside PATH that nobody has, under which the file is from now on; empty: it could not be had.
/// Whether the file still has another name isn't asked, as the answer would be old by the time that it is used.
std::string rescue(int descriptor, const std::string& path) {
  for (int number = 1;; ++number) {
    const std::string beside = path + ".rescued" + (number > 1 ? "-" + std::to_string(number) : "");
    if (link_as(descriptor, beside) || write_anew(descriptor, beside)) return beside;
    if (errno != EEXIST) return {};
  }
}

[[noreturn]] void leave_to_another(int descriptor, const std::string& path) {
  const std::string beside = rescue(descriptor, path);
  const std::string reason = disk::reason();
  struct stat ours;
  const bool has_a_name = fstat(descriptor, &ours) == 0 && ours.st_nlink > 0;
  throw NameTaken("another file has taken the name " + path +
                  " while this run wrote it; what the run has written so far is " +
                  (!beside.empty() ? "in " + beside
                   : has_a_name    ? std::string("where it was moved to")
                                   : "lost: " + reason));
}

}  // namespace

std::string keep_name(hid_t file, const std::string& path) {
  const int descriptor = descriptor_of(file);
  struct stat ours, there;
  if (fstat(descriptor, &ours) != 0) throw std::runtime_error("asking for " + path + ": " + disk::reason());
  const bool taken = stat(path.c_str(), &there) == 0;
  if (taken && there.st_ino == ours.st_ino && there.st_dev == ours.st_dev) return {};
  if (taken) leave_to_another(descriptor, path);
  if (link_as(descriptor, path)) return path + " was moved while the run wrote it; the file now has both names";
  if (!write_anew(descriptor, path)) {
    if (errno == EEXIST) leave_to_another(descriptor, path);  // since we looked
    const std::string reason = disk::reason();
    throw std::runtime_error(path + " was removed while the run wrote it, and cannot be written anew: " + reason);
  }
  return path +
         " was removed while the run wrote it; it was written anew from what the system still held, nothing is missing";
}

}  // namespace railwave::hdf5
