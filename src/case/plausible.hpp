#pragma once

#include <string>

#include "case/complaints.hpp"
#include "case/key.hpp"
#include "case/scene.hpp"

/// Which numbers a key takes at all, which ones the field has, and which unit was probably meant where a number is
/// neither.
namespace railwave::case_file {

/// The numbers that a key takes: its own range, within what any quantity of its unit can be. Beyond that squares and
/// products leave the range of a double, and nothing of a railway is there: 1e300 N/m, 1e-300 m.
Range allowed_range(const Key& key);

/// Where 0 is allowed and stands for "none": the smallest number beside it. 0: any.
double least_beside_zero(const Key& key);

/// The numbers that the field has for a key: its own, or those of its unit. Numbers outside are taken, with a warning.
Range usual_range(const Key& key);

/// True for 0, which means "none" or "off" wherever it is allowed, and for numbers in usual_range().
bool is_usual(const Key& key, double number);

/// "; m are expected: 0.46, if it is in mm" where the number in another unit is usual for the key; else "".
std::string unit_hint(const Key& key, double number);

/// What is said of a number outside of usual_range().
std::string oddity(const Key& key, double number);

/// A table of the limits by unit, in Markdown.
std::string unit_limits_markdown();

/// Warns of values that are odd for the scene, though each key alone allows them: wheels faster than any train.
void remark_on_scene(const scene::Scene& scene, Complaints& remarks);

}  // namespace railwave::case_file
