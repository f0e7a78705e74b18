#include "solve/statics/static_coarse.hpp"

#include <Eigen/Dense>
#include <algorithm>

#include "model/host_copy.hpp"

namespace railwave {
namespace {

/// Elements of an aggregate, at least; more where there would be more aggregates than that: of a compact body E fills
/// up, and its factors take the square of their number. They stay on the host, for which a device waits.
constexpr int least_elements = 16, most_aggregates = on_device ? 300 : 600;
/// A motion counts if its size is that share of the aggregate's largest, squared.
constexpr double least_motion = 1e-8;

}  // namespace

template <class Visit>
void StaticCoarse::each_motion(int row, const Visit& visit) const {
  if (!unknowns_.follows(row)) return visit(Motion{aggregate_[row], &mode_[row]});
  for (const auto& [aggregate, mode] : slaves_.at(row)) visit(Motion{aggregate, &mode});
}

StaticCoarse::StaticCoarse(const Assembly& assembly, const Array<double* [3]>& position, const StaticTangent& tangent)
    : tangent_(tangent), unknowns_(tangent.unknowns()) {
  divide_nodes(assembly);
  lay_modes();
  lay_slaves();
  add_elements(assembly, position);
  std::vector<int> first(count_ + 1, 0), node(aggregate_.size());
  for (int a : aggregate_) ++first[a + 1];
  for (int a = 0; a < count_; ++a) first[a + 1] += first[a];
  std::vector<int> filled(first.begin(), first.end() - 1);
  for (std::size_t n = 0; n < aggregate_.size(); ++n) node[filled[aggregate_[n]]++] = static_cast<int>(n);
  on_device_ = {to_device("first of aggregate", first), to_device("nodes of aggregates", node),
                to_device("aggregate of node", aggregate_), to_device("coarse modes", mode_)};
  coarse_ = unset_array<double*>("coarse coordinates", static_cast<std::size_t>(count_) * modes);
}

/// Each part is halved across its longest side again and again.
void StaticCoarse::divide_nodes(const Assembly& assembly) {
  const auto& elements = assembly.elements;
  aggregate_.assign(unknowns_.rows(), -1);
  std::vector<Vec3> middle(elements.size(), Vec3{0, 0, 0});
  std::vector<int> order(elements.size());
  for (std::size_t e = 0; e < elements.size(); ++e) {
    order[e] = static_cast<int>(e);
    for (int n : elements[e])
      for (int i = 0; i < 3; ++i) middle[e][i] += 0.125 * assembly.nodes[n][i];
  }
  const int largest = std::max(least_elements, static_cast<int>(elements.size()) / most_aggregates);
  for (const auto& part : assembly.parts)
    divide(elements, middle, order, part.first_element, part.first_element + part.element_count, largest);
  for (int& a : aggregate_)
    if (a < 0) a = count_++;
}

void StaticCoarse::divide(const std::vector<CornerNodes>& elements, const std::vector<Vec3>& middle,
                          std::vector<int>& order, int begin, int end, int largest) {
  if (end - begin <= largest) {
    bool any = false;
    for (int k = begin; k < end; ++k)
      for (int n : elements[order[k]])
        if (aggregate_[n] < 0) {
          aggregate_[n] = count_;
          any = true;
        }
    if (any) ++count_;
    return;
  }
  int longest = 0;
  double extent = -1;
  for (int i = 0; i < 3; ++i) {
    double low = 1e300, high = -1e300;
    for (int k = begin; k < end; ++k) {
      low = std::min(low, middle[order[k]][i]);
      high = std::max(high, middle[order[k]][i]);
    }
    if (high - low > extent) {
      extent = high - low;
      longest = i;
    }
  }
  const int half = begin + (end - begin) / 2;
  const auto before = [&](int a, int b) { return std::pair(middle[a][longest], a) < std::pair(middle[b][longest], b); };
  std::nth_element(order.begin() + begin, order.begin() + half, order.begin() + end, before);
  divide(elements, middle, order, begin, half, largest);
  divide(elements, middle, order, half, end, largest);
}

/// Rigid motions about the aggregate's middle, held directions taken out, made orthonormal in the diagonal.
void StaticCoarse::lay_modes() {
  const std::size_t nodes = aggregate_.size();
  const auto position = unknowns_.positions();
  std::vector<Vec3> middle(count_, Vec3{0, 0, 0});
  std::vector<double> members(count_, 0), size(count_, 0);
  for (std::size_t n = 0; n < nodes; ++n) {
    members[aggregate_[n]] += 1;
    for (int i = 0; i < 3; ++i) middle[aggregate_[n]][i] += position[n][i];
  }
  for (int a = 0; a < count_; ++a)
    for (double& x : middle[a]) x /= members[a];
  const auto arm = [&](std::size_t n) {
    const Vec3& c = middle[aggregate_[n]];
    return Eigen::Vector3d(position[n][0] - c[0], position[n][1] - c[1], position[n][2] - c[2]);
  };
  for (std::size_t n = 0; n < nodes; ++n) size[aggregate_[n]] = std::max(size[aggregate_[n]], arm(n).norm());

  using NodeModes = Eigen::Matrix<double, 3, modes>;
  const auto rigid = [&](std::size_t n) {
    const Eigen::Vector3d x = arm(n) / std::max(size[aggregate_[n]], 1e-300);
    NodeModes z;
    z << 1, 0, 0, 0, x[2], -x[1], 0, 1, 0, -x[2], 0, x[0], 0, 0, 1, x[1], -x[0], 0;
    if (const double* p = unknowns_.projection(static_cast<int>(n)))
      z = (Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(p) * z).eval();
    return z;
  };
  std::vector<Block> gram(count_, Block::Zero());
  for (std::size_t n = 0; n < nodes; ++n) {
    const NodeModes z = rigid(n);
    gram[aggregate_[n]] += z.transpose() * z;
  }
  unused_.assign(static_cast<std::size_t>(count_) * modes, 0);
  for (int a = 0; a < count_; ++a) {
    const Eigen::SelfAdjointEigenSolver<Block> eigen(gram[a]);
    Block turn = eigen.eigenvectors();
    for (int m = 0; m < modes; ++m) {
      const double value = eigen.eigenvalues()[m];
      const bool used = value > least_motion * eigen.eigenvalues()[modes - 1] && value > 1e-12;
      turn.col(m) *= used ? 1 / std::sqrt(value) : 0;
      unused_[a * modes + m] = used ? 0 : 1;
    }
    gram[a] = turn;
  }
  mode_.resize(nodes);
  on_host_threads(static_cast<int>(nodes),
                  [&](int n) { Eigen::Map<NodeModes>(mode_[n].data()) = rigid(n) * gram[aggregate_[n]]; });
}

void StaticCoarse::lay_slaves() {
  using NodeModes = Eigen::Matrix<double, 3, modes>;
  for (int n = 0; n < unknowns_.nodes(); ++n) {
    if (!unknowns_.follows(n)) continue;
    auto& own = slaves_[n];
    unknowns_.each_lead(n, [&](const StaticUnknowns::Lead& lead) {
      auto& mode = own.try_emplace(aggregate_[lead.row], RowModes{}).first->second;
      Eigen::Map<NodeModes>(mode.data()) += lead.share * Eigen::Map<const NodeModes>(mode_[lead.row].data());
    });
  }
}

/// Whether the element resists none of its aggregate's rigid motions: nothing holds it, and it has no other.
bool StaticCoarse::is_inside(const CornerNodes& corners) const {
  return std::all_of(corners.begin(), corners.end(), [&](int n) {
    return aggregate_[n] == aggregate_[corners[0]] && !unknowns_.follows(n) && unknowns_.projection(n) == nullptr;
  });
}

void StaticCoarse::add_elements(const Assembly& assembly, const Array<double* [3]>& position) {
  const auto place = to_host(position);
  std::vector<int> crossing;
  for (std::size_t e = 0; e < assembly.elements.size(); ++e)
    if (!is_inside(assembly.elements[e])) crossing.push_back(static_cast<int>(e));
  // So many at a time, as their blocks take ten times their own memory; and in the same memory again, as threads would
  // wait for each other to be given some.
  constexpr int at_once = 4096;
  std::vector<ElementPart> of_element(at_once);
  const int all = static_cast<int>(crossing.size());
  for (int first = 0; first < all; first += at_once) {
    const int count = std::min(at_once, all - first);
    on_host_threads(count, [&](int k) {
      const int e = crossing[first + k];
      find_blocks(assembly.elements[e], tangent_.stiffness_of(e), place, of_element[k]);
    });
    for (int k = 0; k < count; ++k)
      for (const auto& one : of_element[k].blocks)
        of_elements_.try_emplace(one.place, Block::Zero()).first->second += one.block;
  }
}

/// An element's part of E.
void StaticCoarse::find_blocks(const CornerNodes& corners, const ElementStiffness& stiffness,
                               const Array<double* [3]>::HostMirror& place, ElementPart& found) const {
  auto& [motions, touched, blocks] = found;
  motions.clear();
  touched.clear();
  blocks.clear();
  for (int N = 0; N < 8; ++N)
    each_motion(corners[N], [&, &motions = motions, &touched = touched](const Motion& motion) {
      motions.push_back({N, motion});
      if (std::find(touched.begin(), touched.end(), motion.aggregate) == touched.end())
        touched.push_back(motion.aggregate);
    });
  double x[3][7];
  for (int i = 0; i < 3; ++i) {
    double corner_place[8];
    for (int N = 0; N < 8; ++N) corner_place[N] = place(corners[N], i);
    modes_of(corner_place, x[i]);
  }
  for (int column : touched) {
    const std::size_t first = blocks.size();
    for (int row : touched)
      if (row >= column) blocks.push_back({{row, column}, Block::Zero()});
    for (int m = 0; m < modes; ++m) {
      double moved[3][8] = {}, u[3][7], force[3][8];
      for (const auto& at : motions)
        if (at.motion.aggregate == column)
          for (int i = 0; i < 3; ++i) moved[i][at.corner] += (*at.motion.mode)[3 * m + i];
      for (int i = 0; i < 3; ++i) modes_of(moved[i], u[i]);
      stiffness(x, u, force);
      for (std::size_t b = first; b < blocks.size(); ++b)
        for (const auto& at : motions)
          if (at.motion.aggregate == blocks[b].place.first)
            for (int k = 0; k < modes; ++k)
              for (int i = 0; i < 3; ++i) blocks[b].block(k, m) += (*at.motion.mode)[3 * k + i] * force[i][at.corner];
    }
  }
}

void StaticCoarse::add_springs(const SpringCollector& springs, Blocks& blocks) const {
  using Stretch = Eigen::Matrix<double, modes, 1>;
  for (std::size_t s = 0; s < springs.count(); ++s) {
    std::map<int, Stretch> stretch;
    for (int k = springs.first()[s]; k < springs.first()[s + 1]; ++k)
      each_motion(springs.node()[k], [&](const Motion& motion) {
        Stretch& of_aggregate = stretch.try_emplace(motion.aggregate, Stretch::Zero()).first->second;
        for (int m = 0; m < modes; ++m)
          for (int i = 0; i < 3; ++i) of_aggregate[m] += springs.share()[k][i] * (*motion.mode)[3 * m + i];
      });
    for (const auto& [column, right] : stretch)
      for (const auto& [row, left] : stretch) {
        if (row < column) continue;
        blocks.try_emplace({row, column}, Block::Zero()).first->second +=
            springs.stiffness()[s] * left * right.transpose();
      }
  }
}

void StaticCoarse::factor(const SpringCollector& springs) {
  Blocks blocks = of_elements_;
  add_springs(springs, blocks);
  // The modes are orthonormal, so the tangent's shift is one of about its size here too.
  std::vector<double> shift(count_, 0), members(count_, 0);
  for (std::size_t n = 0; n < aggregate_.size(); ++n) {
    shift[aggregate_[n]] += tangent_.shift() * tangent_.diagonal()(n);
    members[aggregate_[n]] += 1;
  }
  for (int a = 0; a < count_; ++a) {
    Block& own = blocks.try_emplace({a, a}, Block::Zero()).first->second;
    for (int m = 0; m < modes; ++m) {
      own(m, m) += shift[a] / members[a];
      if (unused_[a * modes + m] != 0) own(m, m) = 1;
    }
  }
  factors_ = std::make_unique<CoarseFactors>(count_, blocks);
}

void StaticCoarse::precondition(const NodeVector& r, const NodeVector& z) const {
  Kokkos::parallel_for("coarse_restrict", SumTeams(count_ * modes / CoarseRestrict::entries_of_team, threads_of_sum),
                       CoarseRestrict{on_device_, r, coarse_});
  const auto host = to_host(coarse_);
  factors_->solve(host.data());
  Kokkos::deep_copy(coarse_, host);
  Kokkos::parallel_for("coarse_and_fine", Range(0, static_cast<int>(r.extent(0))),
                       CoarseAndFine{on_device_, coarse_, tangent_.inverse_blocks(), r, z});
}

}  // namespace railwave
