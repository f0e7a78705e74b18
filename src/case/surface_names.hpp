#pragma once

#include <algorithm>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace railwave::scene {

/// Names of one or several surfaces, `part.surface`, which act as one; in the file's order.
class SurfaceNames {
 public:
  SurfaceNames() = default;
  SurfaceNames(const char* one) : SurfaceNames(std::string(one)) {}
  SurfaceNames(const std::string& one) {
    if (!one.empty()) names_.push_back(one);
  }
  SurfaceNames(std::initializer_list<std::string> several) : names_(several) {}
  explicit SurfaceNames(std::vector<std::string> several) : names_(std::move(several)) {}

  const std::vector<std::string>& list() const { return names_; }
  auto begin() const { return names_.begin(); }
  auto end() const { return names_.end(); }
  std::size_t size() const { return names_.size(); }
  bool empty() const { return names_.empty(); }
  bool has(const std::string& name) const { return std::find(begin(), end(), name) != end(); }

  /// "rail.head" or "rail.head, rail_2.head"
  std::string text() const {
    std::string all;
    for (const std::string& name : names_) all += (all.empty() ? "" : ", ") + name;
    return all;
  }

  friend bool operator==(const SurfaceNames& a, const SurfaceNames& b) { return a.names_ == b.names_; }
  friend bool operator!=(const SurfaceNames& a, const SurfaceNames& b) { return !(a == b); }

 private:
  std::vector<std::string> names_;
};

}  // namespace railwave::scene
