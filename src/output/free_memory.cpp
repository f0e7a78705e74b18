#include "output/free_memory.hpp"

#include <sys/mman.h>

#include <atomic>

namespace railwave {
namespace {

std::atomic<void*> reserve{nullptr};

/// Counts towards the limits of a process and of the system as memory does, but is not touched, so takes no memory.
void* map(std::size_t bytes) noexcept {
  void* const place = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return place == MAP_FAILED ? nullptr : place;
}

bool hold_reserve() noexcept {
  if (reserve.load() != nullptr) return true;
  void* const place = map(memory_margin);
  if (place == nullptr) return false;
  void* none = nullptr;
  if (!reserve.compare_exchange_strong(none, place)) munmap(place, memory_margin);  // another thread was faster
  return true;
}

void give_reserve_back() noexcept {
  if (void* const place = reserve.exchange(nullptr)) munmap(place, memory_margin);
}

}  // namespace

bool can_be_had(std::size_t bytes) noexcept {
  void* const place = map(bytes);
  if (place != nullptr) munmap(place, bytes);
  return place != nullptr;
}

void expect_free_memory(std::size_t more) {
  if (!hold_reserve() || !can_be_had(memory_margin + more)) throw TooLittleMemory(memory_margin + more);
}

bool enough_to_close(std::size_t more) noexcept {
  if (can_be_had(memory_margin + more)) return true;
  give_reserve_back();
  return can_be_had(memory_margin / 2 + more);
}

bool leaves_free_memory(std::size_t bytes) noexcept {
  return reserve.load() == nullptr || can_be_had(bytes + memory_margin);
}

}  // namespace railwave
