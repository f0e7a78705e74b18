#include "output/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <stdexcept>

#include "output/disk.hpp"
#include "output/unfinished.hpp"

namespace railwave {

void write_whole_file(const std::string& path, const std::string& text) {
  const std::string beside = path + ".new." + std::to_string(getpid());
  const auto fail = [&](const char* what) {
    const std::string reason = disk::reason(), mend = disk::mend();
    unlink(beside.c_str());
    forget_unfinished(beside);
    throw std::runtime_error(std::string(what) + " " + path + ": " + reason + (mend.empty() ? "" : "; ") + mend);
  };
  disk::Descriptor file(open(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (file.get() < 0) fail("cannot make");
  note_unfinished(beside);
  if (!disk::write_at(file.get(), text.data(), text.size(), 0) || !file.close()) fail("cannot write");
  if (rename(beside.c_str(), path.c_str()) != 0) fail("cannot write");
  forget_unfinished(beside);
}

}  // namespace railwave
