#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/files/included_files.hpp"
#include "mesh/files/numbered_mesh.hpp"

namespace railwave {

/// A keyword line `*NAME, KEY=value, FLAG` with its continuation lines.
struct AbaqusKeyword {
  std::string name;                               ///< upper case, without blanks: "NODE", "ENDPART"
  std::map<std::string, std::string> parameters;  ///< keys in upper case; values as written, quotes taken off
  FilePlace place;

  bool has(const std::string& key) const { return parameters.count(key) > 0; }
  /// The value, in lower case: how names of sets are told apart.
  std::string value(const std::string& key) const;
};

/// The lines of an Abaqus input file and of the files that it includes, without comments and empty lines.
class AbaqusLines {
 public:
  /// Paths of the files opened are added to `files`, to which places refer.
  AbaqusLines(const std::string& path, std::vector<std::string>& files);

  /// True when a line is left.
  bool has_line() { return fill(); }
  bool has_keyword() { return fill() && current_[0] == '*'; }
  bool has_data() { return fill() && current_[0] != '*'; }

  AbaqusKeyword take_keyword();

  /// The comma-separated fields of a data line, each without blanks around it; a comma at the end adds no field.
  /// Valid until the next call of anything here.
  std::vector<std::string_view> take_fields();

  /// Place of the line taken last.
  const FilePlace& place() const { return place_; }

  /// Goes on with another file's lines, then returns to this one (*INCLUDE, and INPUT= of *NODE and *ELEMENT).
  void include(const AbaqusKeyword& keyword);

  std::string where(const FilePlace& place) const { return files_.where(place); }

 private:
  struct Source {
    std::string text;
    int file;
    std::size_t offset = 0;
    std::int64_t line = 0;
  };

  bool fill();        // brings up a line, inclusions done
  bool fill_plain();  // the same, where *INCLUDE is a line as any other
  void open(const std::string& path, const FilePlace* from);
  void drop_line() { filled_ = false; }
  AbaqusKeyword read_keyword();

  IncludedFiles files_;
  std::vector<std::unique_ptr<Source>> sources_;  // the innermost last
  std::string_view current_;
  FilePlace current_place_;
  FilePlace place_;
  bool filled_ = false;
};

}  // namespace railwave
