#include "output/disk.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace railwave::disk {

Descriptor::~Descriptor() { close(); }

int Descriptor::release() { return std::exchange(number_, -1); }

bool Descriptor::close() {
  const int number = release();
  return number < 0 || ::close(number) == 0;
}

bool write_at(int file, const void* bytes, std::size_t size, off_t offset) {
  const auto* from = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t written = pwrite(file, from, size, offset);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      if (written == 0) errno = ENOSPC;
      return false;
    }
    from += written;
    offset += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

bool read_at(int file, void* bytes, std::size_t size, off_t offset) {
  auto* to = static_cast<char*>(bytes);
  while (size > 0) {
    const ssize_t got = pread(file, to, size, offset);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return false;
    if (got == 0) {
      std::memset(to, 0, size);
      return true;
    }
    to += got;
    offset += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

off_t length_of(int file) {
  struct stat facts;
  return fstat(file, &facts) == 0 ? facts.st_size : -1;
}

std::string reason() { return std::strerror(errno); }

std::string mend() {
  switch (errno) {
    case ENOSPC:
      return "free some space there, or name a file on another disk";
    case EDQUOT:
      return "your quota there is used up: remove what you no longer need, or name a file on another disk";
    case EFBIG:
      return "files there, or of this shell (ulimit -f), may not be so large";
    case EROFS:
      return "that disk can only be read: name a file on another one";
    case EACCES:
    case EPERM:
      return "you may not write there: ask for the right to, or name another file";
    case EIO:
      return "the disk is failing: name a file on another one, and see to it";
    default:
      return {};
  }
}

void bring_to_disk(const std::string& path) {
  Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() >= 0 && fsync(file.get()) == 0) return;
  const std::string why = reason(), what_to_do = mend();
  throw std::runtime_error("writing " + path + ": " + why + (what_to_do.empty() ? "" : "; ") + what_to_do);
}

}  // namespace railwave::disk
