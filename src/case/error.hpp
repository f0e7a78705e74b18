#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace railwave {

/// A mistake in what the user gave: `what()` holds one complaint a line, each saying what, where and how to mend.
/// The program prints it and exits with code 2.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& complaint) : std::runtime_error(complaint) {}
  explicit InputError(const std::vector<std::string>& complaints) : std::runtime_error(join(complaints)) {}

 private:
  static std::string join(const std::vector<std::string>& complaints) {
    std::string text;
    for (const auto& complaint : complaints) text += (text.empty() ? "" : "\n") + complaint;
    return text;
  }
};

/// What the user asks for needs more memory than is left where this process runs: with other ranks' it may fit.
class MemoryShortage : public InputError {
 public:
  using InputError::InputError;
};

}  // namespace railwave
