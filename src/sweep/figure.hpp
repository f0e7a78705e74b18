#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "case/complaints.hpp"
#include "case/document.hpp"
#include "case/scene.hpp"
#include "post/contact_command.hpp"

namespace railwave::sweep {

/// What is made of a quantity's values over time; frequency: where its power spectral density is largest.
enum class Take { last, mean, minimum, maximum, largest, rms, frequency };

/// A number that is collected of each member.
struct Figure {
  enum class Source { patch, history, mode };
  std::string name;  ///< its column in the table
  Source source = Source::history;
  std::string contact;   ///< of a patch
  std::string quantity;  ///< of a patch: a column of `railwave contact --csv`; of a history: the channel
  int mode = 0;          ///< number of a natural frequency, from 1
  Take take = Take::last;
  double from = -std::numeric_limits<double>::infinity(), to = std::numeric_limits<double>::infinity();  ///< s
  double low = 0, high = std::numeric_limits<double>::infinity();  ///< Hz: where a frequency is looked for
  case_file::Where where;                                          ///< in the study
};

/// All figures of a study, and how what they need is computed.
struct FigureChoice {
  std::vector<Figure> figures;
  ContactRequest patches;                ///< rolling direction, axle, rolling velocity
  std::vector<std::string> modes_parts;  ///< of `railwave modes`; empty: all
  double modes_up_to = 5000;             ///< Hz
  case_file::Where patches_where, modes_where;

  bool need(Figure::Source source) const;
  bool need_run() const { return need(Figure::Source::patch) || need(Figure::Source::history); }
  bool need_modes() const { return need(Figure::Source::mode); }
  /// Changes when other numbers are to be collected.
  std::string key() const;
};

struct FigureValue {
  std::string name, unit;
  double value = 0;  ///< NaN: not known, such as a creepage where nothing touches
};

const std::vector<std::string>& take_names();

/// "patch.tread.area", "contact.tread.normal_force.z", "mode.1.frequency": fills source, contact, quantity and mode.
/// @return what is wrong; empty: nothing
std::string read_source(const std::string& text, Figure& figure);

/// Those of a study that names none: area, pressure, shear, forces and creepages of each contact at the end, energies.
std::vector<Figure> usual_figures(const std::vector<std::string>& contacts);

/// Reads [figures], [patches] and [modes] of a study; adds to the complaints what is wrong. Without [figures] there are
/// none yet.
FigureChoice read_figures(const case_file::Node& study, case_file::Complaints& complaints);

/// Complains about each key of a table that is not among those known.
void expect_keys(const case_file::Node& table, const std::string& subject, const std::vector<std::string>& known,
                 case_file::Complaints& complaints);

/// Complains about each figure that no run of the scene can have, as far as the case alone shows it: contacts and parts
/// that are not there, outputs that are not written, times beyond its end.
void check_figures(const FigureChoice& choice, const scene::Scene& scene, case_file::Complaints& complaints);

/// Complains about each history that no run of the scene will write. Its meshes are made for that: their sets are known
/// then. Throws InputError where the case asks for histories of sets that no mesh has.
void check_histories(const FigureChoice& choice, scene::Scene scene, case_file::Complaints& complaints);

/// @param results of the member's run; not read unless a figure needs it
/// @param modes the table that `railwave modes --csv` wrote; likewise
/// Throws InputError where the files lack what a figure needs.
std::vector<FigureValue> collect(const FigureChoice& choice, const std::string& results, const std::string& modes);

}  // namespace railwave::sweep
