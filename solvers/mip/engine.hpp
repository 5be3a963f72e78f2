// solvers/mip/engine.hpp - what bounds a node: a relaxation of the problem in a box.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solvers/mip/node_bound.hpp"
#include "solvers/mip/node_boxes.hpp"

namespace switchyard::mip {

struct Relaxed {
  enum class State {
    kPoint,    // x, and what is proven
    kEmpty,    // proven: the box holds no feasible point
    kCutoff,   // proven: none below the cutoff
    kTrouble,  // the backend gave neither point nor proof
    kStopped   // a limit, or cancelled
  };
  State state = State::kTrouble;
  NodeBound bound;
  double objective = kInfinity;  // of x
  std::vector<double> x;
  rounding::Duals duals;  // of the problem, where conic nodes have a point
  std::int64_t iterations = 0;
};

/// A relaxation in an instance of its own, of one worker, solved again and again.
class Engine {
 public:
  Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  virtual ~Engine() = default;

  /// In the box, for points with an objective below `cutoff`. `rounds`: times that it is tightened
  /// by cuts, at most.
  virtual Relaxed Solve(const NodeBoxes& boxes, double cutoff, int rounds) = 0;
  /// Likewise, with less effort: what branching wants to know of a child.
  virtual Relaxed Glance(const NodeBoxes& boxes, double cutoff) = 0;
  /// A point of the problem's cones, perhaps optimal for some integers: its neighbourhood matters.
  virtual void See(const std::vector<double>& /*x*/) {}
  [[nodiscard]] virtual std::string Name() const = 0;
};

}  // namespace switchyard::mip
