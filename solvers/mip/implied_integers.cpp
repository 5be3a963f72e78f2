#include "solvers/mip/implied_integers.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "switchyard/boxes.hpp"

namespace switchyard::mip {
namespace {

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

bool IsMultiple(double v, double of) { return std::fmod(v, of) == 0; }

class Search {
 public:
  explicit Search(const sy_problem& problem)
      : problem_(problem),
        rows_(Transpose(*problem.A)),
        is_integer_(At(problem.num_vars), 0),
        num_unknown_(At(problem.num_rows), 0) {}

  std::vector<ImpliedInteger> Run() {
    for (std::int32_t i = 0; i < problem_.num_rows; ++i) {
      EachUnknown(i, [&](std::int32_t, double) { ++num_unknown_[At(i)]; });
    }
    for (std::int32_t j = 0; j < problem_.num_vars; ++j) {
      if (IsIntegerByItself(j)) Take(j);
    }
    for (std::int32_t i = 0; i < problem_.num_rows; ++i) Try(i);
    for (; !ready_.empty();) {
      const std::int32_t i = ready_.back();
      ready_.pop_back();
      Try(i);
    }
    return std::move(found_);
  }

 private:
  /// visit(variable, coefficient) of a row, for those not known to be integers.
  template <class Visit>
  void EachUnknown(std::int32_t i, Visit&& visit) const {
    const boxes_detail::Row row = boxes_detail::RowOf(rows_, i);
    for (std::int32_t k = 0; k < row.count; ++k) {
      if (row.value[k] != 0 && is_integer_[At(row.column[k])] == 0)
        visit(row.column[k], row.value[k]);
    }
  }

  [[nodiscard]] bool IsIntegerByItself(std::int32_t j) const {
    if (problem_.integer != nullptr && problem_.integer[j] != 0) return true;
    if (problem_.x_lower == nullptr || problem_.x_upper == nullptr) return false;
    return problem_.x_lower[j] == problem_.x_upper[j] && IsMultiple(problem_.x_lower[j], 1);
  }

  /// x_j is known to be an integer: rows that lack one more may be ready now.
  void Take(std::int32_t j) {
    is_integer_[At(j)] = 1;
    for (std::int32_t k = problem_.A->start[j]; k < problem_.A->start[j + 1]; ++k) {
      if (problem_.A->value[k] == 0) continue;
      const std::int32_t i = problem_.A->row[k];
      if (--num_unknown_[At(i)] == 1) ready_.push_back(i);
    }
  }

  /// Takes the one variable of an equality that is not known to be an integer, where its
  /// coefficient divides everything else.
  void Try(std::int32_t i) {
    if (num_unknown_[At(i)] != 1 || problem_.row_lower == nullptr ||
        problem_.row_upper == nullptr) {
      return;
    }
    const double side = problem_.row_lower[i];
    if (side != problem_.row_upper[i] || !std::isfinite(side)) return;
    ImpliedInteger last{-1, i};
    double divisor = 0;
    EachUnknown(i, [&](std::int32_t j, double a) {
      last.variable = j;
      divisor = a;
    });
    const boxes_detail::Row row = boxes_detail::RowOf(rows_, i);
    const bool divides =
        IsMultiple(side, divisor) && std::all_of(row.value, row.value + row.count,
                                                 [&](double a) { return IsMultiple(a, divisor); });
    if (!divides) return;
    found_.push_back(last);
    Take(last.variable);
  }

  const sy_problem& problem_;
  Csc rows_;  // column i is row i
  std::vector<std::uint8_t> is_integer_;
  std::vector<std::int32_t> num_unknown_;  // of the entries of each row
  std::vector<std::int32_t> ready_;        // rows with one unknown entry
  std::vector<ImpliedInteger> found_;
};

}  // namespace

std::vector<ImpliedInteger> ImpliedIntegers(const sy_problem& problem) {
  if (problem.A == nullptr) return {};
  return Search(problem).Run();
}

std::vector<std::int32_t> VariablesOf(const std::vector<ImpliedInteger>& implied) {
  std::vector<std::int32_t> variables;
  for (const ImpliedInteger& i : implied) variables.push_back(i.variable);
  std::sort(variables.begin(), variables.end());
  return variables;
}

}  // namespace switchyard::mip
