#include "signal/particle_motion.hpp"

#include <cmath>
#include <stdexcept>

#include "case/error.hpp"
#include "signal/band_pass.hpp"

namespace railwave {

ParticleMotion particle_motion(const std::vector<double>& first, const std::vector<double>& second) {
  if (first.size() != second.size()) throw std::logic_error("two components of a motion have other lengths");
  const auto a = analytic_signal(first), b = analytic_signal(second);
  ParticleMotion motion;
  double square_a = 0, square_b = 0, strongest = 0;
  Complex cross = 0;
  for (std::size_t n = 0; n < a.size(); ++n) {
    square_a += std::norm(a[n]);
    square_b += std::norm(b[n]);
    cross += std::conj(a[n]) * b[n];
    const double now = std::norm(a[n]) + std::norm(b[n]);
    if (now > strongest) {
      strongest = now;
      motion.strongest = n;
    }
  }
  if (!(strongest > 0)) throw InputError("nothing moves: there is no ellipse");
  const double s0 = square_a + square_b, s1 = square_a - square_b, s2 = 2 * cross.real(), s3 = 2 * cross.imag();
  const double polarised = std::sqrt(s1 * s1 + s2 * s2 + s3 * s3), straight = std::hypot(s1, s2);
  // Means over time give the shape; the size is that of the strongest motion.
  const double size = strongest / s0;
  motion.semi_axis_major = std::sqrt(size * (polarised + straight) / 2);
  motion.semi_axis_minor = std::sqrt(size * std::fmax(0, polarised - straight) / 2);
  motion.tilt = std::atan2(s2, s1) / 2;
  motion.phase = std::arg(cross);
  motion.amplitude_ratio = std::sqrt(square_b / square_a);
  motion.polarisation = polarised / s0;
  motion.coherence = square_a > 0 && square_b > 0 ? std::norm(cross) / (square_a * square_b) : 0;
  return motion;
}

}  // namespace railwave
