// tests/solvers/grid_graph.hpp - shortest paths through boxes in the plane, as the sy_problem with
// hints that a front end would hand over (the lean form), and their answers by enumeration.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "switchyard/arcs.hpp"
#include "switchyard/hints.h"
#include "switchyard/host/host.hpp"
#include "switchyard/problem.hpp"

namespace switchyard::test {

enum class EdgeCost { kLinear, kOneNorm, kInfinityNorm, kTwoNorm, kSquared };

/// Boxes of random size in the cells of a grid, arcs both ways between neighbours, less a few;
/// from the first cell to the last. Arc e has the variables phi, y (2), z (2) and its epigraph's;
/// its cost is that of z - y, or linear in phi, y and z.
class GridGraph {
 public:
  GridGraph(int width, int height, EdgeCost cost, std::uint64_t seed);
  GridGraph(const GridGraph&) = delete;
  GridGraph& operator=(const GridGraph&) = delete;

  [[nodiscard]] const sy_problem& view() const { return problem_.view(); }
  [[nodiscard]] const ProblemData& data() const { return problem_.data(); }
  [[nodiscard]] Arcs arcs() const { return {num_vertices_, tail_, head_}; }
  [[nodiscard]] std::int32_t source() const { return 0; }
  [[nodiscard]] std::int32_t target() const { return num_vertices_ - 1; }
  [[nodiscard]] std::vector<std::vector<std::int32_t>> SimplePaths() const;
  /// The whole problem with the flows fixed by their bounds.
  [[nodiscard]] Problem FixedTo(const std::vector<std::int32_t>& path) const;
  sy_paths& paths() { return paths_; }
  Problem& problem() { return problem_; }

 private:
  struct Box {
    double lower[2], upper[2];
  };
  struct Triplets {
    std::vector<std::vector<std::pair<std::int32_t, double>>> columns;
    void Add(std::int32_t row, std::int32_t column, double value);
    [[nodiscard]] Csc Matrix(std::int32_t rows) const;
  };

  void DrawArcs(int width, int height, Random& random);
  void AddVariables(EdgeCost cost, const std::vector<Box>& boxes, Random& random);
  void AddCouplingRows();
  void AddBlock(std::int32_t arc, EdgeCost cost, const std::vector<Box>& boxes);
  void AddCost(std::int32_t arc, EdgeCost cost);
  std::int32_t AddVariable(std::int32_t block, double lower, double upper, double q);
  std::int32_t AddRow(std::int32_t block, double lower, double upper);
  std::int32_t AddCone(std::int32_t block, sy_cone_kind kind, std::int32_t dim);
  void Seal();

  std::int32_t num_vertices_ = 0;
  std::vector<std::int32_t> tail_, head_, first_;  // first_: variable of each arc
  ProblemData data_;
  Triplets a_, f_;
  Problem problem_;
  std::vector<std::int32_t> block_of_x_, block_of_row_, block_of_cone_, own_arc_;
  sy_blocks blocks_{};
  sy_paths paths_{};
  sy_hint hints_[3] = {};
};

/// A host with the modules that the build made of `backends`, and relax-and-round.
std::unique_ptr<Host> HostWith(const std::vector<std::string>& backends);

struct StrategyAnswer {
  sy_status status = SY_OK;
  std::string error, text;
  sy_result result{};
  std::vector<double> x, relaxed_x;
};

/// A control that limits nothing.
sy_control Unlimited(int threads = 1);

/// relax-and-round on a problem, through the host's table; an option as "name=value".
StrategyAnswer RelaxAndRoundOn(Host& host, const sy_problem& problem,
                               const std::vector<std::string>& options = {},
                               const sy_control& control = Unlimited());

/// The optimum of a problem by the host's best backend; infinity where it is infeasible.
double OptimumBy(Host& host, const sy_problem& problem);

/// The least cost of a simple path, each solved with the flows fixed.
double BestPath(Host& host, const GridGraph& graph);

}  // namespace switchyard::test
