#include "modes/shifted_matrix.hpp"

#include <Spectra/SymEigsShiftSolver.h>
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <random>
#include <stdexcept>

namespace railwave {
namespace {

constexpr double tolerance = 1e-10;
constexpr int most_attempts = 6;
constexpr int most_modes = 3000;
constexpr int small_enough_for_full = 240;
constexpr double narrowest = 1e-4;  ///< interval, of the limit: a cluster is not halved

/// x -> (A - sigma I)^-1 x, across the directions that have been found.
class InverseAcross {
 public:
  using Scalar = double;
  InverseAcross(const ShiftedMatrix& matrix, const Eigen::MatrixXd& found) : matrix_(matrix), found_(found) {}

  Eigen::Index rows() const { return matrix_.size(); }
  Eigen::Index cols() const { return matrix_.size(); }
  void set_shift(double) {}  // factorised already
  void perform_op(const double* x, double* y) const {
    const Eigen::VectorXd in = across(Eigen::Map<const Eigen::VectorXd>(x, rows()));
    Eigen::Map<Eigen::VectorXd>(y, rows()) = across(matrix_.solve(in));
  }
  Eigen::VectorXd across(const Eigen::VectorXd& x) const {
    if (found_.cols() == 0) return x;
    return x - found_ * (found_.transpose() * x);
  }

 private:
  const ShiftedMatrix& matrix_;
  const Eigen::MatrixXd& found_;
};

Eigen::VectorXd scattered(int size, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> spread(-1, 1);
  Eigen::VectorXd x(size);
  for (double& value : x) value = spread(generator);
  return x;
}

void append(Eigen::MatrixXd& vectors, const Eigen::VectorXd& column) {
  vectors.conservativeResize(column.size(), vectors.cols() + 1);
  vectors.rightCols(1) = column;
}

/// Factorises at `wanted`, or some steps beside it where the factors would be of no use, as where a part of the matrix
/// that is eliminated first has an eigenvalue there. @return where that is
double shift_near(ShiftedMatrix& matrix, double wanted, double step) {
  const Eigen::VectorXd tried = scattered(matrix.size(), 1);
  for (const int steps : {0, 1, -2}) {
    try {
      matrix.shift_to(wanted + steps * step);
      static_cast<void>(matrix.solve(tried));
      return wanted + steps * step;
    } catch (const InaccurateFactor&) {
      // The next place is tried.
    }
  }
  matrix.shift_to(wanted + 3 * step);
  return wanted + 3 * step;
}

/// The `count` eigenvectors with eigenvalues from low to high.
Eigen::MatrixXd vectors_between(ShiftedMatrix& matrix, double low, double high, int count) {
  const double middle = shift_near(matrix, 0.5 * (low + high), 1e-5 * (high - low));
  Eigen::MatrixXd found(matrix.size(), 0);
  for (int attempt = 0; attempt < most_attempts && found.cols() < count; ++attempt) {
    InverseAcross inverse(matrix, found);
    // The nearest that are left may lie outside, beyond the nearer end.
    const int wanted = std::min<int>(count - static_cast<int>(found.cols()) + attempt, matrix.size() / 3);
    const int basis = std::min(matrix.size(), 2 * wanted + 30);
    Spectra::SymEigsShiftSolver<InverseAcross> solver(inverse, wanted, basis, middle);
    const Eigen::VectorXd start = inverse.across(scattered(matrix.size(), 1 + attempt));
    solver.init(start.data());
    solver.compute(Spectra::SortRule::LargestMagn, 100, tolerance, Spectra::SortRule::SmallestAlge);
    const Eigen::VectorXd values = solver.eigenvalues();
    const Eigen::MatrixXd vectors = solver.eigenvectors();
    Eigen::MatrixXd more = found;
    for (Eigen::Index k = 0; k < values.size(); ++k)
      if (values[k] > low && values[k] < high) append(more, vectors.col(k));
    found = more;
  }
  if (found.cols() != count)
    throw std::runtime_error(fmt::format(
        "{} modes were found between {:.6g} and {:.6g} Hz, where the inertia counts {}; another --up-to may help",
        found.cols(), std::sqrt(std::max(low, 0.0)) / (2 * M_PI), std::sqrt(high) / (2 * M_PI), count));
  return found;
}

class Intervals {
 public:
  Intervals(ShiftedMatrix& matrix, double least, int most)
      : matrix_(matrix), least_(least), most_(most), vectors_(matrix.size(), 0) {}

  int below(double value) {
    matrix_.shift_to(value);
    return matrix_.count_below();
  }

  void search(double low, int below_low, double high, int below_high) {
    const int count = below_high - below_low;
    if (count <= 0) return;
    if (count > most_ && high - low > least_) {
      // Frequencies, not their squares, are spread evenly.
      const double root = 0.5 * (std::sqrt(std::max(low, 0.0)) + std::sqrt(high)),
                   middle = shift_near(matrix_, root * root, 1e-3 * (high - low));
      const int below_middle = matrix_.count_below();
      search(low, below_low, middle, below_middle);
      search(middle, below_middle, high, below_high);
      return;
    }
    const Eigen::MatrixXd found = vectors_between(matrix_, low, high, count);
    vectors_.conservativeResize(matrix_.size(), vectors_.cols() + count);
    vectors_.rightCols(count) = found;
  }

  const Eigen::MatrixXd& vectors() const { return vectors_; }

 private:
  ShiftedMatrix& matrix_;
  double least_;
  int most_;
  Eigen::MatrixXd vectors_;
};

/// The best eigenpairs in the span of vectors (Rayleigh and Ritz).
Eigenpairs refined(const ShiftedMatrix& matrix, const Eigen::MatrixXd& vectors) {
  Eigen::MatrixXd image(vectors.rows(), vectors.cols());
  for (Eigen::Index k = 0; k < vectors.cols(); ++k) image.col(k) = matrix.times(vectors.col(k));
  const Eigen::MatrixXd H = vectors.transpose() * image, G = vectors.transpose() * vectors;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(0.5 * (H + H.transpose()), G);
  return {solver.eigenvalues(), vectors * solver.eigenvectors()};
}

}  // namespace

Eigenpairs eigenpairs_below(ShiftedMatrix& matrix, double limit, int most) {
  if (matrix.size() <= small_enough_for_full) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix.full());
    const Eigen::Index count = (solver.eigenvalues().array() < limit).count();
    return {solver.eigenvalues().head(count), solver.eigenvectors().leftCols(count)};
  }
  Intervals intervals(matrix, narrowest * limit, most);
  const int count = intervals.below(limit);
  if (count > most_modes)
    throw std::runtime_error(
        fmt::format("{} modes lie below {:.6g} Hz, more than the {} that are sought at once; ask for a lower --up-to",
                    count, std::sqrt(limit) / (2 * M_PI), most_modes));
  // Rigid motions lie at 0, and by rounding a little below it.
  intervals.search(-0.5 * narrowest * limit, 0, limit, count);
  if (intervals.vectors().cols() == 0) return {Eigen::VectorXd(0), intervals.vectors()};
  return refined(matrix, intervals.vectors());
}

}  // namespace railwave
