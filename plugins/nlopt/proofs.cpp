#include "proofs.hpp"

#include <algorithm>
#include <cmath>

#include "switchyard/problem.hpp"

namespace switchyard::nlopt {
namespace {

using Eigen::Index;

/// How many sides are finite.
Index Count(const sy_problem& p) {
  const auto finite = [](double side) { return std::isfinite(side); };
  return std::count_if(p.x_lower, p.x_lower + p.num_vars, finite) +
         std::count_if(p.x_upper, p.x_upper + p.num_vars, finite) +
         std::count_if(p.row_lower, p.row_lower + p.num_rows, finite) +
         std::count_if(p.row_upper, p.row_upper + p.num_rows, finite);
}

/// The sides of bounds and rows as normal'x >= level, one column each.
class Sides {
 public:
  Sides(const sy_problem& p, Index more)
      : p_(p),
        normals_(Eigen::MatrixXd::Zero(p.num_vars, Count(p) + more)),
        level_(Eigen::VectorXd::Zero(normals_.cols())) {
    if (p.A != nullptr) by_row_ = Transpose(*p.A);
  }

  /// Each finite side, with `level(side, sign)` of it.
  template <class Level>
  void AddAll(Level&& level) {
    const auto both = [&](std::int32_t k, double lower, double upper, bool row) {
      if (std::isfinite(lower)) Add(k, 1, level(k, lower, 1, row), row);
      if (std::isfinite(upper)) Add(k, -1, level(k, upper, -1, row), row);
    };
    for (std::int32_t i = 0; i < p_.num_rows; ++i) both(i, p_.row_lower[i], p_.row_upper[i], true);
    for (std::int32_t j = 0; j < p_.num_vars; ++j) both(j, p_.x_lower[j], p_.x_upper[j], false);
  }
  void Add(const Eigen::VectorXd& normal, double level) {
    normals_.col(count_) = normal;
    level_[count_++] = level;
  }

  [[nodiscard]] const Eigen::MatrixXd& normals() const { return normals_; }
  [[nodiscard]] const Eigen::VectorXd& level() const { return level_; }
  [[nodiscard]] const std::vector<std::int32_t>& row() const { return row_; }
  [[nodiscard]] const std::vector<double>& sign() const { return sign_; }

 private:
  void Add(std::int32_t k, double sign, double level, bool is_row) {
    if (is_row) {
      const auto at = static_cast<std::size_t>(k);
      for (std::int32_t e = by_row_.start[at]; e < by_row_.start[at + 1]; ++e) {
        const auto entry = static_cast<std::size_t>(e);
        normals_(by_row_.row[entry], count_) = sign * by_row_.value[entry];
      }
    } else {
      normals_(k, count_) = sign;
    }
    row_.push_back(is_row ? k : -1);
    sign_.push_back(sign);
    level_[count_++] = level;
  }

  const sy_problem& p_;
  Csc by_row_;
  Eigen::MatrixXd normals_;
  Eigen::VectorXd level_;
  std::vector<std::int32_t> row_;  // of each side; -1: of a bound
  std::vector<double> sign_;       // +1: a lower one
  Index count_ = 0;
};

/// Is the matrix of the sides small enough?
bool Fits(const sy_problem& p, Index columns) {
  return static_cast<double>(p.num_vars) * static_cast<double>(columns) <= kMostEntries;
}

/// Is what the certificate's sides sum to more than the rounding errors of their sum?
bool StandsOut(const sy_problem& p, const linear::Duals& duals) {
  double size = 0;
  const auto add = [&size](const std::vector<double>& d, const double* lower, const double* upper) {
    for (std::size_t k = 0; k < d.size(); ++k) {
      size += std::abs(linear::Side(d[k], lower[k], upper[k]));
    }
  };
  add(duals.x, p.x_lower, p.x_upper);
  add(duals.row, p.row_lower, p.row_upper);
  constexpr double kNoise = 1e-10;
  return linear::Sides(p, duals) > kNoise * size;
}

/// Is Pd = 0, but for rounding errors?
bool IsFlat(const sy_problem& p, const std::vector<double>& d) {
  if (p.P == nullptr) return true;
  constexpr double kFlat = 1e-9;
  std::vector<double> curved(d.size(), 0.0);
  SymmetricMultiplyAdd(*p.P, 1, d.data(), curved.data());
  const double largest =
      std::abs(*std::max_element(p.P->value, p.P->value + p.P->start[p.num_vars],
                                 [](double a, double b) { return std::abs(a) < std::abs(b); }));
  return std::all_of(curved.begin(), curved.end(),
                     [&](double c) { return std::abs(c) <= kFlat * (1 + largest); });
}

}  // namespace

std::optional<linear::Duals> SeekFarkas(const sy_problem& problem, const std::vector<double>& x,
                                        const Stop& stop) {
  if (!Fits(problem, Count(problem))) return std::nullopt;
  std::vector<double> value(static_cast<std::size_t>(problem.num_rows), 0.0);
  if (problem.A != nullptr) MultiplyAdd(*problem.A, 1, x.data(), value.data());
  Sides sides(problem, 0);
  sides.AddAll([&](std::int32_t k, double side, double sign, bool row) {
    return sign * (side - (row ? value : x)[static_cast<std::size_t>(k)]);
  });
  const auto decided = Decide(sides.normals(), sides.level(), stop);
  if (!decided || decided->x) return std::nullopt;
  std::vector<double> ray(static_cast<std::size_t>(problem.num_rows), 0.0);
  for (std::size_t k = 0; k < sides.row().size(); ++k) {
    if (sides.row()[k] < 0) continue;
    ray[static_cast<std::size_t>(sides.row()[k])] +=
        sides.sign()[k] * decided->u[static_cast<Index>(k)];
  }
  auto farkas = linear::Farkas(problem, ray);
  if (farkas && !StandsOut(problem, *farkas)) farkas.reset();
  return farkas;
}

std::optional<std::vector<double>> SeekRay(const sy_problem& problem, const Stop& stop) {
  const Index n = problem.num_vars;
  const Eigen::VectorXd q = Eigen::Map<const Eigen::VectorXd>(problem.q, n);
  const double slope = q.norm();
  if (problem.nlp != nullptr || slope == 0) return std::nullopt;
  const Index more = 1 + (problem.P != nullptr ? 2 * n : 0);
  if (!Fits(problem, Count(problem) + more)) return std::nullopt;
  Sides sides(problem, more);
  sides.AddAll([](std::int32_t, double, double, bool) { return 0.0; });
  for (Index j = 0; problem.P != nullptr && j < n; ++j) {
    Eigen::VectorXd column = Eigen::VectorXd::Zero(n);
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(n, j);
    SymmetricMultiplyAdd(*problem.P, 1, unit.data(), column.data());
    sides.Add(column, 0);
    sides.Add(-column, 0);
  }
  sides.Add(-q / slope, 1);
  const auto decided = Decide(sides.normals(), sides.level(), stop);
  if (!decided || !decided->x) return std::nullopt;
  auto ray = linear::FallingRay(problem, {decided->x->begin(), decided->x->end()});
  if (ray && !IsFlat(problem, *ray)) ray.reset();
  return ray;
}

}  // namespace switchyard::nlopt
