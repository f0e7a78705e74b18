#include "deck/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "case/error.hpp"

namespace railwave::deck {
namespace {

constexpr std::size_t most_refusals = 20;
// No deck of people has as many; what has more is only counted.
constexpr std::size_t most_entries = 200000, most_kept_refusals = 10000;

const char* called(Fate fate) {
  return fate == Fate::taken ? "taken" : fate == Fate::replaced ? "replaced" : "dropped";
}

std::string upper_case(std::string text) {
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return text;
}

bool stands_for(const std::string& word, const std::string& key) {
  if (!word.empty() && word.back() == '*') return key.compare(0, word.size() - 1, word, 0, word.size() - 1) == 0;
  // A keyword stands for all that is in it.
  return key == word || key.compare(0, word.size() + 1, word + ".") == 0;
}

}  // namespace

Report::Report(const std::vector<std::string>& drop) {
  for (const std::string& word : drop) {
    std::string name = upper_case(word);
    if (!name.empty() && name[0] == '*') name.erase(0, 1);
    drop_.emplace_back(name, false);
  }
}

void Report::add(Fate fate, const Source& source, const std::string& text) {
  // Several parts of one section say the same of it.
  for (auto entry = entries_.rbegin(); entry != entries_.rend() && entry - entries_.rbegin() < 50; ++entry)
    if (entry->source.place.file == source.place.file && entry->source.place.position == source.place.position &&
        entry->text == text)
      return;
  if (entries_.size() == most_entries) {
    ++more_entries_;
    return;
  }
  entries_.push_back({fate, source, text});
  places_.insert({source.place.file, source.place.position});
}

void Report::use(const Source& source, const std::string& text) {
  if (places_.count({source.place.file, source.place.position}) == 0) add(Fate::taken, source, text);
}

void Report::close() {
  if (more_entries_ > 0) return;
  for (const Block& block : blocks_) {
    const auto first = places_.lower_bound({block.source.place.file, block.source.place.position});
    if (first == places_.end() || *first > std::make_pair(block.source.place.file, block.last_line))
      add(Fate::dropped, block.source, "nothing that is taken uses it");
  }
}

bool Report::drops(const std::string& key) {
  bool any = false;
  for (auto& [word, met] : drop_)
    if (!word.empty() && stands_for(word, key)) any = met = true;
  return any;
}

bool Report::refuse(const Source& source, const std::string& key, const std::string& text) {
  if (drops(key)) {
    add(Fate::dropped, source, "as --drop asks, though " + text);
    return true;
  }
  refuse_always(source, fmt::format("{}; mend the deck, or leave that out by --drop {}", text, key));
  return false;
}

void Report::refuse_always(const Source& source, const std::string& text) {
  if (refusals_.size() == most_kept_refusals)
    ++more_refusals_;
  else
    refusals_.push_back({source, text});
}

void Report::check(const std::vector<std::string>& files) const {
  if (refusals_.empty()) return;
  // One line for all of a kind, with the place of the first.
  std::map<std::string, std::size_t> known;
  std::vector<std::string> lines;
  std::vector<std::size_t> more;
  for (const Refusal& refusal : refusals_) {
    const std::string text = fmt::format("*{}: {}", refusal.source.keyword, refusal.text);
    const auto [entry, is_new] = known.emplace(text, lines.size());
    if (!is_new) {
      ++more[entry->second];
      continue;
    }
    lines.push_back(fmt::format("{}:{}: {}", files[refusal.source.place.file], refusal.source.place.position, text));
    more.push_back(0);
  }
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (more[i] > 0) lines[i] += fmt::format(" (and {} more like it)", more[i]);
  if (lines.size() > most_refusals || more_refusals_ > 0) {
    const std::size_t kept = std::min(lines.size(), most_refusals), rest = lines.size() - kept + more_refusals_;
    lines.resize(kept);
    lines.push_back(fmt::format("and {} more; nothing was written", rest));
  }
  throw InputError(lines);
}

std::vector<std::string> Report::unused_drops() const {
  std::vector<std::string> words;
  for (const auto& [word, met] : drop_)
    if (!met) words.push_back(word);
  return words;
}

std::size_t Report::count(Fate fate) const {
  return static_cast<std::size_t>(
      std::count_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.fate == fate; }));
}

std::string Report::text(const std::vector<std::string>& files) const {
  std::vector<const Entry*> ordered;
  for (const Entry& entry : entries_) ordered.push_back(&entry);
  std::stable_sort(ordered.begin(), ordered.end(), [](const Entry* a, const Entry* b) {
    return std::make_tuple(a->source.place.file, a->source.place.position) <
           std::make_tuple(b->source.place.file, b->source.place.position);
  });
  std::string text;
  for (const Entry* entry : ordered)
    text += fmt::format("{}:{}: *{}: {}: {}\n", files[entry->source.place.file], entry->source.place.position,
                        entry->source.keyword, called(entry->fate), entry->text);
  if (more_entries_ > 0) text += fmt::format("and {} more\n", more_entries_);
  return text;
}

}  // namespace railwave::deck
