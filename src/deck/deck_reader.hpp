#pragma once

#include <string>
#include <vector>

#include "deck/deck.hpp"
#include "deck/report.hpp"
#include "mesh/files/dyna_card.hpp"

namespace railwave::deck {

/// Reads an LS-DYNA keyword deck and the files that it includes. What it leaves out goes into the report, and so does
/// what must not be left out, as a refusal. Throws InputError "file:line: what, how to mend" for what can't be read.
void read_deck(const std::string& path, Deck& deck, Report& report);

/// Makes a held hexahedron of each rigid wall, and a contact with it.
void make_walls(Deck& deck, Report& report);

struct Call;

/// What readers of keywords work on, and with.
class DeckReader {
 public:
  DeckReader(const std::string& path, Deck& deck, Report& report);
  void read();

  Deck& deck;
  Report& report;
  DynaLines lines;
  DynaParameters parameters{lines};
  DynaReading reading{lines, parameters};
  std::map<std::string, std::pair<Source, std::int64_t>> degenerate;  ///< kinds of solids that are no hexahedra

  [[noreturn]] void fail(const FilePlace& place, const std::string& text) const;

  /// The number of a thing in a field, with the offset of *INCLUDE_TRANSFORM; 0: none.
  Number number(const DynaCard& card, int field, const char* name, DynaScope::Kind kind,
                const DynaKeyword& keyword) const;
  /// Whether *INCLUDE_TRANSFORM moves what stands in a scope.
  bool is_transformed(int scope) const;
  Number offset(Number number, DynaScope::Kind kind, const DynaKeyword& keyword) const;

 private:
  void take(const DynaKeyword& keyword);
  void refuse_cards_left(Call& call);
  void include_transformed(const DynaKeyword& keyword);
  void transform_nodes();
  void refuse_degenerate();
};

/// The cards of a keyword, one after another.
class Cards {
 public:
  /// @param name of the keyword without _TITLE and _ID
  Cards(const DeckReader& reader, const DynaKeyword& keyword) : reader_(reader), keyword_(keyword) {}

  bool left() const { return at_ < keyword_.lines.size(); }

  bool next_begins_with(char c) const {
    return left() && !keyword_.lines[at_].text.empty() && keyword_.lines[at_].text[0] == c;
  }

  /// Passes over empty lines; whether there is another after them.
  bool more();

  /// Whether a line is left that is not empty, without passing over those before it: an empty line may be a card.
  bool any() const;

  /// Throws InputError when there is none left.
  DynaCard take();
  DynaCard take(std::initializer_list<DynaCard::Width> widths);

  /// The next line as text, "" when there is none.
  std::string title();

  Source source(const DynaCard& card) const { return {card.place(), keyword_.name}; }
  Source source() const { return {keyword_.place, keyword_.name}; }
  const DynaKeyword& keyword() const { return keyword_; }

 private:
  const DynaLine& line();
  const DeckReader& reader_;
  const DynaKeyword& keyword_;
  std::size_t at_ = 0;
};

/// A keyword's reader.
/// @param name without _TITLE and _ID, which `titled` stands for
struct Call {
  DeckReader& reader;
  Cards cards;
  std::string name;
  bool titled;

  /// Whether there is another thing of this keyword, which begins with its title if these have one; that may be empty.
  bool more() { return titled ? cards.any() : cards.more(); }

  Number number(const DynaCard& card, int field, const char* what, DynaScope::Kind kind) const {
    return reader.number(card, field, what, kind, cards.keyword());
  }
};
using Handler = void (*)(Call& call);
struct HandlerEntry {
  const char* name;
  Handler handler;
};

// The tables of keywords, by what they are about; each in the file of that name.
const std::vector<HandlerEntry>& mesh_handlers();
const std::vector<HandlerEntry>& part_handlers();
const std::vector<HandlerEntry>& set_handlers();
const std::vector<HandlerEntry>& definition_handlers();
const std::vector<HandlerEntry>& action_handlers();
const std::vector<HandlerEntry>& load_handlers();
const std::vector<HandlerEntry>& control_handlers();

/// Any *MAT_ and *CONTACT_ keyword.
void read_other_material(Call& call);
void read_contact(Call& call);

/// Whether leaving a keyword out changes nothing that is computed; and why, for the report.
bool is_harmless(const std::string& name, std::string& why);

}  // namespace railwave::deck
