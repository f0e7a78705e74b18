#include "modes/frontal_factor.hpp"

#include <algorithm>

namespace railwave {
namespace {

/// Sets with no more unknowns are not halved.
constexpr std::size_t leaf = 96;

class Dissector {
 public:
  Dissector(const Eigen::SparseMatrix<double>& lower, const std::vector<std::array<double, 3>>& place) : place_(place) {
    const int size = static_cast<int>(lower.rows());
    first_.assign(size + 1, 0);
    const auto each = [&](const auto& visit) {
      for (int column = 0; column < size; ++column)
        for (Eigen::SparseMatrix<double>::InnerIterator it(lower, column); it; ++it)
          if (it.row() != column) visit(static_cast<int>(it.row()), column);
    };
    each([&](int a, int b) { ++first_[a + 1], ++first_[b + 1]; });
    for (int k = 0; k < size; ++k) first_[k + 1] += first_[k];
    std::vector<int> filled(first_.begin(), first_.end() - 1);
    neighbour_.resize(first_.back());
    each([&](int a, int b) { neighbour_[filled[a]++] = b, neighbour_[filled[b]++] = a; });
    side_.assign(size, 0);
    result_.new_number.assign(size, -1);
  }

  Dissection run() {
    const int placed = static_cast<int>(place_.size()), size = static_cast<int>(side_.size());
    std::vector<int> all(placed), last;
    for (int k = 0; k < placed; ++k) all[k] = k;
    for (int k = placed; k < size; ++k) last.push_back(k);
    const auto children = split(std::move(all));
    if (!last.empty()) add(last, children);
    find_borders();
    return std::move(result_);
  }

 private:
  using Fronts = std::vector<int>;

  /// Adds the fronts of a set; returns their roots.
  Fronts split(std::vector<int> set) {
    if (set.empty()) return {};
    if (set.size() <= leaf) return {add(set, {})};
    std::vector<int> best_low, best_high, best_between;
    for (int axis = 0; axis < 3; ++axis) {
      const auto middle = set.begin() + static_cast<long>(set.size() / 2);
      std::nth_element(set.begin(), middle, set.end(), [&](int a, int b) { return place_[a][axis] < place_[b][axis]; });
      const double at = place_[*middle][axis];
      std::vector<int> low, high, between;
      for (int k : set) (place_[k][axis] < at ? low : high).push_back(k);
      if (low.empty() || high.empty()) continue;
      for (int k : low) side_[k] = 1;
      std::vector<int> rest;
      for (int k : high) (touches_low(k) ? between : rest).push_back(k);
      for (int k : low) side_[k] = 0;
      if (!best_low.empty() && between.size() >= best_between.size()) continue;
      best_low = std::move(low);
      best_high = std::move(rest);
      best_between = std::move(between);
    }
    if (best_low.empty()) return {add(set, {})};
    Fronts children = split(std::move(best_low));
    const Fronts more = split(std::move(best_high));
    children.insert(children.end(), more.begin(), more.end());
    if (best_between.empty()) return children;
    return {add(best_between, children)};
  }

  bool touches_low(int k) const {
    for (int i = first_[k]; i < first_[k + 1]; ++i)
      if (side_[neighbour_[i]] != 0) return true;
    return false;
  }

  int add(const std::vector<int>& own, const Fronts& children) {
    const int number = static_cast<int>(result_.fronts.size());
    Front front;
    front.own = own;
    front.first = count_;
    for (int k : own) result_.new_number[k] = count_++;
    for (int child : children) result_.fronts[child].parent = number;
    result_.fronts.push_back(std::move(front));
    return number;
  }

  void find_borders() {
    std::vector<std::vector<int>> children(result_.fronts.size());
    for (std::size_t f = 0; f < result_.fronts.size(); ++f) {
      Front& front = result_.fronts[f];
      const int end = front.first + static_cast<int>(front.own.size());
      std::vector<int>& border = front.border;
      for (int k : front.own)
        for (int i = first_[k]; i < first_[k + 1]; ++i)
          if (const int other = result_.new_number[neighbour_[i]]; other >= end) border.push_back(other);
      for (int child : children[f])
        for (int other : result_.fronts[child].border)
          if (other >= end) border.push_back(other);
      std::sort(border.begin(), border.end());
      border.erase(std::unique(border.begin(), border.end()), border.end());
      if (front.parent >= 0) children[front.parent].push_back(static_cast<int>(f));
    }
  }

  const std::vector<std::array<double, 3>>& place_;
  std::vector<int> first_, neighbour_;
  std::vector<char> side_;
  Dissection result_;
  int count_ = 0;
};

}  // namespace

Dissection nested_dissection(const Eigen::SparseMatrix<double>& lower,
                             const std::vector<std::array<double, 3>>& place) {
  return Dissector(lower, place).run();
}

}  // namespace railwave
