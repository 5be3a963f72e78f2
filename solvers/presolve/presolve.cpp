#include "solvers/presolve/presolve.hpp"

#include <numeric>
#include <utility>

#include "solvers/presolve/reductions.hpp"
#include "solvers/presolve/split_cones.hpp"

namespace switchyard::presolve {
namespace {

/// The upper triangle of P over variables, `place` each one's place among them, -1: it is none.
Csc UpperTriangle(const Csc& P, const std::vector<Index>& variable,
                  const std::vector<Index>& place) {
  const auto count = static_cast<Index>(variable.size());
  Csc upper(count, count);
  for (Index k = 0; k < count; ++k) {
    for (Index e = P.start[variable[k]]; e < P.start[variable[k] + 1]; ++e) {
      const Index i = place[P.row[e]];
      if (i < 0 || i > k) continue;
      upper.row.push_back(i);
      upper.value.push_back(P.value[e]);
    }
    upper.start[k + 1] = static_cast<Index>(upper.row.size());
  }
  return upper;
}

/// Some rows of a store over `count` variables, by columns.
Csc ByColumns(const RowStore& store, const std::vector<Index>& rows, Index count,
              const std::vector<Index>& place) {
  Csc by_rows(count, static_cast<Index>(rows.size()));
  for (std::size_t k = 0; k < rows.size(); ++k) {
    for (const Entry& e : store.Row(rows[k])) {
      if (place[e.column] < 0) continue;
      by_rows.row.push_back(place[e.column]);
      by_rows.value.push_back(e.value);
    }
    by_rows.start[k + 1] = static_cast<Index>(by_rows.row.size());
  }
  return Transpose(by_rows.View());
}

/// Where nothing was asked for, 0.
double At(const std::vector<double>& v, std::size_t k) { return v.empty() ? 0 : v[k]; }

}  // namespace

Presolve::Presolve(const ProblemData& problem, const Limits& limits)
    : whole_(problem), draft_(problem, limits) {
  Reduce();
  // A contradiction has no certificate here: the whole problem has.
  if (draft_.contradiction) draft_ = Draft(problem, {false, false, false});
  Compact();
}

void Presolve::Reduce() {
  constexpr int kRounds = 10;
  MergeParallelRows(draft_);
  for (int round = 0; round < kRounds && !draft_.contradiction; ++round) {
    int removed = ReduceRows(draft_);
    if (draft_.contradiction) return;
    removed += ReduceColumns(draft_);
    if (removed > draft_.num_rows() / 100) continue;
    if (removed + SubstituteFreeColumns(draft_) == 0) break;
  }
  MergeParallelRows(draft_);
  DropEmptyRows(draft_);
}

void Presolve::Compact() {
  const Draft& d = draft_;
  std::vector<Index> place(d.q.size(), -1);
  for (Index j = 0; j < d.num_columns(); ++j) {
    if (d.column_alive[j] == 0) continue;
    place[j] = static_cast<Index>(variable_.size());
    variable_.push_back(j);
  }
  ProblemData& r = reduced_;
  r.num_vars = static_cast<Index>(variable_.size());
  r.flags = whole_.flags;
  r.offset = d.offset;
  for (const Index j : variable_) {
    r.q.push_back(d.q[j] + d.p_shift[j]);
    r.x_lower.push_back(d.lower[j]);
    r.x_upper.push_back(d.upper[j]);
  }
  r.P = UpperTriangle(d.P, variable_, place);
  for (Index i = 0; i < d.num_rows(); ++i) {
    if (d.row_alive[i] == 0) continue;
    draft_row_.push_back(i);
    row_.push_back(i < d.rows_of_a ? i : ~d.source[i - d.rows_of_a]);
    r.row_lower.push_back(d.row_lower[i]);
    r.row_upper.push_back(d.row_upper[i]);
  }
  r.A = ByColumns(d.rows, draft_row_, r.num_vars, place);
  std::vector<Index> all(static_cast<std::size_t>(d.cone_rows.rows()));
  std::iota(all.begin(), all.end(), 0);
  r.F = ByColumns(d.cone_rows, all, r.num_vars, place);
  r.g = d.g;
  r.cones = d.cones;
  for (RowStore* store : {&draft_.rows, &draft_.cone_rows}) *store = RowStore(Csc(), false);
}

Answer Presolve::Back(const Answer& reduced) const {
  const Meaning meaning = reduced.meaning;
  Answer whole;
  whole.meaning = meaning;
  whole.x.assign(draft_.q.size(), 0.0);
  whole.x_dual.assign(draft_.q.size(), 0.0);
  for (std::size_t k = 0; k < variable_.size(); ++k) {
    whole.x[variable_[k]] = At(reduced.x, k);
    whole.x_dual[variable_[k]] = At(reduced.x_dual, k);
  }
  draft_.undo.Points(meaning, whole.x);
  std::vector<double> y(draft_.row_lower.size(), 0.0);
  for (std::size_t k = 0; k < draft_row_.size(); ++k) {
    y[draft_row_[k]] = At(reduced.row_dual, k);
  }
  std::vector<double> z(draft_.g.size(), 0.0);
  for (std::size_t k = 0; k < z.size(); ++k) z[k] = At(reduced.cone_dual, k);
  std::vector<double> curved(draft_.q.size(), 0.0);
  if (meaning == Meaning::kOptimum) {
    MultiplyAdd(draft_.P.View(), 1, whole.x.data(), curved.data());
  }
  draft_.undo.Duals(meaning, curved, z, y, whole.x_dual);
  const auto rows_of_a = static_cast<std::ptrdiff_t>(whole_.row_lower.size());
  whole.row_dual.assign(y.begin(), y.begin() + rows_of_a);
  ConeDualsBack(whole_, y.data() + rows_of_a, z.data(), whole.cone_dual);
  return whole;
}

Answer Presolve::Forth(const Answer& whole) const {
  const ProblemData& r = reduced_;
  Answer reduced;
  for (const Index j : variable_) reduced.x.push_back(whole.x[j]);
  for (const Index i : row_) {
    reduced.row_dual.push_back(i >= 0 ? whole.row_dual[i] : whole.cone_dual[~i]);
  }
  reduced.cone_dual = ConicDuals(whole_, whole.cone_dual);
  reduced.x_dual = r.q;
  SymmetricMultiplyAdd(r.P.View(), 1, reduced.x.data(), reduced.x_dual.data());
  TransposedMultiplyAdd(r.A.View(), -1, reduced.row_dual.data(), reduced.x_dual.data());
  TransposedMultiplyAdd(r.F.View(), -1, reduced.cone_dual.data(), reduced.x_dual.data());
  return reduced;
}

}  // namespace switchyard::presolve
