#pragma once

#include <string>
#include <vector>

#include "case/scene.hpp"
#include "kernels/loads/set_loads.hpp"
#include "kernels/support/spaces.hpp"
#include "model/loads/connector_cells.hpp"
#include "model/parted_lists.hpp"

namespace railwave {

/// A load of fixed direction, a pressure or a torque: its contributions, and the curve it follows.
struct LoadArrays {
  int number = 0;  ///< among the scene's loads
  const scene::Load* load = nullptr;
  const scene::Curve* curve = nullptr;  ///< null: constant 1
  int first = 0;                        ///< its first contribution
  int count = 0;                        ///< contributions (dead loads), facets (pressure)
  Array<double* [3]> amplitude;         ///< dead loads, N
  Array<int* [4]> facets;               ///< pressure
  int set = -1;                         ///< torque
  int torque = -1;                      ///< its number among the torques
  int beam_node = -1;                   ///< of a torque on a node where beams end: its number among those
};

/// Connectors of a scene, with the contributions by which their ends feel them.
struct ConnectorModel {
  std::vector<ConnectorCell> cells;  ///< one for each of the arrays' entries
  ConnectorArrays arrays;
  int first = 0;              ///< contribution
  std::vector<int> cell;      ///< of each contribution
  std::vector<double> share;  ///< weight, negative at `from`
};

/// Nodes of which the histories of sets are the weighted means. A tied node is listed for its displacement, and the
/// corners of the face it lies on for its velocity and acceleration: the scheme has none for it.
struct MotionHistories {
  std::vector<int> first;     ///< of each of LoadModel::history_sets in the arrays, one more than sets
  Array<int*> node;           ///< model node numbers
  Array<double* [2]> weight;  ///< of displacement; of velocity and acceleration
  PartedLists parts;          ///< one list for each set
  Array<int*> driven;         ///< row in `driven_change` of nodes that a prescribed motion moves, else -1; empty: none
  Array<int*> driven_rows;    ///< see PrescribedChange
  Array<double* [6]> driven_change;  ///< of all nodes that prescribed motions move: likewise
};

/// Loads, connectors, and the node sets that both act on or that histories follow.
struct LoadModel {
  NodeSets sets;
  std::vector<int> first_of_set;  ///< in the lists of `sets`, one more than sets
  std::vector<int> history_sets;  ///< set numbers of those of scene.output.history_sets whose motion is written
  MotionHistories motion_histories;
  std::vector<LoadArrays> loads;
  ConnectorModel connectors;
  TorqueArrays torques;
  SetTeams set_teams;
};

/// Nodes of the sets whose motion connectors and torques follow at each step; histories sum theirs block by block.
std::vector<int> nodes_of_moving_sets(const LoadModel& loads);

/// Forces of loads, connectors and beams on nodes: one entry for each force on one node.
struct Contributions {
  std::vector<int> node;
  std::vector<RowShare> share;  ///< from what each gets its force at a step
};

/// The scene's curve of that name; null for an empty name.
const scene::Curve* curve_of(const scene::Scene& scene, const std::string& name);

/// Value of a curve at a time; 1 without a curve.
double curve_value(const scene::Curve* curve, double time);

/// Its integral from 0 to a time of 0 or later, s.
double curve_integral(const scene::Curve* curve, double time);

/// Value of a curve and its first and second derivative by time, from the side of the times before: at a kink or a jump
/// those of the piece that ends there.
struct CurveRates {
  double value, first, second;  ///< 1, 1/s, 1/s2
};

/// @param before s: pieces that begin later than that before `time` do not count yet, so that rounding of times decides
/// nothing; 0: those that begin at `time` do
CurveRates curve_rates(const scene::Curve* curve, double time, double before);

/// What a load's kernel is given of a time: the curve's value times the moment (N m) or the pressure (Pa), of other
/// loads the value alone.
double load_value(const LoadArrays& load, double time);

}  // namespace railwave
