#pragma once

#include <string>

namespace railwave {

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

}  // namespace railwave
