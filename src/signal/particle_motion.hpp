#pragma once

#include <vector>

namespace railwave {

/// The ellipse that a particle runs through, from two components of its motion.
struct ParticleMotion {
  double semi_axis_major = 0, semi_axis_minor = 0;  ///< in the units given, at the strongest motion
  double tilt = 0;             ///< rad, of the major axis, from the first component to the second, -pi/2 to pi/2
  double phase = 0;            ///< rad, of the second component before the first
  double amplitude_ratio = 0;  ///< second component to first
  double polarisation = 0;     ///< 0: as noise; 1: one and the same ellipse all the time
  double coherence = 0;        ///< magnitude squared, of the two components, over all times
  std::size_t strongest = 0;   ///< the sample where the motion was strongest

  /// Whether, seen with the first component to the right (the way a wave travels) and the second upwards (out of the
  /// surface), the particle runs against a rolling wheel: backwards at the top, as in a Rayleigh wave.
  bool retrograde() const { return phase < 0; }
};

/// From Stokes's parameters of the two analytic signals, S1 = <|a|^2 - |b|^2>, S2 = 2 Re <a* b>, S3 = 2 Im <a* b>,
/// means over time: tilt is atan2(S2, S1) / 2, the axes' ratio tan(asin(S3/S)/2) of S^2 = S1^2 + S2^2 + S3^2. Throws
/// std::logic_error for unequal lengths, and InputError without any motion.
ParticleMotion particle_motion(const std::vector<double>& first, const std::vector<double>& second);

}  // namespace railwave
