#include "solvers/conic/iterate.hpp"

#include <algorithm>
#include <cmath>

#include "solvers/conic/slacks.hpp"
#include "solvers/linalg/vector.hpp"

namespace switchyard::conic {

using linalg::AddMultiple;
using linalg::Dot;
using linalg::MaxAbs;

double Distance::Worst() const { return std::max({primal, dual_terms, gap}); }
double Distance::WorstByTerms() const { return std::max({primal_terms, dual_terms, gap}); }

Residuals::Residuals(const Form& form, linalg::Workers* workers)
    : r(form.shape),
      p_x(form.shape.vars),
      a_x(form.shape.rows()),
      h(form.shape.slacks()),
      form_(form),
      workers_(workers),
      row_unit_(form.shape.rows()),
      column_unit_(form.shape.vars),
      row_largest_(form.shape.rows()),
      column_largest_(form.shape.vars),
      rows_(form.shape.rows()),
      columns_(form.shape.vars) {
  const Shape& s = form.shape;
  std::copy_n(form.b.begin(), s.conic_rows(), h.begin());
  std::copy_n(form.lower.begin(), s.bounded, h.begin() + s.lower_bounds());
  for (Index i = 0; i < s.ranges; ++i) h[s.range_tops() + i] = -form.range_top[i];
  for (Index j = 0; j < s.boxed; ++j) h[s.upper_bounds() + j] = -form.upper[j];
  for (Index i = 0; i < s.rows(); ++i) row_unit_[i] = 1 / std::abs(form.row_scale[i]);
  for (Index j = 0; j < s.vars; ++j) column_unit_[j] = std::abs(form.column_scale[j]);
  for (Index i = 0; i < s.rows(); ++i) {
    for (Index e = form.A.row_start[i]; e < form.A.row_start[i + 1]; ++e) {
      const Index j = form.A.column[e];
      const double size = std::abs(form.A.by_row[e]) * row_unit_[i] / column_unit_[j];
      row_largest_[i] = std::max(row_largest_[i], size);
      column_largest_[j] = std::max(column_largest_[j], size);
    }
  }
}

void Residuals::Compute(const Iterate& at) {
  const Shape& s = form_.shape;
  Multiply(form_.A, at.x.data(), a_x.data(), workers_);
  std::fill(p_x.begin(), p_x.end(), 0.0);
  AddProduct(form_.P, 1, at.x.data(), p_x.data());
  quadratic = Dot(at.x, p_x);
  std::fill(columns_.begin(), columns_.end(), 0.0);
  AddSlackColumns(form_, at.y, at.z, workers_, rows_, columns_);
  for (Index j = 0; j < s.vars; ++j) r.x[j] = p_x[j] + form_.q[j] * at.tau - columns_[j];
  const double* b = form_.b.data() + s.conic_rows();
  for (Index i = 0; i < s.equations; ++i) r.y[i] = a_x[s.conic_rows() + i] - b[i] * at.tau;
  EachSlack(s, at.x, a_x, workers_,
            [&](Index slack, double g_x) { r.z[slack] = g_x - h[slack] * at.tau - at.s[slack]; });
  cost_ = Dot(form_.q, at.x);
  worth_ = Dot(b, at.y.data(), at.y.size()) + Dot(h, at.z);
  tau = -cost_ - quadratic / at.tau + worth_ - at.kappa;
  norm_dual = MaxAbs(r.x);
  norm_primal = std::max(MaxAbs(r.y), MaxAbs(r.z));
  MeasureRows(at);
  MeasureColumns(at);
}

// Of rows and bounds: what is left, what it is left of, and of a ray.
void Residuals::MeasureRows(const Iterate& at) {
  const Shape& s = form_.shape;
  double left = 0, largest = 0, term = 0, ray = 0;
  const auto see = [&](double residual, double value, double side, double of_ray, double unit) {
    left = std::max(left, std::abs(residual) * unit);
    largest = std::max({largest, std::abs(value) * unit, std::abs(side) * unit * at.tau});
    ray = std::max(ray, std::abs(of_ray) * unit);
  };
  for (Index i = 0; i < s.conic_rows(); ++i) {
    see(r.z[i], a_x[i], form_.b[i], a_x[i] - at.s[i], row_unit_[i]);
  }
  for (Index i = 0; i < s.ranges; ++i) {
    const Index row = s.cone_rows + i, top = s.range_tops() + i;
    see(r.z[top], a_x[row], form_.range_top[i], a_x[row] + at.s[top], row_unit_[row]);
  }
  for (Index i = 0; i < s.equations; ++i) {
    const Index row = s.conic_rows() + i;
    see(r.y[i], a_x[row], form_.b[row], a_x[row], row_unit_[row]);
  }
  for (Index j = 0; j < s.bounded; ++j) {
    const Index low = s.lower_bounds() + j;
    see(r.z[low], at.x[j], form_.lower[j], at.x[j] - at.s[low], column_unit_[j]);
  }
  for (Index j = 0; j < s.boxed; ++j) {
    const Index top = s.upper_bounds() + j;
    see(r.z[top], at.x[j], form_.upper[j], at.x[j] + at.s[top], column_unit_[j]);
  }
  for (Index j = 0; j < s.vars; ++j) {
    term = std::max(term, std::abs(at.x[j]) * column_unit_[j] * column_largest_[j]);
    ray = std::max(ray, std::abs(p_x[j]) / (column_unit_[j] * form_.objective_scale));
  }
  distance.primal = left / (at.tau + largest);
  distance.primal_terms = left / (at.tau + std::max(largest, term));
  distance.unbounded = cost_ < 0 ? ray / (-cost_ / form_.objective_scale) : kInfinity;
}

// Of stationarity and of the objectives.
void Residuals::MeasureColumns(const Iterate& at) {
  const Shape& s = form_.shape;
  double left = 0, largest = 0, term = 0, farkas = 0;
  for (Index j = 0; j < s.vars; ++j) {
    const double unit = 1 / (column_unit_[j] * form_.objective_scale);
    left = std::max(left, std::abs(r.x[j]) * unit);
    largest = std::max({largest, std::abs(p_x[j]) * unit, std::abs(form_.q[j]) * unit * at.tau});
    farkas = std::max(farkas, std::abs(columns_[j]) * unit);
  }
  for (Index i = 0; i < s.rows(); ++i) {  // rows_ has the multipliers
    term = std::max(term, std::abs(rows_[i]) * row_largest_[i] / row_unit_[i]);
  }
  term /= form_.objective_scale;
  Distance& d = distance;
  d.dual = left / (at.tau + largest);
  d.dual_terms = left / (at.tau + std::max(largest, term));
  const double scale = form_.objective_scale;
  d.primal_objective = (cost_ / at.tau + 0.5 * quadratic / (at.tau * at.tau)) / scale;
  d.dual_objective = (worth_ / at.tau - 0.5 * quadratic / (at.tau * at.tau)) / scale;
  d.gap = std::abs(d.primal_objective - d.dual_objective) /
          (1 + std::min(std::abs(d.primal_objective + form_.offset),
                        std::abs(d.dual_objective + form_.offset)));
  d.infeasible = worth_ > 0 ? farkas / (worth_ / scale) : kInfinity;
}

}  // namespace switchyard::conic
