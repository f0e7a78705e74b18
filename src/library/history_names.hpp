#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/model.hpp"
#include "solve/observer.hpp"

namespace railwave {

/// A quantity of a sample under its name in the group /history of a results file, parts joined by dots.
struct NamedHistory {
  std::string name;
  std::function<std::vector<double>(const HistorySample&)> values;
};

/// Energies, forces of contacts, mean motions of history sets, loads.
std::vector<NamedHistory> named_histories(const Model& model);

}  // namespace railwave
