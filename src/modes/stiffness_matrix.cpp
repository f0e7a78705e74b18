#include "modes/stiffness_matrix.hpp"

#include <map>

#include "model/host_copy.hpp"
#include "model/time_step/tangent_operator.hpp"

namespace railwave {
namespace {

using Position = Array<double* [3]>::HostMirror;
using Block = Eigen::Matrix<double, 24, 24>;

/// Columns are the corner forces (row 3 N + i) of unit displacements of corners.
Block element_matrix(const ElementStiffness& stiffness, const CornerNodes& corners, const Position& position) {
  double x[3][7];
  for (int i = 0; i < 3; ++i) {
    double place[8];
    for (int N = 0; N < 8; ++N) place[N] = position(corners[N], i);
    modes_of(place, x[i]);
  }
  Block block;
  for (int N = 0; N < 8; ++N)
    for (int j = 0; j < 3; ++j) {
      double u[3][7] = {}, force[3][8];
      for (int mode = 0; mode < 7; ++mode) u[j][mode] = mode_sign(mode, N);
      stiffness(x, u, force);
      for (int K = 0; K < 8; ++K)
        for (int i = 0; i < 3; ++i) block(3 * K + i, 3 * N + j) = force[i][K];
    }
  return block;
}

class Collector {
 public:
  Collector(const ModeUnknowns& unknowns, int extra) : unknowns_(unknowns), rows_(unknowns.count() + extra) {}

  void reserve(std::size_t entries) { entries_.reserve(entries); }

  void add_element(const Block& block, const CornerNodes& corners) {
    for (int A = 0; A < 8; ++A)
      unknowns_.each(corners[A], [&](int row, const ModeUnknowns::Shares& of_row) {
        for (int B = 0; B < 8; ++B)
          unknowns_.each(corners[B], [&](int column, const ModeUnknowns::Shares& of_column) {
            if (row < column) return;
            const Eigen::Matrix3d part = block.block<3, 3>(3 * A, 3 * B);
            for (int i = 0; i < of_row.cols(); ++i)
              for (int j = 0; j < of_column.cols(); ++j)
                add(row + i, column + j, of_row.col(i).dot(part * of_column.col(j)));
          });
      });
  }

  void add(int row, int column, double value) {
    if (row >= column) entries_.emplace_back(row, column, value);
  }

  /// Every diagonal place is there, for shifts.
  Eigen::SparseMatrix<double> matrix() {
    for (int k = 0; k < rows_; ++k) add(k, k, 0);
    Eigen::SparseMatrix<double> lower(rows_, rows_);
    lower.setFromTriplets(entries_.begin(), entries_.end());
    return lower;
  }

 private:
  const ModeUnknowns& unknowns_;
  int rows_;
  std::vector<Eigen::Triplet<double>> entries_;
};

}  // namespace

std::vector<ElementStiffness> mode_stiffness(const AssembledScene& assembled) {
  std::vector<ElementStiffness> stiffness;
  for (std::size_t p = 0; p < assembled.assembly.parts.size(); ++p)
    stiffness.push_back(
        settling_stiffness(assembled.scene.parts[p], assembled.scene.materials[assembled.assembly.parts[p].material]));
  return stiffness;
}

SpringCollector mode_springs(const scene::Scene& scene, const std::vector<ConnectorCell>& cells,
                             const std::shared_ptr<BeamModel>& beams, const NodeArrays& nodes) {
  SpringCollector springs;
  springs.add_connectors(scene, cells);
  springs.add_beams(beams, nodes, false);
  return springs;
}

StiffnessMatrix stiffness_matrix(const AssembledScene& assembled, const NodeArrays& nodes, const ModeUnknowns& unknowns,
                                 const SpringCollector& springs, int most) {
  std::vector<std::map<int, double>> stretches(springs.count());
  StiffnessMatrix result;
  for (std::size_t s = 0; s < springs.count(); ++s) {
    for (int k = springs.first()[s]; k < springs.first()[s + 1]; ++k) {
      const Eigen::Vector3d own(springs.share()[k].data());
      unknowns.each(springs.node()[k], [&](int first, const ModeUnknowns::Shares& shares) {
        for (int i = 0; i < shares.cols(); ++i) stretches[s][first + i] += shares.col(i).dot(own);
      });
    }
    if (springs.stiffness()[s] == 0) stretches[s].clear();
    if (static_cast<int>(stretches[s].size()) > most) ++result.extra;
  }

  Collector collector(unknowns, result.extra);
  collector.reserve(300 * assembled.assembly.elements.size() + static_cast<std::size_t>(unknowns.count()));
  const auto stiffness = mode_stiffness(assembled);
  const auto position = to_host(nodes.position);
  for (std::size_t p = 0; p < assembled.assembly.parts.size(); ++p) {
    const auto& range = assembled.assembly.parts[p];
    for (int e = range.first_element; e < range.first_element + range.element_count; ++e) {
      const CornerNodes& corners = assembled.assembly.elements[e];
      collector.add_element(element_matrix(stiffness[p], corners, position), corners);
    }
  }
  int extra = unknowns.count();
  for (std::size_t s = 0; s < springs.count(); ++s) {
    const auto& stretch = stretches[s];
    const double k = springs.stiffness()[s];
    if (static_cast<int>(stretch.size()) > most) {
      collector.add(extra, extra, -k);
      for (const auto& [column, share] : stretch) collector.add(extra, column, k * share);
      ++extra;
      continue;
    }
    for (const auto& [row, of_row] : stretch)
      for (const auto& [column, of_column] : stretch) collector.add(row, column, k * of_row * of_column);
  }
  result.lower = collector.matrix();
  return result;
}

}  // namespace railwave
