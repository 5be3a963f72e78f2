#include "core/solve/recovery.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/solve/check.hpp"
#include "core/solve/tangent.hpp"
#include "switchyard/error.hpp"

namespace switchyard {
namespace {

constexpr std::size_t kTextSize = 1024;

bool IsContinuousConvex(const sy_problem& problem) {
  const bool curved = problem.P != nullptr || problem.nlp != nullptr;
  return problem.integer == nullptr && (!curved || (problem.flags & SY_PROBLEM_CONVEX) != 0);
}

PointKind KindOf(double relative_violation) {
  if (relative_violation <= kSupported) return PointKind::kFeasible;
  return relative_violation <= kNearly ? PointKind::kNearlyFeasible : PointKind::kInfeasible;
}

bool ClaimsSolved(Termination t) {
  return t == Termination::kOptimal || t == Termination::kLocallyOptimal ||
         t == Termination::kTarget;
}

}  // namespace

AnswerBuffers::AnswerBuffers(const ProblemData& problem) : text(kTextSize, '\0') {
  const auto vars = static_cast<std::size_t>(problem.num_vars);
  vectors.x.assign(vars, std::nan(""));
  vectors.x_dual.assign(vars, 0);
  vectors.row_dual.assign(problem.row_lower.size(), 0);
  vectors.cone_dual.assign(problem.g.size(), 0);
  if (problem.nlp != nullptr) {
    vectors.nlp_dual.assign(static_cast<std::size_t>(problem.nlp->num_constraints), 0);
  }
  raw.size = sizeof raw;
  raw.objective = std::nan("");
  raw.bound = -kInfinity;
  raw.iterations = -1;
  raw.nodes = -1;
  raw.relaxed = std::nan("");
  raw.x = vectors.x.data();
  raw.x_dual = vectors.x_dual.data();
  raw.row_dual = vectors.row_dual.data();
  raw.cone_dual = vectors.cone_dual.data();
  raw.nlp_dual = vectors.nlp_dual.data();
  raw.text = text.data();
  raw.text_size = text.size();
}

Violation ViolationOf(const MathematicalProgram& program, const Eigen::VectorXd& x) {
  Violation v;
  const auto worst = [&](const auto& bindings, double& into) {
    for (const auto& binding : bindings) {
      const Eigen::VectorXd values = program.ValuesOf(binding.variables(), x);
      const double violation = binding.evaluator()->Violation(values);
      if (violation > into || std::isnan(violation)) into = violation;  // NaN stays
    }
  };
  worst(program.bounding_box_constraints(), v.bounds);
  worst(program.affine_constraints(), v.rows);
  worst(program.cone_constraints(), v.cones);
  worst(program.quadratic_constraints(), v.nonlinear);
  worst(program.generic_constraints(), v.nonlinear);
  for (int j = 0; j < program.num_vars(); ++j) {
    if (program.variable_type(j) == VariableType::kContinuous) continue;
    v.integrality = std::max(v.integrality, std::abs(x[j] - std::round(x[j])));
    if (program.variable_type(j) == VariableType::kBinary) {
      v.bounds = std::max({v.bounds, -x[j], x[j] - 1});
    }
  }
  return v;
}

void Recovery::Write(const AnswerBuffers& answer) {
  const sy_result& raw = answer.raw;
  result_.termination = static_cast<Termination>(raw.termination);
  result_.message = lowering_.WithNames(program_, answer.text.data());
  result_.iterations = raw.iterations;
  result_.nodes = raw.nodes;
  IndexVariables();
  WritePoint(answer);
  WriteBound(answer);
  WriteDuals(answer);
  JudgeCertificates(answer);
  JudgeOptimum(answer);
}

void Recovery::IndexVariables() {
  const auto count = static_cast<std::size_t>(program_.num_vars());
  const VectorXDecisionVariable all = program_.decision_variables();
  result_.index_.resize(count);
  std::iota(result_.index_.begin(), result_.index_.end(), 0);
  const auto by_id = [&](int i, int j) { return all[i].get_id() < all[j].get_id(); };
  if (!std::is_sorted(result_.index_.begin(), result_.index_.end(), by_id)) {
    std::sort(result_.index_.begin(), result_.index_.end(), by_id);
  }
  result_.variables_.reserve(count);
  for (const int j : result_.index_) result_.variables_.push_back(all[j]);
}

void Recovery::WritePoint(const AnswerBuffers& answer) {
  const sy_point_kind kind = answer.raw.primal;
  if (kind == SY_NO_POINT) return;
  const std::vector<double>& x = answer.vectors.x;
  result_.x_ = Eigen::Map<const Eigen::VectorXd>(x.data(), program_.num_vars());
  if (kind == SY_CERTIFICATE) return;  // a ray has no objective and no violation
  result_.objective = program_.EvalCosts(result_.x_);
  result_.violation = ViolationOf(program_, result_.x_);
  result_.primal = KindOf(RelativeViolation(lowering_.problem().view(), x));
}

void Recovery::AddSuboptimal(const std::vector<double>& x) {
  if (KindOf(RelativeViolation(lowering_.problem().view(), x)) != PointKind::kFeasible) {
    result_.notes.push_back(
        Text(backend_.id, " has a point in its pool that is not feasible: it is left out"));
    return;
  }
  const Eigen::VectorXd point = Eigen::Map<const Eigen::VectorXd>(x.data(), program_.num_vars());
  result_.suboptimal_.push_back({program_.EvalCosts(point), point});
}

void Recovery::WriteBound(const AnswerBuffers& answer) {
  const sy_problem& problem = lowering_.problem().view();
  const bool convex = IsContinuousConvex(problem);
  const bool bound_is_theirs =
      problem.integer != nullptr || (backend_.traits & SY_PROVES_GLOBAL) != 0;
  if (!convex && bound_is_theirs && std::isfinite(answer.raw.bound)) {
    result_.bound = InUserSense(answer.raw.bound);
  }
  const bool has_duals = answer.raw.dual == SY_FEASIBLE || answer.raw.dual == SY_NEARLY_FEASIBLE ||
                         answer.raw.dual == SY_INFEASIBLE_POINT;
  if (!has_duals || problem.integer != nullptr) return;
  const bool has_point = result_.primal == PointKind::kFeasible;
  Vectors v = answer.vectors;
  if (answer.raw.primal == SY_NO_POINT || answer.raw.primal == SY_CERTIFICATE) v.x.clear();
  std::optional<Problem> tangent;
  if (problem.nlp != nullptr) {
    if (!v.x.empty()) tangent = TangentProblem(problem, v.x);
    if (!tangent.has_value()) return;
    DualsOfTangentProblem(v);
  }
  const sy_problem& checked = tangent.has_value() ? tangent->view() : problem;
  const double cutoff = has_point ? InUserSense(result_.objective) : kInfinity;
  const DualCheck check = convex ? CheckDuals(checked, v, cutoff) : EstimateDuals(checked, v);
  JudgeDuals(check, convex);
}

void Recovery::JudgeDuals(const DualCheck& check, bool convex) {
  const bool has_point = result_.primal == PointKind::kFeasible;
  if (std::isfinite(check.bound)) result_.bound = InUserSense(check.bound);
  const auto apart = [&](double value) {
    return std::abs(InUserSense(result_.objective) - value) / (1 + std::abs(result_.objective));
  };
  const double by_estimate =
      apart(check.estimate) + check.open_worth / (1 + std::abs(result_.objective));
  const double error =
      std::isfinite(check.bound) ? std::min(apart(check.bound), by_estimate) : by_estimate;
  result_.dual = KindOf(has_point ? error : check.open_worth);
  if (convex && !std::isfinite(check.bound) && check.open_column >= 0 && has_point) {
    result_.notes.push_back(lowering_.WithNames(
        program_, Text("no bound is proven: x[", check.open_column,
                       "] has no finite box, and its reduced cost is 0 only to rounding")));
  }
}

void Recovery::WriteDuals(const AnswerBuffers& answer) {
  if (answer.raw.dual == SY_NO_POINT) return;
  const double sign = lowering_.maximize() ? -1 : 1;
  const Vectors& v = answer.vectors;
  const auto segment = [&](const std::vector<double>& from, std::int32_t first, int count) {
    return Eigen::VectorXd(sign * Eigen::Map<const Eigen::VectorXd>(from.data() + first, count));
  };
  for (std::size_t k = 0; k < program_.affine_constraints().size(); ++k) {
    const auto& binding = program_.affine_constraints()[k];
    result_.duals_.emplace_back(binding, segment(v.row_dual, lowering_.FirstRow(k),
                                                 binding.evaluator()->num_constraints()));
  }
  for (std::size_t k = 0; k < program_.cone_constraints().size(); ++k) {
    const auto& binding = program_.cone_constraints()[k];
    const Eigen::VectorXd dual =
        segment(v.cone_dual, lowering_.FirstConeRow(k), binding.evaluator()->cone().dim);
    result_.duals_.emplace_back(binding, binding.evaluator()->DualInUserFrame(dual));
  }
  WriteNonlinearDuals(v, sign);
  WriteBoxDuals(v.x_dual);
}

// Of a quadratic constraint that became the cone (1, upper - b'x, ...): d(cost)/d(upper) is the
// negative of the second row's dual.
void Recovery::WriteNonlinearDuals(const Vectors& v, double sign) {
  for (std::size_t k = 0; k < program_.quadratic_constraints().size(); ++k) {
    const auto place = lowering_.PlaceOfQuadratic(k);
    const auto row = static_cast<std::size_t>(place.row);
    double dual = 0;
    if (place.row >= 0 && place.in_nlp) dual = v.nlp_dual[row];
    if (place.row >= 0 && !place.in_nlp) dual = (place.mirrored ? 1 : -1) * v.cone_dual[row + 1];
    result_.duals_.emplace_back(program_.quadratic_constraints()[k],
                                Eigen::VectorXd::Constant(1, sign * dual));
  }
  for (std::size_t k = 0; k < program_.generic_constraints().size(); ++k) {
    const auto& binding = program_.generic_constraints()[k];
    result_.duals_.emplace_back(
        binding,
        sign * Eigen::Map<const Eigen::VectorXd>(v.nlp_dual.data() + lowering_.FirstNonlinearRow(k),
                                                 binding.evaluator()->num_constraints()));
  }
}

// A variable's dual belongs to the side that is active: to the first binding that sets it.
void Recovery::WriteBoxDuals(const std::vector<double>& x_dual) {
  const ProblemData& d = lowering_.problem().data();
  std::vector<std::uint8_t> given(static_cast<std::size_t>(program_.num_vars()), 0);
  for (const auto& binding : program_.bounding_box_constraints()) {
    const auto index = program_.FindDecisionVariableIndices(binding.variables());
    Eigen::VectorXd dual = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(index.size()));
    for (std::size_t k = 0; k < index.size() && !d.x_lower.empty(); ++k) {
      const auto j = static_cast<std::size_t>(index[k]);
      const auto row = static_cast<Eigen::Index>(k);
      const bool sets = x_dual[j] > 0 ? binding.evaluator()->lower_bound()[row] == d.x_lower[j]
                                      : binding.evaluator()->upper_bound()[row] == d.x_upper[j];
      if (!sets || given[j] != 0 || x_dual[j] == 0) continue;
      given[j] = 1;
      dual[row] = InUserSense(x_dual[j]);
    }
    result_.duals_.emplace_back(binding, dual);
  }
}

void Recovery::JudgeCertificates(const AnswerBuffers& answer) {
  const sy_problem& problem = lowering_.problem().view();
  if (answer.raw.dual == SY_CERTIFICATE) {
    const bool holds = ProvesInfeasible(problem, answer.vectors);
    result_.dual = holds ? PointKind::kRay : PointKind::kNone;
    if (!holds) result_.duals_.clear();
    if (!holds && result_.termination == Termination::kInfeasible) {
      Doubt("its certificate does not hold: the duals prove no contradiction");
    }
  }
  if (answer.raw.primal == SY_CERTIFICATE) {
    const bool holds = IsUnboundedRay(problem, answer.vectors);
    result_.primal = holds ? PointKind::kRay : PointKind::kNone;
    if (!holds) result_.x_.resize(0);
    if (!holds && result_.termination == Termination::kUnbounded) {
      Doubt("its ray leaves the constraints, or gains nothing");
    }
  }
}

void Recovery::Doubt(const std::string& why) {
  result_.notes.push_back(Text(backend_.id, " says ", to_string(result_.termination), "; ", why));
  result_.termination = Termination::kNumericalTrouble;
  doubted_ = true;
}

void Recovery::JudgeOptimum(const AnswerBuffers& answer) {
  if (!ClaimsSolved(result_.termination)) return;
  if (result_.primal != PointKind::kFeasible) {
    return Doubt(Text("our check finds its point ", to_string(result_.primal),
                      ": rows are violated by ", result_.violation.rows, ", bounds by ",
                      result_.violation.bounds, ", cones by ", result_.violation.cones,
                      ", functions by ", result_.violation.nonlinear, ", integrality by ",
                      result_.violation.integrality));
  }
  // A local optimum needs no duals, since there may be none; those that come have to hold.
  const bool convex = IsContinuousConvex(lowering_.problem().view());
  const bool local = result_.termination == Termination::kLocallyOptimal;
  const bool needs_duals = (backend_.traits & SY_GIVES_DUALS) != 0 &&
                           lowering_.problem().view().integer == nullptr &&
                           ((result_.termination == Termination::kOptimal && convex) ||
                            (local && answer.raw.dual != SY_NO_POINT));
  if (needs_duals && result_.dual != PointKind::kFeasible) {
    const bool none = answer.raw.dual == SY_NO_POINT;
    return Doubt(none    ? "it gives no duals to support that"
                 : local ? Text("its point and duals satisfy the conditions of first order only ",
                                to_string(result_.dual) == "nearly_feasible" ? "to 1e-3" : "badly")
                         : Text("its duals support ", result_.objective, " only to ",
                                std::isnan(result_.bound) ? "an unknown accuracy"
                                                          : Text("the bound ", result_.bound)));
  }
}

}  // namespace switchyard
