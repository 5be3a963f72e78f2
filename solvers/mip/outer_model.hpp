// solvers/mip/outer_model.hpp - a conic problem as a linear one: second-order cones by tangent
// planes, large ones after they were taken apart.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solvers/mip/node_bound.hpp"
#include "solvers/rounding/entries.hpp"
#include "switchyard/abi.h"
#include "switchyard/problem.hpp"

namespace switchyard::mip {

using rounding::Entry;

/// sum of entries >= lower over the linear problem's columns. Its dual y >= 0 is y times `dual` as
/// a dual of cone rows.
struct Cut {
  std::vector<Entry> entries;
  double lower = 0;
  std::vector<Entry> dual;  // of rows of F
};

/// The linear problem
///
///   columns  x; s for each row of F x + g that has several entries and is in a second-order cone;
///            w for each member of a cone that is taken apart
///   rows     those of A; linear cones; s = F x + g; the sums below; cuts
///
/// A cone |u| <= t, or |u|^2 <= 2 r t, of more than two members u_i is u_i^2 <= w_i t, sum w_i <=
/// t, or <= 2 r (Vielma, Dunning, Huchette and Lubin, 2017). For every rho
///
///   w_i >= 2 rho u_i - rho^2 t
///
/// is valid, and with the multipliers lambda of the sum and y_k of such cuts, sum_k y_k <= lambda
/// for each i, (lambda + sum y_k rho_k^2, -2 sum y_k rho_k of each i) is in the dual of the cone,
/// by Cauchy and Schwarz. So duals of the linear problem are duals of the conic one: bounds are
/// proven there, and no rounding of a cut's coefficients is believed.
class OuterModel {
 public:
  /// "" where all cones are linear or second-order ones and the objective is linear; else why not.
  static std::string WhyNot(const sy_problem& problem);
  /// Has it cones that are not linear?
  static bool IsCurved(const sy_problem& problem);
  /// Borrows the problem, which stays in place.
  explicit OuterModel(const sy_problem& problem);
  OuterModel(const OuterModel&) = delete;
  OuterModel& operator=(const OuterModel&) = delete;

  /// Without cuts, and without integers.
  [[nodiscard]] const Problem& linear() const { return linear_; }
  [[nodiscard]] const sy_problem& problem() const { return problem_; }
  [[nodiscard]] bool has_cones() const { return !curved_.empty(); }

  /// Cuts that a point of the linear problem violates by more than `tolerance`, relative to the
  /// cone's head; the nearest point's tangent for each member.
  void Separate(const std::vector<double>& point, double tolerance, std::vector<Cut>& cuts) const;
  /// Tangents where a point x of the problem, or the nearest one in the cones, lies.
  void TangentsAt(const std::vector<double>& x, std::vector<Cut>& cuts) const;

  /// Of the problem, from those of linear() with cuts behind its rows.
  [[nodiscard]] rounding::Duals DualsOf(const std::vector<double>& row_dual,
                                        const std::vector<Cut>& cuts) const;

 private:
  /// coefficient x[column] + constant; column -1: the constant.
  struct Value {
    std::int32_t column = -1;
    double coefficient = 0, constant = 0;
  };
  /// A second-order cone: rows of F are head (and head2), members.
  struct Curved {
    std::int32_t head, head2;   // t; of a rotated one r, else -1
    std::int32_t first, count;  // members
    std::int32_t w = -1;        // the first of its columns; -1: not taken apart
  };

  void AddValues(const Csc& by_rows);
  void AddCone(const sy_cone& cone, std::int32_t first);
  void AddDirect(const Curved& cone);
  void AddSum(Curved& cone);
  std::int32_t AddColumn(double lower);
  void AddStatic(Cut row, double upper = kInfinity);
  void Put(std::int32_t cone_row, double coefficient, Cut& cut) const;
  [[nodiscard]] Cut MemberCut(const Curved& cone, std::int32_t member, double rho) const;
  [[nodiscard]] Cut DirectCut(const Curved& cone, const std::vector<double>& direction) const;
  [[nodiscard]] double At(std::int32_t cone_row, const std::vector<double>& point) const;
  void SeparateMembers(const Curved& cone, const std::vector<double>& point, double tolerance,
                       std::vector<Cut>& cuts) const;
  void SeparateDirectly(const Curved& cone, const std::vector<double>& point, double tolerance,
                        std::vector<Cut>& cuts) const;
  void Finish();

  sy_problem problem_;
  Problem linear_;
  Csc f_;                     // by rows
  std::vector<Value> value_;  // of each row of F
  std::vector<Curved> curved_;
  std::vector<double> x_lower_;        // of the columns behind x, while they are made
  std::vector<Cut> rows_;              // behind those of A
  std::vector<double> upper_of_rows_;  // their upper sides
};

}  // namespace switchyard::mip
