// switchyard/sets/convex_set.hpp - what a vertex of a graph holds: a closed convex set in R^n.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "switchyard/export.hpp"
#include "switchyard/model/parallelism.hpp"
#include "switchyard/model/program.hpp"
#include "switchyard/sets/random_generator.hpp"
#include "switchyard/sets/scaled_set.hpp"

namespace switchyard {

/// Proven ranges of the coordinates; an end is infinite where none is known or there is none.
struct SetBox {
  Eigen::VectorXd lower;
  Eigen::VectorXd upper;
  bool empty = false;  // proven: the set has no point
  [[nodiscard]] bool is_finite() const { return lower.allFinite() && upper.allFinite(); }
};

/// A volume by counting hits of a box.
struct SampledVolume {
  double volume = 0;
  double rel_accuracy = 0;  // the standard deviation of `volume` over `volume`; infinite at no hit
  int num_samples = 0;
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

  /// IsEmpty, IsBounded, SupportFunction and Projection ask a backend where there is no closed
  /// form, and throw std::runtime_error where none could tell.
  [[nodiscard]] bool IsEmpty() const;
  /// Is the set empty, or 0 its only direction of recession? `parallelism`: how many of the
  /// programs that this may take run at once. Computed once.
  [[nodiscard]] bool IsBounded(Parallelism parallelism = Parallelism::None()) const;
  [[nodiscard]] bool IntersectsWith(const ConvexSet& other) const;
  /// The point of a set that is known to have exactly one.
  [[nodiscard]] std::optional<Eigen::VectorXd> MaybeGetPoint() const { return DoMaybeGetPoint(); }
  /// Some point of the set; none where it is empty.
  [[nodiscard]] std::optional<Eigen::VectorXd> MaybeGetFeasiblePoint() const;
  /// Violation(x) <= tolerance. x has ambient_dimension() entries.
  [[nodiscard]] bool PointInSet(const VectorRef& x, double tolerance = 0) const;
  /// How far x is from the set, absolute. Of a set without variables of its own: the largest
  /// violation of a row or cone. Of one with some (VPolytope, MinkowskiSum, ConvexHull, ...): the
  /// distance in the largest coordinate, infinite where it is empty; by a linear program to 1e-11
  /// (1 + |x|), by others to 1e-6 (1 + |x|), and rather too small: 0 for every point of the set. Of
  /// a product the largest of its factors.
  [[nodiscard]] double Violation(const VectorRef& x) const;
  /// sup {direction'x : x in the set}: infinity where unbounded, -infinity where empty. Where a
  /// program finds it and duals prove a bound, it is from above, by a part in 1e6 at most.
  [[nodiscard]] double SupportFunction(const VectorRef& direction) const;
  /// Of each column of `points` (ambient_dimension() rows) the Euclidean distance to the set, and
  /// the nearest point of the set as a column. None where the set is empty.
  [[nodiscard]] std::optional<std::pair<std::vector<double>, Eigen::MatrixXd>> Projection(
      const Eigen::Ref<const Eigen::MatrixXd>& points) const;

  /// Does CalcVolume answer for this class of sets?
  [[nodiscard]] bool has_exact_volume() const { return DoHasExactVolume(); }
  /// The volume in R^ambient_dimension(), 0 for a flat set. Throws InvalidArgument where there is
  /// no exact form, or the set is one whose volume is not finite and not known to be infinite.
  [[nodiscard]] double CalcVolume() const;
  /// From points drawn evenly from the bounding box, until the standard deviation of the answer is
  /// `desired_rel_accuracy` of it or `max_num_samples` are drawn. Throws InvalidArgument for a set
  /// that is not bounded, an accuracy or number that is not positive.
  [[nodiscard]] SampledVolume CalcVolumeViaSampling(RandomGenerator* generator,
                                                    double desired_rel_accuracy = 1e-2,
                                                    int max_num_samples = 10000) const;

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

  // What a class says of itself.
  [[nodiscard]] virtual std::unique_ptr<ConvexSet> DoClone() const = 0;
  [[nodiscard]] virtual ScaledSet DoScaled() const = 0;

  // What it may know in closed form; what stands here is found from the scaled form. Sizes have
  // been checked; dimension 0 does not come to DoSupport and DoNearestPoint, an empty set not to
  // the latter.
  /// nullopt: found from the scaled form.
  [[nodiscard]] virtual std::optional<SetBox> DoBoundingBox() const { return std::nullopt; }
  [[nodiscard]] virtual std::optional<Eigen::VectorXd> DoMaybeGetPoint() const {
    return std::nullopt;
  }
  [[nodiscard]] virtual std::optional<Eigen::VectorXd> DoMaybeGetFeasiblePoint() const;
  [[nodiscard]] virtual bool DoIsBounded(Parallelism parallelism) const;
  [[nodiscard]] virtual double DoViolation(const Eigen::VectorXd& x) const;
  [[nodiscard]] virtual double DoSupport(const Eigen::VectorXd& direction) const;
  [[nodiscard]] virtual Eigen::VectorXd DoNearestPoint(const Eigen::VectorXd& x) const;
  [[nodiscard]] virtual bool DoHasExactVolume() const { return false; }
  /// Only where DoHasExactVolume(); nullopt: not of this set.
  [[nodiscard]] virtual std::optional<double> DoCalcVolume() const { return std::nullopt; }

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
/// Of sets by value, and of pointers to sets.
template <class... Sets>
ConvexSets MakeConvexSets(Sets&&... sets) {
  ConvexSets all;
  all.reserve(sizeof...(sets));
  (all.emplace_back(std::forward<Sets>(sets)), ...);
  return all;
}

}  // namespace switchyard
