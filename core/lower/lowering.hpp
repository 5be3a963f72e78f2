// core/lower/lowering.hpp - a program's bindings as one sy_problem, and the way back.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/lower/nonlinear.hpp"
#include "core/problem/builder.hpp"
#include "switchyard/model/program.hpp"
#include "switchyard/problem.hpp"

namespace switchyard {

/// A program lowered to a problem. It knows no backend; who loads the problem copies it, since a
/// refresh writes into it.
///
/// The problem's first variables are the program's, in order; epigraph variables of norm costs
/// follow. Rows are those of the affine constraints in the order in which they were added, then the
/// norm costs' own; cones likewise, those of convex quadratic constraints between. Functions are
/// the nlp; where there is one, quadratic constraints are rows of it. Maximizing is minimizing the
/// negative.
class Lowering {
 public:
  /// What convex quadratic constraints are written as where nothing else is a function: for
  /// backends that take cones, and for those that take functions and no cones.
  enum class Quadratics { kAsCones, kAsFunctions };

  /// Throws InvalidArgument where a cost cannot be lowered: a norm that is maximized.
  explicit Lowering(const MathematicalProgram& program, Quadratics form = Quadratics::kAsCones);

  [[nodiscard]] const Problem& problem() const { return problem_; }

  /// What changed in the program since, as ProblemDifference says it; kStructureChanged where the
  /// problem was built anew because rows, cones or patterns are not what they were.
  std::uint64_t Refresh(const MathematicalProgram& program);

  /// -1, or the index of a variable whose bounds exclude each other: then no backend is asked.
  [[nodiscard]] int crossed_variable() const { return crossed_; }
  [[nodiscard]] bool maximize() const { return maximize_; }
  /// Would the other form be another problem?
  [[nodiscard]] bool has_quadratic_cones() const { return !quadratic_.empty() && !nonlinear_; }

  // Where the terms of the program stand.
  [[nodiscard]] std::int32_t FirstRow(std::size_t affine_constraint) const {
    return affine_row_[affine_constraint];
  }
  [[nodiscard]] std::int32_t FirstConeRow(std::size_t cone_constraint) const {
    return cone_row_[cone_constraint];
  }

  /// NULL where no term is a function.
  [[nodiscard]] NonlinearPart* nonlinear() const { return nonlinear_.get(); }
  /// Functions that a refresh replaced stay until this is called: when no backend holds them.
  void ForgetReplaced() { replaced_.clear(); }
  /// Of a quadratic constraint: its row among those of the nlp; else the first row of its cone
  /// (1, upper - b'x, ...) or, where that is `mirrored`, (1, -lower + b'x, ...).
  struct QuadraticPlace {
    bool in_nlp = false;
    bool mirrored = false;
    std::int32_t row = -1;  // -1: free on both sides, nowhere
  };
  [[nodiscard]] const QuadraticPlace& PlaceOfQuadratic(std::size_t quadratic_constraint) const {
    return quadratic_[quadratic_constraint];
  }
  [[nodiscard]] std::int32_t FirstNonlinearRow(std::size_t generic_constraint) const {
    return nonlinear_->terms()->FirstRow(quadratic_.size() + generic_constraint);
  }

  /// A point of all variables from one of the program's: epigraph variables at their least values;
  /// NaN where x is, and where no value is finite.
  [[nodiscard]] std::vector<double> Extend(const MathematicalProgram& program,
                                           const Eigen::VectorXd& x) const;

  /// A text in which x[3], row[3] and cone[3] stand for the problem's own, in the user's names.
  [[nodiscard]] std::string WithNames(const MathematicalProgram& program,
                                      const std::string& text) const;

 private:
  /// Sums of versions: equal exactly where nothing of that kind changed.
  struct Stamps {
    std::uint64_t structure = 0;
    std::uint64_t linear_costs = 0;
    std::uint64_t boxes = 0;
    std::uint64_t nonlinear = 0;
    std::uint64_t others = 0;
  };
  /// The linear part of the objective, without that of epigraph variables.
  struct Linear {
    std::vector<double> q;
    double offset = 0;
  };
  struct Bounds {
    std::vector<double> lower;
    std::vector<double> upper;
    int crossed = -1;
  };
  [[nodiscard]] bool NeedsFunctions(const MathematicalProgram& program) const;
  static Stamps StampsOf(const MathematicalProgram& program);
  static Linear LinearOf(const MathematicalProgram& program);
  static Bounds BoundsOf(const MathematicalProgram& program);

  std::optional<std::uint64_t> RefreshVectors(const MathematicalProgram& program,
                                              const Stamps& now);
  std::uint64_t RefreshAll(const MathematicalProgram& program, const Stamps& now);
  ProblemData Finished();
  bool Write(const MathematicalProgram& program);
  void WriteVariables(const MathematicalProgram& program);
  void WriteCosts(const MathematicalProgram& program);
  void WriteConstraints(const MathematicalProgram& program);
  void WriteNorm(const MathematicalProgram& program, const Binding<NormCost>& binding);
  void WriteCone(const sy_cone& cone, const SparseMatrix& A, const Eigen::VectorXd& b,
                 const std::vector<ConeConstraint::FrameRow>& frame, const std::vector<int>& index);
  void WriteQuadraticConstraints(const MathematicalProgram& program);
  /// True where the terms are not what they were.
  bool WriteNonlinear(const MathematicalProgram& program);
  [[nodiscard]] std::string NameOf(const MathematicalProgram& program, const std::string& kind,
                                   int index) const;
  [[nodiscard]] std::string NameOfNonlinearRow(const MathematicalProgram& program, int row) const;

  Quadratics form_;
  ProblemBuilder builder_;
  Problem problem_;
  Stamps stamps_;
  std::vector<std::int32_t> affine_row_;
  std::vector<std::int32_t> cone_row_;
  std::vector<std::int32_t> norm_variable_;  // the first epigraph variable of each norm cost
  std::vector<QuadraticPlace> quadratic_;
  std::shared_ptr<NonlinearPart> nonlinear_;
  std::vector<std::shared_ptr<NonlinearPart>> replaced_;
  std::uint64_t nonlinear_structure_ = 0;  // the program's structure that the terms are of
  int num_program_cones_ = 0;
  int crossed_ = -1;
  bool maximize_ = false;
};

}  // namespace switchyard
