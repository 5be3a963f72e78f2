// core/lower/lowering.hpp - a program's bindings as one sy_problem, and the way back.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/problem/builder.hpp"
#include "switchyard/model/program.hpp"
#include "switchyard/problem.hpp"

namespace switchyard {

/// A program lowered to a problem. It knows no backend; who loads the problem copies it, since a
/// refresh writes into it.
///
/// The problem's first variables are the program's, in order; epigraph variables of norm costs
/// follow. Rows are those of the affine constraints in the order in which they were added, then the
/// norm costs' own; cones likewise. Maximizing is minimizing the negative.
class Lowering {
 public:
  /// Throws InvalidArgument where a cost cannot be lowered: a norm that is maximized.
  explicit Lowering(const MathematicalProgram& program);

  [[nodiscard]] const Problem& problem() const { return problem_; }

  /// What changed in the program since, as ProblemDifference says it; kStructureChanged where the
  /// problem was built anew because rows, cones or patterns are not what they were.
  std::uint64_t Refresh(const MathematicalProgram& program);

  /// -1, or the index of a variable whose bounds exclude each other: then no backend is asked.
  [[nodiscard]] int crossed_variable() const { return crossed_; }
  [[nodiscard]] bool maximize() const { return maximize_; }

  // Where the terms of the program stand.
  [[nodiscard]] std::int32_t FirstRow(std::size_t affine_constraint) const {
    return affine_row_[affine_constraint];
  }
  [[nodiscard]] std::int32_t FirstConeRow(std::size_t cone_constraint) const {
    return cone_row_[cone_constraint];
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
  static Stamps StampsOf(const MathematicalProgram& program);
  static Linear LinearOf(const MathematicalProgram& program);
  static Bounds BoundsOf(const MathematicalProgram& program);

  std::optional<std::uint64_t> RefreshVectors(const MathematicalProgram& program,
                                              const Stamps& now);
  std::uint64_t RefreshAll(const MathematicalProgram& program);
  void Write(const MathematicalProgram& program);
  void WriteVariables(const MathematicalProgram& program);
  void WriteCosts(const MathematicalProgram& program);
  void WriteConstraints(const MathematicalProgram& program);
  void WriteNorm(const MathematicalProgram& program, const Binding<NormCost>& binding);
  [[nodiscard]] std::string NameOf(const MathematicalProgram& program, const std::string& kind,
                                   int index) const;

  ProblemBuilder builder_;
  Problem problem_;
  Stamps stamps_;
  std::vector<std::int32_t> affine_row_;
  std::vector<std::int32_t> cone_row_;
  std::vector<std::int32_t> norm_variable_;  // the first epigraph variable of each norm cost
  int num_program_cones_ = 0;
  int crossed_ = -1;
  bool maximize_ = false;
};

}  // namespace switchyard
