#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <vector>

#include "output/disk.hpp"
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

/// @param links how many names the run's own file still has
[[noreturn]] void leave_to_another(int descriptor, const std::string& path, nlink_t links) {
  const std::string beside = path + ".rescued";
  const bool rescued = links == 0 && write_anew(descriptor, beside);
  throw std::runtime_error("another file has taken the name " + path +
                           " while this run wrote it; what the run has written so far is " +
                           (rescued     ? "in " + beside
                            : links > 0 ? std::string("where it was moved to")
                                        : "lost: " + disk::reason()));
}

}  // namespace

std::string keep_name(hid_t file, const std::string& path) {
  const int descriptor = descriptor_of(file);
  struct stat ours, there;
  if (fstat(descriptor, &ours) != 0) throw std::runtime_error("asking for " + path + ": " + disk::reason());
  const bool taken = stat(path.c_str(), &there) == 0;
  if (taken && there.st_ino == ours.st_ino && there.st_dev == ours.st_dev) return {};
  if (taken) leave_to_another(descriptor, path, ours.st_nlink);
  if (ours.st_nlink > 0 && linkat(AT_FDCWD, ("/proc/self/fd/" + std::to_string(descriptor)).c_str(), AT_FDCWD,
                                  path.c_str(), AT_SYMLINK_FOLLOW) == 0)
    return path + " was moved while the run wrote it; the file now has both names";
  if (!write_anew(descriptor, path)) {
    if (errno == EEXIST) leave_to_another(descriptor, path, ours.st_nlink);  // since we looked
    const std::string reason = disk::reason();
    throw std::runtime_error(path + " was removed while the run wrote it, and cannot be written anew: " + reason);
  }
  return path +
         " was removed while the run wrote it; it was written anew from what the system still held, nothing is missing";
}

}  // namespace railwave::hdf5
