#include "output/histories/history_values.hpp"

#include <stdexcept>
#include <string>

namespace railwave {
namespace {

template <class Means>
struct Entry {
  const char* name;
  const double* (*values)(const Means&);
};

constexpr Entry<MeanMotion> of_nodes[] = {
    {"displacement", [](const MeanMotion& mean) { return mean.displacement.data(); }},
    {"velocity", [](const MeanMotion& mean) { return mean.velocity.data(); }},
    {"acceleration", [](const MeanMotion& mean) { return mean.acceleration.data(); }},
};

constexpr Entry<ElementMeans> of_elements[] = {
    {"stress", [](const ElementMeans& mean) { return mean.stress.data(); }},
    {"strain", [](const ElementMeans& mean) { return mean.strain.data(); }},
    {"plastic_strain", [](const ElementMeans& mean) { return &mean.plastic_strain; }},
};

template <class Means, std::size_t n>
auto find(const Entry<Means> (&entries)[n], const FieldRow& row) {
  for (const Entry<Means>& entry : entries)
    if (std::string(entry.name) == row.name) return entry.values;
  throw std::logic_error(std::string("histories have no values of ") + row.name + ", see history_values.cpp");
}

}  // namespace

MotionValues motion_values(const FieldRow& row) { return find(of_nodes, row); }

ElementValues element_values(const FieldRow& row) { return find(of_elements, row); }

}  // namespace railwave
