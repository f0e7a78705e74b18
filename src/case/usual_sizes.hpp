#pragma once

/// What the field has, for warnings before a run and for the causes that the monitor names.
namespace railwave {

/// Mean size of a part's elements, m.
inline constexpr double finest_mesh = 1e-6, coarsest_mesh = 0.5;
/// Waves of solids are between those of soft rubber and of diamond, m/s.
inline constexpr double slowest_wave = 5, fastest_wave = 25000;
/// Beyond 350 km/h no train runs, m/s.
inline constexpr double fastest_train = 350 / 3.6;

}  // namespace railwave
