#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/fields.hpp"
#include "model/model.hpp"
#include "output/output_sets.hpp"
#include "solve/observer.hpp"

namespace railwave {

/// A quantity of a sample under its name in the group /history of a results file, parts joined by dots.
struct NamedHistory {
  std::string name;
  std::function<std::vector<double>(const HistorySample&)> values;
};

/// Energies, forces of contacts, mean motions of history sets, loads.
std::vector<NamedHistory> named_histories(const Model& model);

/// A field of a set, as output.fields and output.field_sets ask for it.
struct AskedField {
  const FieldRow* row;
  const OutputSet* set;
  std::vector<double> values;
};

/// Keeps the last sample, and the fields of its instant.
class Listener : public RunObserver {
 public:
  void history(const Model& model, const HistorySample& latest) override;

  HistorySample sample;
  long samples = 0;
  std::vector<AskedField> fields;
};

/// What output.fields asks for of each set.
std::vector<AskedField> asked_fields(const scene::Output& output, const std::vector<OutputSet>& sets);

}  // namespace railwave
