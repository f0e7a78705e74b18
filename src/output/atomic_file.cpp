#include "output/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <stdexcept>

#include "output/disk.hpp"
#include "output/output_place.hpp"

namespace railwave {

void write_whole_file(const std::string& path, const std::string& text, const FileKind& kind) {
  const std::string target = target_of(path), first = target + ".new." + std::to_string(getpid());
  expect_replaceable(target, kind);
  // A name that nobody has: what is there under such a name is not ours.
  constexpr int most = 1000;
  std::string beside = first;
  int descriptor = -1;
  for (int n = 1; n < most && (descriptor = open(beside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666)) < 0 &&
                  errno == EEXIST;
       ++n)
    beside = first + '.' + std::to_string(n);
  const bool made = descriptor >= 0;
  const auto fail = [&](const char* what) {
    const std::string reason = disk::reason(), mend = disk::mend();
    if (made) unlink(beside.c_str());
    forget_unfinished(beside);
    throw std::runtime_error(std::string(what) + " " + path + ": " + reason + (mend.empty() ? "" : "; ") + mend);
  };
  disk::Descriptor file(descriptor);
  if (!made) fail("cannot make");
  note_unfinished(beside);
  if (!disk::write_at(file.get(), text.data(), text.size(), 0) || !file.close()) fail("cannot write");
  if (rename(beside.c_str(), target.c_str()) != 0) fail("cannot write");
  forget_unfinished(beside);
}

}  // namespace railwave
