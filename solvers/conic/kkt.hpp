// solvers/conic/kkt.hpp - the linear equations of a step.
#pragma once

#include <algorithm>
#include <memory>

#include "solvers/conic/form.hpp"
#include "solvers/conic/kkt_plan.hpp"
#include "solvers/conic/kkt_values.hpp"
#include "solvers/conic/product_cone.hpp"
#include "solvers/linalg/block_ldl.hpp"

namespace switchyard::conic {

/// (x, y, z): variables, equations, slacks.
struct Triple {
  Vector x, y, z;
  Triple() = default;
  explicit Triple(const Shape& shape) : x(shape.vars), y(shape.equations), z(shape.slacks()) {}
};

/// One, and A x.
struct KktStep : Triple {
  Vector a_x;
  KktStep() = default;
  explicit KktStep(const Shape& shape) : Triple(shape), a_x(shape.rows()) {}
};

/// Solves
///   P dx - E'dy - G'dz = a,   E dx = b,   G dx + H dz = c
/// with the factors of the same with proximal terms,
///   (P + r) dx - E'dy - G'dz = a,   E dx + r dy = b,   G dx + (H + r) dz = c,
/// whose error it corrects.
class Kkt {
 public:
  static constexpr double kMostProximal = 1e-6;

  Kkt(const Form& form, const Blocks& blocks);
  /// Over a form of the same pattern as another's: what follows from that is shared.
  Kkt(const Form& form, const Kkt& alike);

  /// As if nothing had been solved yet.
  void Restart();
  /// The factors at the cones' current scaling. Whoever shares what is done to the cones shares
  /// this and the solves, too.
  void Factor(const ProductCone& cones);
  /// What may be left of a, and of b and c.
  struct Goal {
    double dual = 0, primal = 0;
  };
  /// How well a solve did.
  struct Outcome {
    double left = 0;  // the largest entry of what is left of the right side, in units of the goal
    int corrections = 0;
    double contraction = 0;  // by the last correction; 0: none was needed
  };
  /// Corrects until the goal is met, or no longer less is left.
  Outcome Solve(const ProductCone& cones, const Triple& right, const Goal& goal, KktStep& found);

  /// What the factors say, uncorrected; what it leaves.
  double SolveOnce(const ProductCone& cones, const Triple& right, const Goal& goal, KktStep& found);
  /// What the last solve left of its right side, if it was not trusted blindly.
  [[nodiscard]] const Triple& left() const { return left_.raw; }
  /// The largest entry of what is left, but for what the cones mend, in units of a goal.
  double Measure(const ProductCone& cones, const Triple& left, const Goal& goal);

  /// Another r for the next factors.
  [[nodiscard]] double proximal() const { return next_; }
  void set_proximal(double r) { next_ = std::clamp(r, least_proximal_, kMostProximal); }
  [[nodiscard]] double least_proximal() const { return least_proximal_; }

  /// Factors of twice the digits from the next ones on, and a least r that they bear.
  void TakeMoreDigits();
  [[nodiscard]] bool twofold() const { return digits_ == linalg::Digits::kTwofold; }
  [[nodiscard]] const linalg::BlockLdl& factors() const { return ldl_; }
  [[nodiscard]] int raised_pivots() const { return raised_; }
  [[nodiscard]] int corrections() const { return corrections_; }
  [[nodiscard]] int solves() const { return solves_; }

 private:
  /// A kept cone: R^-1 = diag(weight) + sum of w_k v_k v_k', and the multipliers of the equations
  /// v_k'F dx - t_k / w_k = v_k'c.
  struct KeptCone {
    Index column = 0;  // of the first; the others' follow
    std::size_t part = 0;
    std::vector<Index> row;  // of A
    Index first = 0;         // the part's first row
    Index rank = 0;
  };
  void TakeSides(const KeptCone& cone, const Vector& c);
  void GiveSlacks(const KeptCone& cone, Vector& z) const;

  [[nodiscard]] double SideOfRow(Index r, const Vector& c) const;
  void SlacksOfRow(Index r, double multiplier, const Vector& c, KktStep& step) const;
  void Weigh(const ProductCone& cones);
  void Approximate(const ProductCone& cones, const Triple& right, KktStep& step);
  void CondensePlain(const ProductCone& cones, const Triple& right);
  void ExpandPlain(const ProductCone& cones, const Triple& right, KktStep& step);
  /// What is left of a right side; and z again, without what the cones mend.
  struct Remainder {
    Triple raw;
    Vector z;
    explicit Remainder(const Shape& shape) : raw(shape), z(shape.slacks()) {}
  };
  static double Largest(const Remainder& left, const Goal& goal);
  static double Dot(const Remainder& a, const Remainder& b, const Goal& goal);
  static void AddMultiple(double alpha, const Remainder& from, Remainder& to);
  /// v <- u - v.
  static void Reverse(const Remainder& u, Remainder& v);
  /// left = right - what the equations make of step.
  void Leave(const ProductCone& cones, const Triple& right, const KktStep& step, Remainder& left);
  struct Direction {
    KktStep step;
    Remainder image;
    double square;  // of the image
  };
  Outcome Correct(const ProductCone& cones, const Triple& right, const Goal& goal, KktStep& found);
  void Orthogonalize(std::size_t used, const Goal& goal);
  void KeepDirection(std::size_t number, double square);

  Kkt(const std::shared_ptr<const KktPlan>& plan, const Form& form);
  Kkt(const Form& form, std::shared_ptr<const KktPlan> plan, const linalg::BlockLdl& symbolic);
  void ListKeptCones();
  void MakeRoom();

  const Form& form_;
  const std::shared_ptr<const KktPlan> plan_;
  linalg::BlockLdl ldl_;
  const Vector constant_;  // of the matrix
  double proximal_ = 0, next_, least_proximal_;
  std::vector<KeptCone> kept_cones_;
  linalg::Digits digits_ = linalg::Digits::kPlain;
  KktWeights weights_;
  Vector value_, value_low_;  // of the matrix
  Vector right_, right_low_;  // of the condensed equations
  Vector rows_, slack_;
  Remainder left_, image_;
  KktStep step_;
  std::vector<Direction> directions_;  // the latest, in turns
  bool trusted_ = false;               // these factors left next to nothing at once
  double trusted_left_ = 0;
  int raised_ = 0;
  int corrections_ = 0;
  int solves_ = 0;
};

}  // namespace switchyard::conic
