#include <fmt/format.h>

#include <cmath>

#include "deck/deck_reader.hpp"
#include "mesh/files/text_file.hpp"
#include "mesh/vectors.hpp"

namespace railwave::deck {
namespace {

using Kind = DynaScope::Kind;

void read_curve(Call& call) {
  Curve curve;
  curve.title = call.titled ? call.cards.title() : "";
  const DynaCard card = call.cards.take();
  curve.source = call.cards.source(card);
  const Number number = call.number(card, 0, "LCID", Kind::curve);
  if (card.whole(1, "SIDR") == 1)
    call.reader.report.refuse(curve.source, "DEFINE_CURVE.SIDR",
                              "SIDR 1 has the curve act in dynamic relaxation alone, which isn't read; leave the curve "
                              "out, or set SIDR to 0");
  const double along = card.real(2, "SFA", 1), up = card.real(3, "SFO", 1);
  const double shift = card.real(4, "OFFA"), lift = card.real(5, "OFFO");
  while (call.cards.more()) {
    const DynaCard point = call.cards.take({dyna_point, dyna_point});
    const double abscissa = along * (point.real(0, "A1") + shift), ordinate = up * (point.real(1, "O1") + lift);
    if (!curve.points.empty() && abscissa < curve.points.back()[0])
      call.reader.fail(point.place(), fmt::format("the abscissa {} of curve {} is below the one before; put the points "
                                                  "in order",
                                                  abscissa, number));
    // A jump: the later value holds from there on.
    if (!curve.points.empty() && abscissa == curve.points.back()[0])
      curve.points.back()[0] = std::nextafter(abscissa, -1e300);
    curve.points.push_back({abscissa, ordinate});
  }
  if (curve.points.empty()) call.reader.fail(card.place(), fmt::format("curve {} has no points; add them", number));
  const auto [entry, is_new] = call.reader.deck.curves.emplace(number, curve);
  if (!is_new)
    call.reader.fail(card.place(), fmt::format("curve {} is defined again (first at {}); give each its own number",
                                               number, call.reader.lines.where(entry->second.source.place)));
}

/// x along the first vector; the second lies in the plane of x and y.
bool make_axes(const Vec3& x, const Vec3& in_plane, std::array<Vec3, 3>& axes) {
  const Vec3 z = cross(x, in_plane);
  if (!(length(x) > 0) || !(length(z) > 0)) return false;
  axes[0] = scaled(1 / length(x), x);
  axes[2] = scaled(1 / length(z), z);
  axes[1] = cross(axes[2], axes[0]);
  return true;
}

void keep_axes(Call& call, Number number, const Axes& axes) { call.reader.deck.axes[number] = axes; }

void read_coordinate_system(Call& call) {
  while (call.more()) {
    if (call.titled) call.cards.title();
    const DynaCard first = call.cards.take(), second = call.cards.take();
    const auto at = [](const DynaCard& card, int i) {
      return Vec3{card.real(i, "X"), card.real(i + 1, "Y"), card.real(i + 2, "Z")};
    };
    Axes axes;
    axes.source = call.cards.source(first);
    const Vec3 origin = at(first, 1), on_x = at(first, 4), in_plane = at(second, 0);
    if (first.whole(7, "CIDL") != 0)
      call.reader.report.refuse(axes.source, "DEFINE_COORDINATE_SYSTEM.CIDL",
                                "systems within another (CIDL) aren't read");
    if (!make_axes(difference(on_x, origin), difference(in_plane, origin), axes.axes))
      call.reader.fail(first.place(), "the three points lie on a line; give three that make a plane");
    keep_axes(call, call.number(first, 0, "CID", Kind::define), axes);
  }
}

void read_coordinate_vector(Call& call) {
  while (call.more()) {
    if (call.titled) call.cards.title();
    const DynaCard card = call.cards.take();
    Axes axes;
    axes.source = call.cards.source(card);
    const Vec3 x{card.real(1, "XX"), card.real(2, "YX"), card.real(3, "ZX")};
    const Vec3 in_plane{card.real(4, "XV"), card.real(5, "YV"), card.real(6, "ZV")};
    if (!make_axes(x, in_plane, axes.axes))
      call.reader.fail(card.place(), "the two vectors are parallel or zero; give two that make a plane");
    keep_axes(call, call.number(card, 0, "CID", Kind::define), axes);
  }
}

void read_coordinate_nodes(Call& call) {
  while (call.more()) {
    if (call.titled) call.cards.title();
    const DynaCard card = call.cards.take();
    Axes axes;
    axes.source = call.cards.source(card);
    axes.nodes = {call.number(card, 1, "N1", Kind::node), call.number(card, 2, "N2", Kind::node),
                  call.number(card, 3, "N3", Kind::node)};
    if (card.whole(4, "FLAG") == 1)
      call.reader.report.refuse(axes.source, "DEFINE_COORDINATE_NODES.FLAG",
                                "FLAG 1, axes that go with the nodes, aren't read");
    const std::string direction = lower_case(card.text(5));
    axes.direction = direction == "y" ? 1 : direction == "z" ? 2 : 0;
    keep_axes(call, call.number(card, 0, "CID", Kind::define), axes);
  }
}

void read_vector(Call& call) {
  if (call.titled) call.cards.title();
  while (call.cards.more()) {
    const DynaCard card = call.cards.take();
    Direction direction;
    direction.source = call.cards.source(card);
    for (int i = 0; i < 3; ++i) direction.vector[i] = card.real(4 + i, "head") - card.real(1 + i, "tail");
    if (card.whole(7, "CID") != 0)
      call.reader.report.refuse(direction.source, "DEFINE_VECTOR.CID", "vectors of another system (CID) aren't read");
    call.reader.deck.vectors[call.number(card, 0, "VID", Kind::define)] = direction;
  }
}

void read_orientation(Call& call) {
  if (call.titled) call.cards.title();
  while (call.cards.more()) {
    const DynaCard card = call.cards.take();
    Direction direction;
    direction.source = call.cards.source(card);
    direction.option = card.whole(1, "IOP");
    for (int i = 0; i < 3; ++i) direction.vector[i] = card.real(2 + i, "XT, YT, ZT");
    direction.nodes = {call.number(card, 5, "NID1", Kind::node), call.number(card, 6, "NID2", Kind::node)};
    call.reader.deck.orientations[call.number(card, 0, "VID", Kind::define)] = direction;
  }
}

struct Change {
  std::array<Vec3, 3> matrix{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Vec3 shift{0, 0, 0};
};

/// Turn by an angle in degrees about an axis through a point (Rodrigues).
Change turn(const Vec3& axis, const Vec3& point, double degrees) {
  const double a = degrees * 3.14159265358979323846 / 180, c = std::cos(a), s = std::sin(a);
  const Vec3 n = scaled(1 / length(axis), axis);
  Change change;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) change.matrix[i][j] = (i == j ? c : 0) + (1 - c) * n[i] * n[j];
  change.matrix[0][1] -= s * n[2];
  change.matrix[0][2] += s * n[1];
  change.matrix[1][0] += s * n[2];
  change.matrix[1][2] -= s * n[0];
  change.matrix[2][0] -= s * n[1];
  change.matrix[2][1] += s * n[0];
  for (int i = 0; i < 3; ++i) change.shift[i] = point[i] - dot(change.matrix[i], point);
  return change;
}

void apply(Transformation& all, const Change& next) {
  const Transformation before = all;
  for (int i = 0; i < 3; ++i) {
    all.shift[i] = dot(next.matrix[i], before.shift) + next.shift[i];
    for (int j = 0; j < 3; ++j) {
      all.matrix[i][j] = 0;
      for (int k = 0; k < 3; ++k) all.matrix[i][j] += next.matrix[i][k] * before.matrix[k][j];
    }
  }
}

Change change_of(Call& call, const DynaCard& card) {
  const std::string option = lower_case(card.text(0));
  const auto a = [&](int i) { return card.real(i, "parameter"); };
  Change change;
  if (option == "transl") {
    change.shift = {a(1), a(2), a(3)};
  } else if (option == "scale") {
    for (int i = 0; i < 3; ++i) change.matrix[i][i] = card.real(1 + i, "scale", 1);
    if (change.matrix[0][0] <= 0 || change.matrix[1][1] <= 0 || change.matrix[2][2] <= 0)
      call.reader.fail(card.place(), "SCALE below 0 turns elements inside out; give factors above 0");
  } else if (option == "rotate" && a(7) != 0) {
    const Vec3 axis{a(1), a(2), a(3)};
    if (!(length(axis) > 0)) call.reader.fail(card.place(), "ROTATE has no axis; give its direction");
    change = turn(axis, {a(4), a(5), a(6)}, a(7));
  } else if (!(option == "rotate" && a(4) == 0 && a(5) == 0 && a(6) == 0 && a(1) == 0)) {
    call.reader.fail(card.place(), fmt::format("option {} isn't read, only TRANSL, SCALE and ROTATE about a direction, "
                                               "through a point, by an angle; write the nodes as they are to be",
                                               for_message(card.text(0))));
  }
  return change;
}

void read_transformation(Call& call) {
  if (call.titled) call.cards.title();
  const DynaCard first = call.cards.take();
  Transformation all;
  all.source = call.cards.source(first);
  // The last is applied first.
  std::vector<Change> changes;
  while (call.cards.more()) changes.push_back(change_of(call, call.cards.take()));
  for (auto change = changes.rbegin(); change != changes.rend(); ++change) apply(all, *change);
  call.reader.deck.transformations[call.number(first, 0, "TRANID", Kind::define)] = all;
}

/// Boxes along the axes: number, then lowest and highest x, y, z in turn.
void read_box(Call& call) {
  while (call.more()) {
    const std::string title = call.titled ? call.cards.title() : "";
    const DynaCard card = call.cards.take();
    Box box;
    box.source = call.cards.source(card);
    const Number number = call.number(card, 0, "BOXID", Kind::define);
    for (int i = 0; i < 3; ++i) {
      box.low[i] = card.real(1 + 2 * i, "XMN");
      box.high[i] = card.real(2 + 2 * i, "XMX");
    }
    call.reader.deck.boxes[number] = box;
  }
}

}  // namespace

const std::vector<HandlerEntry>& definition_handlers() {
  static const std::vector<HandlerEntry> all = {{"DEFINE_CURVE", read_curve},
                                                {"DEFINE_COORDINATE_SYSTEM", read_coordinate_system},
                                                {"DEFINE_COORDINATE_VECTOR", read_coordinate_vector},
                                                {"DEFINE_COORDINATE_NODES", read_coordinate_nodes},
                                                {"DEFINE_BOX", read_box},
                                                {"DEFINE_VECTOR", read_vector},
                                                {"DEFINE_SD_ORIENTATION", read_orientation},
                                                {"DEFINE_TRANSFORMATION", read_transformation}};
  return all;
}

}  // namespace railwave::deck
