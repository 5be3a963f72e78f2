#include "least_squares.hpp"

#include <Eigen/Householder>
#include <Eigen/Jacobi>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace switchyard::nlopt {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Of a column's length, what must be left of it beside the columns in use.
constexpr double kIndependent = 1e-11;

/// W = Q'E and b = Q'f, where the columns in use, in their order, are upper triangular in W.
class ActiveSet {
 public:
  ActiveSet(const MatrixXd& E, const VectorXd& f, const std::vector<std::uint8_t>& free)
      : W_(E), b_(f), free_(free), length_(E.colwise().norm()), u_(VectorXd::Zero(E.cols())) {
    place_.assign(static_cast<std::size_t>(E.cols()), -1);
    barred_.assign(place_.size(), 0);
    used_.reserve(place_.size());
  }

  [[nodiscard]] const VectorXd& u() const { return u_; }

  /// Takes every free column that is independent of those before it.
  void TakeFree() {
    for (Index k = 0; k < W_.cols(); ++k) {
      if (free_[at(k)] != 0 && IsIndependent(k)) Enter(k);
    }
    if (!used_.empty()) Assign(Triangular());
  }

  /// Takes the column along which the residual falls fastest; false where none is left.
  bool Grow() {
    for (;;) {
      const Index best = Steepest();
      if (best < 0) return false;
      if (IsIndependent(best)) {
        Enter(best);
        const VectorXd z = Triangular();
        if (z[z.size() - 1] > 0) {
          Settle(z);
          return true;
        }
        Leave(static_cast<Index>(used_.size()) - 1);
      }
      barred_[at(best)] = 1;
    }
  }

 private:
  static std::size_t at(Index k) { return static_cast<std::size_t>(k); }
  [[nodiscard]] Index rank() const { return static_cast<Index>(used_.size()); }

  [[nodiscard]] Index Steepest() const {
    const Index rest = W_.rows() - rank();
    if (rest == 0) return -1;
    const double noise = 10 * std::numeric_limits<double>::epsilon() * b_.norm();
    const VectorXd slope = W_.bottomRows(rest).transpose() * b_.tail(rest);
    Index best = -1;
    double most = noise;
    for (Index k = 0; k < slope.size(); ++k) {
      if (place_[at(k)] >= 0 || free_[at(k)] != 0 || barred_[at(k)] != 0 || length_[k] == 0) {
        continue;
      }
      if (slope[k] / length_[k] > most) {
        most = slope[k] / length_[k];
        best = k;
      }
    }
    return best;
  }

  [[nodiscard]] bool IsIndependent(Index k) const {
    const Index rest = W_.rows() - rank();
    return rest > 0 && W_.col(k).tail(rest).norm() > kIndependent * length_[k];
  }

  void Enter(Index k) {
    const Index row = rank();
    const Index rest = W_.rows() - row;
    VectorXd tail(rest - 1);
    double tau = 0;
    double diagonal = 0;
    W_.col(k).tail(rest).makeHouseholder(tail, tau, diagonal);
    VectorXd work(W_.cols());
    W_.bottomRows(rest).applyHouseholderOnTheLeft(tail, tau, work.data());
    b_.tail(rest).applyHouseholderOnTheLeft(tail, tau, work.data());
    W_.col(k).tail(rest - 1).setZero();
    place_[at(k)] = row;
    used_.push_back(k);
  }

  /// Those behind move up and are made triangular again, a rotation each.
  void Leave(Index place) {
    place_[at(used_[at(place)])] = -1;
    used_.erase(used_.begin() + place);
    for (Index j = place; j < rank(); ++j) {
      const Index column = used_[at(j)];
      place_[at(column)] = j;
      Eigen::JacobiRotation<double> rotation;
      rotation.makeGivens(W_(j, column), W_(j + 1, column));
      W_.applyOnTheLeft(j, j + 1, rotation.adjoint());
      b_.applyOnTheLeft(j, j + 1, rotation.adjoint());
      W_(j + 1, column) = 0;
    }
  }

  /// The least squares solution over the columns in use, whatever its signs.
  [[nodiscard]] VectorXd Triangular() const {
    VectorXd z = b_.head(rank());
    for (Index j = rank(); j-- > 0;) {
      const auto column = W_.col(used_[at(j)]);
      z[j] /= column[j];
      z.head(j) -= z[j] * column.head(j);
    }
    return z;
  }

  void Assign(const VectorXd& z) {
    for (Index j = 0; j < rank(); ++j) u_[used_[at(j)]] = z[j];
  }

  /// Goes from u towards z as far as signs allow, and leaves behind what reached 0, until z itself
  /// has the signs.
  void Settle(VectorXd z) {
    for (;;) {
      double step = 1;
      Index first = -1;
      for (Index j = 0; j < rank(); ++j) {
        const Index k = used_[at(j)];
        if (free_[at(k)] != 0 || z[j] > 0) continue;
        const double part = u_[k] / (u_[k] - z[j]);
        if (first < 0 || part < step) {
          step = part;
          first = j;
        }
      }
      if (first < 0) break;
      for (Index j = 0; j < rank(); ++j) u_[used_[at(j)]] += step * (z[j] - u_[used_[at(j)]]);
      u_[used_[at(first)]] = 0;
      for (Index j = rank(); j-- > 0;) {
        const Index k = used_[at(j)];
        if (free_[at(k)] != 0 || u_[k] > 0) continue;
        u_[k] = 0;
        Leave(j);
      }
      if (rank() == 0) return;
      z = Triangular();
    }
    Assign(z);
    std::fill(barred_.begin(), barred_.end(), std::uint8_t{0});
  }

  MatrixXd W_;
  VectorXd b_;
  const std::vector<std::uint8_t>& free_;
  const VectorXd length_;
  VectorXd u_;
  std::vector<Index> used_;
  std::vector<Index> place_;          // of each column among those in use; -1: not in use
  std::vector<std::uint8_t> barred_;  // tried from here, and led nowhere
};

}  // namespace

std::optional<LeastSquares> SolveLeastSquares(const MatrixXd& E, const VectorXd& f,
                                              const std::vector<std::uint8_t>& free,
                                              const Stop& stop) {
  ActiveSet set(E, f, free);
  set.TakeFree();
  // In exact arithmetic no set comes twice; with rounding errors it might.
  const Index most = 5 * (E.cols() + E.rows()) + 10;
  for (Index k = 0; k < most && set.Grow(); ++k) {
    if (stop()) return std::nullopt;
  }
  return LeastSquares{set.u(), f - E * set.u()};
}

std::optional<Alternative> Decide(const MatrixXd& G, const VectorXd& h, const Stop& stop) {
  const double scale = h.size() > 0 ? h.maxCoeff() : 0;
  if (scale <= 0) return Alternative{VectorXd::Zero(G.rows()), {}};
  MatrixXd E(G.rows() + 1, G.cols());
  E.topRows(G.rows()) = G;
  E.row(G.rows()) = h.transpose() / scale;
  VectorXd f = VectorXd::Zero(E.rows());
  f[G.rows()] = 1;
  const std::vector<std::uint8_t> free(static_cast<std::size_t>(E.cols()), 0);
  auto solved = SolveLeastSquares(E, f, free, stop);
  if (!solved) return std::nullopt;
  const VectorXd& r = solved->residual;
  // |r| = 1 / |(x, 1)|, so a smaller one means a point that is too far away to be one.
  constexpr double kNone = 1e-9;
  if (r.norm() <= kNone) return Alternative{std::nullopt, std::move(solved->u)};
  return Alternative{VectorXd(-scale * r.head(G.rows()) / r[G.rows()]), {}};
}

}  // namespace switchyard::nlopt
