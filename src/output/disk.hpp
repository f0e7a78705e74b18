#pragma once

#include <sys/types.h>

#include <cstddef>
#include <string>

namespace railwave::disk {

/// A descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(other.release()) {}
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor();
  int get() const { return number_; }
  int release();
  /// Closes now. @return whether the system took all that was written
  bool close();

 private:
  int number_;
};

/// All of it, however many calls of the system that takes. @return false: the system refuses, errno tells why
bool write_at(int file, const void* bytes, std::size_t size, off_t offset);

/// What lies beyond the file's end reads as zeros.
bool read_at(int file, void* bytes, std::size_t size, off_t offset);

/// Bytes; negative: errno tells why not.
off_t length_of(int file);

/// For messages: "File too large" ...
std::string reason();

/// What to do about what the system just refused, to be said behind reason(); may be empty.
std::string mend();

/// Has the disk hold what was written of a file, or of a folder's list of names; throws std::runtime_error if it
/// refuses.
void bring_to_disk(const std::string& path);

}  // namespace railwave::disk
