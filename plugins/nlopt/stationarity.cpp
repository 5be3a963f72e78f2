#include "stationarity.hpp"

#include <algorithm>
#include <cmath>

namespace switchyard::nlopt {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A side where a variable or a constraint is, or nearly so.
struct Active {
  std::int32_t of;
  int sign;  // +1: a lower side, -1: an upper one, 0: both, of an equation
  double distance;
};

void AddActive(std::int32_t of, double value, double lower, double upper, double near,
               std::vector<Active>& active) {
  if (lower == upper) {
    active.push_back({of, 0, std::abs(value - lower)});
    return;
  }
  const auto add = [&](double side, int sign) {
    const double distance = std::abs(value - side);
    if (distance <= near * (1 + std::abs(side))) active.push_back({of, sign, distance});
  };
  if (std::isfinite(lower)) add(lower, 1);
  if (std::isfinite(upper)) add(upper, -1);
}

/// min |E u - gradient|: a row for each variable that is not fixed, a column for each active side.
class Conditions {
 public:
  Conditions(const Functions& functions, double near)
      : functions_(functions), place_(functions.x().size(), -1) {
    const sy_problem& p = functions.problem();
    for (std::int32_t i = 0; i < functions.num_constraints(); ++i) {
      AddActive(i, functions.value(i), functions.lower(i), functions.upper(i), near, constraints_);
    }
    for (std::int32_t j = 0; j < p.num_vars; ++j) {
      const auto at = static_cast<std::size_t>(j);
      if (p.x_lower[j] == p.x_upper[j]) continue;
      place_[at] = static_cast<Index>(moving_.size());
      moving_.push_back(at);
      AddActive(j, functions.x()[at], p.x_lower[j], p.x_upper[j], near, bounds_);
    }
    gradient_.resize(static_cast<Index>(moving_.size()));
    for (std::size_t k = 0; k < moving_.size(); ++k) {
      gradient_[static_cast<Index>(k)] = functions.gradient()[moving_[k]];
    }
  }

  [[nodiscard]] std::optional<LeastSquares> Solve(const Stop& stop) const {
    if (constraints_.empty() || moving_.empty()) return EachForItself();
    if (double(gradient_.size()) * double(num_columns()) > kMostEntries) return std::nullopt;
    std::vector<std::uint8_t> free;
    for (const Active& a : constraints_) free.push_back(a.sign == 0 ? 1 : 0);
    free.resize(static_cast<std::size_t>(num_columns()), 0);
    return SolveLeastSquares(Columns(), gradient_, free, stop);
  }

  [[nodiscard]] Multipliers Take(const LeastSquares& solved) const {
    Multipliers m;
    m.constraint.assign(static_cast<std::size_t>(functions_.num_constraints()), 0.0);
    Index column = 0;
    for (const Active& a : constraints_) {
      const double u = solved.u[column++];
      m.constraint[static_cast<std::size_t>(a.of)] += a.sign < 0 ? -u : u;
      m.gap += std::abs(u) * a.distance;
    }
    m.on_bound.assign(functions_.x().size(), 0.0);
    for (const Active& a : bounds_) {
      const double u = solved.u[column++];
      m.on_bound[static_cast<std::size_t>(a.of)] += a.sign * u;
      m.gap += std::abs(u) * a.distance;
    }
    for (std::size_t k = 0; k < moving_.size(); ++k) {
      const double rest = std::abs(solved.residual[static_cast<Index>(k)]);
      m.residual = std::max(m.residual, rest);
      m.gap += rest * std::abs(functions_.x()[moving_[k]]);
    }
    m.residual /= 1 + (moving_.empty() ? 0 : gradient_.cwiseAbs().maxCoeff());
    m.bound = functions_.gradient();
    MultiplyAdd(functions_.normals().View(), -1, m.constraint.data(), m.bound.data());
    return m;
  }

 private:
  [[nodiscard]] Index num_columns() const {
    return static_cast<Index>(constraints_.size() + bounds_.size());
  }
  /// Where there are bounds alone, or constraints alone, of nothing that moves.
  [[nodiscard]] LeastSquares EachForItself() const {
    LeastSquares solved{VectorXd::Zero(num_columns()), gradient_};
    Index column = 0;
    for (const Active& a : bounds_) {
      double& rest = solved.residual[place_[static_cast<std::size_t>(a.of)]];
      const double u = std::max(0.0, a.sign * rest);
      rest -= a.sign * u;
      solved.u[column++] = u;
    }
    return solved;
  }

  [[nodiscard]] MatrixXd Columns() const {
    MatrixXd E = MatrixXd::Zero(gradient_.size(), num_columns());
    const Csc& normals = functions_.normals();
    Index column = 0;
    for (const Active& a : constraints_) {
      const auto at = static_cast<std::size_t>(a.of);
      for (std::int32_t k = normals.start[at]; k < normals.start[at + 1]; ++k) {
        const auto entry = static_cast<std::size_t>(k);
        const Index row = place_[static_cast<std::size_t>(normals.row[entry])];
        if (row >= 0) E(row, column) = (a.sign < 0 ? -1 : 1) * normals.value[entry];
      }
      ++column;
    }
    for (const Active& a : bounds_) E(place_[static_cast<std::size_t>(a.of)], column++) = a.sign;
    return E;
  }

  const Functions& functions_;
  std::vector<std::size_t> moving_;  // variables that are not fixed
  std::vector<Index> place_;         // of each variable among them; -1: fixed
  std::vector<Active> constraints_, bounds_;
  VectorXd gradient_;
};

}  // namespace

std::optional<Multipliers> EstimateMultipliers(Functions& functions, double near,
                                               const Stop& stop) {
  if (!functions.Differentiate()) return std::nullopt;
  const Conditions conditions(functions, near);
  const auto solved = conditions.Solve(stop);
  return solved ? std::optional(conditions.Take(*solved)) : std::nullopt;
}

}  // namespace switchyard::nlopt
