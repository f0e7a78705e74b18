#include "output/atomic_file.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cstring>

namespace railwave {
namespace {

enum State { free_place, being_changed, noted };

/// A handler may not wait for a lock, nor allocate. Few files are made at once; what finds no place is left as a kill
/// leaves it.
struct Place {
  std::atomic<int> state{free_place};
  char path[4096];
};
std::array<Place, 8> places;
static_assert(std::atomic<int>::is_always_lock_free);

bool change(Place& place, State from) {
  int expected = from;
  return place.state.compare_exchange_strong(expected, being_changed);
}

}  // namespace

void note_unfinished(const std::string& path) {
  for (Place& place : places) {
    if (path.size() >= sizeof place.path || !change(place, free_place)) continue;
    std::memcpy(place.path, path.c_str(), path.size() + 1);
    place.state = noted;
    return;
  }
}

void forget_unfinished(const std::string& path) {
  for (Place& place : places)
    if (change(place, noted)) place.state = path == place.path ? free_place : noted;
}

void remove_unfinished() noexcept {
  for (Place& place : places)
    if (change(place, noted)) {
      unlink(place.path);
      place.state = free_place;
    }
}

}  // namespace railwave
