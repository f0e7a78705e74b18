#include "output/run_places.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "case/error.hpp"
#include "output/atomic_file.hpp"
#include "output/disk.hpp"
#include "output/output_place.hpp"

namespace railwave {
namespace {

bool earlier(const timespec& a, const timespec& b) {
  return a.tv_sec < b.tv_sec || (a.tv_sec == b.tv_sec && a.tv_nsec < b.tv_nsec);
}

/// The system refuses: no mistake of the user's.
[[noreturn]] void fail(const std::string& what) {
  const std::string reason = disk::reason(), mend = disk::mend();
  throw std::runtime_error(what + ": " + reason + (mend.empty() ? "" : "; ") + mend);
}

/// A killed run leaves its lock, and may leave the file that it had begun under another name, which need not have its
/// mark yet. That file is removed: it was changed after the lock was made, and the killed run was the only one that
/// might.
void remove_unfinished(const std::string& path, const struct stat& lock) {
  const std::string unfinished = path + ".new";
  struct stat facts;
  if (lstat(unfinished.c_str(), &facts) == 0 && S_ISREG(facts.st_mode) && !earlier(facts.st_mtim, lock.st_mtim))
    unlink(unfinished.c_str());
}

}  // namespace

RunLock::RunLock(const std::string& path, const std::string& asked_by) {
  const std::string target = target_of(path);
  const std::string name = target + ".lock";
  for (;;) {
    struct stat there;
    const bool left = lstat(name.c_str(), &there) == 0;
    // An empty one is what a run left that was killed between making it and writing into it.
    if (left && (!S_ISREG(there.st_mode) || (there.st_size > 0 && !is_of_kind(name, kinds::lock()))))
      throw InputError(fmt::format(
          "{}: {} is {}, and the run would lock {} by a file of that name; move it away, or name another file",
          asked_by, name, seems_to_be(name), path));
    disk::Descriptor file(open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666));
    if (file.get() < 0) fail(asked_by + ": " + name + " cannot be made");
    if (flock(file.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
      throw InputError(
          fmt::format("{}: another run is writing {} now; wait for its end, or name another file", asked_by, path));
    struct stat ours, named;
    if (fstat(file.get(), &ours) != 0 || stat(name.c_str(), &named) != 0 || ours.st_ino != named.st_ino ||
        ours.st_dev != named.st_dev)
      continue;  // the run that had it ended just now, and removed it
    if (left) remove_unfinished(target, there);
    const std::string text = fmt::format(
        "Railwave lock: process {} writes the file beside this one. After its end this file may be removed.\n",
        getpid());
    if (ftruncate(file.get(), 0) != 0 || !disk::write_at(file.get(), text.data(), text.size(), 0)) {
      const int why = errno;
      unlink(name.c_str());
      errno = why;
      fail(asked_by + ": " + name + " cannot be written");
    }
    lock_ = name;
    descriptor_ = file.release();
    note_unfinished(lock_);  // a signal before the run takes it away too
    return;
  }
}

RunLock::~RunLock() {
  if (descriptor_ < 0) return;
  struct stat ours, named;
  const bool same = fstat(descriptor_, &ours) == 0 && lstat(lock_.c_str(), &named) == 0 &&
                    ours.st_ino == named.st_ino && ours.st_dev == named.st_dev;
  if (same) unlink(lock_.c_str());  // before others can have it
  forget_unfinished(lock_);
  close(descriptor_);
}

}  // namespace railwave
