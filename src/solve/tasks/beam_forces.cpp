#include "solve/tasks/beam_forces.hpp"

#include "model/host_copy.hpp"

namespace railwave {

Task beam_task(Model& model, StepKind kind) {
  const BeamModel& built = *model.beams;
  return {built.moments.empty() ? "beams" : "beams, torques on points", "a",
          [&model, &built, settling = kind == StepKind::settling](const Instant& instant) {
            BeamForce force{built.arrays, model.nodes.position, model.extra.contribution, settling, instant.elapsed};
            for (std::size_t l = 0; l < built.moments.size(); ++l)
              force.given[l] = curve_value(built.moments[l]->curve, instant.time) * built.moments[l]->load->moment;
            Kokkos::parallel_for("beam_force", SpreadRange(0, built.arrays.count + built.arrays.moment_count), force);
          }};
}

void advance_rotations(const Model& model, double step) {
  const BeamArrays& beams = model.beams->arrays;
  Kokkos::parallel_for("beam_rotations", SpreadRange(0, beams.node_count),
                       BeamRotationUpdate{{beams}, model.velocity_lag + 0.5 * step, step});
}

void queue_beam_energies(const Model& model, double step, EnergyAccount& energy, Reductions& sums) {
  const BeamArrays& beams = model.beams->arrays;
  sums.sum(BeamEnergy{beams, model.nodes.position}, beams.count,
           [&energy](const double* sum) { energy.internal += *sum; });
  sums.sum(BeamKineticEnergy{{beams}, model.velocity_lag, step}, beams.node_count,
           [&energy](const double* sum) { energy.kinetic += *sum; });
  sums.sum(ArraySum{beams.work}, beams.moment_count, [&energy](const double* sum) { energy.external_work += *sum; });
}

std::vector<BeamResultants> beam_resultants(const Model& model) {
  const BeamModel& built = *model.beams;
  const auto result = unset_array<double* [6]>("beam section forces", built.arrays.count);
  Kokkos::parallel_for("beam_section_forces", Range(0, built.arrays.count),
                       BeamSectionForces{built.arrays, model.nodes.position, result});
  const auto host = to_host(result);
  std::vector<BeamResultants> all(model.scene.beams.size());
  for (std::size_t b = 0; b < all.size(); ++b)
    for (int e = built.first_of_beam[b]; e < built.first_of_beam[b + 1]; ++e)
      for (int i = 0; i < 3; ++i) {
        all[b].force.push_back(host(e, i));
        all[b].moment.push_back(host(e, 3 + i));
      }
  return all;
}

void relax_rotations(const Model& model, double damping) {
  const BeamArrays& beams = model.beams->arrays;
  Kokkos::parallel_for("beam_relaxation", Range(0, beams.node_count),
                       BeamRelaxation{{beams}, model.beams->relaxation_inertia, damping});
}

void stop_rotations(const Model& model) { Kokkos::deep_copy(model.beams->arrays.spin, 0.0); }

BeamRelaxationState relaxation_state(const Model& model) {
  const BeamModel& built = *model.beams;
  double sum[3];
  block_sum(BeamRelaxationSums{{built.arrays}, built.relaxation_inertia, built.arm}, built.arrays.node_count, sum,
            *model.reduction_space);
  return {sum[0], sum[1], sum[2]};
}

void interpolate_inside_beams(const Model& model, const std::function<Vec3&(int)>& value) {
  for (const Assembly::BeamChain& chain : model.assembly.beam_chains) {
    const std::size_t last = chain.nodes.size() - 1;
    const Vec3 from = value(chain.nodes.front()), to = value(chain.nodes.back());
    for (std::size_t k = 1; k < last; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(last);
      for (int i = 0; i < 3; ++i) value(chain.nodes[k])[i] = from[i] + share * (to[i] - from[i]);
    }
  }
}

}  // namespace railwave
