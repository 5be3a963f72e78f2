#include "switchyard/sets/scaled_rows.hpp"

#include "core/problem/builder.hpp"
#include "switchyard/error.hpp"

namespace switchyard {

int ScaledRows::AddSet(const ScaledSet& set, const std::vector<Combination>& columns) {
  Require(static_cast<int>(columns.size()) == 1 + set.dim, "a set in R^", set.dim, " needs ",
          1 + set.dim, " combinations of columns, for t and each x, got ", columns.size());
  const int first_aux = AddAux(set.num_aux);
  const int first_row = static_cast<int>(lower_.size());
  lower_.insert(lower_.end(), set.lower.begin(), set.lower.end());
  upper_.insert(upper_.end(), set.upper.begin(), set.upper.end());
  const int first_cone_row = cone_rows_;
  for (const sy_cone& cone : set.cones) AddCone(cone);
  const auto put = [&](const Csc& matrix, int first, std::vector<Entry>& entries) {
    for (int j = 0; j < matrix.cols; ++j) {
      const auto at = static_cast<std::size_t>(j);
      const Combination places =
          j <= set.dim ? columns[at] : Combination{{first_aux + j - 1 - set.dim, 1.0}};
      for (auto k = static_cast<std::size_t>(matrix.start[at]);
           k < static_cast<std::size_t>(matrix.start[at + 1]); ++k) {
        for (const auto& [column, factor] : places) {
          const double value = factor * matrix.value[k];
          if (value != 0) entries.push_back({first + matrix.row[k], column, value});
        }
      }
    }
  };
  put(set.A, first_row, A_);
  put(set.F, first_cone_row, F_);
  return first_aux;
}

int ScaledRows::AddSet(const ScaledSet& set) {
  std::vector<Combination> same;
  for (int j = 0; j <= set.dim; ++j) same.push_back({{j, 1.0}});
  return AddSet(set, same);
}

ScaledSet ScaledRows::Finish() const {
  const int columns = 1 + dim_ + num_aux_;
  const auto sealed = [columns](const std::vector<Entry>& entries, int rows) {
    TripletMatrix matrix;
    for (const Entry& e : entries) matrix.Add(e.row, e.column, e.value);
    return matrix.SealOnce(rows, columns);
  };
  return {dim_,   num_aux_, sealed(A_, static_cast<int>(lower_.size())),
          lower_, upper_,   sealed(F_, cone_rows_),
          cones_};
}

}  // namespace switchyard
