#include "sweep/member_row.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>

#include <fmt/format.h>

namespace railwave::sweep {

std::optional<MemberLock> MemberLock::take(const std::string& path) {
  for (;;) {
    disk::Descriptor file(open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666));
    if (file.get() < 0) throw std::runtime_error(fmt::format("cannot make {}: {}", path, disk::reason()));
    if (flock(file.get(), LOCK_EX | LOCK_NB) != 0) {
      if (errno == EWOULDBLOCK) return std::nullopt;
      throw std::runtime_error(fmt::format(
          "cannot lock {}: {}; the study's folder must lie on a file system with locks", path, disk::reason()));
    }
    struct stat ours, named;
    const bool same = fstat(file.get(), &ours) == 0 && stat(path.c_str(), &named) == 0 && ours.st_ino == named.st_ino &&
                      ours.st_dev == named.st_dev;
    if (same) return MemberLock(path, std::move(file));  // else who had it has just removed it
  }
}

MemberLock::MemberLock(MemberLock&& other) noexcept : path_(std::move(other.path_)), file_(std::move(other.file_)) {
  other.path_.clear();
}

MemberLock::~MemberLock() {
  if (file_.get() >= 0 && !path_.empty()) unlink(path_.c_str());  // before others can have it
}

}  // namespace railwave::sweep
