#include "post/patch_ways.hpp"

#include <algorithm>
#include <limits>

namespace railwave {

std::vector<int> PatchWays::add(double time, const ContactSolution& solution) {
  std::vector<SeenPatch> seen;
  for (const ContactPatch& patch : solution.patches) seen.push_back({patch.frame.centre, patch.size(), patch.small()});
  const std::vector<int> numbers = identities_.numbers(time, seen);
  std::vector<Row> added;
  int large = 0;
  Row only{0, 0};
  for (std::size_t p = 0; p < numbers.size(); ++p) {
    const ContactPatch& patch = solution.patches[p];
    if (numbers[p] > static_cast<int>(ways_.size())) ways_.resize(numbers[p]);
    auto& way = ways_[numbers[p] - 1];
    way.push_back({time, true, patch.frame.centre, patch.length()});
    added.push_back({numbers[p], static_cast<int>(way.size()) - 1});
    if (!patch.small() && ++large == 1) only = added.back();
  }
  if (added.size() == 1)
    only = added[0];
  else if (large != 1)
    only = {0, 0};
  rows_.push_back(only);
  std::sort(added.begin(), added.end(), [](const Row& a, const Row& b) { return a.number < b.number; });
  rows_.insert(rows_.end(), added.begin(), added.end());
  return numbers;
}

std::vector<Vector> PatchWays::velocity_of_rows() const {
  std::vector<std::vector<Vector>> velocities;
  for (const auto& way : ways_) velocities.push_back(patch_velocity(way));
  std::vector<Vector> result;
  for (const Row& row : rows_)
    result.push_back(row.number > 0 ? velocities[row.number - 1][row.sighting]
                                    : Vector(Vector::Constant(std::numeric_limits<double>::quiet_NaN())));
  return result;
}

}  // namespace railwave
