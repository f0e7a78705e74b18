#include "solve/tasks/beam_forces.hpp"

#include "model/host_copy.hpp"

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
                         Reductions& sums) {
  sums.sum(BeamEnergy{beams, nodal.nodes.position}, beams.count,
           [&energy](const double* sum) { energy.internal += *sum; });
  sums.sum(BeamKineticEnergy{{beams}, nodal.velocity_lag, step}, beams.node_count,
           [&energy](const double* sum) { energy.kinetic += *sum; });
  sums.sum(ArraySum{beams.work}, beams.moment_count, [&energy](const double* sum) { energy.external_work += *sum; });
}

std::vector<BeamResultants> beam_resultants(const BeamModel& built, const NodeArrays& nodes) {
  const auto result = unset_array<double* [6]>("beam section forces", built.arrays.count);
  Kokkos::parallel_for("beam_section_forces", Range(0, built.arrays.count),
                       BeamSectionForces{built.arrays, nodes.position, result});
  const auto host = to_host(result);
  std::vector<BeamResultants> all(built.first_of_beam.size() - 1);
  for (std::size_t b = 0; b < all.size(); ++b)
    for (int e = built.first_of_beam[b]; e < built.first_of_beam[b + 1]; ++e)
      for (int i = 0; i < 3; ++i) {
        all[b].force.push_back(host(e, i));
        all[b].moment.push_back(host(e, 3 + i));
      }
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
