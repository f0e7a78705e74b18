#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "deck/conversion.hpp"
#include "mesh/vectors.hpp"

namespace railwave::deck {
namespace {

struct SideSurface {
  int body;
  std::vector<Face> faces;
  std::string name;  ///< "body.set"
};

double mean_area(const Conversion& conversion, const std::vector<Face>& faces) {
  double area = 0;
  for (const Face& face : faces) {
    const auto n = conversion.bodies.mesh().face_nodes(face);
    const auto& x = conversion.bodies.mesh().nodes;
    area += 0.5 * length(cross(difference(x[n[2]], x[n[0]]), difference(x[n[3]], x[n[1]])));
  }
  return area / static_cast<double>(std::max<std::size_t>(1, faces.size()));
}

/// Outside faces with all nodes in a set.
std::vector<Face> faces_among(Conversion& conversion, Number set, const Source& source) {
  const auto nodes = conversion.members({set, true}, source);
  std::vector<Face> faces;
  std::set<int> covered;
  for (const Face& face : conversion.bodies.exterior()) {
    const auto corners = conversion.bodies.mesh().face_nodes(face);
    if (!std::all_of(corners.begin(), corners.end(),
                     [&](int n) { return std::binary_search(nodes.begin(), nodes.end(), n); }))
      continue;
    faces.push_back(face);
    covered.insert(corners.begin(), corners.end());
  }
  std::size_t outside = 0;
  for (const int n : nodes)
    if (covered.count(n) == 0) ++outside;
  if (outside > 0)
    conversion.report.refuse(source, "CONTACT.NODES",
                             fmt::format("{} of {} nodes of set {} are not corners of an outside face whose other "
                                         "corners are in the set too: surfaces of contact are made of faces",
                                         outside, nodes.size(), set));
  return faces;
}

std::vector<SideSurface> surfaces_of(Conversion& conversion, const Contact& contact, const Side& side) {
  const Source& source = contact.source;
  std::vector<Face> faces;
  std::string name;
  if (side.number == 0 || side.type == 5) {
    for (const Face& face : conversion.bodies.exterior())
      if (static_cast<std::size_t>(face.element) < conversion.deck.own_elements) faces.push_back(face);
    name = "skin";
  } else if (side.type == 0) {
    faces = conversion.faces_of_set(side.number, source);
    name = conversion.name_of_segments(side.number);
  } else if (side.type == 2 || side.type == 3) {
    faces = conversion.skin_of(conversion.parts_of(side.number, side.type == 2, source));
    name = fmt::format("{}_{}_skin", side.type == 2 ? "parts" : "part", side.number);
  } else if (side.type == 4) {
    faces = faces_among(conversion, side.number, source);
    name = fmt::format("nodes_{}_faces", side.number);
  } else {
    conversion.fail(source,
                    fmt::format("a side of type {} isn't read, only 0 (segments), 2 and 3 (parts), 4 (nodes) and "
                                "5 (all)",
                                side.type));
  }
  if (faces.empty())
    conversion.fail(source, fmt::format("side {} (type {}) has no outside faces of hexahedra", side.number, side.type));
  std::vector<SideSurface> surfaces;
  for (const auto& [body, of_body] : conversion.by_body(faces))
    surfaces.push_back({body, of_body, conversion.mesh.surface(body, of_body, name)});
  return surfaces;
}

class Contacts {
 public:
  explicit Contacts(Conversion& conversion) : conversion_(conversion) {}

  void write(const Contact& contact) {
    first_ = names_.size();
    auto slaves = surfaces_of(conversion_, contact, contact.slave);
    if (contact.kind == Contact::Kind::single) {
      write_single(contact, slaves);
    } else {
      auto masters = surfaces_of(conversion_, contact, contact.master);
      const bool both_ways =
          contact.source.keyword.find("ONE_WAY") == std::string::npos && contact.kind == Contact::Kind::surfaces;
      if (both_ways && slaves.size() == 1 && masters.size() == 1 &&
          mean_area(conversion_, slaves[0].faces) > 1.001 * mean_area(conversion_, masters[0].faces)) {
        std::swap(slaves, masters);
        conversion_.report.add(Fate::replaced, contact.source,
                               "slave and master change places: the finer is the slave");
      }
      for (const SideSurface& slave : slaves) write_pairs(contact, slave, masters);
    }
    summarise(contact);
  }

 private:
  bool tied(const Contact& contact) const { return contact.kind == Contact::Kind::tied; }

  void write_single(const Contact& contact, const std::vector<SideSurface>& all) {
    if (all.size() == 1) {
      conversion_.report.refuse(contact.source, "CONTACT.SELF", "a body's contact with itself isn't here");
      return;
    }
    conversion_.report.add(Fate::dropped, contact.source,
                           "each body's contact with itself: none folds onto itself here");
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t k = i + 1; k < all.size(); ++k) {
        if (conversion_.bodies.joined(all[i].body, all[k].body)) {
          conversion_.report.add(Fate::dropped, contact.source, "contact between bodies that are grown together");
          continue;
        }
        const bool finer = mean_area(conversion_, all[i].faces) <= mean_area(conversion_, all[k].faces);
        write_section(contact, finer ? all[i] : all[k], {finer ? all[k] : all[i]});
      }
  }

  /// One section with all masters but the slave's own body.
  void write_pairs(const Contact& contact, const SideSurface& slave, const std::vector<SideSurface>& masters) {
    std::vector<SideSurface> others;
    for (const SideSurface& master : masters) {
      if (master.body == slave.body)
        conversion_.report.refuse(
            contact.source, "CONTACT.SELF",
            fmt::format("both sides are of [parts.{}], and a body's contact with itself isn't here",
                        conversion_.bodies.all()[slave.body].name));
      else if (conversion_.bodies.joined(master.body, slave.body))
        conversion_.report.add(Fate::dropped, contact.source, "contact between bodies that are grown together");
      else
        others.push_back(master);
    }
    if (others.empty()) return;
    if (!tied(contact)) return write_section(contact, slave, others);
    for (const SideSurface& other : others) write_tie(contact, slave, other);
  }

  /// Of the slave, what lies on the master is tied.
  void write_tie(const Contact& contact, const SideSurface& slave, const SideSurface& master) {
    std::size_t left_out = 0;
    SideSurface near = slave;
    near.faces = faces_on(conversion_.bodies.mesh(), slave.faces, master.faces, left_out);
    if (left_out > 0)
      conversion_.report.add(Fate::dropped, contact.source,
                             fmt::format("{} nodes on the master that are corners of no face on it", left_out));
    if (near.faces.empty()) {
      conversion_.report.add(
          Fate::dropped, contact.source,
          fmt::format("no face of [parts.{}] lies on [parts.{}]", body_name(slave), body_name(master)));
      return;
    }
    if (near.faces.size() < slave.faces.size())
      near.name = conversion_.mesh.surface(slave.body, near.faces, fmt::format("on_{}", body_name(master)));
    write_section(contact, near, {master});
  }

  const std::string& body_name(const SideSurface& side) const { return conversion_.bodies.all()[side.body].name; }

  void write_section(const Contact& contact, const SideSurface& slave, const std::vector<SideSurface>& masters) {
    CaseText& text = conversion_.text;
    const std::string name = conversion_.bodies.new_name(contact.title, fmt::format("contact_{}", ++count_));
    names_.push_back(name);
    text.section((tied(contact) ? "ties." : "contacts.") + name);
    text.key("slave", toml(slave.name));
    std::vector<std::string> of_masters;
    for (const SideSurface& master : masters) of_masters.push_back(master.name);
    text.key("master", of_masters.size() == 1 ? toml(of_masters[0]) : toml(of_masters));
    if (tied(contact)) return;
    write_friction(contact);
  }

  void write_friction(const Contact& contact) {
    CaseText& text = conversion_.text;
    if (contact.friction < 0 || contact.dynamic_friction < 0)
      return conversion_.report.refuse_always(
          contact.source, "FS or FD is below 0: friction from parts or tables isn't read; give its coefficient");
    text.key("friction", contact.friction);
    if (contact.decay <= 0) return;
    if (contact.dynamic_friction >= contact.friction) {
      conversion_.report.add(Fate::replaced, contact.source, "FD is not below FS: friction is constant, FS");
      return;
    }
    text.key("dynamic_friction", contact.dynamic_friction);
    text.key("friction_decay", contact.decay / conversion_.units.velocity());
  }

  void summarise(const Contact& contact) {
    if (names_.size() == first_ && tied(contact))
      conversion_.report.refuse(contact.source, "CONTACT.TIED",
                                "it ties nothing: no face of the slave lies on the master");
    if (names_.size() == first_) return;
    const char* section = tied(contact) ? "ties" : "contacts";
    std::string said = fmt::format("[{}.{}]", section, names_[first_]);
    if (names_.size() - first_ > 1) said += fmt::format(" to [{}.{}]", section, names_.back());
    if (tied(contact)) {
      conversion_.report.add(Fate::taken, contact.source, said);
      return;
    }
    if (contact.dynamic_friction != 0 && contact.dynamic_friction != contact.friction && contact.decay <= 0)
      said += "; without DC friction is FS at any speed";
    if (contact.damping != 0 || contact.penalty_scale != 1) said += "; VDC and SFS are of contact by penalty";
    conversion_.report.add(Fate::replaced, contact.source,
                           said + "; contact by penalty: by Lagrange multipliers where these can be (docs/contact.md)");
  }

  Conversion& conversion_;
  std::vector<std::string> names_;
  std::size_t first_ = 0;
  int count_ = 0;
};

}  // namespace

void write_contacts(Conversion& conversion) {
  Contacts contacts(conversion);
  for (const Contact& contact : conversion.deck.contacts) contacts.write(contact);
}

}  // namespace railwave::deck
