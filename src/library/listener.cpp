#include "library/listener.hpp"

#include "output/histories/history_values.hpp"

namespace railwave {
namespace {

std::vector<double> three(const Vec3& vector) { return {vector[0], vector[1], vector[2]}; }

void add_contact(std::vector<NamedHistory>& names, const std::string& name, std::size_t c) {
  const auto add = [&](const char* quantity, auto of) {
    names.push_back(
        {"contact." + name + "." + quantity, [c, of](const HistorySample& sample) { return of(sample.contacts[c]); }});
  };
  add("normal_force", [](const ContactTotals& totals) { return three(totals.normal_force); });
  add("tangential_force", [](const ContactTotals& totals) { return three(totals.tangential_force); });
  add("master_force", [](const ContactTotals& totals) { return three(totals.master_force); });
  add("nodes_in_contact",
      [](const ContactTotals& totals) { return std::vector<double>{static_cast<double>(totals.nodes_in_contact)}; });
  add("nodes_slipping",
      [](const ContactTotals& totals) { return std::vector<double>{static_cast<double>(totals.nodes_slipping)}; });
}

void add_motion(std::vector<NamedHistory>& names, const HistorySet& set, std::size_t s) {
  for (const FieldRow* row : set.quantities_of(FieldRow::Place::node))
    names.push_back(
        {"set." + set.name + "." + row->name, [s, row, read = motion_values(*row)](const HistorySample& sample) {
           const double* first = read(sample.sets[s]);
           return std::vector<double>(first, first + row->components);
         }});
}

void add_reaction(std::vector<NamedHistory>& names, const std::string& motion, std::size_t m) {
  names.push_back({"prescribed_motion." + motion + ".reaction",
                   [m](const HistorySample& sample) { return three(sample.reactions[m].force); }});
  names.push_back({"prescribed_motion." + motion + ".work",
                   [m](const HistorySample& sample) { return std::vector<double>{sample.reactions[m].work}; }});
}

void add_load(std::vector<NamedHistory>& names, const scene::Load& load, std::size_t l) {
  if (load.type == scene::LoadType::torque)
    names.push_back({"load." + load.name + ".moment",
                     [l](const HistorySample& sample) { return std::vector<double>{sample.loads[l].moment}; }});
  else
    names.push_back(
        {"load." + load.name + ".force", [l](const HistorySample& sample) { return three(sample.loads[l].force); }});
  names.push_back({"load." + load.name + ".work",
                   [l](const HistorySample& sample) { return std::vector<double>{sample.loads[l].work}; }});
}

}  // namespace

std::vector<NamedHistory> named_histories(const Model& model) {
  std::vector<NamedHistory> names;
  for (const EnergyTerm& term : energy_terms)
    names.push_back({std::string("energy.") + term.name,
                     [&term](const HistorySample& sample) { return std::vector<double>{sample.energy.*term.value}; }});
  for (std::size_t c = 0; c < model.scene.contacts.size(); ++c) add_contact(names, model.scene.contacts[c].name, c);
  std::size_t moving = 0;
  for (const HistorySet& set : resolve_history_sets(model.scene, model.assembly))
    if (set.motion()) add_motion(names, set, moving++);
  for (std::size_t l = 0; l < model.scene.loads.size(); ++l) add_load(names, model.scene.loads[l], l);
  for (std::size_t m = 0; m < model.scene.prescribed_motions.size(); ++m)
    add_reaction(names, model.scene.prescribed_motions[m].name, m);
  return names;
}

std::vector<AskedField> asked_fields(const scene::Output& output, const std::vector<OutputSet>& sets) {
  std::vector<AskedField> fields;
  for (const OutputSet& set : sets)
    for (const std::string& name : output.fields)
      if (const FieldRow& row = field_named(name); !set.is_beam() && set.has(row)) fields.push_back({&row, &set, {}});
  return fields;
}

void Listener::history(const Model& model, const HistorySample& latest) {
  sample = latest;
  ++samples;
  for (AskedField& field : fields)
    field.values = output_field(model, model, model.ties, *field.row, field.set->numbers(*field.row)).values;
}

}  // namespace railwave
