#include "solvers/conic/warm_start.hpp"

#include <algorithm>
#include <cmath>

#include "switchyard/cones.hpp"

namespace switchyard::conic {
namespace {

void MoveInside(const Form& form, Vector& v) {
  Vector one;
  for (const ConeGroup& g : form.cones) {
    one.resize(g.layout.dim);
    for (Index c = 0; c < g.layout.count; ++c) {
      for (Index i = 0; i < g.layout.dim; ++i) one[i] = v[g.first + g.layout.Row(c, i)];
      FactsOf(g.kind).into_dual(one.data(), g.layout.dim, g.parameter);
      for (Index i = 0; i < g.layout.dim; ++i) v[g.first + g.layout.Row(c, i)] = one[i];
    }
  }
  for (auto i = static_cast<std::size_t>(form.shape.cone_rows); i < v.size(); ++i) {
    v[i] = std::max(v[i], 0.0);
  }
}

}  // namespace

Iterate AsIterate(const presolve::Answer& answer, const Form& form) {
  const Shape& s = form.shape;
  Iterate at{form.PointForth(answer.x.data()),
             Vector(s.equations),
             Vector(s.slacks()),
             Vector(s.slacks()),
             1,
             0};
  const Vector y = form.RowDualsForth(answer.row_dual.data(), answer.cone_dual.data());
  Vector a_x(s.rows());
  Multiply(form.A, at.x.data(), a_x.data());
  std::copy(y.begin() + s.conic_rows(), y.end(), at.y.begin());
  // A dual of either sign is one of two sides.
  const auto split = [](double dual, double& lower, double& upper) {
    lower = std::max(dual, 0.0);
    upper = std::max(-dual, 0.0);
  };
  for (Index r = 0; r < s.conic_rows(); ++r) {
    at.s[r] = a_x[r] - form.b[r];
    at.z[r] = y[r];
    const Index range = r - s.cone_rows, top = s.range_tops() + range;
    if (range < 0 || range >= s.ranges) continue;
    at.s[top] = form.range_top[range] - a_x[r];
    split(y[r], at.z[r], at.z[top]);
  }
  for (Index j = 0; j < s.bounded; ++j) {
    const double dual =
        answer.x_dual[form.variable[j]] * form.column_scale[j] * form.objective_scale;
    double none = 0;
    const bool boxed = j < s.boxed;
    at.s[s.lower_bounds() + j] = at.x[j] - form.lower[j];
    if (boxed) at.s[s.upper_bounds() + j] = form.upper[j] - at.x[j];
    split(dual, at.z[s.lower_bounds() + j], boxed ? at.z[s.upper_bounds() + j] : none);
  }
  for (Vector* v : {&at.s, &at.z}) MoveInside(form, *v);
  return at;
}

Iterate Carried(const Iterate& at, const Form& from, const Form& to) {
  const Shape& s = to.shape;
  const double cost = to.objective_scale / from.objective_scale;
  Iterate carried = at;
  const auto scale_slack = [&](Index slack, double unit) {
    carried.s[slack] *= unit;
    carried.z[slack] *= cost / unit;
  };
  for (Index r = 0; r < s.rows(); ++r) {
    const double unit = to.row_scale[r] / from.row_scale[r];
    if (r < s.conic_rows()) {
      scale_slack(r, std::abs(unit));
    } else {
      carried.y[r - s.conic_rows()] *= cost / unit;
    }
  }
  for (Index i = 0; i < s.ranges; ++i) {
    const Index r = s.cone_rows + i;
    scale_slack(s.range_tops() + i, std::abs(to.row_scale[r] / from.row_scale[r]));
  }
  for (Index j = 0; j < s.vars; ++j) {
    const double unit = from.column_scale[j] / to.column_scale[j];
    carried.x[j] *= unit;
    if (j < s.bounded) scale_slack(s.lower_bounds() + j, std::abs(unit));
    if (j < s.boxed) scale_slack(s.upper_bounds() + j, std::abs(unit));
  }
  return carried;
}

}  // namespace switchyard::conic
