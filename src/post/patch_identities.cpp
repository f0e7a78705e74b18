#include "post/patch_identities.hpp"

#include <algorithm>
#include <tuple>

namespace railwave {
namespace {

constexpr double reach_in_sizes = 2;    ///< that a patch may lie off its predicted place
constexpr double doubt_of_way = 0.25;   ///< and more where it has moved, of the way, at most as much again
constexpr double price_of_shift = 0.1;  ///< an unknown common motion should be small, but fit before that

}  // namespace

void PatchIdentities::predict(double time) {
  for (Track& track : tracks_) {
    const Track* known = track.moving ? &track : nullptr;
    for (const Track& other : tracks_)
      if (!track.moving && other.moving &&
          (known == nullptr ||
           (other.last.centre - track.last.centre).norm() < (known->last.centre - track.last.centre).norm()))
        known = &other;
    const Vector way = known ? Vector((time - track.time) * known->velocity) : Vector(Vector::Zero());
    track.predicted = track.last.centre + way;
    track.doubt = doubt_of_way * way.norm();
  }
}

PatchIdentities::Match PatchIdentities::match(const std::vector<SeenPatch>& patches, const Vector& shift) const {
  using Pair = std::tuple<bool, double, int, int>;  // not both large; distance; track; patch
  std::vector<Pair> pairs;
  for (std::size_t k = 0; k < tracks_.size(); ++k)
    for (std::size_t j = 0; j < patches.size(); ++j) {
      const Track& track = tracks_[k];
      const double size = std::max(track.last.size, patches[j].size),
                   off = (patches[j].centre - track.predicted - shift).norm();
      if (off <= reach_in_sizes * size + std::min(track.doubt, reach_in_sizes * size))
        pairs.emplace_back(track.last.small || patches[j].small, off, static_cast<int>(k), static_cast<int>(j));
    }
  std::sort(pairs.begin(), pairs.end());
  Match found{std::vector<int>(patches.size(), -1)};
  std::vector<char> taken(tracks_.size(), 0);
  for (const auto& [small, off, k, j] : pairs) {
    if (taken[k] || found.track[j] >= 0) continue;
    taken[k] = 1;
    found.track[j] = k;
    found.large += !small;
    ++found.all;
    found.distance += off;
  }
  return found;
}

std::vector<int> PatchIdentities::numbers(double time, const std::vector<SeenPatch>& patches) {
  predict(time);
  Match best = match(patches, Vector::Zero());
  if (std::none_of(tracks_.begin(), tracks_.end(), [](const Track& track) { return track.moving; })) {
    double price = best.distance;
    for (const Track& track : tracks_)
      for (const SeenPatch& patch : patches) {
        const Vector shift = (patch.centre - track.predicted).dot(rolling_) * rolling_;
        Match other = match(patches, shift);
        const double its_price = other.distance + price_of_shift * other.all * shift.norm();
        if (std::make_tuple(-other.large, -other.all, its_price) >= std::make_tuple(-best.large, -best.all, price))
          continue;
        best = std::move(other);
        price = its_price;
      }
  }
  std::vector<int> numbers;
  for (std::size_t j = 0; j < patches.size(); ++j) {
    if (best.track[j] < 0) {
      best.track[j] = static_cast<int>(tracks_.size());
      tracks_.push_back({patches[j], time});
    } else {
      Track& track = tracks_[best.track[j]];
      if (time > track.time) {
        track.velocity = (patches[j].centre - track.last.centre) / (time - track.time);
        track.moving = true;
      }
      track.last = patches[j];
      track.time = time;
    }
    numbers.push_back(best.track[j] + 1);
  }
  return numbers;
}

}  // namespace railwave
