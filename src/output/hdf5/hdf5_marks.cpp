#include "output/file_kind.hpp"

#include <fcntl.h>

#include <cstdint>
#include <cstring>
#include <deque>
#include <utility>
#include <vector>

#include "output/disk.hpp"

namespace railwave::hdf5 {
namespace {

constexpr std::uint64_t longest_text = 4096, longest_header = 1 << 20;
constexpr int most_blocks = 256, most_heap_objects = 100000;

/// A little-endian number of `size` bytes.
std::uint64_t number_at(const std::vector<char>& bytes, std::uint64_t place, int size) {
  std::uint64_t value = 0;
  if (place + static_cast<std::uint64_t>(size) > bytes.size()) return 0;
  for (int i = size; i-- > 0;)
    value = value << 8 | static_cast<unsigned char>(bytes[place + static_cast<std::uint64_t>(i)]);
  return value;
}

std::uint64_t padded(std::uint64_t size) { return (size + 7) / 8 * 8; }

class RootReader {
 public:
  explicit RootReader(const std::string& path)
      : file_(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)),
        length_(file_.get() < 0 ? -1 : disk::length_of(file_.get())) {}

  std::optional<RootAttributes> read() {
    const auto head = bytes(0, 96);
    if (head.size() < 96 || std::memcmp(head.data(), "\211HDF\r\n\032\n", 8) != 0) return std::nullopt;
    const int version = head[8];
    // Offsets and lengths of 8 bytes each, as the library makes them unless asked.
    if ((version == 0 || version == 1) && head[13] == 8 && head[14] == 8)
      read_old_header(number_at(head, version == 0 ? 64 : 68, 8));
    if ((version == 2 || version == 3) && head[9] == 8 && head[10] == 8) read_header(number_at(head, 36, 8));
    return std::move(found_);
  }

 private:
  /// As many of them as there are.
  std::vector<char> bytes(std::uint64_t place, std::uint64_t size) const {
    const auto length = static_cast<std::uint64_t>(std::max<off_t>(length_, 0));
    if (place >= length) return {};
    std::vector<char> result(std::min(size, length - place));
    if (!disk::read_at(file_.get(), result.data(), result.size(), static_cast<off_t>(place))) return {};
    return result;
  }

  /// Object header 1, of HDF5 before 1.8.
  void read_old_header(std::uint64_t place) {
    const auto prefix = bytes(place, 16);
    if (prefix.size() < 16 || prefix[0] != 1) return;
    blocks_.push_back({place + 16, number_at(prefix, 8, 4)});
    for (int count = 0; !blocks_.empty() && count < most_blocks; ++count) {
      const auto [where, size] = blocks_.front();
      blocks_.pop_front();
      if (size <= longest_header) read_messages(bytes(where, size), {2, 4, 8});
    }
  }

  /// Object header 2.
  void read_header(std::uint64_t place) {
    constexpr std::uint64_t times = 16, phases = 4, checksum = 4;
    const auto prefix = bytes(place, 34);
    if (prefix.size() < 34 || std::memcmp(prefix.data(), "OHDR", 4) != 0 || prefix[4] != 2) return;
    const int flags = static_cast<unsigned char>(prefix[5]);
    const std::uint64_t at = 6 + (flags & 0x20 ? times : 0) + (flags & 0x10 ? phases : 0);
    const int size_of_size = 1 << (flags & 3);
    const Layout layout{1, 3, static_cast<std::uint64_t>(flags & 4 ? 6 : 4)};
    const std::uint64_t first = number_at(prefix, at, size_of_size);
    if (first <= longest_header)
      read_messages(bytes(place + at + static_cast<std::uint64_t>(size_of_size), first), layout);
    for (int count = 0; !blocks_.empty() && count < most_blocks; ++count) {
      const auto [where, size] = blocks_.front();
      blocks_.pop_front();
      if (size > longest_header || size < 8) continue;
      const auto block = bytes(where, size - checksum);
      if (block.size() < 4 || std::memcmp(block.data(), "OCHK", 4) != 0) continue;
      read_messages({block.begin() + 4, block.end()}, layout);
    }
  }

  /// Of a message's head: bytes of its type, which come first and are followed by two of its size; where its flags
  /// stand; where it ends.
  struct Layout {
    int type_size;
    std::uint64_t flags, end;
  };

  void read_messages(const std::vector<char>& block, const Layout& layout) {
    constexpr std::uint64_t attribute = 0x0c, continuation = 0x10;
    constexpr char shared = 2;
    for (std::uint64_t at = 0; at + layout.end <= block.size();) {
      const std::uint64_t type = number_at(block, at, layout.type_size),
                          size = number_at(block, at + static_cast<std::uint64_t>(layout.type_size), 2);
      const char flags = block[at + layout.flags];
      at += layout.end;
      if (size > block.size() - at) return;
      const std::vector<char> message(block.begin() + static_cast<std::ptrdiff_t>(at),
                                      block.begin() + static_cast<std::ptrdiff_t>(at + size));
      if (type == continuation) blocks_.push_back({number_at(message, 0, 8), number_at(message, 8, 8)});
      if (type == attribute && !(flags & shared)) read_attribute(message);
      at += size;
    }
  }

  void read_attribute(const std::vector<char>& message) {
    if (message.size() < 8) return;
    const int version = message[0];
    if (version < 1 || version > 3 || (version > 1 && message[1] != 0)) return;
    const auto in_place = [&](std::uint64_t size) { return version == 1 ? padded(size) : size; };
    const std::uint64_t name_size = number_at(message, 2, 2), type_size = number_at(message, 4, 2),
                        space_size = number_at(message, 6, 2);
    const std::uint64_t name = version == 3 ? 9 : 8, type = name + in_place(name_size),
                        space = type + in_place(type_size), value = space + in_place(space_size);
    if (name_size == 0 || type_size < 8 || space_size < 2 || value > message.size()) return;
    const bool scalar = message[space + 1] == 0;
    if (!scalar) return;
    const std::string called(message.data() + name, strnlen(message.data() + name, name_size));
    constexpr int whole_number = 0, of_any_length = 9;
    const int kind = message[type] & 0x0f;
    const std::uint64_t size = number_at(message, type + 4, 4);
    if (kind == whole_number && size <= 8 && value + size <= message.size())
      found_.numbers[called] = static_cast<long>(number_at(message, value, static_cast<int>(size)));
    if (kind == of_any_length && value + 16 <= message.size())
      found_.texts[called] =
          text(number_at(message, value, 4), number_at(message, value + 4, 8), number_at(message, value + 12, 4));
  }

  /// An object of a global heap; empty where it is not there or too long.
  std::string text(std::uint64_t size, std::uint64_t heap, std::uint64_t index) const {
    if (size > longest_text) return {};
    const auto head = bytes(heap, 16);
    if (head.size() < 16 || std::memcmp(head.data(), "GCOL", 4) != 0) return {};
    const std::uint64_t end = heap + number_at(head, 8, 8);
    if (end < heap) return {};
    std::uint64_t at = heap + 16;
    for (int count = 0; at + 16 <= end && count < most_heap_objects; ++count) {
      const auto object = bytes(at, 16);
      if (object.size() < 16) return {};
      const std::uint64_t number = number_at(object, 0, 2), length = number_at(object, 8, 8);
      if (number == 0) return {};  // free space: the last
      if (number == index) {
        const auto found = bytes(at + 16, std::min(size, length));
        return {found.begin(), found.end()};
      }
      if (length > end - at - 16) return {};
      at += 16 + padded(length);
    }
    return {};
  }

  disk::Descriptor file_;
  off_t length_;
  std::deque<std::pair<std::uint64_t, std::uint64_t>> blocks_;  ///< place, size
  RootAttributes found_;
};

}  // namespace

std::string RootAttributes::text(const std::string& name) const {
  const auto found = texts.find(name);
  return found == texts.end() ? std::string() : found->second;
}

long RootAttributes::number(const std::string& name, long otherwise) const {
  const auto found = numbers.find(name);
  return found == numbers.end() ? otherwise : found->second;
}

std::optional<RootAttributes> read_root_attributes(const std::string& path) { return RootReader(path).read(); }

}  // namespace railwave::hdf5
