// min 1/2 x'Px + q'x becomes min t + q'x with 2 t 1 >= |Sx|^2, P = S'S: a variable t and a rotated
// cone (t, 1, Sx) behind all others.
//
// At a solution the cone's dual is (1, t, -Sx), so S'(-Sx) = -Px stands where Px stood, and the
// other duals pass as they are.
#include <cmath>

#include "core/bridges/bridges.hpp"
#include "core/linalg/semidefinite_factor.hpp"
#include "switchyard/error.hpp"

namespace switchyard {
namespace {

class QuadraticObjectiveBridge final : public Bridge {
 public:
  /// `cone`: the rows (t, 0, Sx) over the image's variables.
  QuadraticObjectiveBridge(std::size_t vars, std::size_t cone_rows, Csc P, Csc cone)
      : vars_(vars), cone_rows_(cone_rows), P_(std::move(P)), cone_(std::move(cone)) {}

  void Back(Vectors& v) const override {
    if (!v.x.empty()) v.x.resize(vars_);
    if (!v.x_dual.empty()) v.x_dual.resize(vars_);
    if (!v.cone_dual.empty()) v.cone_dual.resize(cone_rows_);
  }

  void Forward(Vectors& v) const override {
    if (!v.x.empty()) v.x.push_back(0.5 * QuadraticForm(P_.View(), v.x.data()));
    if (!v.x_dual.empty()) v.x_dual.push_back(0);
    if (v.x_dual.empty() && v.row_dual.empty() && v.cone_dual.empty()) return;
    const auto rows = static_cast<std::size_t>(cone_.rows);
    v.cone_dual.resize(cone_rows_, std::nan(""));
    v.cone_dual.resize(cone_rows_ + rows, v.x.empty() ? std::nan("") : 0.0);
    if (v.x.empty()) return;
    double* dual = v.cone_dual.data() + cone_rows_;
    MultiplyAdd(cone_.View(), -1, v.x.data(), dual);
    dual[1] = -dual[0];
    dual[0] = 1;
  }

 private:
  std::size_t vars_;
  std::size_t cone_rows_;
  Csc P_;
  Csc cone_;
};

/// (t, 0, Sx) over (x, t).
Csc ConeRows(const Csc& S) {
  Csc cone = S;
  cone.rows += 2;
  cone.cols += 1;
  for (std::int32_t& row : cone.row) row += 2;
  cone.row.push_back(0);
  cone.value.push_back(1);
  cone.start.push_back(static_cast<std::int32_t>(cone.row.size()));
  return cone;
}

Bridged Apply(ProblemData d) {
  Require((d.flags & SY_PROBLEM_CONVEX) != 0,
          "a nonconvex quadratic objective has no form as a cone");
  Require(d.nlp == nullptr, "a quadratic objective beside nonlinear functions stays as it is");
  const auto vars = static_cast<std::size_t>(d.num_vars);
  const auto cone_rows = static_cast<std::size_t>(d.num_cone_rows());
  const SemidefiniteFactor factor = FactorSemidefinite(d.P);
  if (const auto& negative = factor.not_semidefinite) {
    Refuse("the quadratic objective is not convex: a pivot of its matrix is ", negative->pivot,
           " in the component of x[", negative->column, "]");
  }
  const std::int32_t rows = 2 + factor.S.rows;
  Csc P = std::move(d.P);
  d.P = Csc(d.num_vars + 1, d.num_vars + 1);
  d.num_vars += 1;
  for (Csc* m : {&d.A, &d.F}) {
    m->cols = d.num_vars;
    m->start.push_back(m->start.back());
  }
  Csc cone = ConeRows(factor.S);
  d.F = StackRows(d.F, cone);
  d.g.resize(cone_rows + static_cast<std::size_t>(rows), 0.0);
  d.g[cone_rows + 1] = 1;
  d.cones.push_back({SY_CONE_ROTATED, rows, 0});
  d.q.push_back(1);
  if (!d.x_lower.empty()) {
    d.x_lower.push_back(-kInfinity);
    d.x_upper.push_back(kInfinity);
  }
  if (!d.integer.empty()) d.integer.push_back(0);
  return {std::move(d), std::make_unique<QuadraticObjectiveBridge>(vars, cone_rows, std::move(P),
                                                                   std::move(cone))};
}

}  // namespace

BridgeKind QuadraticObjectiveToCone() {
  return {"quadratic objective to a rotated cone", SY_ACCEPTS_QUADRATIC_OBJECTIVE,
          ConeFeature(SY_CONE_ROTATED), Apply, true};
}

}  // namespace switchyard
