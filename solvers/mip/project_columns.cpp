#include "solvers/mip/project_columns.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "switchyard/problem.hpp"
#include "switchyard/safe_bound.hpp"

namespace switchyard::mip {
namespace {

using rounding::Duals;

constexpr std::int32_t kMost = 300;  // columns of a projection, whose cost is the cube

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

bool IsPowerOfTwo(double v) {
  int exponent;
  return std::abs(std::frexp(v, &exponent)) == 0.5;
}

/// A row of A, or of F in a cone that is a product of half-lines or points.
struct Row {
  bool is_cone = false;
  std::int32_t index = 0;
  bool below = false, above = false;                     // has a lower side, an upper one
  std::vector<std::pair<std::int32_t, double>> entries;  // of J, by their places in it
};

class Projection {
 public:
  Projection(const sy_problem& p, const std::vector<double>& lower,
             const std::vector<double>& upper, const Duals& duals)
      : p_(p) {
    FindColumns(lower, upper, duals);
    if (columns_.empty() || static_cast<std::int32_t>(columns_.size()) > kMost) return;
    FindRows();
    FindOrder();
  }
  [[nodiscard]] bool empty() const { return rows_.empty(); }

  /// The least move after which A_J'y + F_J'z = q_J, but for rounding; rows of one side give no
  /// more than they have.
  void Project(Duals& duals) const {
    constexpr int kRounds = 3;
    for (int round = 0; round < kRounds; ++round) {
      const auto n = static_cast<Eigen::Index>(columns_.size());
      Eigen::VectorXd rho(n);
      for (Eigen::Index k = 0; k < n; ++k) {
        const Interval at = Residual(columns_[static_cast<std::size_t>(k)], duals);
        rho[k] = (at.lower + at.upper) / 2;
      }
      const std::vector<double> weight = Weights(duals);
      Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(n, n);
      for (std::size_t i = 0; i < rows_.size(); ++i) {
        for (const auto& [k, a] : rows_[i].entries) {
          for (const auto& [l, b] : rows_[i].entries) gram(k, l) += weight[i] * a * b;
        }
      }
      const Eigen::VectorXd u = gram.ldlt().solve(rho);
      if (!u.allFinite()) return;
      for (std::size_t i = 0; i < rows_.size(); ++i) {
        double step = 0;
        for (const auto& [k, a] : rows_[i].entries) step += weight[i] * a * u[k];
        double& dual = DualOf(rows_[i], duals);
        dual = Bearable(rows_[i], dual + step);
      }
    }
  }

  /// The rows of the order have what leaves their columns nothing, after what stands in these is
  /// rounded to multiples of `unit`; 0: as it is. Is every column without ends at 0?
  bool MakeZero(double unit, Duals& duals) const {
    if (unit > 0) Round(unit, duals);
    for (const auto& [at, entry] : order_) {
      const Row& row = rows_[at];
      double& dual = DualOf(row, duals);
      const double old = dual;
      dual = 0;
      const Interval rho = Residual(columns_[At(row.entries[entry].first)], duals);
      dual = rho.lower / row.entries[entry].second;
      if (rho.lower == rho.upper && Bearable(row, dual) == dual) continue;
      dual = old;
      return false;
    }
    return std::all_of(free_.begin(), free_.end(), [&](std::int32_t j) {
      const Interval rho = Residual(j, duals);
      return rho.lower == 0 && rho.upper == 0;
    });
  }

 private:
  static double& DualOf(const Row& row, Duals& duals) {
    return (row.is_cone ? duals.cone : duals.row)[At(row.index)];
  }
  static double Bearable(const Row& row, double dual) {
    return (dual > 0 && !row.below) || (dual < 0 && !row.above) ? 0 : dual;
  }

  template <class Visit>
  static void EachEntry(const sy_csc* m, std::int32_t j, Visit&& visit) {
    for (std::int32_t k = m != nullptr ? m->start[j] : 0; m != nullptr && k < m->start[j + 1];
         ++k) {
      visit(m->row[k], m->value[k]);
    }
  }

  [[nodiscard]] Interval Residual(std::int32_t j, const Duals& duals) const {
    safe_bound_detail::ErrorFreeSum sum;
    if (p_.q != nullptr) sum.Add(p_.q[j]);
    EachEntry(p_.A, j, [&](std::int32_t i, double a) { sum.AddProduct(-a, duals.row[At(i)]); });
    EachEntry(p_.F, j, [&](std::int32_t i, double f) { sum.AddProduct(-f, duals.cone[At(i)]); });
    return sum.Enclosure();
  }

  void FindColumns(const std::vector<double>& lower, const std::vector<double>& upper,
                   const Duals& duals) {
    for (std::int32_t j = 0; j < p_.num_vars; ++j) {
      const double l = lower[At(j)], u = upper[At(j)];
      const bool in_rows = p_.A != nullptr && p_.A->start[j + 1] > p_.A->start[j];
      const bool is_free = l == -kInfinity && u == kInfinity;
      const bool is_open = safe_bound_detail::OpenSize(Residual(j, duals), l, u) > 0;
      if (is_free && (in_rows || is_open)) free_.push_back(j);
      if ((is_free && in_rows) || is_open) columns_.push_back(j);
    }
  }

  void FindRows() {
    const auto side = [](const double* sides, std::int32_t i) {
      return sides != nullptr && std::isfinite(sides[i]);
    };
    for (std::int32_t i = 0; i < p_.num_rows; ++i) {
      rows_.push_back({false, i, side(p_.row_lower, i), side(p_.row_upper, i), {}});
    }
    std::int32_t first = 0;
    for (std::int32_t c = 0; c < p_.num_cones; first += p_.cones[c++].dim) {
      const bool zero = p_.cones[c].kind == SY_CONE_ZERO;
      const bool movable = zero || p_.cones[c].kind == SY_CONE_NONNEGATIVE;
      for (std::int32_t i = first; i < first + p_.cones[c].dim; ++i) {
        rows_.push_back({true, i, movable, zero, {}});
      }
    }
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      const auto place = static_cast<std::int32_t>(k);
      EachEntry(p_.A, columns_[k], [&](std::int32_t i, double a) {
        if (a != 0) rows_[At(i)].entries.emplace_back(place, a);
      });
      EachEntry(p_.F, columns_[k], [&](std::int32_t i, double f) {
        if (f != 0) rows_[At(p_.num_rows + i)].entries.emplace_back(place, f);
      });
    }
    std::erase_if(rows_,
                  [](const Row& row) { return row.entries.empty() || (!row.below && !row.above); });
  }

  /// A forest of rows with two sides that join columns to one another, or to the ground; then a
  /// column of which one row of the forest is left, and that row, again and again.
  void FindOrder() {
    std::vector<std::int32_t> degree(columns_.size(), 0);
    const std::vector<std::size_t> forest = Forest();
    for (const std::size_t i : forest) EachFree(rows_[i], [&](auto k, double) { ++degree[k]; });
    std::vector<std::uint8_t> taken(forest.size(), 0);
    for (bool any = true; any;) {
      any = false;
      for (std::size_t t = 0; t < forest.size(); ++t) {
        if (taken[t] != 0) continue;
        const Row& row = rows_[forest[t]];
        const auto leaf = std::find_if(row.entries.begin(), row.entries.end(), [&](const auto& e) {
          return IsFree(e.first) && degree[At(e.first)] == 1 && IsPowerOfTwo(e.second);
        });
        if (leaf == row.entries.end()) continue;
        order_.emplace_back(forest[t], static_cast<std::size_t>(leaf - row.entries.begin()));
        EachFree(row, [&](auto k, double) { --degree[k]; });
        taken[t] = 1;
        any = true;
      }
    }
  }

  [[nodiscard]] std::vector<std::size_t> Forest() const {
    std::vector<std::size_t> by_size, forest;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (rows_[i].below && rows_[i].above) by_size.push_back(i);
    }
    std::stable_sort(by_size.begin(), by_size.end(), [&](std::size_t a, std::size_t b) {
      return rows_[a].entries.size() < rows_[b].entries.size();
    });
    std::vector<std::size_t> tree(columns_.size() + 1);  // of each column, and of the ground
    std::iota(tree.begin(), tree.end(), std::size_t{0});
    for (const std::size_t i : by_size) {
      std::vector<std::size_t> joined;
      EachFree(rows_[i], [&](auto k, double) { joined.push_back(tree[k]); });
      if (joined.size() == 1) joined.push_back(tree.back());
      std::sort(joined.begin(), joined.end());
      joined.erase(std::unique(joined.begin(), joined.end()), joined.end());
      if (joined.size() < 2) continue;
      forest.push_back(i);
      for (std::size_t& t : tree) {
        if (std::binary_search(joined.begin(), joined.end(), t)) t = joined.front();
      }
    }
    return forest;
  }

  [[nodiscard]] bool IsFree(std::int32_t k) const {
    return std::binary_search(free_.begin(), free_.end(), columns_[At(k)]);
  }
  template <class Visit>
  void EachFree(const Row& row, Visit&& visit) const {
    for (const auto& [k, a] : row.entries) {
      if (IsFree(k)) visit(At(k), a);
    }
  }

  /// Of rows whose dual has one sign, what it has of the largest dual, squared.
  [[nodiscard]] std::vector<double> Weights(const Duals& duals) const {
    double largest = 0;
    for (const double y : duals.row) largest = std::max(largest, std::abs(y));
    std::vector<double> weight;
    for (const Row& row : rows_) {
      const double y = (row.is_cone ? duals.cone : duals.row)[At(row.index)];
      const double share = largest > 0 ? std::min(1.0, std::abs(y) / largest) : 1;
      weight.push_back(row.below && row.above ? 1 : share * share);
    }
    return weight;
  }

  /// What stands in columns without ends: tails of cones towards 0, heads up.
  void Round(double unit, Duals& duals) const {
    std::vector<std::uint8_t> in_rows(At(p_.num_rows), 0), in_cones(At(p_.num_cone_rows), 0);
    for (const std::int32_t j : free_) {
      EachEntry(p_.A, j, [&](std::int32_t i, double) { in_rows[At(i)] = 1; });
      EachEntry(p_.F, j, [&](std::int32_t i, double) { in_cones[At(i)] = 1; });
    }
    for (std::size_t i = 0; i < in_rows.size(); ++i) {
      if (in_rows[i] != 0) duals.row[i] = std::round(duals.row[i] / unit) * unit;
    }
    std::int32_t first = 0;
    for (std::int32_t c = 0; c < p_.num_cones; first += p_.cones[c++].dim) {
      const sy_cone_kind kind = p_.cones[c].kind;
      const std::int32_t heads = kind == SY_CONE_SECOND_ORDER ? 1 : kind == SY_CONE_ROTATED ? 2 : 0;
      const bool linear = kind == SY_CONE_ZERO || kind == SY_CONE_NONNEGATIVE;
      if (heads == 0 && !linear) continue;
      for (std::int32_t i = 0; i < p_.cones[c].dim; ++i) {
        double& y = duals.cone[At(first + i)];
        if (in_cones[At(first + i)] == 0) continue;
        y = (i < heads ? std::ceil(y / unit) : std::trunc(y / unit)) * unit;
      }
    }
  }

  const sy_problem& p_;
  std::vector<std::int32_t> free_, columns_;  // without ends; those and others that are open
  std::vector<Row> rows_;
  std::vector<std::pair<std::size_t, std::size_t>> order_;  // a row, and its entry
};

}  // namespace

void ProjectColumns(const sy_problem& problem, const std::vector<double>& lower,
                    const std::vector<double>& upper, Duals& duals) {
  const Projection projection(problem, lower, upper, duals);
  if (projection.empty()) return;
  projection.Project(duals);
  double largest = 0;
  for (const double y : duals.row) largest = std::max(largest, std::abs(y));
  for (const double y : duals.cone) largest = std::max(largest, std::abs(y));
  int exponent;
  std::frexp(largest, &exponent);
  for (const int digits : {0, 48, 44, 40, 36, 32, 28}) {
    Duals moved = duals;
    const double unit = digits == 0 ? 0 : std::ldexp(1.0, exponent - digits);
    if (!projection.MakeZero(unit, moved)) continue;
    duals = std::move(moved);
    return;
  }
}

}  // namespace switchyard::mip
