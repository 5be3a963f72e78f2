#include "solvers/conic/twofold_condensing.hpp"

#include <algorithm>

namespace switchyard::conic {
namespace {

using Number = linalg::Twofold<double>;

Number At(const linalg::Numbers& v, std::size_t i) { return {v.high[i], v.low[i]}; }

/// out = (H + r)^-1 c for the rows of a cone.
void DivideCone(const ConeGroup& group, const KktWeights& weights, std::size_t part, Index cone,
                const std::vector<Number>& c, std::vector<Number>& out) {
  const cones::Layout& layout = group.layout;
  const KktWeights::Part& rest = weights.cones[part];
  const auto count = static_cast<std::size_t>(layout.count);
  for (Index i = 0; i < layout.dim; ++i) {
    out[i] = c[i] * weights.cone_row[group.first + layout.Row(cone, i)];
  }
  for (std::size_t k = 0; k < rest.w.size() / count; ++k) {
    const double* v = rest.v.data() + k * layout.rows();
    Number along;
    for (Index i = 0; i < layout.dim; ++i) along += c[i] * v[layout.Row(cone, i)];
    along *= Number{rest.w[k * count + cone]};
    for (Index i = 0; i < layout.dim; ++i) out[i] += along * v[layout.Row(cone, i)];
  }
}

/// take(row, (H + r)^-1 of `side(row)`) for all rows of cones; `workers` share the groups.
template <class Side, class Take>
void DivideCones(const Form& form, const KktWeights& weights, linalg::Workers* workers, Side&& side,
                 Take&& take) {
  const auto divide = [&](std::size_t p) {
    const ConeGroup& group = form.cones[p];
    std::vector<Number> c(group.layout.dim), out(group.layout.dim);
    for (Index cone = 0; cone < group.layout.count; ++cone) {
      const auto row = [&](Index i) { return group.first + group.layout.Row(cone, i); };
      for (Index i = 0; i < group.layout.dim; ++i) c[i] = side(row(i));
      DivideCone(group, weights, p, cone, c, out);
      for (Index i = 0; i < group.layout.dim; ++i) take(row(i), out[i]);
    }
  };
  linalg::EachPart(workers, form.cones.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) divide(p);
  });
}

/// body(i) for i in [0, count); `workers` share them.
template <class Body>
void Each(linalg::Workers* workers, Index count, Body&& body) {
  constexpr std::size_t kGrain = 1024;
  linalg::EachPart(workers, static_cast<std::size_t>(count), kGrain,
                   [&](std::size_t begin, std::size_t end) {
                     for (std::size_t i = begin; i < end; ++i) body(static_cast<Index>(i));
                   });
}

}  // namespace

void CondenseTwofold(const Form& form, const KktWeights& weights, const Triple& right,
                     std::size_t kept, linalg::Workers* workers,
                     const linalg::NumbersOf<double>& condensed) {
  const Shape& s = form.shape;
  const std::size_t own = right.x.size() + right.y.size();
  std::copy(right.x.begin(), right.x.end(), condensed.high);
  std::copy(right.y.begin(), right.y.end(), condensed.high + s.vars);
  std::fill_n(condensed.high + own, kept, 0.0);
  std::fill_n(condensed.low, own + kept, 0.0);
  const auto weighed = [&](Index slack) {
    return Number::Product(weights.slack[slack - s.cone_rows], right.z[slack]);
  };
  std::vector<Number> side(s.conic_rows());  // R^-1 c
  DivideCones(
      form, weights, workers, [&](Index r) { return Number{right.z[r]}; },
      [&](Index r, const Number& v) { side[r] = v; });
  for (Index i = 0; i < s.inequalities; ++i) {
    const Index r = s.cone_rows + i;
    side[r] = i < s.ranges ? weighed(r) - weighed(s.range_tops() + i) : weighed(r);
  }
  Each(workers, s.vars, [&](Index j) {
    Number sum = At({condensed.high, condensed.low}, j);
    for (Index e = form.A.column_start[j]; e < form.A.column_start[j + 1]; ++e) {
      const Index r = form.A.row[e];
      if (r < s.conic_rows()) sum += side[r] * form.A.by_column[e];
    }
    if (j < s.bounded) sum += weighed(s.lower_bounds() + j);
    if (j < s.boxed) sum -= weighed(s.upper_bounds() + j);
    condensed.high[j] = sum.high;
    condensed.low[j] = sum.low;
  });
}

void ExpandTwofold(const Form& form, const KktWeights& weights, const Triple& right,
                   const linalg::Numbers& solution, linalg::Workers* workers, KktStep& step) {
  const Shape& s = form.shape;
  std::copy_n(solution.high, s.vars, step.x.begin());
  for (Index i = 0; i < s.equations; ++i) step.y[i] = -solution.high[s.vars + i];
  std::vector<Number> a_x(form.A.rows);
  Each(workers, form.A.rows, [&](Index r) {
    for (Index e = form.A.row_start[r]; e < form.A.row_start[r + 1]; ++e) {
      a_x[r] += At(solution, form.A.column[e]) * form.A.by_row[e];
    }
    step.a_x[r] = a_x[r].high;
  });
  DivideCones(
      form, weights, workers, [&](Index r) { return Number{right.z[r]} - a_x[r]; },
      [&](Index r, const Number& v) { step.z[r] = v.high; });
  const auto put = [&](Index slack, const Number& g_x) {
    step.z[slack] = ((Number{right.z[slack]} - g_x) * weights.slack[slack - s.cone_rows]).high;
  };
  for (Index i = 0; i < s.inequalities; ++i) put(s.cone_rows + i, a_x[s.cone_rows + i]);
  for (Index i = 0; i < s.ranges; ++i) put(s.range_tops() + i, -a_x[s.cone_rows + i]);
  for (Index j = 0; j < s.bounded; ++j) put(s.lower_bounds() + j, At(solution, j));
  for (Index j = 0; j < s.boxed; ++j) put(s.upper_bounds() + j, -At(solution, j));
}

}  // namespace switchyard::conic
