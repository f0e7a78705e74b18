#include "sweep/member_row.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <limits>

#include <fmt/format.h>

#include "case/document.hpp"
#include "case/error.hpp"
#include "output/atomic_file.hpp"
#include "output/disk.hpp"
#include "output/file_kind.hpp"

namespace railwave::sweep {
namespace {

using case_file::Node;
using case_file::toml_text;

constexpr const char* row_mark = "# Railwave sweep: a member's row";
constexpr int statuses = sizeof status_names / sizeof *status_names;

FileKind row_kind() { return {FileKind::Form::text, "the row of a member of a sweep", row_mark, ""}; }

double number_of(const Node* node) {
  return node && node->is_number() ? node->number : std::numeric_limits<double>::quiet_NaN();
}

std::string text_of(const Node* node) { return node ? node->text : ""; }

}  // namespace

std::string quoted(const std::string& text) {
  Node node;
  node.type = Node::Type::text;
  node.text = text;
  return toml_text(node);
}

void write_row(const Member& member, const MemberRow& row) {
  std::string text = std::string(row_mark) + '\n';
  text +=
      fmt::format("status = {}\nreason = {}\n", quoted(status_names[static_cast<int>(row.status)]), quoted(row.reason));
  text += fmt::format("figures_key = {}\nfigures = [\n", quoted(row.figures_key));
  for (const FigureValue& one : row.figures)
    text += fmt::format("  [{}, {}, {}],\n", quoted(one.name),
                        std::isnan(one.value) ? "nan" : fmt::format("{:.17e}", one.value), quoted(one.unit));
  text += "]\nend = true\n";
  const std::string path = MemberFiles(member).row();
  write_whole_file(path, text, row_kind());
  disk::bring_to_disk(path);
}

std::optional<MemberRow> read_row(const Member& member) try {
  const std::string path = MemberFiles(member).row();
  std::error_code failed;
  if (!std::filesystem::is_regular_file(path, failed)) return std::nullopt;
  case_file::Complaints complaints(path);
  const case_file::Document document = case_file::parse_document(case_file::load_text(path), complaints);
  const Node& root = document.root;
  const Node* figures = root.find("figures");
  if (!document.usable || !document.complete || !root.find("end") || !figures) return std::nullopt;
  MemberRow row;
  for (int s = 0; s < statuses; ++s)
    if (text_of(root.find("status")) == status_names[s]) row.status = static_cast<Status>(s);
  row.reason = text_of(root.find("reason"));
  row.figures_key = text_of(root.find("figures_key"));
  for (const Node& one : figures->children) {
    if (one.children.size() != 3) return std::nullopt;
    row.figures.push_back({one.children[0].text, one.children[2].text, number_of(&one.children[1])});
  }
  if (!row.final()) return std::nullopt;
  return row;
} catch (const InputError&) {
  return std::nullopt;
}

bool is_done(const Study& study, const Member& member) {
  const auto row = read_row(member);
  return row && (row->status == Status::broke_down || row->figures_key == study.figures.key());
}

std::string in_the_way_of_row(const Member& member) {
  const std::string path = MemberFiles(member).row();
  std::error_code failed;
  if (!std::filesystem::exists(path, failed) || is_of_kind(path, row_kind())) return {};
  return fmt::format("{} is {}, not the row of a member; move it away", path, seems_to_be(path));
}

void note_attempt(const Member& member, const std::string& what) {
  char host[256] = "";
  gethostname(host, sizeof host - 1);
  const std::time_t now = std::time(nullptr);
  char when[32] = "";
  std::tm parts{};
  std::strftime(when, sizeof when, "%Y-%m-%dT%H:%M:%SZ", gmtime_r(&now, &parts));
  std::string line;
  for (const char c : fmt::format("{} {} {}: {}", when, host, getpid(), what)) line += c == '\n' ? ' ' : c;
  line += '\n';
  // One call of the system, so that a kill leaves a whole line or none.
  const disk::Descriptor file(
      open(MemberFiles(member).attempts().c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
  if (file.get() < 0 || write(file.get(), line.data(), line.size()) != static_cast<ssize_t>(line.size()))
    throw std::runtime_error(fmt::format("cannot write {}: {}", MemberFiles(member).attempts(), disk::reason()));
}

std::string last_attempt(const Member& member) {
  std::ifstream file(MemberFiles(member).attempts());
  std::string last;
  for (std::string line; std::getline(file, line);)
    if (!line.empty()) last = line;
  const auto colon = last.find(": ");
  return colon == std::string::npos ? last : last.substr(colon + 2);
}

}  // namespace railwave::sweep
