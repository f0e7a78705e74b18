#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include <fmt/format.h>

#include "case/error.hpp"
#include "case/number_text.hpp"
#include "case/read_case.hpp"
#include "case/suggest.hpp"
#include "mesh/mesh_memory.hpp"
#include "output/run_places.hpp"
#include "sweep/member_inputs.hpp"
#include "sweep/overrides_of_members.hpp"
#include "sweep/study.hpp"

namespace railwave::sweep {
namespace {

namespace fs = std::filesystem;
using case_file::Complaints;
using case_file::Node;
using case_file::printable;
using Type = Node::Type;

constexpr double most_members = 1e5;
/// On the host, of processes of the program: what it takes without elements, and for each. 87 MB were measured of the
/// 11 thousand elements of cases/first_steps.toml, which settle by Newton's method; others take less an element.
constexpr double bytes_of_program = 30e6, bytes_of_element = 6000;

/// Keys that the sweep gives each member itself.
const std::vector<std::string> own_keys = {"output.file", "checkpoint.file", "settle.cache_folder",
                                           "settle.keep_unsettled"};

void read_text(const Node& study, const char* name, std::string& text, Complaints& complaints) {
  const Node* node = study.find(name);
  if (!node) return;
  if (node->type != Type::text || node->text.empty())
    complaints.add(node->where, std::string(name) + ": is " + node->described() + ", must be text in quotes");
  else
    text = node->text;
}

void read_count(const Node& table, const char* name, int least, int& count, const std::string& subject,
                Complaints& complaints) {
  constexpr int most = 1000;
  const Node* node = table.find(name);
  if (!node) return;
  if (node->type != Type::integer || node->integer < least || node->integer > most)
    complaints.add(node->where, fmt::format("{}{}: must be a whole number from {} to {}", subject, name, least, most));
  else
    count = static_cast<int>(node->integer);
}

void read_slurm(const Node& node, SlurmChoice& slurm, Complaints& complaints) {
  if (node.type != Type::table) return complaints.add(node.where, "[slurm]: must be a section");
  expect_keys(node, "[slurm]", {"cpus_per_job", "options"}, complaints);
  read_count(node, "cpus_per_job", 1, slurm.cpus_per_job, "[slurm] ", complaints);
  const Node* options = node.find("options");
  if (!options) return;
  if (options->type != Type::list)
    return complaints.add(options->where, "[slurm] options: must be a list, such as [\"--time=2:00:00\"]");
  for (const Node& one : options->children) {
    if (one.type != Type::text || one.text.rfind("--", 0) != 0 || one.text.find('\n') != std::string::npos)
      complaints.add(one.where, "[slurm] options: each must be an option of sbatch, such as \"--time=2:00:00\"");
    slurm.options.push_back(one.text);
  }
}

void refuse_own_keys(const std::vector<Overrides>& entries, Complaints& complaints) {
  std::set<std::string> refused;
  for (const Overrides& entry : entries)
    for (const Override& one : entry)
      if (std::find(own_keys.begin(), own_keys.end(), one.key) != own_keys.end() && refused.insert(one.key).second)
        complaints.add(one.value.where, one.key + ": the sweep gives each member files of its own; leave this key out");
}

/// Without ending; the folder of the results of a case of that name would be the same.
std::string usual_folder(const std::string& study_path) { return default_results_folder(study_path); }

/// What a case says; a text without letters where it says nothing.
Node value_in_case(const Node& root, const std::string& key) {
  Node nothing;
  nothing.type = Type::text;
  std::string name = key;
  std::optional<std::int64_t> index;
  if (const auto open = key.find('['); open != std::string::npos && key.back() == ']') {
    index = parse_integer(key.substr(open + 1, key.size() - open - 2));
    name = key.substr(0, open);
  }
  const Node* at = &root;
  for (std::size_t begin = 0; at && begin <= name.size();) {
    const auto dot = std::min(name.find('.', begin), name.size());
    at = at->type == Type::table ? at->find(name.substr(begin, dot - begin)) : nullptr;
    begin = dot + 1;
  }
  if (at && index)
    at = at->type == Type::list && *index >= 0 && *index < static_cast<std::int64_t>(at->children.size())
             ? &at->children[static_cast<std::size_t>(*index)]
             : nullptr;
  return at && at->type != Type::table ? *at : nothing;
}

std::string bare_text(const Node& value) { return value.type == Type::text ? value.text : case_file::toml_text(value); }

std::string called(const std::vector<Parameter>& parameters, const std::vector<Node>& values) {
  std::string text;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const std::string& key = parameters[p].key;
    const auto dot = key.rfind('.');
    text += (p == 0 ? "" : ", ") + (dot == std::string::npos ? key : key.substr(dot + 1)) + '=' +
            (bare_text(values[p]).empty() ? "as in the case" : bare_text(values[p]));
  }
  return text.empty() ? "the case as it is" : text;
}

/// Fit for a folder's name, and not too long.
std::string folder_name(const std::string& text) {
  constexpr std::size_t longest = 60;
  std::string name;
  for (const char c : text) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '=' || c == '-' || c == '_';
    if (plain)
      name += c;
    else if (!name.empty() && name.back() != '_' && c == ' ')
      name += '_';
  }
  return name.substr(0, longest);
}

void make_members(const Node& study, Study& result, Complaints& complaints) {
  const MemberSources sources = read_member_sources(study, result.path, complaints);
  Overrides common;
  if (const Node* node = study.find("common")) common = keys_of(*node, result.path);
  refuse_own_keys({common}, complaints);
  for (const auto* entries : {&sources.list, &sources.rows, &sources.grid}) refuse_own_keys(*entries, complaints);
  complaints.throw_if_any();

  Complaints of_case(result.case_file);
  const case_file::Document document = case_file::parse_document(case_file::load_text(result.case_file), of_case);
  of_case.throw_if_any();
  for (const std::string& key : keys_of(sources)) result.parameters.push_back({key, unit_of_key(key)});
  MemberHash hash;
  std::map<std::string, int> numbers;
  for (const Overrides& own : combinations(sources, most_members)) {
    Member member;
    member.number = static_cast<int>(result.members.size()) + 1;
    std::vector<std::string> origins;
    for (const Overrides* all : {static_cast<const Overrides*>(&common), &own})
      for (const Override& one : *all) {
        member.overrides.push_back(one.key + '=' + case_file::toml_text(one.value));
        origins.push_back(one.origin);
      }
    const Node root = with_overrides(document.root, member.overrides);
    for (const Parameter& parameter : result.parameters) member.values.push_back(value_in_case(root, parameter.key));
    member.called = called(result.parameters, member.values);
    scene::Scene scene;
    try {
      scene = read_case(result.case_file, member.overrides, nullptr, origins);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: member {} ({}):\n{}", result.path, member.number, member.called, error.what()));
    }
    check_figures(result.figures, scene, complaints);
    if (!complaints.empty() && member.number > 1)
      complaints.add({}, fmt::format("these are mistakes of member {} ({}) and not of those before it", member.number,
                                     member.called));
    complaints.throw_if_any();
    member.memory = bytes_of_program + bytes_of_element * expected_elements(scene);
    member.settles = scene.settle.active;
    for (const InputFile& file : input_files(scene))
      if (file.path != scene.path) member.files.push_back(file.path);
    member.hash = hash.of(root, member.files);
    if (const auto [twin, is_new] = numbers.emplace(member.hash, member.number); !is_new)
      throw InputError(fmt::format("{}: members {} and {} are the same case ({}); leave one of them out", result.path,
                                   twin->second, member.number, member.called));
    member.folder =
        fmt::format("{}/members/{}-{}", result.folder, folder_name(member.called), member.hash.substr(0, 12));
    if (result.figures.figures.empty()) {
      std::vector<std::string> contacts;
      for (const auto& contact : scene.contacts) contacts.push_back(contact.name);
      result.figures.figures = usual_figures(contacts);
    }
    result.members.push_back(std::move(member));
  }
}

}  // namespace

Study read_study(const std::string& path) {
  Complaints complaints(path);
  const case_file::Document document = case_file::parse_document(case_file::load_text(path), complaints);
  if (!document.usable) complaints.throw_if_any();
  const Node& root = document.root;
  const std::vector<std::string> known = {"title", "case", "folder",  "retries", "keep_results", "table", "common",
                                          "grid",  "list", "figures", "patches", "modes",        "slurm"};
  expect_keys(root, "", known, complaints);
  Study study;
  study.path = path;
  read_text(root, "title", study.title, complaints);
  read_text(root, "case", study.case_file, complaints);
  study.folder = usual_folder(path);
  read_text(root, "folder", study.folder, complaints);
  read_count(root, "retries", 0, study.retries, "", complaints);
  if (const Node* keep = root.find("keep_results")) {
    if (keep->type != Type::boolean) complaints.add(keep->where, "keep_results: must be true or false");
    study.keep_results = keep->boolean;
  }
  if (const Node* common = root.find("common"); common && common->type != Type::table)
    complaints.add(common->where, "[common]: must be a section with the keys that all members have");
  if (const Node* slurm = root.find("slurm")) read_slurm(*slurm, study.slurm, complaints);
  study.figures = read_figures(root, complaints);
  if (study.case_file.empty() && !root.find("case"))
    complaints.add({}, "case: is missing; name the case file that all members have, such as case = \"rolling.toml\"");
  complaints.throw_if_any();
  const std::string folder = fs::path(path).parent_path().string();
  if (fs::path(study.case_file).is_relative()) study.case_file = (fs::path(folder) / study.case_file).string();
  make_members(root, study, complaints);
  return study;
}

std::vector<const Member*> chosen_members(const Study& study, const std::string& words) {
  const auto refuse = [&](const std::string& why) {
    throw InputError(fmt::format("--members {}: {}; numbers and ranges from 1 to {} are wanted, such as 3,17-20",
                                 printable(words), why, study.members.size()));
  };
  std::set<std::int64_t> numbers;
  for (std::size_t at = 0; at <= words.size();) {
    const auto comma = std::min(words.find(',', at), words.size());
    const std::string word = words.substr(at, comma - at);
    const auto dash = word.find('-');
    const auto first = parse_integer(word.substr(0, dash));
    const auto last = dash == std::string::npos ? first : parse_integer(word.substr(dash + 1));
    if (!first || !last) refuse("'" + printable(word) + "' is no number");
    if (*first < 1 || *last > static_cast<std::int64_t>(study.members.size()) || *first > *last)
      refuse(fmt::format("the study has no members {}", printable(word)));
    for (std::int64_t n = *first; n <= *last; ++n) numbers.insert(n);
    at = comma + 1;
  }
  std::vector<const Member*> members;
  for (const std::int64_t n : numbers) members.push_back(&study.members[static_cast<std::size_t>(n - 1)]);
  return members;
}

std::vector<const Member*> share_of_job(const Study& study, int index, int count) {
  if (index < 1 || index > count)
    throw InputError(fmt::format("--job {}/{}: the first number must be from 1 to the second", index, count));
  std::vector<const Member*> members;
  for (const Member& member : study.members)
    if ((member.number - 1) % count == index - 1) members.push_back(&member);
  return members;
}

}  // namespace railwave::sweep
