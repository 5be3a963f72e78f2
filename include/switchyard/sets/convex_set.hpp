// switchyard/sets/convex_set.hpp - what a vertex of a graph holds: a closed convex set in R^n.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "switchyard/export.hpp"
#include "switchyard/model/program.hpp"
#include "switchyard/sets/scaled_set.hpp"

namespace switchyard {

/// Proven ranges of the coordinates; an end is infinite where none is known or there is none.
struct SetBox {
  Eigen::VectorXd lower;
  Eigen::VectorXd upper;
  bool empty = false;  // proven: the set has no point
  [[nodiscard]] bool is_finite() const { return lower.allFinite() && upper.allFinite(); }
};

/// A set is a value behind a pointer: immutable from its first use in a graph on. A class of sets
/// says one thing, its scaled form; all questions are answered from that, and a class that has a
/// closed form for one overrides it. Const members may be called from several threads.
class SWITCHYARD_EXPORT ConvexSet {
 public:
  virtual ~ConvexSet();
  [[nodiscard]] std::unique_ptr<ConvexSet> Clone() const { return DoClone(); }
  [[nodiscard]] int ambient_dimension() const { return dimension_; }
  /// "hyperrectangle", "intersection", ... for messages.
  [[nodiscard]] virtual std::string Kind() const = 0;

  /// The cone over the set; computed once.
  [[nodiscard]] const ScaledSet& scaled() const;
  /// Computed once: by propagation over the rows and cones, then, where that leaves ends open, by
  /// a linear program for each, its duals made safe.
  [[nodiscard]] const SetBox& bounding_box() const;

  /// Throws std::runtime_error where no backend could tell.
  [[nodiscard]] bool IsEmpty() const;
  [[nodiscard]] bool IsBounded() const;
  [[nodiscard]] bool IntersectsWith(const ConvexSet& other) const;
  /// The point of a set that is known to have exactly one.
  [[nodiscard]] std::optional<Eigen::VectorXd> MaybeGetPoint() const { return DoMaybeGetPoint(); }
  /// Some point of the set; none where it is empty.
  [[nodiscard]] std::optional<Eigen::VectorXd> MaybeGetFeasiblePoint() const;
  /// Is every row and cone violated by at most `tolerance`, absolute? x has ambient_dimension()
  /// entries.
  [[nodiscard]] bool PointInSet(const VectorRef& x, double tolerance = 0) const;
  /// The largest absolute violation of a row or cone at x.
  [[nodiscard]] double Violation(const VectorRef& x) const;

  /// x in the set, as constraints; returns the new variables, if any, and the constraints.
  std::pair<VectorXDecisionVariable, std::vector<Binding<Constraint>>> AddPointInSetConstraints(
      MathematicalProgram* prog, const VariableList& x) const;
  /// x in t S, t >= 0.
  std::vector<Binding<Constraint>> AddPointInNonnegativeScalingConstraints(
      MathematicalProgram* prog, const VariableList& x, Variable t) const;
  /// Ax + b in (c't + d) S, c't + d >= 0. At scale 0 an unbounded S contributes its recession cone.
  std::vector<Binding<Constraint>> AddPointInNonnegativeScalingConstraints(
      MathematicalProgram* prog, const Eigen::Ref<const Eigen::MatrixXd>& A, const VectorRef& b,
      const VectorRef& c, double d, const VariableList& x, const VariableList& t) const;

 protected:
  explicit ConvexSet(int dimension);
  ConvexSet(const ConvexSet&) = default;  // copies share what was computed
  ConvexSet& operator=(const ConvexSet&) = default;
  /// For a set that is assigned a new value: what was found of the old one is forgotten.
  void Changed(int dimension);

  [[nodiscard]] virtual std::unique_ptr<ConvexSet> DoClone() const = 0;
  [[nodiscard]] virtual ScaledSet DoScaled() const = 0;
  /// nullopt: found from the scaled form.
  [[nodiscard]] virtual std::optional<SetBox> DoBoundingBox() const { return std::nullopt; }
  [[nodiscard]] virtual std::optional<Eigen::VectorXd> DoMaybeGetPoint() const {
    return std::nullopt;
  }

 private:
  struct Known;  // what is computed once
  int dimension_;
  std::shared_ptr<Known> known_;
};

/// Sets by value: copies clone.
class SWITCHYARD_EXPORT ConvexSetPointer {
 public:
  // NOLINTNEXTLINE(google-explicit-constructor): a value of any class of sets
  ConvexSetPointer(const ConvexSet& set) : set_(set.Clone()) {}
  // NOLINTNEXTLINE(google-explicit-constructor)
  ConvexSetPointer(std::shared_ptr<const ConvexSet> set) : set_(std::move(set)) {}
  const ConvexSet& operator*() const { return *set_; }
  const ConvexSet* operator->() const { return set_.get(); }
  [[nodiscard]] const std::shared_ptr<const ConvexSet>& shared() const { return set_; }

 private:
  std::shared_ptr<const ConvexSet> set_;  // immutable, so that copies may share it
};
using ConvexSets = std::vector<ConvexSetPointer>;
template <class... Sets>
ConvexSets MakeConvexSets(const Sets&... sets) {
  return {ConvexSetPointer(sets)...};
}

}  // namespace switchyard
