#include "refine.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace switchyard::nlopt {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Unknowns of a step, and of one whose equations are dependent.
constexpr Index kMostUnknowns = 1200;
constexpr Index kMostByRank = 500;
// Error of its equations, relative.
constexpr double kSolved = 1e-9;
// Step of a difference, relative.
constexpr double kDifference = 1e-7;

/// The equations of the step, where the functions are.
class NewtonEquations {
 public:
  NewtonEquations(const Functions& functions, const Multipliers& m)
      : functions_(functions), y_(m.constraint), place_(m.bound.size(), -1) {
    const sy_problem& p = functions.problem();
    for (std::size_t j = 0; j < place_.size(); ++j) {
      if (m.on_bound[j] != 0 || p.x_lower[j] == p.x_upper[j]) continue;
      place_[j] = static_cast<Index>(moving_.size());
      moving_.push_back(j);
    }
    for (std::size_t i = 0; i < y_.size(); ++i) {
      const auto at = static_cast<std::int32_t>(i);
      if (y_[i] != 0 || functions.lower(at) == functions.upper(at)) held_.push_back(at);
    }
  }

  [[nodiscard]] const std::vector<std::size_t>& moving() const { return moving_; }
  [[nodiscard]] Index size() const { return static_cast<Index>(moving_.size() + held_.size()); }

  /// g - N y of the moving variables.
  [[nodiscard]] VectorXd Rest() const {
    std::vector<double> rest = functions_.gradient();
    MultiplyAdd(functions_.normals().View(), -1, y_.data(), rest.data());
    VectorXd moving(static_cast<Index>(moving_.size()));
    for (Index a = 0; a < moving.size(); ++a) {
      moving[a] = rest[moving_[static_cast<std::size_t>(a)]];
    }
    return moving;
  }

  /// d, by H of the moving variables.
  [[nodiscard]] VectorXd Solve(const MatrixXd& hessian) const {
    const Index n = static_cast<Index>(moving_.size());
    MatrixXd K = MatrixXd::Zero(size(), size());
    VectorXd right(size());
    K.topLeftCorner(n, n) = hessian;
    right.head(n) = -Rest();
    for (Index c = n; c < size(); ++c) {
      const std::int32_t i = held_[static_cast<std::size_t>(c - n)];
      PutNormal(i, c, K);
      const bool at_upper = y_[static_cast<std::size_t>(i)] < 0;
      right[c] = (at_upper ? functions_.upper(i) : functions_.lower(i)) - functions_.value(i);
    }
    // Quick, and right unless H is singular or the normals are dependent.
    const VectorXd quick = K.partialPivLu().solve(right);
    const double error = (K * quick - right).cwiseAbs().maxCoeff();
    if (error <= kSolved * right.cwiseAbs().maxCoeff()) return quick.head(n);
    if (size() > kMostByRank) return VectorXd::Constant(n, std::nan(""));
    return K.completeOrthogonalDecomposition().solve(right).head(n);
  }

 private:
  void PutNormal(std::int32_t constraint, Index column, MatrixXd& K) const {
    const Csc& normals = functions_.normals();
    const auto at = static_cast<std::size_t>(constraint);
    for (std::int32_t k = normals.start[at]; k < normals.start[at + 1]; ++k) {
      const auto entry = static_cast<std::size_t>(k);
      const Index a = place_[static_cast<std::size_t>(normals.row[entry])];
      if (a >= 0) K(a, column) = K(column, a) = normals.value[entry];
    }
  }

  const Functions& functions_;
  const std::vector<double>& y_;
  std::vector<Index> place_;  // of each variable among the moving; -1: it stays
  std::vector<std::size_t> moving_;
  std::vector<std::int32_t> held_;  // constraints
};

/// H by differences of the gradient of the Lagrangian, within the bounds.
std::optional<MatrixXd> Differences(const NewtonEquations& equations, std::vector<double> x,
                                    const Stop& stop, Functions& functions) {
  const sy_problem& p = functions.problem();
  const VectorXd here = equations.Rest();
  MatrixXd H(here.size(), here.size());
  for (Index a = 0; a < H.cols(); ++a) {
    const std::size_t j = equations.moving()[static_cast<std::size_t>(a)];
    const double at = x[j];
    const double step = kDifference * (1 + std::abs(at));
    x[j] = at + step <= p.x_upper[j] ? at + step : std::max(at - step, p.x_lower[j]);
    if (stop() || !functions.DifferentiateAt(x.data())) return std::nullopt;
    H.col(a) = (equations.Rest() - here) / (x[j] - at);
    x[j] = at;
  }
  if (!functions.MoveTo(x.data()) || !functions.Differentiate()) return std::nullopt;
  return MatrixXd(0.5 * (H + H.transpose()));
}

}  // namespace

std::optional<std::vector<double>> NewtonStep(Functions& functions, std::vector<double> x,
                                              const Multipliers& multipliers, const Stop& stop) {
  const sy_problem& p = functions.problem();
  for (std::size_t j = 0; j < x.size(); ++j) {
    if (multipliers.on_bound[j] > 0) x[j] = p.x_lower[j];
    if (multipliers.on_bound[j] < 0) x[j] = p.x_upper[j];
  }
  if (!functions.MoveTo(x.data()) || !functions.Differentiate()) return std::nullopt;
  const NewtonEquations equations(functions, multipliers);
  if (equations.moving().empty() || equations.size() > kMostUnknowns) return x;
  std::optional<MatrixXd> hessian = functions.Hessian(multipliers.constraint);
  hessian = hessian ? MatrixXd((*hessian)(equations.moving(), equations.moving()))
                    : Differences(equations, x, stop, functions);
  if (!hessian) return std::nullopt;
  const VectorXd d = equations.Solve(*hessian);
  if (!d.allFinite()) return std::nullopt;
  for (Index a = 0; a < d.size(); ++a) {
    const std::size_t j = equations.moving()[static_cast<std::size_t>(a)];
    x[j] = std::clamp(x[j] + d[a], p.x_lower[j], p.x_upper[j]);
  }
  return x;
}

}  // namespace switchyard::nlopt
