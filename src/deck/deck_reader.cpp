#include "deck/deck_reader.hpp"

#include <fmt/format.h>

#include "case/error.hpp"
#include "mesh/files/text_file.hpp"
#include "mesh/vectors.hpp"

namespace railwave::deck {
namespace {

bool ends_in(const std::string& name, const std::string& ending) {
  return name.size() > ending.size() && name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
}

bool begins_with(const std::string& name, const char* beginning) { return name.rfind(beginning, 0) == 0; }

const std::map<std::string, Handler>& handlers() {
  static const std::map<std::string, Handler> all = [] {
    std::map<std::string, Handler> table;
    for (const auto* some : {&mesh_handlers(), &part_handlers(), &set_handlers(), &definition_handlers(),
                             &action_handlers(), &load_handlers(), &control_handlers()})
      for (const HandlerEntry& entry : *some) table.emplace(entry.name, entry.handler);
    return table;
  }();
  return all;
}

Handler handler_of(const std::string& name) {
  const auto found = handlers().find(name);
  if (found != handlers().end()) return found->second;
  if (begins_with(name, "CONTACT_") && !begins_with(name, "CONTACT_FORCE_TRANSDUCER")) return read_contact;
  if (begins_with(name, "MAT_") && !begins_with(name, "MAT_ADD_") && !begins_with(name, "MAT_THERMAL"))
    return read_other_material;
  return nullptr;
}

/// Keywords that hold directions or places besides those of nodes.
bool has_directions(const std::string& name) {
  for (const char* beginning :
       {"INITIAL_", "LOAD_", "BOUNDARY_SPC", "BOUNDARY_PRESCRIBED", "RIGIDWALL", "DEFINE_COORDINATE_SYSTEM",
        "DEFINE_COORDINATE_VECTOR", "DEFINE_VECTOR", "DEFINE_SD_ORIENTATION", "DEFINE_BOX"})
    if (begins_with(name, beginning)) return true;
  return false;
}

std::string unknown(const std::string& name) {
  if (begins_with(name, "ELEMENT_"))
    return "elements of this kind aren't read, only hexahedra (ELEMENT_SOLID), beams, discrete elements and point "
           "masses; model the part with these";
  if (begins_with(name, "RIGIDWALL"))
    return "rigid walls are read of RIGIDWALL_PLANAR, infinite and at rest; model others by hexahedra that a "
           "*BOUNDARY_SPC holds or a *BOUNDARY_PRESCRIBED_MOTION moves, and a contact";
  if (begins_with(name, "CONSTRAINED_NODAL_RIGID") || begins_with(name, "CONSTRAINED_EXTRA") ||
      begins_with(name, "CONSTRAINED_RIGID"))
    return "there are no rigid bodies here; tie the parts by *CONTACT_TIED, or make the rigid part of stiff hexahedra";
  return "this keyword isn't read, and may change what is computed";
}

}  // namespace

bool Cards::more() {
  while (left() && trim(keyword_.lines[at_].text).empty()) ++at_;
  return left();
}

bool Cards::any() const {
  for (std::size_t i = at_; i < keyword_.lines.size(); ++i)
    if (!trim(keyword_.lines[i].text).empty()) return true;
  return false;
}

const DynaLine& Cards::line() {
  if (!left())
    reader_.fail(keyword_.place, fmt::format("*{} ends after {} of its cards; complete it, the file may have been cut "
                                             "short",
                                             keyword_.name, at_));
  return keyword_.lines[at_++];
}

DynaCard Cards::take() {
  const DynaLine& next = line();
  return {reader_.reading, next, keyword_};
}

DynaCard Cards::take(std::initializer_list<DynaCard::Width> widths) {
  const DynaLine& next = line();
  return {reader_.reading, next, keyword_, widths};
}

std::string Cards::title() { return left() ? std::string(trim(keyword_.lines[at_++].text)) : std::string(); }

DeckReader::DeckReader(const std::string& path, Deck& into, Report& of_import)
    : deck(into), report(of_import), lines(path, into.mesh.files) {}

void DeckReader::fail(const FilePlace& place, const std::string& text) const {
  throw InputError(lines.where(place) + " " + text);
}

Number DeckReader::offset(Number number, DynaScope::Kind kind, const DynaKeyword& keyword) const {
  if (number == 0) return 0;
  const Number offset = lines.scopes()[keyword.scope].offset[kind];
  return number < 0 ? number - offset : number + offset;
}

Number DeckReader::number(const DynaCard& card, int field, const char* name, DynaScope::Kind kind,
                          const DynaKeyword& keyword) const {
  return offset(card.whole(field, name), kind, keyword);
}

void DeckReader::include_transformed(const DynaKeyword& keyword) {
  const auto names = dyna_file_names(keyword.lines, 1);
  if (names.empty()) fail(keyword.place, "*INCLUDE_TRANSFORM names no file; write it in the next line");
  // Cards behind the lines of the name: five of them.
  std::size_t at = 0;
  while (at < keyword.lines.size() && keyword.lines[at].place.position < names[0].second.position) ++at;
  while (at < keyword.lines.size()) {
    const auto text = trim(keyword.lines[at++].text);
    if (text.size() < 2 || text.substr(text.size() - 2) != " +") break;
  }
  const auto card = [&](std::size_t i) -> std::optional<DynaCard> {
    if (at + i >= keyword.lines.size()) return std::nullopt;
    return DynaCard(reading, keyword.lines[at + i], keyword);
  };
  DynaScope scope = lines.scopes()[keyword.scope];
  scope.parent = keyword.scope;
  scope.place = keyword.place;
  scope.transformation = 0;
  using Kind = DynaScope::Kind;
  if (const auto offsets = card(0)) {
    const Kind kinds[] = {Kind::node, Kind::element, Kind::part, Kind::material, Kind::set, Kind::curve, Kind::define};
    for (int i = 0; i < 7; ++i) scope.offset[kinds[i]] += offsets->whole(i, "offset");
  }
  if (const auto others = card(1)) scope.offset[Kind::other] += others->whole(0, "IDROFF");
  if (const auto factors = card(2))
    for (int i = 0; i < 3; ++i)
      if (factors->real(i, "factor", 1) != 1)
        fail(factors->place(),
             "factors of mass, time or length that convert an included file aren't read; convert the file to the "
             "deck's units");
  if (const auto last = card(3)) scope.transformation = number(*last, 0, "TRANID", Kind::define, keyword);
  if (const auto last = card(4); last && scope.transformation == 0)
    scope.transformation = number(*last, 0, "TRANID", Kind::define, keyword);
  for (const std::int64_t offset : scope.offset)
    if (offset > largest_dyna_number || offset < -largest_dyna_number)
      fail(keyword.place, fmt::format("the offsets add up to {}, at most {} is read; choose smaller ones", offset,
                                      largest_dyna_number));
  report.add(Fate::taken, {keyword.place, keyword.name}, fmt::format("file {}", names[0].first));
  lines.include(names, lines.add_scope(scope));
}

bool DeckReader::is_transformed(int scope) const {
  for (int at = scope; at >= 0; at = lines.scopes()[at].parent)
    if (lines.scopes()[at].transformation != 0) return true;
  return false;
}

void DeckReader::take(const DynaKeyword& keyword) {
  const Source source{keyword.place, keyword.name};
  if (parameters.take(keyword)) return report.add(Fate::taken, source, "where fields name them");
  if (report.drops(keyword.name))
    return report.add(Fate::dropped, source, fmt::format("as --drop asks, {} lines", keyword.lines.size()));
  if (keyword.name == "INCLUDE_TRANSFORM") return include_transformed(keyword);
  if (is_transformed(keyword.scope) && has_directions(keyword.name))
    report.refuse(source, "INCLUDE_TRANSFORM." + keyword.name,
                  "directions and places in a file that *INCLUDE_TRANSFORM moves aren't moved with its nodes; put this "
                  "keyword into the deck itself");
  Call call{*this, {*this, keyword}, keyword.name, false};
  Handler handler = handler_of(call.name);
  for (const char* option : {"_TITLE", "_ID"})
    if (ends_in(keyword.name, option) && handlers().count(keyword.name) == 0) {
      call.name = keyword.name.substr(0, keyword.name.size() - std::string(option).size());
      call.titled = true;
      handler = handler_of(call.name);
      break;
    }
  if (handler != nullptr) {
    report.add_block(source, keyword.lines.empty() ? keyword.place.position : keyword.lines.back().place.position);
    handler(call);
    return refuse_cards_left(call);
  }
  std::string why;
  if (is_harmless(call.name, why)) return report.add(Fate::dropped, source, why);
  report.refuse(source, keyword.name, unknown(keyword.name));
}

void DeckReader::refuse_cards_left(Call& call) {
  if (!call.cards.more()) return;
  // Of these the further cards are optional and only say how LS-DYNA computes or writes, or the whole is refused.
  for (const char* beginning : {"CONTACT_", "CONTROL_", "DATABASE_", "MAT_", "SECTION_", "TITLE", "KEYWORD"})
    if (begins_with(call.name, beginning)) return;
  const DynaCard card = call.cards.take();
  report.refuse_always(call.cards.source(card),
                       "this card is one more than the keyword has, so that those before may not be what they are "
                       "meant as (an empty line counts as a card); give each thing its own keyword");
}

void DeckReader::transform_nodes() {
  // Nodes are moved when all transformations are known, from the innermost file outwards.
  std::vector<std::vector<const Transformation*>> chains;
  for (const DynaScope& scope : lines.scopes()) {
    std::vector<const Transformation*> chain;
    for (const DynaScope* at = &scope;; at = &lines.scopes()[at->parent]) {
      if (at->transformation != 0) {
        const auto found = deck.transformations.find(at->transformation);
        if (found == deck.transformations.end())
          fail(at->place, fmt::format("the deck has no *DEFINE_TRANSFORMATION {}; define it, or mend the number",
                                      at->transformation));
        chain.push_back(&found->second);
        report.use(found->second.source, "nodes of *INCLUDE_TRANSFORM");
      }
      if (at->parent < 0) break;
    }
    chains.push_back(chain);
  }
  deck.mesh.move_nodes([&](std::size_t i, const Vec3& place) {
    Vec3 x = place;
    for (const Transformation* change : chains[deck.node_scopes[i]]) {
      Vec3 y = change->shift;
      for (int r = 0; r < 3; ++r) y[r] += dot(change->matrix[r], x);
      x = y;
    }
    return x;
  });
}

void DeckReader::refuse_degenerate() {
  for (const auto& [kind, first] : degenerate)
    report.refuse_always(first.first,
                         fmt::format("{}: {}, of which this is the first; solids here are hexahedra of eight "
                                     "nodes: mesh the part with these",
                                     kind, first.second));
}

void DeckReader::read() {
  while (const auto keyword = lines.next()) take(*keyword);
  refuse_degenerate();
  transform_nodes();
}

void read_deck(const std::string& path, Deck& deck, Report& report) { DeckReader(path, deck, report).read(); }

}  // namespace railwave::deck
