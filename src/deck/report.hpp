#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "deck/deck.hpp"

namespace railwave::deck {

/// What became of a keyword or of something in it.
enum class Fate { taken, replaced, dropped };

/// What an import made of a deck, line by line; and what it cannot take, unless --drop has that left out.
class Report {
 public:
  /// @param drop keywords ("MAT_ADD_EROSION") and their parts ("CONTACT.BT") that are to be left out; a word that ends
  /// in * stands for all that begin so
  explicit Report(const std::vector<std::string>& drop);

  void add(Fate fate, const Source& source, const std::string& text);

  /// A reason not to import the deck; when `key` is to be dropped, a line of the report instead.
  /// @return whether it is dropped
  bool refuse(const Source& source, const std::string& key, const std::string& text);

  /// A reason that --drop does not take away.
  void refuse_always(const Source& source, const std::string& text);

  /// Whether --drop has the keyword left out; notes that it was there.
  bool drops(const std::string& key);

  /// Throws InputError with all reasons, first come first, if there are any.
  /// @param files paths of the deck's files
  void check(const std::vector<std::string>& files) const;

  /// Words of --drop that met nothing.
  std::vector<std::string> unused_drops() const;

  /// The report by file and line, as text.
  std::string text(const std::vector<std::string>& files) const;

  std::size_t count(Fate fate) const;

  /// The same of a thing that is used, if nothing has been said of it.
  void use(const Source& source, const std::string& text);

  /// A keyword with its cards, of which the report is to say something.
  void add_block(const Source& source, std::int64_t last_line) { blocks_.push_back({source, last_line}); }

  /// Says of each block of which nothing has been said that nothing uses it.
  void close();

 private:
  struct Block {
    Source source;
    std::int64_t last_line;
  };
  struct Entry {
    Fate fate;
    Source source;
    std::string text;
  };
  struct Refusal {
    Source source;
    std::string text;
  };
  std::vector<std::pair<std::string, bool>> drop_;  // word, whether it met something
  std::vector<Entry> entries_;
  std::vector<Refusal> refusals_;
  std::size_t more_entries_ = 0, more_refusals_ = 0;  // that are only counted
  std::vector<Block> blocks_;
  std::set<std::pair<int, std::int64_t>> places_;  // file and line of the entries
};

}  // namespace railwave::deck
