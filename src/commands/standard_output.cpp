#include "commands/standard_output.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <string>

#include "output/disk.hpp"

namespace railwave {

void keep_standard_descriptors() {
  for (int descriptor = 0; descriptor <= STDERR_FILENO; ++descriptor)
    while (fcntl(descriptor, F_GETFD) < 0 && errno == EBADF)
      if (open("/", O_RDONLY | O_DIRECTORY) < 0) return;  // takes the lowest number that is free
}

StandardOutput::StandardOutput() : before_(std::cout.rdbuf(this)), terminal_(isatty(STDOUT_FILENO) == 1) {
  setp(waiting_.data(), waiting_.data() + waiting_.size() - 1);  // the last place is overflow()'s
}

StandardOutput::~StandardOutput() {
  write_out();
  std::cout.rdbuf(before_);
}

StandardOutput::int_type StandardOutput::overflow(int_type character) {
  if (!traits_type::eq_int_type(character, traits_type::eof())) {
    *pptr() = traits_type::to_char_type(character);
    pbump(1);
  }
  write_out();
  return traits_type::not_eof(character);
}

std::streamsize StandardOutput::xsputn(const char* text, std::streamsize length) {
  std::streambuf::xsputn(text, length);
  if (terminal_ && std::memchr(text, '\n', static_cast<std::size_t>(length)) != nullptr) write_out();
  return length;
}

int StandardOutput::sync() {
  write_out();
  return 0;
}

void StandardOutput::write_out() {
  const char* from = pbase();
  while (from < pptr() && !nobody_reads_) {
    const ssize_t written = write(STDOUT_FILENO, from, static_cast<std::size_t>(pptr() - from));
    if (written > 0) {
      from += written;
      continue;
    }
    if (written < 0 && errno == EINTR) continue;
    if (written < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) {
      pollfd ready{STDOUT_FILENO, POLLOUT, 0};
      if (poll(&ready, 1, -1) >= 0 || errno == EINTR) continue;
    }
    const int reason = written == 0 ? ENOSPC : errno;
    nobody_reads_ = reason == EPIPE;
    if (failure_ == 0 && !nobody_reads_) failure_ = reason;
    break;  // what waits is lost; what comes later may find room
  }
  setp(waiting_.data(), waiting_.data() + waiting_.size() - 1);
}

int StandardOutput::end(int code) {
  write_out();
  if (failure_ == 0) return code;
  errno = failure_;
  const std::string reason = disk::reason(), mend = disk::mend();
  std::fputs(("railwave: not all that was to go to standard output got there: " + reason + (mend.empty() ? "" : "; ") +
              mend + "\n")
                 .c_str(),
             stderr);
  return code == 0 ? 1 : code;
}

}  // namespace railwave
