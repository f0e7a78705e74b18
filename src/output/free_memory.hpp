#pragma once

#include <cstddef>
#include <new>

/// Memory that must be free before HDF5 is called. HDF5 1.10 does not check every allocation: without memory it frees
/// what it never had, or ends the program. So it is called only while several times the need of any one call is free
/// (several times, because other threads may allocate meanwhile). As much is held in reserve while a file is open, and
/// released to close the file where no other memory is left.
namespace railwave {

/// Bytes. The most that a call of our HDF5 wrapper takes is below a quarter of it (tests/output/test_little_memory.py
/// measures it), but for what a caller adds for the size of its arrays.
inline constexpr std::size_t memory_margin = std::size_t{16} << 20;

/// Less memory is free than the next operation may need; it was not begun.
class TooLittleMemory : public std::bad_alloc {
 public:
  explicit TooLittleMemory(std::size_t wanted) : wanted_(wanted) {}
  std::size_t wanted() const { return wanted_; }  ///< bytes
  const char* what() const noexcept override {
    return "out of memory: too little is left to write or read files safely";
  }

 private:
  std::size_t wanted_;
};

/// Whether so many bytes can be allocated now, within the machine's memory and all limits (ulimit -v, ulimit -d).
/// Allocates none.
bool can_be_had(std::size_t bytes) noexcept;

/// Throws TooLittleMemory unless the margin and `more` bytes can be allocated and the reserve is held.
void expect_free_memory(std::size_t more = 0);

/// For calls that must not throw, such as closing: releases the reserve where the margin and `more` can't be allocated.
/// @return whether half the margin and `more` can be allocated then
bool enough_to_close(std::size_t more = 0) noexcept;

/// Whether `bytes` can be allocated and still leave the margin, while a reserve is held: large arrays must not take the
/// memory that HDF5 counts on.
bool leaves_free_memory(std::size_t bytes) noexcept;

}  // namespace railwave
