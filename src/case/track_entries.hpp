#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "case/complaints.hpp"
#include "case/scene.hpp"

namespace railwave::case_file {

/// m: the sides of a box that bounds nothing.
inline constexpr double unbounded = 1e3;

/// Adds an entry that a section makes; complains of a name that is there already.
/// @param subject the section, and `line` its line
template <class Entry>
void add_entry(std::vector<Entry>& entries, const char* section, Entry entry, int line, const std::string& subject,
               Complaints& complaints) {
  entry.line = line;
  if (const Entry* other = find_entry(entries, entry.name)) {
    complaints.add({line}, fmt::format("{}: makes [{}.{}], which is there already (line {}); rename one", subject,
                                       section, entry.name, other->line));
    return;
  }
  entries.push_back(std::move(entry));
}

/// Adds what a track makes to the scene, under names that begin with the track's, or with a prefix of one of its rails.
class TrackEntries {
 public:
  TrackEntries(scene::Scene& into, const scene::Track& of, Complaints& complaints, const std::string& prefix = "")
      : scene(into), track(of), complaints_(complaints), prefix_(prefix.empty() ? of.name : prefix) {}

  scene::Scene& scene;
  const scene::Track& track;

  std::string own(const std::string& what) const { return prefix_ + "_" + what; }
  std::string own(const char* what, int number) const { return fmt::format("{}_{}_{}", prefix_, what, number); }

  /// Complains of a name that is there already.
  template <class Entry>
  void add(std::vector<Entry>& entries, const char* section, Entry entry) {
    add_entry(entries, section, std::move(entry), track.line, subject(), complaints_);
  }

  void add_part(const std::string& name, const std::string& mesh, const std::string& material,
                const scene::Vec3& position) {
    scene::Part part;
    part.name = name;
    part.mesh = mesh;
    part.material = material;
    part.position = position;
    part.mirror = track.mirror;
    part.take_hourglass(track.hourglass);
    add(scene.parts, "parts", part);
  }

  void complain(const std::string& what) { complaints_.add({track.line}, subject() + ": " + what); }

 private:
  std::string subject() const { return "[tracks." + track.name + "]"; }

  Complaints& complaints_;
  std::string prefix_;
};

/// A place where a rail lies on a sleeper.
struct RailSeat {
  double x = 0;                         ///< m, of its middle, in the track's own axes
  std::string sleeper;                  ///< part
  std::string rail;                     ///< part, and its mesh
  double rail_start = 0, rail_end = 0;  ///< m
  std::string pad_material;             ///< of a solid pad
  int number = 0;
};

/// Adds the fastening of a seat: connector `NAME_fastening_K`; with a solid pad part `NAME_pad_K`, tied to foot and
/// sleeper, and that connector if the pad leaves anything to it.
/// @param kind of the sleeper, with everything said
void add_fastening(TrackEntries& entries, const scene::Sleeper& kind, const RailSeat& seat);

/// Half the thickness of a rail's web where it is thinnest, m.
double half_web(const std::string& section);

/// The joint at a track's gap: fishplates NAME_fishplate_left and _right (left: towards -y), tied to or in contact with
/// both rails, and bolts. Bolt k is a beam NAME_bolt_k with pretension between points NAME_bolt_k_left and _right
/// beyond the plates' outer sides; thinner beams of the points' names spread its head over the nodes `bolt_k` there.
void add_joint(TrackEntries& entries, const std::string& material);

}  // namespace railwave::case_file
