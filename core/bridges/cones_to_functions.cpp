// Cones become functions for a solver of nonlinear programs: the rows of each are variables of
// their own, s = Fx + g, behind all others, and smooth_cones.hpp says what holds of them.
//
// The duals of the rows s - Fx = g are, negated, those of the cones: stationarity in x sees nothing
// else.
#include <algorithm>
#include <cmath>

#include "core/bridges/bridges.hpp"
#include "core/bridges/smooth_cones.hpp"

namespace switchyard {
namespace {

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

constexpr double kRounding = 1e-13;

bool AllFinite(const double* values, std::size_t count) {
  return std::all_of(values, values + count, [](double v) { return std::isfinite(v); });
}

/// The functions of the problem, if it has any, with those of the cones behind them.
class ConeFunctions {
 public:
  /// `cones`: their rows are the variables from `first` on.
  ConeFunctions(const sy_nlp* inner, std::int32_t first, const std::vector<sy_cone>& cones)
      : inner_(inner), first_(first) {
    std::int32_t row = inner != nullptr ? inner->num_constraints : 0;
    inner_rows_ = row;
    jacobian_ = Inner(inner != nullptr ? &inner->jacobian : nullptr);
    hessian_ = Inner(inner != nullptr ? &inner->hessian : nullptr);
    inner_jacobian_ = jacobian_.row.size();
    inner_hessian_ = hessian_.row.size();
    if (inner != nullptr) {
      lower_.assign(inner->lower, inner->lower + row);
      upper_.assign(inner->upper, inner->upper + row);
    }
    std::int32_t variable = first;
    for (const sy_cone& cone : cones) {
      const SmoothCone& functions = *SmoothConeOf(cone.kind);
      terms_.push_back({&functions, cone, variable, row});
      AddPatterns(terms_.back());
      variable += cone.dim;
      row += functions.rows(cone.dim);
    }
    lower_.resize(At(row), 0);
    upper_.resize(At(row), kInfinity);
    jacobian_.rows = row;
    jacobian_.cols = hessian_.rows = hessian_.cols = variable;
    WriteRecord();
  }
  ConeFunctions(const ConeFunctions&) = delete;
  ConeFunctions& operator=(const ConeFunctions&) = delete;

  [[nodiscard]] const sy_nlp& record() const { return record_; }
  [[nodiscard]] std::int32_t inner_rows() const { return inner_rows_; }

  /// Multipliers of the cones' functions at s whose gradients make up the duals z as well as they
  /// can, NaN where s is on no smooth part of a boundary; z keeps what is left: bounds' duals.
  void Split(const std::vector<double>& s, std::vector<double>& z,
             std::vector<double>& multipliers) const {
    for (const Term& t : terms_) {
      const auto rows = At(t.functions->rows(t.cone.dim));
      const auto dim = At(t.cone.dim);
      const double* point = s.data() + (t.first - first_);
      double* dual = z.data() + (t.first - first_);
      std::vector<double> J(rows * dim);
      if (rows > 0) t.functions->jacobian(point, t.cone.dim, t.cone.parameter, J.data());
      // Of the power cone's two functions the one on whose side the point is.
      const std::size_t active = rows == 2 && point[2] < 0 ? 1 : 0;
      double along = 0;
      double length = 0;
      double largest = 0;
      for (std::size_t j = 0; rows > 0 && j < dim; ++j) {
        const double slope = J[j * rows + active];
        along += slope * dual[j];
        length += slope * slope;
        largest = std::max(largest, std::abs(dual[j]));
      }
      for (std::size_t i = 0; i < rows; ++i) {
        multipliers.push_back(i != active ? 0.0 : along / length);
      }
      for (std::size_t j = 0; rows > 0 && j < dim; ++j) {
        dual[j] -= along / length * J[j * rows + active];
        if (std::abs(dual[j]) <= kRounding * largest) dual[j] = 0;
      }
    }
  }

 private:
  struct Term {
    const SmoothCone* functions;
    sy_cone cone;
    std::int32_t first;  // variable
    std::int32_t row;    // of the nlp
  };

  [[nodiscard]] Csc Inner(const sy_csc* given) const {
    Csc pattern = given != nullptr ? Csc(*given) : Csc(0, first_);
    pattern.value.clear();
    return pattern;
  }

  // Behind the columns of the inner functions: what the cones add stands in their own columns.
  void AddPatterns(const Term& term) {
    const std::int32_t rows = term.functions->rows(term.cone.dim);
    for (std::int32_t j = 0; j < term.cone.dim; ++j) {
      for (std::int32_t i = 0; i < rows; ++i) jacobian_.row.push_back(term.row + i);
      jacobian_.start.push_back(static_cast<std::int32_t>(jacobian_.row.size()));
      for (std::int32_t i = 0; rows > 0 && i <= j; ++i) {
        if (term.functions->curved(i, j)) hessian_.row.push_back(term.first + i);
      }
      hessian_.start.push_back(static_cast<std::int32_t>(hessian_.row.size()));
    }
  }

  void WriteRecord() {
    constexpr std::uint32_t kAll =
        SY_OBJECTIVE | SY_GRADIENT | SY_CONSTRAINTS | SY_JACOBIAN | SY_HESSIAN;
    record_.size = sizeof record_;
    record_.flags = inner_ != nullptr ? inner_->flags : std::uint32_t{SY_NLP_CONCURRENT};
    record_.provides = inner_ != nullptr ? inner_->provides : kAll;
    record_.num_constraints = static_cast<std::int32_t>(lower_.size());
    record_.lower = lower_.data();
    record_.upper = upper_.data();
    record_.jacobian = jacobian_.View();
    record_.hessian = hessian_.View();
    record_.context = this;
    record_.evaluate = [](void* self, sy_evaluation* e) noexcept {
      return static_cast<const ConeFunctions*>(self)->Evaluate(*e);
    };
  }

  sy_verdict Evaluate(sy_evaluation& e) const {
    if ((e.want & SY_OBJECTIVE) != 0 && e.objective != nullptr) *e.objective = 0;
    if ((e.want & SY_GRADIENT) != 0 && e.gradient != nullptr) {
      std::fill_n(e.gradient, jacobian_.cols, 0.0);
    }
    if (inner_ != nullptr) {
      const sy_verdict verdict = inner_->evaluate(inner_->context, &e);
      if (verdict != SY_EVALUATED) return verdict;
    }
    return EvaluateCones(e) ? SY_EVALUATED : SY_UNDEFINED;
  }

  bool EvaluateCones(const sy_evaluation& e) const {
    const bool values = (e.want & SY_CONSTRAINTS) != 0 && e.constraints != nullptr;
    const bool slopes = (e.want & SY_JACOBIAN) != 0 && e.jacobian != nullptr;
    const bool curves = (e.want & SY_HESSIAN) != 0 && e.hessian != nullptr;
    for (const Term& t : terms_) {
      const std::int32_t dim = t.cone.dim;
      if (t.functions->rows(dim) == 0) continue;
      const double* s = e.x + t.first;
      const double a = t.cone.parameter;
      if (values) t.functions->values(s, dim, a, e.constraints + t.row);
      if (slopes) {
        t.functions->jacobian(s, dim, a, e.jacobian + jacobian_.start[At(t.first)]);
      }
      if (curves) {
        t.functions->hessian(s, dim, a, e.multipliers + t.row,
                             e.hessian + hessian_.start[At(t.first)]);
      }
    }
    const auto finite = [](const double* all, std::size_t from, std::size_t to) {
      return AllFinite(all + from, to - from);
    };
    return (!values || finite(e.constraints, At(inner_rows_), lower_.size())) &&
           (!slopes || finite(e.jacobian, inner_jacobian_, jacobian_.row.size())) &&
           (!curves || finite(e.hessian, inner_hessian_, hessian_.row.size()));
  }

  const sy_nlp* inner_;
  std::int32_t first_;
  std::int32_t inner_rows_ = 0;
  std::size_t inner_jacobian_ = 0;
  std::size_t inner_hessian_ = 0;
  std::vector<Term> terms_;
  Csc jacobian_, hessian_;
  std::vector<double> lower_, upper_;
  sy_nlp record_{};
};

class ConesToFunctionsBridge final : public Bridge {
 public:
  ConesToFunctionsBridge(const ProblemData& before, std::vector<std::uint8_t> moved, Csc rows,
                         std::vector<double> offset, std::unique_ptr<ConeFunctions> functions)
      : vars_(At(before.num_vars)),
        rows_(At(before.num_rows())),
        moved_(std::move(moved)),
        stays_(moved_.size()),
        F_(std::move(rows)),
        g_(std::move(offset)),
        functions_(std::move(functions)) {
    for (std::size_t i = 0; i < stays_.size(); ++i) stays_[i] = moved_[i] == 0 ? 1 : 0;
  }

  void Back(Vectors& v) const override {
    if (!v.x.empty()) v.x.resize(vars_);
    if (!v.x_dual.empty()) v.x_dual.resize(vars_);
    if (!v.nlp_dual.empty()) v.nlp_dual.resize(At(functions_->inner_rows()));
    if (v.row_dual.empty()) return;
    std::vector<double> cone_dual(moved_.size());
    std::size_t from_row = rows_;
    std::size_t from_cone = 0;
    for (std::size_t i = 0; i < moved_.size(); ++i) {
      cone_dual[i] = moved_[i] != 0        ? -v.row_dual[from_row++]
                     : v.cone_dual.empty() ? 0.0
                                           : v.cone_dual[from_cone++];
    }
    v.cone_dual = std::move(cone_dual);
    v.row_dual.resize(rows_);
  }

  void Forward(Vectors& v) const override {
    const bool any_dual = !v.row_dual.empty() || !v.cone_dual.empty() || !v.x_dual.empty();
    if (!v.x.empty()) {
      std::vector<double> s = g_;
      MultiplyAdd(F_.View(), 1, v.x.data(), s.data());
      v.x.insert(v.x.end(), s.begin(), s.end());
    }
    if (!any_dual) return;
    v.row_dual.resize(rows_, std::nan(""));
    v.cone_dual.resize(moved_.size(), std::nan(""));
    v.nlp_dual.resize(At(functions_->inner_rows()), std::nan(""));
    std::vector<double> z = Keep(v.cone_dual, moved_);
    for (const double dual : z) v.row_dual.push_back(-dual);
    v.cone_dual = Keep(v.cone_dual, stays_);
    if (v.x.empty()) {
      v.nlp_dual.resize(At(functions_->record().num_constraints), std::nan(""));
    } else {
      functions_->Split({v.x.begin() + static_cast<std::ptrdiff_t>(vars_), v.x.end()}, z,
                        v.nlp_dual);
    }
    if (!v.x_dual.empty()) v.x_dual.insert(v.x_dual.end(), z.begin(), z.end());
  }

 private:
  std::size_t vars_;
  std::size_t rows_;
  std::vector<std::uint8_t> moved_;  // of each cone row
  std::vector<std::uint8_t> stays_;
  Csc F_;  // of those that moved
  std::vector<double> g_;
  std::unique_ptr<ConeFunctions> functions_;
};

/// -F with the identity behind it.
Csc EquationRows(const Csc& F) {
  Csc rows = F;
  for (double& value : rows.value) value = -value;
  for (std::int32_t i = 0; i < F.rows; ++i) {
    rows.row.push_back(i);
    rows.value.push_back(1);
    rows.start.push_back(static_cast<std::int32_t>(rows.row.size()));
  }
  rows.cols += F.rows;
  return rows;
}

void AddColumns(Csc& m, std::int32_t count) {
  m.cols += count;
  m.start.resize(At(m.cols) + 1, m.start.back());
}

Bridged Apply(ProblemData d) {
  std::vector<std::uint8_t> moved;
  std::vector<std::uint8_t> stays;
  std::vector<sy_cone> smooth;
  std::vector<sy_cone> others;
  for (const sy_cone& cone : d.cones) {
    const bool is_smooth = SmoothConeOf(cone.kind) != nullptr;
    (is_smooth ? smooth : others).push_back(cone);
    moved.insert(moved.end(), At(cone.dim), is_smooth ? 1 : 0);
    stays.insert(stays.end(), At(cone.dim), is_smooth ? 0 : 1);
  }
  Csc F = KeepRows(d.F, moved);
  std::vector<double> g = Keep(d.g, moved);
  auto functions = std::make_unique<ConeFunctions>(d.nlp, d.num_vars, smooth);
  const sy_nlp* record = &functions->record();
  auto maps =
      std::make_unique<ConesToFunctionsBridge>(d, std::move(moved), F, g, std::move(functions));
  d.F = KeepRows(d.F, stays);
  d.g = Keep(d.g, stays);
  for (Csc* m : {&d.A, &d.F, &d.P}) AddColumns(*m, F.rows);
  d.P.rows = d.P.cols;
  d.A = StackRows(d.A, EquationRows(F));
  d.row_lower.insert(d.row_lower.end(), g.begin(), g.end());
  d.row_upper.insert(d.row_upper.end(), g.begin(), g.end());
  d.q.resize(d.q.size() + At(F.rows), 0.0);
  d.x_lower.resize(At(d.num_vars), -kInfinity);
  d.x_upper.resize(At(d.num_vars), kInfinity);
  for (const sy_cone& cone : smooth) {
    for (std::int32_t i = 0; i < cone.dim; ++i) {
      d.x_lower.push_back(SmoothConeOf(cone.kind)->nonnegative(i) ? 0 : -kInfinity);
      d.x_upper.push_back(kInfinity);
    }
  }
  if (!d.integer.empty()) d.integer.resize(d.integer.size() + At(F.rows), 0);
  d.num_vars += F.rows;
  d.cones = std::move(others);
  d.nlp = record;
  return {std::move(d), std::move(maps)};
}

}  // namespace

BridgeKind ConesToFunctions() {
  return {"cones to smooth functions",
          ConeFeature(SY_CONE_SECOND_ORDER) | ConeFeature(SY_CONE_EXPONENTIAL) |
              ConeFeature(SY_CONE_POWER),
          SY_ACCEPTS_NLP | SY_ACCEPTS_ROWS | SY_ACCEPTS_BOUNDS, Apply};
}

}  // namespace switchyard
