#include "output/atomic_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace railwave {

void write_whole_file(const std::string& path, const std::string& text) {
  const std::string beside = path + ".new." + std::to_string(getpid());
  const auto fail = [&](const char* what) {
    const std::string reason = std::strerror(errno);
    std::remove(beside.c_str());
    throw std::runtime_error(std::string(what) + " " + path + ": " + reason);
  };
  std::FILE* file = std::fopen(beside.c_str(), "wb");
  if (!file) fail("cannot make");
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  if (std::fclose(file) != 0 || !written) fail("cannot write");
  if (std::rename(beside.c_str(), path.c_str()) != 0) fail("cannot write");
}

}  // namespace railwave
