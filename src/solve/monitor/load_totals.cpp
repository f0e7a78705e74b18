#include <algorithm>
#include <memory>
#include <utility>

#include "kernels/loads/load_sums.hpp"
#include "model/beams/beams.hpp"
#include "solve/monitor/energies.hpp"

namespace railwave {
namespace {

void queue_total(const NodalState& nodal, const LoadArrays& arrays, LoadTotals& totals, SampleSums& sums) {
  const scene::Load& load = *arrays.load;
  const double factor = curve_value(arrays.curve, nodal.time);
  const auto forces = [&totals](double scale) {
    return [&totals, scale](const double* sum) {
      for (int i = 0; i < 3; ++i) totals.force[i] = scale * sum[i];
    };
  };
  switch (load.type) {
    case scene::LoadType::nodal_force:
      for (int i = 0; i < 3; ++i) totals.force[i] = factor * load.force[i];
      break;
    case scene::LoadType::traction:
      sums.sum(AmplitudeSum{arrays.amplitude}, arrays.count, forces(factor));
      break;
    case scene::LoadType::pressure:
      sums.sum(FacetSum{nodal.nodes.position, arrays.facets}, arrays.count, forces(-factor * load.pressure));
      break;
    case scene::LoadType::torque:
      totals.moment = factor * load.moment;
      break;
  }
}

/// Of a torque on a point the beams keep the account, of all other loads their contributions.
void queue_work(const NodalState& nodal, const LoadArrays& load, const std::shared_ptr<BeamModel>& beams,
                LoadTotals& totals, SampleSums& sums) {
  Array<const double*> work = nodal.external.work;
  int first = load.first, count = load.count * (load.load->type == scene::LoadType::pressure ? 4 : 1);
  if (load.beam_node >= 0) {
    work = beams->arrays.work;
    first = static_cast<int>(std::find(beams->moments.begin(), beams->moments.end(), &load) - beams->moments.begin());
    count = 1;
  }
  const Array<const double*> own = Kokkos::subview(work, std::make_pair(first, first + count));
  sums.sum(ArraySum{own}, count, [&totals](const double* sum) { totals.work = *sum; });
}

}  // namespace

void queue_load_totals(const NodalState& nodal, const LoadModel& loads, const std::shared_ptr<BeamModel>& beams,
                       std::vector<LoadTotals>& totals, SampleSums& sums) {
  totals.resize(loads.loads.size());
  for (std::size_t l = 0; l < totals.size(); ++l) {
    queue_total(nodal, loads.loads[l], totals[l], sums);
    queue_work(nodal, loads.loads[l], beams, totals[l], sums);
  }
}

void queue_reactions(const NodalState& nodal, std::vector<ReactionTotals>& totals, SampleSums& sums) {
  totals.resize(nodal.prescribed.size());
  for (std::size_t s = 0; s < totals.size(); ++s) {
    const PrescribedSet& set = nodal.prescribed[s];
    const int count = static_cast<int>(set.nodes.extent(0));
    const PrescribedMotion motion = prescribed_motion(nodal, set, 0);
    const PrescribedInstant instant = prescribed_instant(nodal, set);
    sums.sum(PrescribedReaction{motion, instant}, count, [&totals = totals[s]](const double* sum) {
      for (int i = 0; i < 3; ++i) totals.force[i] = sum[i];
    });
    sums.sum(PrescribedWork{motion, instant}, count, [&totals = totals[s]](const double* sum) { totals.work = *sum; });
  }
}

}  // namespace railwave
