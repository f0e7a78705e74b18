#include "model/sample_sums.hpp"

#include "kernels/beams/beam.hpp"
#include "kernels/beams/beam_rotation.hpp"
#include "kernels/boundaries/non_reflecting.hpp"
#include "kernels/boundaries/prescribed_motion.hpp"
#include "kernels/contact/contact_sums.hpp"
#include "kernels/contact/laws/linear_penalty.hpp"
#include "kernels/loads/load_sums.hpp"
#include "kernels/monitor/monitor_terms.hpp"

namespace railwave {

void SampleSums::launch() {
  if constexpr (on_device) joined_.launch<SampleTerms>(space(), order());
}

}  // namespace railwave
