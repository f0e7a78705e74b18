#pragma once

#include <string>
#include <vector>

namespace railwave::case_file {

/// Where something stands: a line of the case file, or an override. Line 0: the file as a whole.
struct Where {
  int line = 0;
  int override_number = 0;  ///< from 1, in the order in which overrides are given; 0: none
};

/// The mistakes found so far in one case file.
class Complaints {
 public:
  /// @param origins where each override stands, such as "study.toml:12"; those without are of the command line
  explicit Complaints(std::string file, std::vector<std::string> origins = {})
      : file_(std::move(file)), origins_(std::move(origins)) {}

  void add(Where where, const std::string& text);
  bool empty() const { return found_.empty(); }

  /// Throws InputError with one mistake a line, in the file's order, then those of the whole file, then those of
  /// overrides.
  void throw_if_any() const;

  /// The same lines, if not to be thrown: warnings.
  std::vector<std::string> lines() const;

 private:
  struct Complaint {
    Where where;
    std::string text;
  };
  std::string origin(const Where& where) const;
  std::string file_;
  std::vector<std::string> origins_;
  std::vector<Complaint> found_;
};

/// `text` fit to stand in one line of a message: control characters replaced, cut when very long.
std::string printable(const std::string& text, std::size_t longest = 80);

}  // namespace railwave::case_file
