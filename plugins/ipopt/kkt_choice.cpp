#include "kkt_choice.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "pattern_builder.hpp"
#include "solvers/linalg/elimination.hpp"
#include "solvers/linalg/ordering.hpp"

namespace switchyard::ipopt {
namespace {

using linalg::Index;

/// Ipopt's augmented system: variables that are not fixed, slacks, multipliers of equations and of
/// inequalities.
class Augmented {
 public:
  Augmented(const sy_problem& p, const Shape& shape)
      : column_(static_cast<std::size_t>(p.num_vars), -1), row_(shape.is_equation.size()) {
    for (std::int32_t j = 0; j < p.num_vars; ++j) {
      if (p.x_lower[j] != p.x_upper[j]) column_[j] = variables_++;
    }
    const bool none = shape.loosens_equations();
    counts.equations = none ? 0 : shape.equations;
    counts.inequalities = static_cast<Index>(row_.size()) - counts.equations;
    Index equation = variables_ + counts.inequalities;
    Index inequality = equation + counts.equations;
    for (std::size_t i = 0; i < row_.size(); ++i) {
      row_[i] = shape.is_equation[i] != 0 && !none ? equation++ : inequality++;
    }
    entries.n = inequality;
    for (Index j = 0; j < entries.n; ++j) Add(j, j);
    for (Index i = 0; i < counts.inequalities; ++i) {
      Add(inequality - counts.inequalities + i, variables_ + i);
    }
    for (std::size_t k = 0; k < shape.hessian.size(); ++k) {
      Add(column_[shape.hessian.row[k]], column_[shape.hessian.col[k]]);
    }
    for (std::size_t k = 0; k < shape.jacobian.size(); ++k) {
      Add(row_[shape.jacobian.row[k]], column_[shape.jacobian.col[k]]);
    }
  }

  /// Entries of the longest column.
  [[nodiscard]] Index Longest() const {
    std::vector<Index> length(static_cast<std::size_t>(entries.n), 0);
    for (std::size_t k = 0; k < entries.row.size(); ++k) {
      ++length[entries.row[k]];
      if (entries.row[k] != entries.col[k]) ++length[entries.col[k]];
    }
    return length.empty() ? 0 : *std::max_element(length.begin(), length.end());
  }

  CondensedKkt::Counts counts;
  CondensedKkt::Entries entries;

 private:
  void Add(Index i, Index j) {
    if (i < 0 || j < 0) return;
    entries.row.push_back(i);
    entries.col.push_back(j);
  }

  std::vector<Index> column_, row_;
  Index variables_ = 0;
};

/// Multiplications of a factorization of the whole.
double WorkOf(const CondensedKkt::Entries& e) {
  PatternBuilder builder(e.n);
  for (std::size_t k = 0; k < e.row.size(); ++k) builder.Add(e.row[k], e.col[k]);
  builder.Finish();
  const linalg::SymmetricPattern& pattern = builder.pattern();
  return linalg::Eliminate(pattern, linalg::MinimumDegreeOrder(pattern)).Work();
}

/// sum r (r + 1) / 2 over the inequalities of r variables.
double Products(const Augmented& a) {
  std::vector<double> length(static_cast<std::size_t>(a.counts.inequalities), -2.0);
  const Index first = a.entries.n - a.counts.inequalities;
  for (const Index i : a.entries.row) {
    if (i >= first) ++length[i - first];
  }
  return std::accumulate(length.begin(), length.end(), 0.0,
                         [](double sum, double r) { return sum + r * (r + 1) / 2; });
}

}  // namespace

KktShape KktShapeOf(const sy_problem& problem, const Shape& shape) {
  // As AMD calls a column dense.
  constexpr double kDense = 10, kFew = 16;
  // Multiplications in less than the time that MUMPS takes for a column that fills in nothing.
  constexpr double kPerColumn = 1000;
  const Augmented a(problem, shape);
  KktShape found;
  found.counts = a.counts;
  const double longest = a.Longest();
  found.has_dense_column = longest > std::max(kFew, kDense * std::sqrt(double(a.entries.n)));
  const double free = kPerColumn * a.entries.n;
  double limit = free;
  if (Products(a) > limit) limit += WorkOf(a.entries);
  if (Products(a) > limit) return found;
  const auto condensed = CondensedKkt::Make(a.entries, a.counts);
  if (condensed == nullptr) return found;
  if (condensed->work() > limit && limit == free) limit += WorkOf(a.entries);
  found.condensed_is_cheaper = condensed->work() <= limit;
  return found;
}

}  // namespace switchyard::ipopt
