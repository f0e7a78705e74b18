#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/files/included_files.hpp"
#include "mesh/files/numbered_mesh.hpp"

/// The lines of an LS-DYNA keyword deck. Format: LS-DYNA Keyword User's Manual, volume I, "Getting started" and
/// *INCLUDE [LSTC 2021].
namespace railwave {

struct DynaLine {
  std::string_view text;  ///< without the line's end; valid as long as the DynaLines
  FilePlace place;
};

/// How wide the fields of a keyword's cards are, unless they are separated by commas.
enum class DynaFormat {
  standard,  ///< as each card has it
  ten,       ///< whole numbers of eight columns have ten (I10=Y, or "%" behind the keyword)
  twenty     ///< all fields have twenty columns (LONG=Y, or "+" behind the keyword)
};

/// A keyword with its data lines, comments left out. Empty lines count: they are cards without entries.
struct DynaKeyword {
  std::string name;  ///< upper case, without *: "ELEMENT_SOLID"
  FilePlace place;
  DynaFormat format = DynaFormat::standard;
  int scope = 0;  ///< position in DynaLines::scopes()
  std::vector<DynaLine> lines;
};

/// What *INCLUDE_TRANSFORM does to the numbers in a file. Offsets hold those of the files around it too.
struct DynaScope {
  enum Kind { node, element, part, material, set, curve, define, other, kinds };
  int parent = -1;                           ///< the scope around it
  std::array<std::int64_t, kinds> offset{};  ///< added to numbers, by Kind
  std::int64_t transformation = 0;           ///< number of a *DEFINE_TRANSFORMATION of the parent's; 0: none
  FilePlace place;                           ///< of the *INCLUDE_TRANSFORM
};

/// The keywords of a deck and of the files that it includes, in the order in which LS-DYNA reads them.
class DynaLines {
 public:
  /// Paths of the files opened are added to `files`, to which places refer.
  DynaLines(const std::string& path, std::vector<std::string>& files);

  /// The next keyword; nothing at the deck's end. Inclusions are done here.
  std::optional<DynaKeyword> next();

  const std::vector<DynaScope>& scopes() const { return scopes_; }

  /// The file that included a file; -1: none.
  int includer(int file) const { return files_.includer(file); }

  /// "path:line:".
  std::string where(const FilePlace& place) const { return files_.where(place); }

  /// Goes on with the files of an *INCLUDE or *INCLUDE_TRANSFORM, then returns to this one.
  /// @param scope of what they hold
  void include(const std::vector<std::pair<std::string, FilePlace>>& names, int scope);
  int add_scope(const DynaScope& scope);
  void add_folder(const std::string& folder) { folders_.push_back(folder); }

 private:
  struct Source {
    std::string_view text;
    int file;
    int scope;
    DynaFormat format;  // what keywords have that say nothing else
    std::size_t offset = 0;
    std::int64_t line = 0;
  };

  void open(const std::string& path, const FilePlace* from, int scope);
  std::string find(const std::string& name, const FilePlace& from) const;
  bool fill();
  void check_text(std::string_view line) const;
  DynaKeyword read_keyword();
  void set_format(DynaKeyword& keyword, std::string_view rest);
  void obey_include(const DynaKeyword& keyword);

  IncludedFiles files_;
  std::vector<std::unique_ptr<std::string>> texts_;
  std::vector<Source> sources_;  // the innermost last
  std::vector<DynaScope> scopes_{1};
  std::vector<std::string> folders_;
  std::string_view current_;
  FilePlace current_place_;
  bool filled_ = false;
};

/// File names of an *INCLUDE's lines: one each, continued where a line ends in " +".
std::vector<std::pair<std::string, FilePlace>> dyna_file_names(const std::vector<DynaLine>& lines, std::size_t most);

}  // namespace railwave
