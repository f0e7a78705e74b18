#include "model/time_step/tangent_operator.hpp"

#include "model/host_copy.hpp"

namespace railwave {

TangentOperator::TangentOperator(const Assembly& assembly, int more_rows) {
  const auto& elements = assembly.elements;
  const std::size_t nodes = assembly.nodes.size() + more_rows;
  std::vector<int> first(nodes + 1, 0), corner(8 * elements.size());
  for (const auto& corners : elements)
    for (int n : corners) ++first[n + 1];
  for (std::size_t n = 0; n < nodes; ++n) first[n + 1] += first[n];
  std::vector<int> filled(first.begin(), first.end() - 1);
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (int N = 0; N < 8; ++N) corner[filled[elements[e][N]]++] = static_cast<int>(8 * e) + N;
  corners_ = to_device("tangent corners", elements);
  first_corner_ = to_device("tangent first corner", first);
  corner_ = to_device("tangent corner", corner);
  corner_force_ = unset_array<double* [24]>("tangent corner force", elements.size());
}

void TangentOperator::apply(const Assembly& assembly, const std::vector<ElementStiffness>& stiffness,
                            const Array<const double* [3]>& position, const NodeVector& u, double inverse_time,
                            const NodeVector& f) const {
  // Parts that follow each other and are alike in one launch: of a track's sleepers each takes less time than that.
  const auto& parts = assembly.parts;
  for (std::size_t p = 0, next; p < parts.size(); p = next) {
    int count = parts[p].element_count;
    for (next = p + 1; next < parts.size() && stiffness[next] == stiffness[p] &&
                       parts[next].first_element == parts[p].first_element + count;
         ++next)
      count += parts[next].element_count;
    Kokkos::parallel_for(
        "element_tangent", Range(0, ElementTangent::batches(count)),
        ElementTangent{parts[p].first_element, count, stiffness[p], corners_, position, u, corner_force_});
  }
  Kokkos::parallel_for("tangent_gather", Range(0, static_cast<int>(first_corner_.extent(0)) - 1),
                       GatherTangent{first_corner_, corner_, corner_force_, f});
  add_springs(u, inverse_time, f);
}

void TangentOperator::add_springs(const NodeVector& u, double inverse_time, const NodeVector& f) const {
  if (springs_.count == 0) return;
  Kokkos::parallel_for("tangent_springs", SumTeams(springs_.count, threads_of_sum),
                       SpringForce{springs_, u, inverse_time});
  Kokkos::parallel_for("tangent_add_springs", SpreadRange(0, springs_.node_count), AddSprings{springs_, f});
}

}  // namespace railwave
