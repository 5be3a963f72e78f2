// switchyard/problem_update.hpp - a sy_update applied to an owning problem: what a host keeps in
// step with a backend, and what a solver without an incremental form of its own can use.
#pragma once

#include <string>
#include <vector>

#include "switchyard/problem.hpp"

namespace switchyard {
namespace problem_detail {

inline void Need(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("update: ") + what);
}

inline void CopyValues(const sy_csc* from, Csc& to, const char* what) {
  const std::int32_t count = from == nullptr ? 0 : from->start[from->cols];
  Need(count == to.nonzeros(), what);
  if (count > 0) to.value.assign(from->value, from->value + count);
}

inline void TakeWhole(const sy_update& update, ProblemData& d) {
  const sy_problem& given = *update.problem;
  Need(given.num_vars == d.num_vars && given.num_rows == d.num_rows() &&
           given.num_cone_rows == d.num_cone_rows(),
       "the problem's dimensions differ from the loaded one's");
  if ((update.whole & SY_UPDATES_BOUNDS) != 0) {
    const auto take = [](const double* from, std::int32_t count, double none,
                         std::vector<double>& to) {
      to.assign(static_cast<std::size_t>(count), none);
      if (from != nullptr) std::copy(from, from + count, to.begin());
    };
    const bool boxed = given.x_lower != nullptr || given.x_upper != nullptr;
    take(given.x_lower, boxed ? d.num_vars : 0, -kInfinity, d.x_lower);
    take(given.x_upper, boxed ? d.num_vars : 0, kInfinity, d.x_upper);
    take(given.row_lower, d.num_rows(), -kInfinity, d.row_lower);
    take(given.row_upper, d.num_rows(), kInfinity, d.row_upper);
  }
  if ((update.whole & SY_UPDATES_VECTORS) != 0) {
    if (given.q != nullptr) {
      d.q.assign(given.q, given.q + given.num_vars);
    } else {
      d.q.assign(static_cast<std::size_t>(given.num_vars), 0.0);
    }
    d.offset = given.offset;
    if (given.g != nullptr) {
      d.g.assign(given.g, given.g + given.num_cone_rows);
    } else {
      d.g.assign(static_cast<std::size_t>(given.num_cone_rows), 0.0);
    }
  }
  if ((update.whole & SY_UPDATES_VALUES) != 0) {
    CopyValues(given.P, d.P, "P has another pattern than the loaded one");
    CopyValues(given.A, d.A, "A has another pattern than the loaded one");
    CopyValues(given.F, d.F, "F has another pattern than the loaded one");
  }
  if ((update.whole & (SY_UPDATES_VALUES | SY_UPDATES_NLP)) != 0) d.flags = given.flags;
  d.nlp = given.nlp;
  d.hints = given.hints;
}

inline void CheckSingles(const sy_update& update, const ProblemData& d) {
  const auto in_range = [](const std::int32_t* index, std::int32_t count, std::int32_t size) {
    return std::all_of(index, index + count, [=](std::int32_t i) { return i >= 0 && i < size; });
  };
  Need(in_range(update.x, update.num_x, d.num_vars), "a variable's index is out of range");
  Need(in_range(update.row, update.num_rows, d.num_rows()), "a row's index is out of range");
  Need(in_range(update.cone, update.num_cones, d.num_cones()), "a cone's index is out of range");
}

inline void SetSingles(const sy_update& update, ProblemData& d) {
  if (update.num_x > 0 && d.x_lower.empty()) {
    d.x_lower.assign(static_cast<std::size_t>(d.num_vars), -kInfinity);
    d.x_upper.assign(static_cast<std::size_t>(d.num_vars), kInfinity);
  }
  for (std::int32_t k = 0; k < update.num_x; ++k) {
    d.x_lower[static_cast<std::size_t>(update.x[k])] = update.x_lower[k];
    d.x_upper[static_cast<std::size_t>(update.x[k])] = update.x_upper[k];
  }
  for (std::int32_t k = 0; k < update.num_rows; ++k) {
    d.row_lower[static_cast<std::size_t>(update.row[k])] = update.row_lower[k];
    d.row_upper[static_cast<std::size_t>(update.row[k])] = update.row_upper[k];
  }
  if (update.num_cones > 0 && d.cone_on.empty()) d.cone_on.assign(d.cones.size(), 1);
  for (std::int32_t k = 0; k < update.num_cones; ++k) {
    d.cone_on[static_cast<std::size_t>(update.cone[k])] = update.cone_on[k] != 0 ? 1 : 0;
  }
}

inline void RemoveRows(const sy_update& update, ProblemData& d) {
  if (update.num_gone_rows == 0) return;
  std::vector<std::uint8_t> keep(d.row_lower.size(), 1);
  for (std::int32_t k = 0; k < update.num_gone_rows; ++k) {
    const std::int32_t i = update.gone_row[k];
    Need(i >= 0 && i < d.num_rows(), "the index of a row to remove is out of range");
    Need(k == 0 || i > update.gone_row[k - 1], "rows to remove do not ascend");
    keep[static_cast<std::size_t>(i)] = 0;
  }
  d.A = KeepRows(d.A, keep);
  d.row_lower = Keep(d.row_lower, keep);
  d.row_upper = Keep(d.row_upper, keep);
}

/// Removes the cones that `keep` does not name, with their rows.
inline void KeepCones(const std::vector<std::uint8_t>& keep, ProblemData& d) {
  std::vector<std::uint8_t> keep_row;
  for (std::size_t c = 0; c < d.cones.size(); ++c) {
    keep_row.insert(keep_row.end(), static_cast<std::size_t>(d.cones[c].dim), keep[c]);
  }
  d.F = KeepRows(d.F, keep_row);
  d.g = Keep(d.g, keep_row);
  d.cones = Keep(d.cones, keep);
  if (!d.cone_on.empty()) d.cone_on = Keep(d.cone_on, keep);
}

inline void RemoveCones(const sy_update& update, ProblemData& d) {
  if (update.num_gone_cones == 0) return;
  std::vector<std::uint8_t> keep(d.cones.size(), 1);
  for (std::int32_t k = 0; k < update.num_gone_cones; ++k) {
    const std::int32_t c = update.gone_cone[k];
    Need(c >= 0 && c < d.num_cones(), "the index of a cone to remove is out of range");
    Need(k == 0 || c > update.gone_cone[k - 1], "cones to remove do not ascend");
    keep[static_cast<std::size_t>(c)] = 0;
  }
  KeepCones(keep, d);
}

inline void WidenColumns(Csc& a, std::int32_t cols) {
  a.start.resize(static_cast<std::size_t>(cols) + 1, a.start.back());
  a.cols = cols;
}

template <class T>
void Append(std::vector<T>& v, const T* from, std::int32_t count, T otherwise) {
  for (std::int32_t k = 0; k < count; ++k) v.push_back(from != nullptr ? from[k] : otherwise);
}

inline void AppendVariables(const sy_more& more, ProblemData& d) {
  const std::int32_t old_vars = d.num_vars;
  d.num_vars += more.num_vars;
  d.q.resize(static_cast<std::size_t>(old_vars), 0.0);
  Append(d.q, more.q, more.num_vars, 0.0);
  if (!d.x_lower.empty() || more.x_lower != nullptr || more.x_upper != nullptr) {
    d.x_lower.resize(static_cast<std::size_t>(old_vars), -kInfinity);
    d.x_upper.resize(static_cast<std::size_t>(old_vars), kInfinity);
    Append(d.x_lower, more.x_lower, more.num_vars, -kInfinity);
    Append(d.x_upper, more.x_upper, more.num_vars, kInfinity);
  }
  if (!d.integer.empty() || more.integer != nullptr) {
    d.integer.resize(static_cast<std::size_t>(old_vars), 0);
    Append(d.integer, more.integer, more.num_vars, std::uint8_t{0});
  }
  for (Csc* a : {&d.A, &d.F, &d.P}) WidenColumns(*a, d.num_vars);
  d.P.rows = d.num_vars;
}

inline void AppendRows(const sy_more& more, ProblemData& d) {
  if (more.num_rows > 0) {
    Need(more.At != nullptr && more.At->cols == more.num_rows && more.At->rows == d.num_vars,
         "the appended rows are not (old + new variables) x rows");
    d.A = StackRows(d.A, Transpose(*more.At));
    Append(d.row_lower, more.row_lower, more.num_rows, -kInfinity);
    Append(d.row_upper, more.row_upper, more.num_rows, kInfinity);
  }
  if (more.num_cone_rows > 0) {
    Need(more.Ft != nullptr && more.Ft->cols == more.num_cone_rows && more.Ft->rows == d.num_vars,
         "the appended cone rows are not (old + new variables) x rows");
    d.F = StackRows(d.F, Transpose(*more.Ft));
    Append(d.g, more.g, more.num_cone_rows, 0.0);
    d.cones.insert(d.cones.end(), more.cones, more.cones + more.num_cones);
    if (!d.cone_on.empty()) d.cone_on.resize(d.cones.size(), 1);
  }
}

}  // namespace problem_detail

/// All that is no matrix, integrality or list of cones: the same-sized vectors of `from`.
inline void CopyVectors(const ProblemData& from, ProblemData& to) {
  to.flags = from.flags;
  to.q = from.q;
  to.offset = from.offset;
  to.x_lower = from.x_lower;
  to.x_upper = from.x_upper;
  to.row_lower = from.row_lower;
  to.row_upper = from.row_upper;
  to.g = from.g;
  to.cone_on = from.cone_on;
  to.nlp = from.nlp;
  to.hints = from.hints;
}

/// Applies an update in the order of its fields. Throws std::invalid_argument where an index or a
/// dimension does not fit; `d` is then in between.
inline void ApplyUpdate(const sy_update& update, ProblemData& d) {
  using namespace problem_detail;
  CheckSingles(update, d);
  Need(update.whole == 0 || update.problem != nullptr, "whole sections need a problem");
  if (update.problem != nullptr) TakeWhole(update, d);
  SetSingles(update, d);
  RemoveRows(update, d);
  RemoveCones(update, d);
  if (update.more != nullptr) {
    AppendVariables(*update.more, d);
    AppendRows(*update.more, d);
  }
}

inline void Problem::Apply(const sy_update& update) {
  using namespace problem_detail;
  const bool patterns_stay = update.num_gone_rows == 0 && update.num_gone_cones == 0 &&
                             update.more == nullptr && (update.whole & SY_UPDATES_VALUES) == 0;
  if (patterns_stay) {  // every mistake is found before anything is written: no copy
    ApplyUpdate(update, data_);
  } else {
    ProblemData next = data_;
    ApplyUpdate(update, next);
    data_ = std::move(next);
  }
  Seal();
}

}  // namespace switchyard
