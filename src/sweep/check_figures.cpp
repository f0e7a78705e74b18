#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "case/error.hpp"
#include "case/suggest.hpp"
#include "mesh/contact_zone.hpp"
#include "post/history_series.hpp"
#include "post/planned_histories.hpp"
#include "sweep/figure.hpp"

namespace railwave::sweep {
namespace {

using case_file::Complaints;

std::string subject(const Figure& figure) { return "[figures] " + figure.name + ": "; }

/// What a contact solution is made of, and a case need not write; empty: it does.
std::string missing_output(const scene::Output& output) {
  const auto writes = [&](const char* field) { return scene::is_among(field, output.contact_fields); };
  if (!scene::is_among("slave", output.contact_sides)) return "output.contact_sides leaves out 'slave'";
  for (const char* field : {"normal_force", "tangential_force"})
    if (!writes(field)) return fmt::format("output.contact_fields leaves out '{}'", field);
  if (!writes("position") && !writes("displacement"))
    return "output.contact_fields leaves out both 'position' and 'displacement'";
  return "";
}

std::string patch_mistake(const Figure& figure, const scene::Scene& scene) {
  std::vector<std::string> contacts;
  for (const scene::Contact& contact : scene.contacts) contacts.push_back(contact.name);
  if (std::find(contacts.begin(), contacts.end(), figure.contact) == contacts.end())
    return fmt::format("there is no contact '{}' in {}; {}", figure.contact, scene.path,
                       contacts.empty() ? "it has none" : suggestion(figure.contact, contacts));
  if (const std::string missing = missing_output(scene.output); !missing.empty())
    return fmt::format("{} has no contact solution: {}", scene.path, missing);
  const auto& windows = scene.output_windows;
  const bool in_window = std::any_of(windows.begin(), windows.end(), [&](const scene::OutputWindow& window) {
    return window.has_contact(figure.contact) && window.start <= figure.to &&
           figure.from <= window.end.value_or(scene.time.end);
  });
  if (scene.output.field_interval > 0 || in_window || figure.from <= 0 || figure.to >= scene.time.end) return "";
  return fmt::format(
      "no output lies from {} s to {} s: without output.field_interval, or a window of outputs there, contacts are "
      "written at the run's beginning and end alone",
      figure.from, figure.to);
}

/// Samples are taken every history_interval and at the end: there are no more than this makes.
std::string few_samples(const Figure& figure, const scene::Scene& scene) {
  const double interval = scene.output.history_interval;
  const double length = std::fmin(figure.to, scene.time.end) - std::fmax(figure.from, 0);
  if (!(interval > 0) || !(length / interval + 2 < static_cast<double>(fewest_samples))) return "";
  return fmt::format(
      "there are {} samples at most from {} s to {} s, of which {} are wanted: output.history_interval is {} s",
      std::floor(length / interval + 2), std::fmax(figure.from, 0), std::fmin(figure.to, scene.time.end),
      fewest_samples, interval);
}

std::string run_mistake(const Figure& figure, const scene::Scene& scene) {
  if (figure.from > scene.time.end)
    return fmt::format("from is {} s, after the end of the run (time.end is {} s)", figure.from, scene.time.end);
  if (figure.to < 0) return fmt::format("to is {} s, before the run begins", figure.to);
  return figure.source == Figure::Source::patch ? patch_mistake(figure, scene) : few_samples(figure, scene);
}

void check_parts(const FigureChoice& choice, const scene::Scene& scene, Complaints& complaints) {
  std::vector<std::string> known;
  for (const scene::Part& part : scene.parts) known.push_back(part.name);
  for (const scene::PointMass& point : scene.points) known.push_back(point.name);
  for (const std::string& name : choice.modes_parts)
    if (std::find(known.begin(), known.end(), name) == known.end())
      complaints.add(choice.modes_where, fmt::format("[modes] parts: there is no part or point mass '{}' in {}; {}",
                                                     case_file::printable(name), scene.path, suggestion(name, known)));
}

}  // namespace

void check_figures(const FigureChoice& choice, const scene::Scene& scene, Complaints& complaints) {
  for (const Figure& figure : choice.figures) {
    if (figure.source == Figure::Source::mode) continue;
    if (const std::string mistake = run_mistake(figure, scene); !mistake.empty())
      complaints.add(figure.where, subject(figure) + mistake);
  }
  if (choice.need_modes()) check_parts(choice, scene, complaints);
}

void check_histories(const FigureChoice& choice, scene::Scene scene, Complaints& complaints) {
  const bool axle = choice.patches.axle && choice.need(Figure::Source::patch);
  if (!axle && !choice.need(Figure::Source::history)) return;
  const auto planned = [&]() -> std::optional<PlannedHistories> {
    try {
      place_contact_zones(scene);
    } catch (const InputError&) {
      return {};
    }
    return PlannedHistories::of(scene);
  }();
  if (!planned) return;  // its member will be refused, with the reason in its row
  const auto check = [&](case_file::Where where, const std::string& what, const auto& expect) {
    try {
      expect();
    } catch (const InputError& error) {
      complaints.add(where, what + error.what());
    }
  };
  for (const Figure& figure : choice.figures)
    if (figure.source == Figure::Source::history)
      check(figure.where, subject(figure), [&] {
        if (const std::size_t count = planned->count(figure.quantity); count != 1)
          throw InputError(fmt::format("{} finds {} histories; name one", figure.quantity, count));
      });
  if (axle) check(choice.patches_where, "[patches] axle: ", [&] { planned->expect_velocity(*choice.patches.axle); });
}

}  // namespace railwave::sweep
