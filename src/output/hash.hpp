#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace railwave {

/// FNV-1a.
class Hash {
 public:
  void add(const void* bytes, std::size_t count) {
    const auto* byte = static_cast<const unsigned char*>(bytes);
    for (std::size_t i = 0; i < count; ++i) value_ = (value_ ^ byte[i]) * 0x100000001b3u;
  }
  void add(const std::string& text) {
    add(text.data(), text.size());
    add("", 1);
  }
  template <class T>
  void add(const std::vector<T>& values) {
    const std::uint64_t count = values.size();
    add(&count, sizeof count);
    add(values.data(), values.size() * sizeof(T));
  }

  /// For much: eight bytes at a time.
  void add_words(const void* bytes, std::size_t count) {
    const auto* from = static_cast<const unsigned char*>(bytes);
    for (std::size_t i = 0; i + 8 <= count; i += 8) {
      std::uint64_t word;
      std::memcpy(&word, from + i, 8);
      value_ = (value_ ^ word) * 0x9e3779b97f4a7c15u;
      value_ ^= value_ >> 32;
    }
    add(from + count / 8 * 8, count % 8);
  }

  std::uint64_t value() const { return value_; }
  std::string text() const { return fmt::format("{:016x}", value_); }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace railwave
