// min 1/2 x'Px + q'x becomes min t + q'x with 2 t 1 >= |Sx|^2, P = S'S: a variable t and a rotated
// cone (t, 1, Sx) behind all others.
//
// S comes from a pivoted Cholesky factor of each connected component of P, dense: components of
// objectives are small or diagonal. Each pivot is the largest entry that the steps before it left
// on the diagonal, so a semidefinite P of any rank ends with a rest that is 0 to rounding. At a
// solution the cone's dual is (1, t, -Sx), so S'(-Sx) = -Px stands where Px stood, and the other
// duals pass as they are.
#include <Eigen/Core>
#include <cmath>
#include <numeric>

#include "core/bridges/bridges.hpp"
#include "core/problem/builder.hpp"
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

std::int32_t Root(std::vector<std::int32_t>& parent, std::int32_t j) {
  while (parent[static_cast<std::size_t>(j)] != j) {
    auto& up = parent[static_cast<std::size_t>(j)];
    up = parent[static_cast<std::size_t>(up)];
    j = up;
  }
  return j;
}

/// The variables of each connected component of P that has an entry.
std::vector<std::vector<std::int32_t>> Components(const Csc& P) {
  std::vector<std::int32_t> parent(static_cast<std::size_t>(P.cols));
  std::iota(parent.begin(), parent.end(), 0);
  std::vector<std::uint8_t> used(parent.size(), 0);
  for (std::int32_t j = 0; j < P.cols; ++j) {
    for (auto k = P.start[static_cast<std::size_t>(j)];
         k < P.start[static_cast<std::size_t>(j) + 1]; ++k) {
      const std::int32_t i = P.row[static_cast<std::size_t>(k)];
      used[static_cast<std::size_t>(i)] = used[static_cast<std::size_t>(j)] = 1;
      parent[static_cast<std::size_t>(Root(parent, i))] = Root(parent, j);
    }
  }
  std::vector<std::vector<std::int32_t>> members(parent.size());
  for (std::int32_t j = 0; j < P.cols; ++j) {
    if (used[static_cast<std::size_t>(j)] == 0) continue;
    members[static_cast<std::size_t>(Root(parent, j))].push_back(j);
  }
  std::erase_if(members, [](const auto& component) { return component.empty(); });
  return members;
}

/// Appends to `S` the rows of a factor of the component's block; returns how many.
std::int32_t FactorComponent(const Csc& P, const std::vector<std::int32_t>& members,
                             std::vector<std::int32_t>& local, std::int32_t first_row,
                             TripletMatrix& S) {
  const auto n = static_cast<Eigen::Index>(members.size());
  for (std::size_t k = 0; k < members.size(); ++k) {
    local[static_cast<std::size_t>(members[k])] = static_cast<std::int32_t>(k);
  }
  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(n, n);
  for (const std::int32_t j : members) {
    for (auto k = static_cast<std::size_t>(P.start[static_cast<std::size_t>(j)]);
         k < static_cast<std::size_t>(P.start[static_cast<std::size_t>(j) + 1]); ++k) {
      const auto a = local[static_cast<std::size_t>(P.row[k])];
      const auto b = local[static_cast<std::size_t>(j)];
      block(a, b) = block(b, a) = P.value[k];
    }
  }
  const double scale = block.cwiseAbs().maxCoeff();
  std::int32_t rows = 0;
  for (Eigen::Index p = 0; block.diagonal().maxCoeff(&p) > 1e-14 * scale; ++rows) {
    const Eigen::VectorXd s = block.col(p) / std::sqrt(block(p, p));
    for (Eigen::Index c = 0; c < n; ++c) {
      if (s[c] != 0) S.Add(first_row + rows, members[static_cast<std::size_t>(c)], s[c]);
    }
    block.noalias() -= s * s.transpose();
    block.row(p).setZero();  // what rounding left of it is not a pivot again
    block.col(p).setZero();
  }
  Require(block.cwiseAbs().maxCoeff() <= 1e-9 * scale,
          "the quadratic objective is not convex: a pivot of its matrix is ",
          block.diagonal().minCoeff(), " in the component of x[", members.front(), "]");
  return rows;
}

Bridged Apply(ProblemData d) {
  Require((d.flags & SY_PROBLEM_CONVEX) != 0,
          "a nonconvex quadratic objective has no form as a cone");
  const auto vars = static_cast<std::size_t>(d.num_vars);
  const auto cone_rows = static_cast<std::size_t>(d.num_cone_rows());
  TripletMatrix S;
  std::int32_t rows = 2;
  S.Add(0, d.num_vars, 1);
  std::vector<std::int32_t> local(vars, 0);
  for (const auto& component : Components(d.P)) {
    rows += FactorComponent(d.P, component, local, rows, S);
  }
  Csc P = std::move(d.P);
  d.P = Csc(d.num_vars + 1, d.num_vars + 1);
  d.num_vars += 1;
  for (Csc* m : {&d.A, &d.F}) {
    m->cols = d.num_vars;
    m->start.push_back(m->start.back());
  }
  Csc cone = S.Seal(rows, d.num_vars);
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
