#pragma once

#include <array>
#include <streambuf>

namespace railwave {

/// Standard descriptors (0, 1, 2) that are closed when the program starts are given to a thing that can be neither
/// written nor read: else the first file that is opened, such as one of results, would become standard output. To be
/// called before anything is opened.
void keep_standard_descriptors();

/// While this lives std::cout goes through it to descriptor 1, and what the system refuses is remembered; the stream
/// itself never fails, so that a run goes on. A reader that has gone (EPIPE) is no fault: nobody wants the rest.
class StandardOutput : public std::streambuf {
 public:
  StandardOutput();
  ~StandardOutput() override;
  StandardOutput(const StandardOutput&) = delete;
  StandardOutput& operator=(const StandardOutput&) = delete;

  /// Writes what waits. If anything has been lost it says so on stderr.
  /// @return `code`, or 1 for 0 if anything has been lost
  int end(int code);

 protected:
  int_type overflow(int_type character) override;
  std::streamsize xsputn(const char* text, std::streamsize length) override;
  int sync() override;

 private:
  void write_out();
  std::array<char, 1 << 16> waiting_;
  std::streambuf* before_;
  bool terminal_;  ///< gets each line at once
  bool nobody_reads_ = false;
  int failure_ = 0;  ///< errno of the first refusal; 0: none
};

}  // namespace railwave
