// switchyard/problem.hpp - an owning sy_problem, and its sparse products. Knows abi.h alone.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

#include "switchyard/abi.h"

namespace switchyard {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A sparse matrix in compressed columns that owns its arrays; rows ascend within a column.
struct Csc {
  std::int32_t rows = 0;
  std::int32_t cols = 0;
  std::vector<std::int32_t> start = {0};  // cols + 1
  std::vector<std::int32_t> row;
  std::vector<double> value;

  Csc() = default;
  /// No entries.
  Csc(std::int32_t num_rows, std::int32_t num_cols)
      : rows(num_rows), cols(num_cols), start(static_cast<std::size_t>(num_cols) + 1, 0) {}
  explicit Csc(const sy_csc& given)
      : rows(given.rows), cols(given.cols), start(given.start, given.start + given.cols + 1) {
    row.assign(given.row, given.row + start.back());
    if (given.value != nullptr) value.assign(given.value, given.value + start.back());
  }

  [[nodiscard]] std::int32_t nonzeros() const { return start.back(); }
  /// Borrows: good until this matrix changes.
  [[nodiscard]] sy_csc View() const {
    return {rows, cols, start.data(), row.data(), value.empty() ? nullptr : value.data()};
  }
};

/// The transpose, rows ascending, in time linear in entries and dimensions, in the memory of t.
/// Where column i is written next stands in start[i + 1], its end when it is full.
inline Csc Transpose(const sy_csc& a, Csc t = {}) {
  t.rows = a.cols;
  t.cols = a.rows;
  t.row.resize(static_cast<std::size_t>(a.start[a.cols]));
  t.value.resize(a.value != nullptr ? t.row.size() : 0);
  t.start.assign(static_cast<std::size_t>(a.rows) + 2, 0);
  for (std::size_t k = 0; k < t.row.size(); ++k) ++t.start[static_cast<std::size_t>(a.row[k]) + 2];
  std::partial_sum(t.start.begin(), t.start.end(), t.start.begin());
  t.start.pop_back();
  for (std::int32_t j = 0; j < a.cols; ++j) {
    for (std::int32_t k = a.start[j]; k < a.start[j + 1]; ++k) {
      const auto to = static_cast<std::size_t>(t.start[static_cast<std::size_t>(a.row[k]) + 1]++);
      t.row[to] = j;
      if (a.value != nullptr) t.value[to] = a.value[k];
    }
  }
  return t;
}

/// y += alpha A x.
inline void MultiplyAdd(const sy_csc& a, double alpha, const double* x, double* y) {
  for (std::int32_t j = 0; j < a.cols; ++j) {
    const double scaled = alpha * x[j];
    if (scaled == 0) continue;
    for (std::int32_t k = a.start[j]; k < a.start[j + 1]; ++k) y[a.row[k]] += a.value[k] * scaled;
  }
}

/// x += alpha A'y.
inline void TransposedMultiplyAdd(const sy_csc& a, double alpha, const double* y, double* x) {
  for (std::int32_t j = 0; j < a.cols; ++j) {
    double sum = 0;
    for (std::int32_t k = a.start[j]; k < a.start[j + 1]; ++k) sum += a.value[k] * y[a.row[k]];
    x[j] += alpha * sum;
  }
}

/// y += alpha P x for a symmetric P of which the upper triangle is given.
inline void SymmetricMultiplyAdd(const sy_csc& p, double alpha, const double* x, double* y) {
  for (std::int32_t j = 0; j < p.cols; ++j) {
    for (std::int32_t k = p.start[j]; k < p.start[j + 1]; ++k) {
      const std::int32_t i = p.row[k];
      y[i] += alpha * p.value[k] * x[j];
      if (i != j) y[j] += alpha * p.value[k] * x[i];
    }
  }
}

/// x'Px for a symmetric P of which the upper triangle is given.
inline double QuadraticForm(const sy_csc& p, const double* x) {
  double sum = 0;
  for (std::int32_t j = 0; j < p.cols; ++j) {
    for (std::int32_t k = p.start[j]; k < p.start[j + 1]; ++k) {
      sum += (p.row[k] == j ? 1 : 2) * p.value[k] * x[p.row[k]] * x[j];
    }
  }
  return sum;
}

/// 1/2 x'Px + q'x + offset, without the nonlinear part.
inline double Objective(const sy_problem& problem, const double* x) {
  double sum = problem.offset;
  if (problem.P != nullptr) sum += 0.5 * QuadraticForm(*problem.P, x);
  const std::int32_t n = problem.q != nullptr ? problem.num_vars : 0;
  return std::inner_product(x, x + n, problem.q, sum);
}

/// [top; bottom].
inline Csc StackRows(const Csc& top, const Csc& bottom) {
  if (top.cols != bottom.cols) throw std::invalid_argument("stacked matrices differ in columns");
  Csc both(top.rows + bottom.rows, top.cols);
  both.row.reserve(top.row.size() + bottom.row.size());
  both.value.reserve(both.row.capacity());
  for (std::int32_t j = 0; j < top.cols; ++j) {
    const auto column = static_cast<std::size_t>(j);
    const auto append = [&](const Csc& part, std::int32_t above) {
      for (auto k = static_cast<std::size_t>(part.start[column]);
           k < static_cast<std::size_t>(part.start[column + 1]); ++k) {
        both.row.push_back(part.row[k] + above);
        both.value.push_back(part.value[k]);
      }
    };
    append(top, 0);
    append(bottom, top.rows);
    both.start[column + 1] = static_cast<std::int32_t>(both.row.size());
  }
  return both;
}

/// The rows i with keep[i], in their order.
inline Csc KeepRows(const Csc& a, const std::vector<std::uint8_t>& keep) {
  std::vector<std::int32_t> place(keep.size() + 1, 0);
  for (std::size_t i = 0; i < keep.size(); ++i) place[i + 1] = place[i] + (keep[i] != 0 ? 1 : 0);
  Csc kept(place.back(), a.cols);
  for (std::size_t j = 0; j < static_cast<std::size_t>(a.cols); ++j) {
    for (auto k = static_cast<std::size_t>(a.start[j]);
         k < static_cast<std::size_t>(a.start[j + 1]); ++k) {
      const auto i = static_cast<std::size_t>(a.row[k]);
      if (keep[i] == 0) continue;
      kept.row.push_back(place[i]);
      kept.value.push_back(a.value[k]);
    }
    kept.start[j + 1] = static_cast<std::int32_t>(kept.row.size());
  }
  return kept;
}

/// The entries v[i] with keep[i].
template <class T>
std::vector<T> Keep(const std::vector<T>& v, const std::vector<std::uint8_t>& keep) {
  std::vector<T> kept;
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (keep[i] != 0) kept.push_back(v[i]);
  }
  return kept;
}

/// A sy_problem by value. A section without entries is absent; nlp and hints are borrowed.
struct ProblemData {
  std::int32_t num_vars = 0;
  std::uint32_t flags = 0;
  Csc P;  // upper triangle
  std::vector<double> q;
  double offset = 0;
  std::vector<double> x_lower;  // empty, like x_upper: free
  std::vector<double> x_upper;
  std::vector<std::uint8_t> integer;
  Csc A;
  std::vector<double> row_lower;
  std::vector<double> row_upper;
  Csc F;
  std::vector<double> g;
  std::vector<sy_cone> cones;
  std::vector<std::uint8_t> cone_on;  // empty: all; else one for each cone
  const sy_nlp* nlp = nullptr;
  const sy_hint* hints = nullptr;

  ProblemData() = default;
  explicit ProblemData(const sy_problem& given);

  [[nodiscard]] std::int32_t num_rows() const { return std::int32_t(row_lower.size()); }
  [[nodiscard]] std::int32_t num_cones() const { return static_cast<std::int32_t>(cones.size()); }
  [[nodiscard]] std::int32_t num_cone_rows() const { return static_cast<std::int32_t>(g.size()); }
  [[nodiscard]] bool has_integers() const {
    return std::any_of(integer.begin(), integer.end(), [](std::uint8_t i) { return i != 0; });
  }
};

/// The owning problem: data, and a sy_problem over it that stays in place and true.
class Problem {
 public:
  Problem() { Seal(); }
  explicit Problem(ProblemData data) : data_(std::move(data)) { Seal(); }
  explicit Problem(const sy_problem& given) : Problem(ProblemData(given)) {}
  Problem(const Problem& other) : data_(other.data_) { Seal(); }
  Problem(Problem&& other) noexcept : data_(std::move(other.data_)) { Seal(); }
  Problem& operator=(Problem other) noexcept {
    std::swap(data_, other.data_);
    Seal();
    return *this;
  }
  ~Problem() = default;

  [[nodiscard]] const ProblemData& data() const { return data_; }
  [[nodiscard]] const sy_problem& view() const { return view_; }

  /// Changes the data by `edit`, then renews the view.
  template <class Edit>
  void Change(Edit&& edit) {
    edit(data_);
    Seal();
  }

  /// Applies an update in the order of its fields. Throws std::invalid_argument, unchanged, where
  /// an index or a dimension does not fit. (switchyard/problem_update.hpp)
  void Apply(const sy_update& update);

 private:
  void Seal();

  ProblemData data_;
  sy_csc p_{}, a_{}, f_{};
  sy_problem view_{};
};

namespace problem_detail {
template <class T>
std::vector<T> Copy(const T* from, std::int32_t count) {
  return from == nullptr ? std::vector<T>() : std::vector<T>(from, from + count);
}
template <class T>
const T* OrNull(const std::vector<T>& v) {
  return v.empty() ? nullptr : v.data();
}
}  // namespace problem_detail

inline ProblemData::ProblemData(const sy_problem& given)
    : num_vars(given.num_vars),
      flags(given.flags),
      offset(given.offset),
      nlp(given.nlp),
      hints(given.hints) {
  using problem_detail::Copy;
  P = given.P != nullptr ? Csc(*given.P) : Csc(num_vars, num_vars);
  A = given.A != nullptr ? Csc(*given.A) : Csc(given.num_rows, num_vars);
  F = given.F != nullptr ? Csc(*given.F) : Csc(given.num_cone_rows, num_vars);
  q = given.q != nullptr ? Copy(given.q, num_vars)
                         : std::vector<double>(static_cast<std::size_t>(num_vars), 0.0);
  x_lower = Copy(given.x_lower, num_vars);
  x_upper = Copy(given.x_upper, num_vars);
  if (x_lower.empty() != x_upper.empty()) {
    x_lower.resize(static_cast<std::size_t>(num_vars), -kInfinity);
    x_upper.resize(static_cast<std::size_t>(num_vars), kInfinity);
  }
  integer = Copy(given.integer, num_vars);
  const auto rows = static_cast<std::size_t>(given.num_rows);
  row_lower = Copy(given.row_lower, given.num_rows);
  row_upper = Copy(given.row_upper, given.num_rows);
  row_lower.resize(rows, -kInfinity);
  row_upper.resize(rows, kInfinity);
  g = Copy(given.g, given.num_cone_rows);
  g.resize(static_cast<std::size_t>(given.num_cone_rows), 0.0);
  cones = Copy(given.cones, given.num_cones);
}

inline void Problem::Seal() {
  using problem_detail::OrNull;
  const ProblemData& d = data_;
  p_ = d.P.View();
  a_ = d.A.View();
  f_ = d.F.View();
  view_ = {};
  view_.size = sizeof view_;
  view_.num_vars = d.num_vars;
  view_.num_rows = d.num_rows();
  view_.num_cones = d.num_cones();
  view_.num_cone_rows = d.num_cone_rows();
  view_.flags = d.flags;
  view_.P = d.P.nonzeros() > 0 ? &p_ : nullptr;
  view_.q = OrNull(d.q);
  view_.offset = d.offset;
  view_.x_lower = OrNull(d.x_lower);
  view_.x_upper = OrNull(d.x_upper);
  view_.integer = d.has_integers() ? d.integer.data() : nullptr;
  view_.A = d.num_rows() > 0 ? &a_ : nullptr;
  view_.row_lower = OrNull(d.row_lower);
  view_.row_upper = OrNull(d.row_upper);
  view_.F = d.num_cone_rows() > 0 ? &f_ : nullptr;
  view_.g = OrNull(d.g);
  view_.cones = OrNull(d.cones);
  view_.nlp = d.nlp;
  view_.hints = d.hints;
}

}  // namespace switchyard
