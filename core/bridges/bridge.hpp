// core/bridges/bridge.hpp - from a problem to one that a backend takes, and the way back.
//
// A bridge is a pure map: the same problem gives the same image. It may append variables, and
// relabel rows and cones; it never reorders or drops a variable, so bounds of variables pass
// straight through all bridges that keep them as bounds, and x is the head of the image's x.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/problem/vectors.hpp"
#include "switchyard/problem.hpp"

namespace switchyard {

/// Features of a problem as bits: sy_solver.accepts below, 32 + a cone's kind above. A backend's
/// abilities are the same bits, so `features & ~abilities` is what stands between the two.
using Features = std::uint64_t;

constexpr Features ConeFeature(sy_cone_kind kind) { return Features{1} << (32 + kind); }
Features FeaturesOf(const sy_problem& problem);
/// What the backend takes where there are integers, and where there are none.
Features AbilitiesOf(const sy_solver& solver, bool with_integers);
/// "variable bounds", "power cones", ... for messages.
std::string DescribeFeatures(Features features);

/// Is a cone switched off?
bool AnyOff(const ProblemData& problem);

/// The maps of vectors over a problem and its image under a bridge. It keeps what they need, not
/// the image: that goes on to the next bridge.
class Bridge {
 public:
  Bridge() = default;
  Bridge(const Bridge&) = delete;
  Bridge& operator=(const Bridge&) = delete;
  virtual ~Bridge() = default;

  /// Vectors over the image become vectors over the original: points, duals and rays alike.
  virtual void Back(Vectors& v) const = 0;
  /// Vectors over the original become vectors over the image; NaN where nothing is known.
  virtual void Forward(Vectors& v) const = 0;
};

/// One application of a bridge.
struct Bridged {
  ProblemData image;
  std::unique_ptr<Bridge> maps;
};

/// A bridge as the planner sees it: a row of the table.
struct BridgeKind {
  const char* name;
  Features removes;
  Features adds;  // at most
  /// Throws InvalidArgument where this problem cannot be mapped.
  Bridged (*apply)(ProblemData);
  bool may_throw = false;
};

/// All bridges, each in a file of its own in bridges/.
const std::vector<BridgeKind>& BridgeKinds();

using BridgePlan = std::vector<const BridgeKind*>;

/// The shortest chain of bridges after which only `abilities` are needed.
struct Planned {
  bool found = false;
  BridgePlan plan;
  Features missing = 0;  // where none was found: what no bridge removes
};
Planned PlanBridges(Features features, Features abilities);

/// A chain of bridges applied to a problem, which they copy once. Its hints stay in place as long
/// as the chain.
class BridgeChain {
 public:
  BridgeChain() = default;
  /// Cones that are off are left out first.
  BridgeChain(const Problem& problem, const BridgePlan& plan);

  [[nodiscard]] bool empty() const { return bridges_.empty(); }
  /// The last image; only where not empty().
  [[nodiscard]] const Problem& image() const { return image_; }
  void Back(Vectors& v) const;
  void Forward(Vectors& v) const;
  /// Hints that the chain could not map, a sentence each.
  [[nodiscard]] const std::vector<std::string>& dropped_hints() const { return dropped_; }

 private:
  void MapHints(const sy_problem& problem);

  std::vector<std::unique_ptr<Bridge>> bridges_;
  Problem image_;
  std::vector<sy_hint> hints_;
  std::vector<std::string> dropped_;
};

}  // namespace switchyard
