#include "modes/modes_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "case/error.hpp"
#include "model/assembly.hpp"
#include "model/checks/doubts.hpp"
#include "model/model.hpp"
#include "modes/modes.hpp"
#include "output/atomic_file.hpp"
#include "output/results_writer.hpp"
#include "output/run_places.hpp"

namespace railwave {
namespace {

std::string part_name(const scene::Scene& scene, const Mode& mode) {
  return mode.part < 0 ? "points and beams" : scene.parts[mode.part].name;
}

std::string name_of(const Mode& mode) {
  if (mode.rigid) return "rigid";
  if (!mode.round) return "";
  return fmt::format("{} ({},{})", text_of(mode.round->kind), mode.round->circles, mode.round->diameters);
}

/// @param several whether there are several parts: the table then names the one that moves most
void print(const scene::Scene& scene, const std::vector<Mode>& modes, bool several, std::ostream& out) {
  out << fmt::format("{:>5} {:>11} {:>11}    {}\n", "mode", "Hz", "modal kg",
                     several ? fmt::format("{:<24}moves most", "name") : "name");
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const Mode& mode = modes[k];
    std::string line =
        fmt::format("{:>5} {:>11.3f} {:>11.4g}  {:<24}", k + 1, mode.frequency, mode.modal_mass, name_of(mode));
    if (several) line += fmt::format("{} {:.0f} %", part_name(scene, mode), 100 * mode.part_share);
    out << line.substr(0, line.find_last_not_of(' ') + 1) << '\n';
  }
}

/// A line for each part whose hourglass control holds so much of modes' energy that a run's monitor would warn of it:
/// their frequencies are those of the control. The mode with the largest share stands for the others.
void warn_of_hourglass(const scene::Scene& scene, const std::vector<Mode>& modes, std::ostream& out) {
  const double limit = scene.monitor.hourglass_share;
  for (std::size_t p = 0; p < scene.parts.size(); ++p) {
    std::size_t worst = modes.size();
    int count = 0;
    for (std::size_t k = 0; k < modes.size(); ++k) {
      if (modes[k].hourglass_part != static_cast<int>(p) || !(modes[k].hourglass_share > limit)) continue;
      ++count;
      if (worst == modes.size() || modes[k].hourglass_share > modes[worst].hourglass_share) worst = k;
    }
    if (count == 0) continue;
    const scene::Part& part = scene.parts[p];
    out << fmt::format(
        "warning: [parts.{}] (line {}) is bent over few elements: its hourglass control holds more than {:.3g} "
        "(monitor.hourglass_share) of the energy of {} of the {} modes, "
        "at most {:.3g} of mode {}'s ({:.1f} Hz), whose frequencies depend on hourglass_coefficient; refine it where "
        "these modes bend it (docs/hourglass.md)\n",
        part.name, part.line, limit, count, modes.size(), modes[worst].hourglass_share, worst + 1,
        modes[worst].frequency);
  }
}

constexpr const char* heading =
    "mode,frequency,rigid,modal_mass,part,part_share,kind,nodal_circles,nodal_diameters,order_share,axial_share,"
    "radial_share,circumferential_share";

FileKind mode_table() { return {FileKind::Form::table, "a table of 'railwave modes --csv'", heading, ""}; }

void check_files(const scene::Scene& scene, const ModesRequest& request) {
  OutputPlaces places(request.overwrite);
  name_inputs(scene, places);
  if (request.csv) places.writes(*request.csv, mode_table(), "--csv", "the table");
  if (request.shapes)
    places.writes_with_companion(*request.shapes, kinds::modes(), kinds::modes_xdmf(), "--out",
                                 "the file of the shapes");
  places.check();
}

std::string csv_of(const scene::Scene& scene, const std::vector<Mode>& modes) {
  std::string text = fmt::format("{}\n", heading);
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const Mode& mode = modes[k];
    text += fmt::format("{},{:.10g},{},{:.6g},{},{:.4f}", k + 1, mode.frequency, mode.rigid ? 1 : 0, mode.modal_mass,
                        part_name(scene, mode), mode.part_share);
    if (mode.round) {
      const RoundName& r = *mode.round;
      text += fmt::format(",{},{},{},{:.4f},{:.4f},{:.4f},{:.4f}\n", text_of(r.kind), r.circles, r.diameters,
                          r.order_share, r.axial_share, r.radial_share, r.circumferential_share);
    } else {
      text += ",,,,,,,\n";
    }
  }
  return text;
}

}  // namespace

int modes_command(const scene::Scene& scene, const ModesRequest& request, std::ostream& out) {
  if (!(request.up_to > 0 && std::isfinite(request.up_to)))
    throw InputError(fmt::format("--up-to {}: a frequency above 0 is wanted, in Hz, e.g. --up-to 5000", request.up_to));
  check_files(scene, request);
  const ModeScene wanted = mode_scene(scene, request.parts);
  Model model;
  std::vector<std::string> notes;
  build_model(wanted.scene, assemble(wanted.scene, notes), model);
  for (const std::string& note : notes) out << "note: " << note << '\n';
  for (const std::string& doubt : mesh_doubts(model, model.contacts, model.step_size))
    out << "warning: " << doubt << '\n';
  out << fmt::format("{} elements, {} nodes\n", model.element_count(), model.node_count());
  for (const std::string& note : wanted.notes) out << "note: " << note << '\n';
  out.flush();  // the rest may take minutes
  const ModeList list = modes_below(model, request.up_to);

  out << fmt::format("{} free directions; factor of {:.1f} million entries\n", list.unknowns,
                     1e-6 * static_cast<double>(list.factor_entries));
  if (list.solves.before > 0)
    out << fmt::format("solves: relative residual {:.1e} at most{}\n", list.solves.before,
                       list.solves.refinements == 0 ? ""
                                                    : fmt::format(", {:.1e} after {} refinements or fewer",
                                                                  list.solves.after, list.solves.refinements));
  const bool round =
      std::any_of(list.modes.begin(), list.modes.end(), [](const Mode& mode) { return mode.round.has_value(); });
  if (round) out << "names: direction of most motion (nodal circles, nodal diameters)\n";
  print(model.scene, list.modes, model.scene.parts.size() + model.scene.points.size() > 1, out);
  warn_of_hourglass(model.scene, list.modes, out);
  const auto rigid = std::count_if(list.modes.begin(), list.modes.end(), [](const Mode& mode) { return mode.rigid; });
  out << fmt::format("all {} modes below {:g} Hz, counted by inertia{}\n", list.modes.size(), request.up_to,
                     rigid > 0 ? fmt::format("; {} of them rigid motions", rigid) : "");
  try {
    if (request.csv) write_whole_file(*request.csv, csv_of(model.scene, list.modes), mode_table());
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(fmt::format("the table was not written: {}", error.what()));
  }
  if (request.shapes) {
    write_mode_file(model, list, *request.shapes);
    out << fmt::format("shapes: {} and {}\n", *request.shapes, xdmf_path(*request.shapes));
  }
  return 0;
}

}  // namespace railwave
