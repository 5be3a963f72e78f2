#include "core/lower/lowering.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/model/quadratic_cone.hpp"
#include "core/problem/difference.hpp"

namespace switchyard {
namespace {

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Writes scale * a for every entry a of `matrix` to `out`, rows from `first_row`, columns where
/// `index` has them.
void WriteMatrix(const SparseMatrix& matrix, const std::vector<int>& index, std::int32_t first_row,
                 double scale, TripletMatrix& out) {
  for (int j = 0; j < matrix.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator entry(matrix, j); entry; ++entry) {
      out.Add(first_row + static_cast<std::int32_t>(entry.row()),
              index[static_cast<std::size_t>(j)], scale * entry.value());
    }
  }
}

void WriteQuadratic(const SparseMatrix& Q, const std::vector<int>& index, double sign,
                    TripletMatrix& P) {
  for (int j = 0; j < Q.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator entry(Q, j); entry; ++entry) {
      if (entry.row() > j) break;  // rows ascend: the rest is the lower triangle
      const int a = index[static_cast<std::size_t>(entry.row())];
      const int b = index[static_cast<std::size_t>(j)];
      const bool folded = entry.row() != j && a == b;  // one variable bound twice
      P.Add(std::min(a, b), std::max(a, b), sign * (folded ? 2 : 1) * entry.value());
    }
  }
}

}  // namespace

Lowering::Lowering(const MathematicalProgram& program, Quadratics form)
    : form_(form), stamps_(StampsOf(program)) {
  Write(program);
  problem_ = Problem(Finished());
}

ProblemData Lowering::Finished() {
  ProblemData data = builder_.Finish();
  data.nlp = nonlinear_ != nullptr ? &nonlinear_->record() : nullptr;
  return data;
}

Lowering::Stamps Lowering::StampsOf(const MathematicalProgram& program) {
  const auto sum = [](const auto& bindings) {
    std::uint64_t total = 0;
    for (const auto& binding : bindings) total += binding.evaluator()->version();
    return total;
  };
  return {program.structure_version(), sum(program.linear_costs()),
          sum(program.bounding_box_constraints()),
          sum(program.generic_costs()) + sum(program.quadratic_constraints()) +
              sum(program.generic_constraints()),
          sum(program.quadratic_costs()) + sum(program.norm_costs()) +
              sum(program.affine_constraints()) + sum(program.cone_constraints())};
}

std::uint64_t Lowering::Refresh(const MathematicalProgram& program) {
  const Stamps now = StampsOf(program);
  const bool linear = now.linear_costs != stamps_.linear_costs;
  const bool boxes = now.boxes != stamps_.boxes;
  const bool rest = now.structure != stamps_.structure || now.others != stamps_.others ||
                    now.nonlinear != stamps_.nonlinear;
  if (!linear && !boxes && !rest) return 0;
  std::optional<std::uint64_t> kinds;
  if (!rest) kinds = RefreshVectors(program, now);
  if (!kinds.has_value()) kinds = RefreshAll(program, now);
  stamps_ = now;
  return *kinds;
}

// Costs and bounds of variables alone: nothing is sorted, no matrix is written. None: a bound
// appeared where there was none, so the section does.
std::optional<std::uint64_t> Lowering::RefreshVectors(const MathematicalProgram& program,
                                                      const Stamps& now) {
  std::uint64_t kinds = 0;
  const auto replace = [&kinds](std::vector<double>& old, const std::vector<double>& fresh,
                                std::uint64_t kind) {
    if (!std::equal(fresh.begin(), fresh.end(), old.begin())) kinds |= kind;
    std::copy(fresh.begin(), fresh.end(), old.begin());
  };
  if (now.boxes != stamps_.boxes) {
    if (problem_.data().x_lower.empty()) return std::nullopt;
    const Bounds bounds = BoundsOf(program);
    crossed_ = bounds.crossed;
    problem_.Change([&](ProblemData& d) {
      replace(d.x_lower, bounds.lower, SY_UPDATES_BOUNDS);
      replace(d.x_upper, bounds.upper, SY_UPDATES_BOUNDS);
    });
  }
  if (now.linear_costs != stamps_.linear_costs) {
    const Linear linear = LinearOf(program);
    if (linear.offset != problem_.data().offset) kinds |= SY_UPDATES_VECTORS;
    problem_.Change([&](ProblemData& d) {
      replace(d.q, linear.q, SY_UPDATES_VECTORS);
      d.offset = linear.offset;
    });
  }
  return kinds;
}

std::uint64_t Lowering::RefreshAll(const MathematicalProgram& program, const Stamps& now) {
  builder_.Rewrite();
  const bool had_functions = nonlinear_ != nullptr;
  const bool other_terms = Write(program);
  ProblemData fresh = Finished();
  const ProblemData& before = problem_.data();
  const bool same_sizes = fresh.num_vars == before.num_vars &&
                          fresh.num_rows() == before.num_rows() &&
                          fresh.num_cone_rows() == before.num_cone_rows() &&
                          had_functions == (nonlinear_ != nullptr) && !other_terms;
  if (!same_sizes || !builder_.SamePatterns()) {
    builder_ = ProblemBuilder();
    Write(program);
    problem_ = Problem(Finished());
    return kStructureChanged;
  }
  std::uint64_t kinds = ProblemDifference(before, fresh);
  if (had_functions && now.nonlinear != stamps_.nonlinear) kinds |= SY_UPDATES_NLP;
  problem_ = Problem(std::move(fresh));
  return kinds;
}

// True where the functions are others than those of the writing before.
bool Lowering::Write(const MathematicalProgram& program) {
  maximize_ = program.objective_sense() == ObjectiveSense::kMaximize;
  crossed_ = -1;
  affine_row_.clear();
  cone_row_.clear();
  norm_variable_.clear();
  quadratic_.clear();
  builder_.flags = SY_PROBLEM_CONVEX;
  WriteVariables(program);
  WriteConstraints(program);
  WriteQuadraticConstraints(program);
  num_program_cones_ = static_cast<int>(builder_.cones.size());
  WriteCosts(program);
  return WriteNonlinear(program);
}

Lowering::Bounds Lowering::BoundsOf(const MathematicalProgram& program) {
  const auto count = static_cast<std::size_t>(program.num_vars());
  Bounds bounds{std::vector<double>(count, -kInfinity), std::vector<double>(count, kInfinity), -1};
  for (int j = 0; j < program.num_vars(); ++j) {
    if (program.variable_type(j) != VariableType::kBinary) continue;
    bounds.lower[At(j)] = 0;
    bounds.upper[At(j)] = 1;
  }
  for (const auto& box : program.bounding_box_constraints()) {
    const auto index = program.FindDecisionVariableIndices(box.variables());
    for (std::size_t k = 0; k < index.size(); ++k) {
      double& lower = bounds.lower[At(index[k])];
      double& upper = bounds.upper[At(index[k])];
      const auto row = static_cast<Eigen::Index>(k);
      lower = std::max(lower, box.evaluator()->lower_bound()[row]);
      upper = std::min(upper, box.evaluator()->upper_bound()[row]);
      if (lower > upper && bounds.crossed < 0) bounds.crossed = index[k];
    }
  }
  return bounds;
}

Lowering::Linear Lowering::LinearOf(const MathematicalProgram& program) {
  const double sign = program.objective_sense() == ObjectiveSense::kMaximize ? -1 : 1;
  Linear linear{std::vector<double>(static_cast<std::size_t>(program.num_vars()), 0.0), 0};
  const auto add = [&](const auto& binding, const Eigen::VectorXd& a, double constant) {
    const auto index = program.FindDecisionVariableIndices(binding.variables());
    for (std::size_t k = 0; k < index.size(); ++k) {
      linear.q[At(index[k])] += sign * a[static_cast<Eigen::Index>(k)];
    }
    linear.offset += sign * constant;
  };
  for (const auto& binding : program.linear_costs()) {
    add(binding, binding.evaluator()->a(), binding.evaluator()->b());
  }
  for (const auto& binding : program.quadratic_costs()) {
    add(binding, binding.evaluator()->b(), binding.evaluator()->c());
  }
  return linear;
}

void Lowering::WriteVariables(const MathematicalProgram& program) {
  builder_.AddVariables(program.num_vars());
  for (int j = 0; j < program.num_vars(); ++j) {
    builder_.integer[At(j)] = program.variable_type(j) != VariableType::kContinuous ? 1 : 0;
  }
  Bounds bounds = BoundsOf(program);
  builder_.x_lower = std::move(bounds.lower);
  builder_.x_upper = std::move(bounds.upper);
  crossed_ = bounds.crossed;
}

void Lowering::WriteConstraints(const MathematicalProgram& program) {
  for (const auto& binding : program.affine_constraints()) {
    const LinearConstraint& rows = *binding.evaluator();
    const std::int32_t first = builder_.AddRows(rows.num_constraints());
    affine_row_.push_back(first);
    WriteMatrix(rows.get_sparse_A(), program.FindDecisionVariableIndices(binding.variables()),
                first, 1, builder_.A);
    for (int i = 0; i < rows.num_constraints(); ++i) {
      builder_.row_lower[At(first + i)] = rows.lower_bound()[i];
      builder_.row_upper[At(first + i)] = rows.upper_bound()[i];
    }
  }
  for (const auto& binding : program.cone_constraints()) {
    const ConeConstraint& cone = *binding.evaluator();
    cone_row_.push_back(static_cast<std::int32_t>(builder_.g.size()));
    WriteCone(cone.cone(), cone.A(), cone.b(), cone.frame(),
              program.FindDecisionVariableIndices(binding.variables()));
  }
}

// Ax + b, taken to the cone by its frame.
void Lowering::WriteCone(const sy_cone& cone, const SparseMatrix& A, const Eigen::VectorXd& b,
                         const std::vector<ConeConstraint::FrameRow>& frame,
                         const std::vector<int>& index) {
  const std::int32_t first = builder_.AddCone(cone);
  // Where each row of z goes: to one row of the cone, or (below the diagonal) to none.
  std::vector<ConeConstraint::FrameRow> place(static_cast<std::size_t>(A.rows()), {-1, 0});
  for (int i = 0; i < cone.dim; ++i) {
    const auto& from = frame[At(i)];
    place[At(from.row)] = {first + i, from.scale};
    builder_.g[At(first + i)] = from.scale * b[from.row];
  }
  for (int j = 0; j < A.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator entry(A, j); entry; ++entry) {
      const auto& to = place[static_cast<std::size_t>(entry.row())];
      if (to.row >= 0) builder_.F.Add(to.row, index[At(j)], to.scale * entry.value());
    }
  }
}

// Rows of the nlp where there is one anyway, rotated cones where there is none.
void Lowering::WriteQuadraticConstraints(const MathematicalProgram& program) {
  const bool in_nlp = NeedsFunctions(program);
  for (const auto& binding : program.quadratic_constraints()) {
    const QuadraticConstraint& form = *binding.evaluator();
    if (in_nlp) {
      quadratic_.push_back({true, false, static_cast<std::int32_t>(quadratic_.size())});
      continue;
    }
    const bool mirrored = form.lower_bound()[0] > -kInfinity;
    const double sign = mirrored ? -1 : 1;
    const double side = mirrored ? -form.lower_bound()[0] : form.upper_bound()[0];
    if (side == kInfinity) {  // free on both sides
      quadratic_.push_back({});
      continue;
    }
    quadratic_.push_back({false, mirrored, static_cast<std::int32_t>(builder_.g.size())});
    const SparseMatrix Q = sign * form.Q();
    RotatedCone z = RotatedConeOf(Q, sign * form.b(), side);
    const RotatedLorentzConeConstraint cone(std::move(z.A), z.b);
    WriteCone(cone.cone(), cone.A(), cone.b(), cone.frame(),
              program.FindDecisionVariableIndices(binding.variables()));
  }
}

bool Lowering::NeedsFunctions(const MathematicalProgram& program) const {
  return NeedsNonlinearPart(program) ||
         (form_ == Quadratics::kAsFunctions && !program.quadratic_constraints().empty());
}

bool Lowering::WriteNonlinear(const MathematicalProgram& program) {
  const bool needed = NeedsFunctions(program);
  const auto num_vars = static_cast<std::int32_t>(builder_.q.size());
  const bool kept = needed && nonlinear_ != nullptr &&
                    nonlinear_structure_ == program.structure_version() &&
                    nonlinear_->terms()->SamePatterns();
  const bool other = needed && nonlinear_ != nullptr && !kept;
  std::shared_ptr<NonlinearPart> before = std::exchange(nonlinear_, nullptr);
  if (before != nullptr) replaced_.push_back(before);
  if (!needed) return false;
  auto terms = kept ? before->terms() : std::make_shared<const NonlinearTerms>(program, num_vars);
  nonlinear_ = std::make_shared<NonlinearPart>(std::move(terms), program);
  nonlinear_structure_ = program.structure_version();
  const auto convex = [](const auto& bindings) {
    return std::all_of(bindings.begin(), bindings.end(),
                       [](const auto& binding) { return binding.evaluator()->is_convex(); });
  };
  const bool all_convex =
      convex(program.generic_costs()) && convex(program.quadratic_constraints()) &&
      convex(program.generic_constraints()) && (!maximize_ || program.generic_costs().empty());
  if (!all_convex) builder_.flags &= ~std::uint32_t{SY_PROBLEM_CONVEX};
  return other;
}

void Lowering::WriteCosts(const MathematicalProgram& program) {
  const double sign = maximize_ ? -1 : 1;
  Linear linear = LinearOf(program);
  builder_.q = std::move(linear.q);
  builder_.offset = linear.offset;
  for (const auto& binding : program.quadratic_costs()) {
    const QuadraticCost& cost = *binding.evaluator();
    WriteQuadratic(cost.Q(), program.FindDecisionVariableIndices(binding.variables()), sign,
                   builder_.P);
    const bool convex =
        maximize_ ? QuadraticCost(SparseMatrix(-cost.Q()), cost.b()).is_convex() : cost.is_convex();
    if (!convex) builder_.flags &= ~std::uint32_t{SY_PROBLEM_CONVEX};
  }
  for (const auto& binding : program.norm_costs()) WriteNorm(program, binding);
}

// min t over the epigraph: |z|_2 <= t a Lorentz cone, |z_i| <= t_i or <= t as rows,
// |z_1..|^2 <= t z_0 the rotated cone 2 s_0 s_1 >= |s_2|^2 at (t, z_0, sqrt2 z_1..).
void Lowering::WriteNorm(const MathematicalProgram& program, const Binding<NormCost>& binding) {
  const NormCost& cost = *binding.evaluator();
  Require(!maximize_, cost.Name(),
          ": a norm cannot be maximized; the objective is to be maximized");
  const auto index = program.FindDecisionVariableIndices(binding.variables());
  const auto m = static_cast<std::int32_t>(cost.b().size());
  const bool one_each = cost.norm() == NormCost::Norm::kL1;
  const std::int32_t t = builder_.AddVariables(one_each ? m : 1);
  norm_variable_.push_back(t);
  for (std::int32_t k = 0; k < (one_each ? m : 1); ++k) builder_.q[At(t + k)] = 1;
  if (cost.norm() == NormCost::Norm::kL2) {
    const std::int32_t first = builder_.AddCone({SY_CONE_SECOND_ORDER, m + 1, 0});
    builder_.F.Add(first, t, 1);
    WriteMatrix(cost.A(), index, first + 1, 1, builder_.F);
    for (std::int32_t i = 0; i < m; ++i) builder_.g[At(first + 1 + i)] = cost.b()[i];
  } else if (cost.norm() == NormCost::Norm::kPerspectiveQuadratic) {
    const std::int32_t first = builder_.AddCone({SY_CONE_ROTATED, m + 1, 0});
    const auto scale = [](Eigen::Index i) { return i == 0 ? 1.0 : std::sqrt(2.0); };
    builder_.F.Add(first, t, 1);
    for (int j = 0; j < cost.A().outerSize(); ++j) {
      for (SparseMatrix::InnerIterator entry(cost.A(), j); entry; ++entry) {
        builder_.F.Add(first + 1 + static_cast<std::int32_t>(entry.row()), index[At(j)],
                       scale(entry.row()) * entry.value());
      }
    }
    for (std::int32_t i = 0; i < m; ++i) builder_.g[At(first + 1 + i)] = scale(i) * cost.b()[i];
  } else {
    for (const double side : {-1.0, 1.0}) {  // t +- (Ax)_i >= -+ b_i
      const std::int32_t first = builder_.AddRows(m);
      WriteMatrix(cost.A(), index, first, side, builder_.A);
      for (std::int32_t i = 0; i < m; ++i) {
        builder_.A.Add(first + i, one_each ? t + i : t, 1);
        builder_.row_lower[At(first + i)] = -side * cost.b()[i];
      }
    }
  }
}

std::vector<double> Lowering::Extend(const MathematicalProgram& program,
                                     const Eigen::VectorXd& x) const {
  std::vector<double> all(x.data(), x.data() + x.size());
  all.resize(At(problem_.data().num_vars));
  for (std::size_t k = 0; k < norm_variable_.size(); ++k) {
    const auto& binding = program.norm_costs()[k];
    const NormCost& cost = *binding.evaluator();
    const Eigen::VectorXd values = program.ValuesOf(binding.variables(), x);
    const auto t = At(norm_variable_[k]);
    if (cost.norm() == NormCost::Norm::kL1) {
      const Eigen::VectorXd z = (cost.A() * values + cost.b()).cwiseAbs();
      std::copy(z.data(), z.data() + z.size(), all.begin() + static_cast<std::ptrdiff_t>(t));
    } else {
      const double value = program.EvalBinding(binding, x)[0];
      all[t] = std::isinf(value) ? std::nan("") : value;
    }
  }
  return all;
}

}  // namespace switchyard
