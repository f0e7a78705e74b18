#pragma once

namespace railwave {

/// Libraries may end the program by themselves: HDF5 1.10 calls exit(-1) without a word where it finds no memory for an
/// identifier, on whatever thread. While one of these lives such an end is told, and has the exit code of a failure.
class NoSuddenExit {
 public:
  NoSuddenExit();
  ~NoSuddenExit();
  NoSuddenExit(const NoSuddenExit&) = delete;
  NoSuddenExit& operator=(const NoSuddenExit&) = delete;
};

}  // namespace railwave
