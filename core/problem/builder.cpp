#include "core/problem/builder.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace switchyard {
namespace {

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

bool AllInfinite(const std::vector<double>& lower, const std::vector<double>& upper) {
  return std::all_of(lower.begin(), lower.end(), [](double l) { return l == -kInfinity; }) &&
         std::all_of(upper.begin(), upper.end(), [](double u) { return u == kInfinity; });
}

}  // namespace

const Csc& TripletMatrix::Seal(std::int32_t rows, std::int32_t cols) {
  if (sealed_) return matrix_;
  if (InOrder()) return TakeAsWritten(rows, cols);
  // A stable counting sort by column; a column is sorted by row only where it is not yet.
  std::vector<std::int32_t> start(At(cols) + 1, 0);
  for (const std::int32_t j : col_) ++start[At(j) + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<std::int32_t> order(row_.size());
  std::vector<std::int32_t> next(start.begin(), start.end() - 1);
  for (std::size_t k = 0; k < col_.size(); ++k) {
    order[At(next[At(col_[k])]++)] = static_cast<std::int32_t>(k);
  }
  const auto by_row = [&](std::int32_t a, std::int32_t b) { return row_[At(a)] < row_[At(b)]; };
  matrix_ = Csc(rows, cols);
  matrix_.row.reserve(row_.size());
  matrix_.value.reserve(row_.size());
  slot_.resize(row_.size());
  for (std::int32_t j = 0; j < cols; ++j) {
    const auto first = order.begin() + start[At(j)];
    const auto last = order.begin() + start[At(j) + 1];
    if (!std::is_sorted(first, last, by_row)) std::stable_sort(first, last, by_row);
    for (auto k = first; k != last; ++k) {
      const bool repeats = k != first && row_[At(*k)] == matrix_.row.back();
      if (!repeats) {
        matrix_.row.push_back(row_[At(*k)]);
        matrix_.value.push_back(0);
      }
      matrix_.value.back() += value_[At(*k)];
      slot_[At(*k)] = static_cast<std::int32_t>(matrix_.row.size()) - 1;
    }
    matrix_.start[At(j) + 1] = static_cast<std::int32_t>(matrix_.row.size());
  }
  std::vector<double>().swap(value_);
  next_ = slot_.size();
  sealed_ = true;
  return matrix_;
}

Csc TripletMatrix::SealOnce(std::int32_t rows, std::int32_t cols) {
  Seal(rows, cols);
  Csc matrix = std::move(matrix_);
  *this = TripletMatrix();
  return matrix;
}

bool TripletMatrix::InOrder() const {
  for (std::size_t k = 1; k < col_.size(); ++k) {
    const bool follows = col_[k] > col_[k - 1] || (col_[k] == col_[k - 1] && row_[k] > row_[k - 1]);
    if (!follows) return false;
  }
  return true;
}

// Nothing to sort: each triplet is an entry, in its place.
const Csc& TripletMatrix::TakeAsWritten(std::int32_t rows, std::int32_t cols) {
  matrix_ = Csc(rows, cols);
  for (const std::int32_t j : col_) ++matrix_.start[At(j) + 1];
  std::partial_sum(matrix_.start.begin(), matrix_.start.end(), matrix_.start.begin());
  matrix_.row = row_;
  matrix_.value = std::exchange(value_, {});
  slot_.resize(row_.size());
  std::iota(slot_.begin(), slot_.end(), 0);
  next_ = slot_.size();
  sealed_ = true;
  return matrix_;
}

void TripletMatrix::Rewrite() {
  std::fill(matrix_.value.begin(), matrix_.value.end(), 0.0);
  next_ = 0;
  same_ = true;
}

std::int32_t ProblemBuilder::AddVariables(std::int32_t count) {
  const std::size_t first = q.size();
  q.resize(first + At(count), 0.0);
  x_lower.resize(q.size(), -kInfinity);
  x_upper.resize(q.size(), kInfinity);
  integer.resize(q.size(), 0);
  return static_cast<std::int32_t>(first);
}

std::int32_t ProblemBuilder::AddRows(std::int32_t count) {
  const std::size_t first = row_lower.size();
  row_lower.resize(first + At(count), -kInfinity);
  row_upper.resize(row_lower.size(), kInfinity);
  return static_cast<std::int32_t>(first);
}

std::int32_t ProblemBuilder::AddCone(const sy_cone& cone) {
  const std::size_t first = g.size();
  cones.push_back(cone);
  g.resize(first + At(cone.dim), 0.0);
  return static_cast<std::int32_t>(first);
}

ProblemData ProblemBuilder::Finish() {
  const auto vars = static_cast<std::int32_t>(q.size());
  ProblemData d;
  d.P = P.Seal(vars, vars);
  d.A = A.Seal(static_cast<std::int32_t>(row_lower.size()), vars);
  d.F = F.Seal(static_cast<std::int32_t>(g.size()), vars);
  TakeVectors(d);
  return d;
}

ProblemData ProblemBuilder::FinishOnce() {
  const auto vars = static_cast<std::int32_t>(q.size());
  ProblemData d;
  d.P = P.SealOnce(vars, vars);
  d.A = A.SealOnce(static_cast<std::int32_t>(row_lower.size()), vars);
  d.F = F.SealOnce(static_cast<std::int32_t>(g.size()), vars);
  TakeVectors(d);
  return d;
}

void ProblemBuilder::TakeVectors(ProblemData& d) {
  d.num_vars = static_cast<std::int32_t>(q.size());
  d.flags = flags;
  d.q = std::move(q);
  d.offset = offset;
  if (!AllInfinite(x_lower, x_upper)) {
    d.x_lower = std::move(x_lower);
    d.x_upper = std::move(x_upper);
  }
  if (std::any_of(integer.begin(), integer.end(), [](std::uint8_t i) { return i != 0; })) {
    d.integer = std::move(integer);
  }
  d.row_lower = std::move(row_lower);
  d.row_upper = std::move(row_upper);
  d.g = std::move(g);
  d.cones = std::move(cones);
}

void ProblemBuilder::Rewrite() {
  P.Rewrite();
  A.Rewrite();
  F.Rewrite();
  for (auto* v : {&q, &x_lower, &x_upper, &row_lower, &row_upper, &g}) v->clear();
  integer.clear();
  cones.clear();
  offset = 0;
  flags = 0;
}

}  // namespace switchyard
