#include "model/lent_array.hpp"

#include <algorithm>
#include <map>
#include <mutex>

namespace railwave {
namespace {

/// What has been given back, by its size.
class KeptMemory {
 public:
  LentMemory lend(std::size_t bytes) {
    const std::lock_guard<std::mutex> lock(mutex_);
    // So much larger that it is still not wasted.
    constexpr std::size_t most_times = 4;
    if (const auto found = kept_.lower_bound(bytes); found != kept_.end() && found->first <= most_times * bytes) {
      LentMemory lent(found->second, {found->first});
      bytes_ -= found->first;
      kept_.erase(found);
      return lent;
    }
    const std::size_t rounded = std::max(least_bytes, bytes + bytes / 8);
    try {
      return {allocate(rounded), {rounded}};
    } catch (const std::exception&) {
      forget();
      return {allocate(bytes), {bytes}};
    }
  }

  void take_back(void* memory, std::size_t bytes) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (bytes_ + bytes > most_kept_memory) return Kokkos::kokkos_free<MemorySpace>(memory);
    kept_.emplace(bytes, memory);
    bytes_ += bytes;
    if (ends_with_kokkos_) return;
    ends_with_kokkos_ = true;
    Kokkos::push_finalize_hook([this] {
      const std::lock_guard<std::mutex> at_end(mutex_);
      forget();
      ends_with_kokkos_ = false;
    });
  }

  std::size_t bytes() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return bytes_;
  }

 private:
  static constexpr std::size_t least_bytes = 4096;

  static void* allocate(std::size_t bytes) { return Kokkos::kokkos_malloc<MemorySpace>("lent memory", bytes); }

  void forget() {
    for (const auto& [bytes, memory] : kept_) Kokkos::kokkos_free<MemorySpace>(memory);
    kept_.clear();
    bytes_ = 0;
  }

  std::mutex mutex_;
  std::multimap<std::size_t, void*> kept_;
  std::size_t bytes_ = 0;
  bool ends_with_kokkos_ = false;
};

KeptMemory& kept() {
  static KeptMemory memory;
  return memory;
}

}  // namespace

void GiveBack::operator()(void* memory) const { kept().take_back(memory, bytes); }

LentMemory lend_memory(std::size_t bytes) { return bytes == 0 ? LentMemory() : kept().lend(bytes); }

std::size_t kept_memory() { return kept().bytes(); }

}  // namespace railwave
