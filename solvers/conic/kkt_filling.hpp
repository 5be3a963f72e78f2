// solvers/conic/kkt_filling.hpp - how kkt_values.hpp fills them, whatever a number is.
#pragma once

#include <algorithm>

#include "solvers/cones/kinds.hpp"
#include "solvers/conic/kkt_values.hpp"

namespace switchyard::conic {

/// N: double, or linalg::Twofold<double>; `Place` adds one to an entry.
template <class N, class Place>
class KktFilling {
 public:
  KktFilling(const Form& form, const KktPlan& plan, const KktWeights& weights, Place place)
      : f_(form), p_(plan), w_(weights), place_(place) {}

  void Fill() {
    const Shape& s = f_.shape;
    for (Index j = 0; j < s.vars; ++j) {
      place_.Add(p_.diagonal[j], {p_.group[j] == 0 ? w_.proximal : w_.uncurved});
    }
    for (Index j = 0; j < s.bounded; ++j) place_.Add(p_.diagonal[j], Slack(s.lower_bounds() + j));
    for (Index j = 0; j < s.boxed; ++j) place_.Add(p_.diagonal[j], Slack(s.upper_bounds() + j));
    for (Index i = 0; i < s.equations; ++i) place_.Add(p_.diagonal[s.vars + i], {-w_.proximal});
    for (Index r = 0, next = 0; r < s.conic_rows(); r = next) {
      next = r + 1;
      if (p_.row_target[r] < 0) continue;
      while (next < s.conic_rows() && p_.row_target[next] == p_.row_target[r]) ++next;
      next == r + 1 ? AddRow(r) : AddRows(r, next);
    }
    for (std::size_t k = 0; k < p_.kept_row.size(); ++k) {
      place_.Add(p_.kept_pivot[k], -linalg::Reciprocal(Row(p_.kept_row[k])));
    }
    for (const KktPlan::Cone& cone : p_.cones) AddCone(cone);
  }

 private:
  [[nodiscard]] N Slack(Index slack) const { return {w_.slack[slack - f_.shape.cone_rows]}; }
  /// What a conic row weighs, with both its sides.
  [[nodiscard]] N Row(Index r) const {
    const Index range = r - f_.shape.cone_rows;
    if (range < 0) return {w_.cone_row[r]};
    return range < f_.shape.ranges ? Slack(r) + Slack(f_.shape.range_tops() + range) : Slack(r);
  }

  void AddRow(Index r) {
    const linalg::SparseMatrix& a = f_.A;
    const Index* target = p_.target.data() + p_.row_target[r];
    const double* value = a.by_row.data() + a.row_start[r];
    const Index size = a.row_start[r + 1] - a.row_start[r];
    const N weight = Row(r);
    for (Index b = 0; b < size; ++b) {
      const N factor = weight * value[b];
      for (Index c = 0; c <= b; ++c) place_.Add(*target++, factor * value[c]);
    }
  }

  /// Of rows over the same variables: their products meet here before they are placed.
  void AddRows(Index begin, Index end) {
    const linalg::SparseMatrix& a = f_.A;
    const Index size = a.row_start[begin + 1] - a.row_start[begin];
    products_.assign(static_cast<std::size_t>(size) * (size + 1) / 2, N{});
    for (Index r = begin; r < end; ++r) {
      const double* value = a.by_row.data() + a.row_start[r];
      const N weight = Row(r);
      N* product = products_.data();
      for (Index b = 0; b < size; ++b) {
        const N factor = weight * value[b];
        for (Index c = 0; c <= b; ++c) product[c] += factor * value[c];
        product += b + 1;
      }
    }
    const Index* target = p_.target.data() + p_.row_target[begin];
    for (const N& product : products_) place_.Add(*target++, product);
  }

  void AddCone(const KktPlan::Cone& cone) {
    const ConeGroup& group = f_.cones[cone.part];
    const KktWeights::Part& part = w_.cones[cone.part];
    const auto count = static_cast<std::size_t>(group.layout.count);
    const std::size_t rank = part.w.size() / count;
    for (std::size_t k = 0; k < rank; ++k) {
      Combine(cone, part.v.data() + k * group.layout.rows());
      const double w = part.w[k * count + cone.cone];
      if (cone.kept()) {
        KeepCombination(cone, static_cast<Index>(k), w);
      } else if (w != 0) {
        CondenseCombination(cone, w);
      }
    }
  }

  /// combined_ = v'F of the cone, by its columns.
  void Combine(const KktPlan::Cone& cone, const double* v) {
    const ConeGroup& group = f_.cones[cone.part];
    combined_.assign(cone.num_columns, N{});
    const Index* local = p_.local_place.data() + cone.local;
    for (Index i = 0; i < group.layout.dim; ++i) {
      const Index row = group.layout.Row(cone.cone, i), r = group.first + row;
      for (Index e = f_.A.row_start[r]; e < f_.A.row_start[r + 1]; ++e) {
        combined_[*local++] += Place::Product(f_.A.by_row[e], v[row]);
      }
    }
  }

  void CondenseCombination(const KktPlan::Cone& cone, double w) {
    const Index* target = p_.target.data() + cone.target;
    for (Index b = 0; b < cone.num_columns; ++b) {
      const N factor = combined_[b] * w;
      for (Index c = 0; c <= b; ++c) place_.Add(*target++, factor * combined_[c]);
    }
  }

  void KeepCombination(const KktPlan::Cone& cone, Index k, double w) {
    const Index first = cone.kept_entry + k * (cone.num_columns + 1);
    for (Index b = 0; b < cone.num_columns; ++b) place_.Add(first + b, combined_[b]);
    const Index pivot = first + cone.num_columns;
    if (w != 0) {
      place_.Add(pivot, -linalg::Reciprocal(N{w}));
    } else {
      const cones::Kind& kind = *cones::FindKind(f_.cones[cone.part].kind);
      place_.Add(pivot, {k == 0 && kind.diagonal_but_for_two ? kInfinity : -kInfinity});
    }
  }

  const Form& f_;
  const KktPlan& p_;
  const KktWeights& w_;
  Place place_;
  std::vector<N> combined_, products_;
};

}  // namespace switchyard::conic
