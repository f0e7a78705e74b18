#pragma once

#include <memory>
#include <vector>

#include "bogie_data.hpp"
#include "interface_motion.hpp"

namespace railwave::vehicle {

/// The bogie at an instant.
struct BogieSample {
  Vector force{};         ///< N, of the primary suspension on the wheelset that Railwave computes
  Vector frame{};         ///< m, displacement of the frame's centre from its equilibrium at the start
  double pitch = 0;       ///< rad, of the frame about y
  double energy = 0;      ///< J, kinetic and potential
  double dissipated = 0;  ///< J, in dampers since the start
};

/// A bogie's state, kept in memory.
class BogieState {
 public:
  BogieState();
  ~BogieState();
  BogieState(BogieState&&) noexcept;
  BogieState& operator=(BogieState&&) noexcept;

 private:
  friend class Bogie;
  struct Kept;
  std::unique_ptr<Kept> kept_;
};

/// A bogie as a multibody system (Simbody), over a wheelset whose motion comes from outside.
///
/// Suspensions are Simbody's linear bushings without rotational stiffness. The wheelset is a point without mass, whose
/// motion is prescribed and counts from where it is when the run begins.
class Bogie {
 public:
  /// At time 0 all bodies are in equilibrium but for what the data say of the frame's start.
  explicit Bogie(const BogieData& data);
  ~Bogie();

  /// At time 0: has all bodies move along x at this speed (m/s), besides what the data say. The constructor leaves it
  /// 0.
  void start(double speed);

  /// Goes on from the path's first sample, the present instant, to its last.
  /// @return the bogie at the times of all samples but the first
  std::vector<BogieSample> follow(const MotionPath& path);

  /// The bogie now.
  BogieSample sample() const;

  BogieState save() const;
  void restore(const BogieState& state);

 private:
  struct System;
  std::unique_ptr<System> system_;
};

}  // namespace railwave::vehicle
