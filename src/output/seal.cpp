#include "output/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "output/disk.hpp"
#include "output/hash.hpp"

namespace railwave {
namespace {

struct Seal {
  char mark[8];
  std::uint64_t length, checksum;  ///< of what comes before
};
constexpr char mark[8] = {'R', 'W', 's', 'e', 'a', 'l', 'e', 'd'};

std::uint64_t checksum_of(int file, off_t length, const std::string& path) {
  std::vector<char> bytes(std::size_t{1} << 20);
  Hash hash;
  for (off_t at = 0; at < length;) {
    const auto size = static_cast<std::size_t>(std::min<off_t>(length - at, static_cast<off_t>(bytes.size())));
    if (!disk::read_at(file, bytes.data(), size, at))
      throw std::runtime_error("reading " + path + ": " + disk::reason());
    hash.add_words(bytes.data(), size);
    at += static_cast<off_t>(size);
  }
  return hash.value();
}

}  // namespace

void seal(const std::string& path) {
  const auto fail = [&] { throw std::runtime_error("writing " + path + ": " + disk::reason()); };
  disk::Descriptor file(open(path.c_str(), O_RDWR | O_CLOEXEC));
  const off_t length = file.get() < 0 ? -1 : disk::length_of(file.get());
  if (length < 0) fail();
  Seal all;
  std::memcpy(all.mark, mark, sizeof mark);
  all.length = static_cast<std::uint64_t>(length);
  all.checksum = checksum_of(file.get(), length, path);
  if (!disk::write_at(file.get(), &all, sizeof all, length) || fsync(file.get()) != 0 || !file.close()) fail();
}

void check_seal(const std::string& path) {
  disk::Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  Seal all{};
  const off_t length = (file.get() < 0 ? -1 : disk::length_of(file.get())) - static_cast<off_t>(sizeof all);
  if (file.get() < 0 || (length >= 0 && !disk::read_at(file.get(), &all, sizeof all, length)))
    throw std::runtime_error("reading it: " + disk::reason());
  if (length < 0 || std::memcmp(all.mark, mark, sizeof mark) != 0)
    throw std::runtime_error("it is not whole, or no file of this version of the program");
  if (all.length != static_cast<std::uint64_t>(length) || all.checksum != checksum_of(file.get(), length, path))
    throw std::runtime_error("its checksum is not that of what it holds; the file has been damaged");
}

}  // namespace railwave
