#include "solve/tasks/beam_forces.hpp"

namespace railwave {

Task beam_task(const NodalState& nodal, const BeamModel& built, StepKind kind) {
  return {built.moments.empty() ? "beams" : "beams, torques on points", "a",
          [&nodal, &built, settling = kind == StepKind::settling](const Instant& instant) {
            BeamForce force{built.arrays, nodal.nodes.position, nodal.external.contribution, settling, instant.elapsed};
            for (std::size_t l = 0; l < built.moments.size(); ++l) force.given[l] = instant.value_of(*built.moments[l]);
            Kokkos::parallel_for(
                "beam_force", SpreadRange(instant.space(), 0, built.arrays.count + built.arrays.moment_count), force);
          }};
}

Task rotation_task(const NodalState& nodal, const BeamModel& built) {
  return {"rotations of beams", "f to j", [&nodal, &built](const Instant& instant) {
            const BeamArrays& beams = built.arrays;
            Kokkos::parallel_for("beam_rotations", SpreadRange(instant.space(), 0, beams.node_count),
                                 BeamRotationUpdate{{beams}, nodal.velocity_lag + 0.5 * instant.step, instant.step});
          }};
}

void queue_beam_energies(const NodalState& nodal, const BeamArrays& beams, double step, EnergyAccount& energy,
                         SampleSums& sums) {
  sums.sum(BeamEnergy{beams, nodal.nodes.position}, beams.count,
           [&energy](const double* sum) { energy.internal += *sum; });
  sums.sum(BeamKineticEnergy{{beams}, nodal.velocity_lag, step}, beams.node_count,
           [&energy](const double* sum) { energy.kinetic += *sum; });
  sums.sum(ArraySum{beams.work}, beams.moment_count, [&energy](const double* sum) { energy.external_work += *sum; });
}

void queue_beam_resultants(const BeamModel& built, const NodeArrays& nodes, std::vector<BeamResultants>& all,
                           Reductions& sums) {
  all.resize(built.first_of_beam.size() - 1);
  sums.each(BeamSectionForces{built.arrays, nodes.position}, built.arrays.count, [&built, &all](const double* values) {
    for (std::size_t b = 0; b < all.size(); ++b)
      for (int e = built.first_of_beam[b]; e < built.first_of_beam[b + 1]; ++e) {
        const double* const of_element = values + e * BeamSectionForces::values;
        all[b].force.insert(all[b].force.end(), of_element, of_element + 3);
        all[b].moment.insert(all[b].moment.end(), of_element + 3, of_element + 6);
      }
  });
}

std::vector<BeamResultants> beam_resultants(const BeamModel& built, const NodeArrays& nodes) {
  std::vector<BeamResultants> all;
  ReductionSpace space;
  Reductions sums(space);
  queue_beam_resultants(built, nodes, all, sums);
  sums.fetch();
  return all;
}

void relax_rotations(const BeamModel& built, double damping) {
  Kokkos::parallel_for("beam_relaxation", Range(0, built.arrays.node_count),
                       BeamRelaxation{{built.arrays}, built.relaxation_inertia, damping});
}

void stop_rotations(const BeamModel& built) { Kokkos::deep_copy(built.arrays.spin, 0.0); }

BeamRelaxationState relaxation_state(const BeamModel& built, ReductionSpace& space) {
  double sum[3];
  block_sum(BeamRelaxationSums{{built.arrays}, built.relaxation_inertia, built.arm}, built.arrays.node_count, sum,
            space);
  return {sum[0], sum[1], sum[2]};
}

void interpolate_inside_beams(const Assembly& assembly, const std::function<Vec3&(int)>& value) {
  for (const Assembly::BeamChain& chain : assembly.beam_chains) {
    const std::size_t last = chain.nodes.size() - 1;
    const Vec3 from = value(chain.nodes.front()), to = value(chain.nodes.back());
    for (std::size_t k = 1; k < last; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(last);
      for (int i = 0; i < 3; ++i) value(chain.nodes[k])[i] = from[i] + share * (to[i] - from[i]);
    }
  }
}

}  // namespace railwave
