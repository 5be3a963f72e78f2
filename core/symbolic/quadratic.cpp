#include <algorithm>
#include <cmath>
#include <span>

#include "core/symbolic/columns.hpp"
#include "core/symbolic/node.hpp"
#include "core/symbolic/quadratic.hpp"
#include "switchyard/error.hpp"
#include "switchyard/symbolic/decompose.hpp"

namespace switchyard {
namespace {

using Triplet = Eigen::Triplet<double>;

// a'x + a_0, by columns.
struct Affine {
  std::vector<std::pair<int, double>> terms;
  double constant;
};

// 1/2 x'Qx + b'x + c, as it is added up.
struct Sums {
  Columns columns;
  std::vector<Triplet> Q;
  std::vector<std::pair<int, double>> b;
  double c = 0;

  Affine ByColumns(const Expression& e) {
    Affine affine{{}, e.constant()};
    for (const auto& [variable, coefficient] : e.MergedLinear()) {
      affine.terms.emplace_back(columns.Of(variable), coefficient);
    }
    return affine;
  }

  // += factor (u'x + u_0) (v'x + v_0) = factor (x' uv' x + (v_0 u + u_0 v)'x + u_0 v_0), where
  // x' uv' x = 1/2 x'(uv' + vu') x.
  void AddProduct(double factor, const Affine& u, const Affine& v) {
    for (const auto& [i, u_i] : u.terms) {
      for (const auto& [j, v_j] : v.terms) {
        Q.emplace_back(i, j, factor * u_i * v_j);
        Q.emplace_back(j, i, factor * u_i * v_j);
      }
    }
    for (const auto& [i, u_i] : u.terms) b.emplace_back(i, factor * v.constant * u_i);
    for (const auto& [j, v_j] : v.terms) b.emplace_back(j, factor * u.constant * v_j);
    c += factor * u.constant * v.constant;
  }

  QuadraticForm Finish() const {
    const int n = columns.size();
    QuadraticForm form{SparseMatrix(n, n), Eigen::VectorXd::Zero(n), c, {}};
    form.Q.setFromTriplets(Q.begin(), Q.end());
    form.Q.prune([](Eigen::Index, Eigen::Index, double value) { return value != 0; });
    for (const auto& [i, b_i] : b) form.b[i] += b_i;
    form.variables = Eigen::Map<const VectorXDecisionVariable>(columns.variables().data(), n);
    return form;
  }
};

// Leaves out the variables whose coefficients all cancelled.
QuadraticForm OfUsedVariables(QuadraticForm form) {
  std::vector<Eigen::Index> used;
  for (Eigen::Index j = 0; j < form.b.size(); ++j) {
    if (form.b[j] != 0 || form.Q.outerIndexPtr()[j] < form.Q.outerIndexPtr()[j + 1]) {
      used.push_back(j);
    }
  }
  const auto count = static_cast<Eigen::Index>(used.size());
  if (count == form.b.size()) return form;
  SparseMatrix choose(count, form.b.size());
  for (Eigen::Index i = 0; i < count; ++i) choose.insert(i, used[static_cast<std::size_t>(i)]) = 1;
  const SparseMatrix back = choose.transpose();
  const SparseMatrix rows = choose * form.Q;
  form.Q = rows * back;
  form.b = (choose * form.b).eval();
  form.variables = VectorXDecisionVariable(form.variables(used));
  return form;
}

}  // namespace

bool HasQuadraticForm(const ExpressionNode& node) {
  if (node.op() == Op::kMultiply) return IsAffine(node.operand(0)) && IsAffine(node.operand(1));
  return IsSquareOfAffine(node);
}

bool IsSquareOfAffine(const ExpressionNode& node) {
  return IsWholePower(node) && node.operand(1).constant() == 2 && IsAffine(node.operand(0));
}

bool IsQuadratic(const Expression& e) {
  return std::all_of(e.nonlinear().begin(), e.nonlinear().end(),
                     [](const auto& term) { return HasQuadraticForm(*term.node); });
}

QuadraticForm DecomposeQuadratic(const Expression& e) {
  Sums sums{Columns(std::span(&e, 1)), {}, {}, e.constant()};
  for (const auto& [variable, coefficient] : e.MergedLinear()) {
    sums.b.emplace_back(sums.columns.Of(variable), coefficient);
  }
  for (const auto& [node, coefficient] : e.nonlinear()) {
    if (!HasQuadraticForm(*node)) {
      Refuse(e.to_string(60), " is not quadratic: the term ",
             Expression(coefficient, node).to_string(60), " is not");
    }
    const Affine first = sums.ByColumns(node->operand(0));
    if (node->op() == Op::kMultiply) {
      sums.AddProduct(coefficient, first, sums.ByColumns(node->operand(1)));
    } else {
      sums.AddProduct(coefficient, first, first);
    }
  }
  return OfUsedVariables(sums.Finish());
}

std::optional<int> PolynomialDegree(const Expression& e) {
  constexpr double kLargest = 1e9;  // degrees beyond it count as it
  constexpr double kNone = -1;
  const NodeOrder order(e);
  std::vector<double> of_node;
  const auto degree = [&](const Expression& sum) {
    double largest = sum.linear().empty() ? 0 : 1;
    for (const auto& term : sum.nonlinear()) {
      const double one = of_node[order.place(term.node.get())];
      if (one == kNone) return kNone;
      largest = std::max(largest, one);
    }
    return std::min(largest, kLargest);
  };
  for (const ExpressionNode* node : order.nodes()) {
    const double first = degree(node->operand(0));
    double d = kNone;
    if (node->op() == Op::kMultiply) {
      const double second = degree(node->operand(1));
      if (first != kNone && second != kNone) d = first + second;
    } else if (IsWholePower(*node) && first != kNone) {
      d = first * node->operand(1).constant();
    }
    of_node.push_back(d);
  }
  const double d = degree(e);
  return d == kNone ? std::nullopt : std::optional(static_cast<int>(d));
}

}  // namespace switchyard
