#include <algorithm>

#include "case/suggest.hpp"
#include "sweep/figure.hpp"

namespace railwave::sweep {
namespace {

using case_file::Complaints;
using case_file::Node;
using case_file::printable;
using Type = Node::Type;

constexpr const char* letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";

void read_number(const Node& table, const char* name, const std::string& subject, double& number,
                 Complaints& complaints) {
  const Node* node = table.find(name);
  if (!node) return;
  if (node->is_number())
    number = node->number;
  else
    complaints.add(node->where, subject + ' ' + name + ": is " + node->described() + ", must be a number");
}

void read_take(const Node& node, const std::string& subject, Figure& figure, Complaints& complaints) {
  const auto& names = take_names();
  const auto found = std::find(names.begin(), names.end(), node.text);
  if (node.type != Type::text || found == names.end())
    complaints.add(node.where,
                   subject + " take: there is no '" + printable(node.text) + "'; " + suggestion(node.text, names));
  else
    figure.take = static_cast<Take>(found - names.begin());
}

void read_figure(const Node& node, FigureChoice& choice, Complaints& complaints) {
  Figure figure;
  figure.name = node.name;
  figure.where = node.where;
  const std::string subject = "[figures] " + printable(node.name);
  if (node.name.empty() || node.name.find_first_not_of(letters) != std::string::npos)
    complaints.add(node.where, subject + ": the name may only have letters a-z, digits, '_' and '-'");
  for (const char* column : {"status", "reason"})
    if (node.name == column)
      complaints.add(node.where, subject + ": the table has a column of that name; choose another");
  const Node* source = node.type == Type::table ? node.find("of") : &node;
  if (!source || source->type != Type::text)
    return complaints.add(node.where, subject +
                                          ": must be what is collected, such as \"patch.tread.area\", or {of = "
                                          "\"contact.tread.normal_force.z\", take = \"maximum\"}");
  if (node.type == Type::table) {
    expect_keys(node, subject, {"of", "take", "from", "to", "low", "high"}, complaints);
    if (const Node* take = node.find("take")) read_take(*take, subject, figure, complaints);
    read_number(node, "from", subject, figure.from, complaints);
    read_number(node, "to", subject, figure.to, complaints);
    read_number(node, "low", subject, figure.low, complaints);
    read_number(node, "high", subject, figure.high, complaints);
    if (!(figure.from <= figure.to)) complaints.add(node.where, subject + ": from is after to");
    if (!(figure.low < figure.high)) complaints.add(node.where, subject + ": low must be below high");
  }
  if (const std::string mistake = read_source(source->text, figure); !mistake.empty())
    complaints.add(source->where, subject + ": '" + printable(source->text) + "': " + mistake);
  if (figure.take == Take::frequency && figure.source != Figure::Source::history)
    complaints.add(node.where, subject + ": take = \"frequency\" is of a history, which has many values");
  choice.figures.push_back(figure);
}

void read_patches(const Node& node, ContactRequest& request, Complaints& complaints) {
  expect_keys(node, "[patches]", {"rolling_direction", "axle", "rolling_velocity"}, complaints);
  if (const Node* direction = node.find("rolling_direction")) {
    const bool good = direction->type == Type::list && direction->children.size() == 3 &&
                      std::all_of(direction->children.begin(), direction->children.end(),
                                  [](const Node& one) { return one.is_number(); });
    if (!good)
      complaints.add(direction->where, "[patches] rolling_direction: must be three numbers, such as [1, 0, 0]");
    else
      for (std::size_t i = 0; i < 3; ++i) request.rolling_direction[i] = direction->children[i].number;
    const auto& d = request.rolling_direction;
    if (!(d[0] * d[0] + d[1] * d[1] + d[2] * d[2] > 0))
      complaints.add(direction->where, "[patches] rolling_direction: must not be zero");
  }
  if (const Node* axle = node.find("axle")) {
    if (axle->type != Type::text || axle->text.empty())
      complaints.add(axle->where, "[patches] axle: must be a history set, such as \"wheel.bore\"");
    request.axle = axle->text;
  }
  if (const Node* velocity = node.find("rolling_velocity")) {
    if (!velocity->is_number() || !(velocity->number > 0))
      complaints.add(velocity->where, "[patches] rolling_velocity: must be a number in m/s above 0");
    request.rolling_velocity = velocity->number;
    if (request.axle)
      complaints.add(velocity->where, "[patches]: axle and rolling_velocity exclude each other; keep one of them");
  }
}

void read_modes(const Node& node, FigureChoice& choice, Complaints& complaints) {
  expect_keys(node, "[modes]", {"parts", "up_to"}, complaints);
  read_number(node, "up_to", "[modes]", choice.modes_up_to, complaints);
  if (!(choice.modes_up_to > 0)) complaints.add(node.where, "[modes] up_to: must be above 0 Hz");
  if (const Node* parts = node.find("parts")) {
    if (parts->type != Type::list) complaints.add(parts->where, "[modes] parts: must be a list of names");
    for (const Node& part : parts->children) {
      if (part.type != Type::text) complaints.add(part.where, "[modes] parts: must be a list of names");
      choice.modes_parts.push_back(part.text);
    }
  }
}

/// A section of the study that is a table; complains about anything else.
const Node* section(const Node& study, const char* name, Complaints& complaints) {
  const Node* node = study.find(name);
  if (!node || node->type == Type::table) return node;
  complaints.add(node->where, std::string("[") + name + "]: is " + node->described() + ", must be a section");
  return nullptr;
}

}  // namespace

void expect_keys(const Node& table, const std::string& subject, const std::vector<std::string>& known,
                 Complaints& complaints) {
  for (const Node& child : table.children)
    if (std::find(known.begin(), known.end(), child.name) == known.end())
      complaints.add(child.where, subject + (subject.empty() ? "" : " ") + printable(child.name) + ": unknown key; " +
                                      suggestion(child.name, known));
}

FigureChoice read_figures(const Node& study, Complaints& complaints) {
  FigureChoice choice;
  if (const Node* figures = section(study, "figures", complaints))
    for (const Node& one : figures->children) read_figure(one, choice, complaints);
  if (const Node* patches = section(study, "patches", complaints)) {
    choice.patches_where = patches->where;
    read_patches(*patches, choice.patches, complaints);
  }
  if (const Node* modes = section(study, "modes", complaints)) {
    choice.modes_where = modes->where;
    read_modes(*modes, choice, complaints);
  }
  return choice;
}

}  // namespace railwave::sweep
