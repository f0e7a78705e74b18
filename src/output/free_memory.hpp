#pragma once

#include <cstddef>
#include <new>

/// Memory for what can't do without. HDF5 1.10 does not see everywhere that it got none: it frees what it never had, or
/// ends the program. So it is entered only where there is several times what any one call takes; and one such share is
/// held in reserve while a file is open, and given back to close in good order when there is no more. Other threads may
/// take memory meanwhile: hence several times.
namespace railwave {

/// Bytes. The most that a call of our HDF5 wrapper takes is below a quarter of it (tests/output/test_little_memory.py
/// measures it), but for what a caller adds for the size of its arrays.
inline constexpr std::size_t memory_margin = std::size_t{16} << 20;

/// There is less memory left than what is to come may need; nothing of it was begun.
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

/// Whether so many bytes can be had now, within the machine's memory and all limits (ulimit -v, ulimit -d). Takes none.
bool can_be_had(std::size_t bytes) noexcept;

/// The margin and `more` bytes can be had, and the reserve is held; else throws TooLittleMemory.
void expect_free_memory(std::size_t more = 0);

/// For what can throw nothing, such as closing: where the margin and `more` can't be had the reserve is given back.
/// @return whether half the margin and `more` can be had then
bool enough_to_close(std::size_t more = 0) noexcept;

/// Whether what is asked for leaves the margin, where a reserve is held: large arrays are not to take what HDF5 counts
/// on.
bool leaves_free_memory(std::size_t bytes) noexcept;

}  // namespace railwave
