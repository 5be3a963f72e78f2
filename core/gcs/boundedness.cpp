#include "core/gcs/boundedness.hpp"

#include <cmath>

#include "core/problem/row_matrix.hpp"
#include "switchyard/boxes.hpp"

namespace switchyard {
namespace {

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Rows of a block at scale 1, its own variables behind `first_own`.
void WriteRows(const PlacedRows& rows, const TermBlock& block, std::int32_t first_own,
               RowMatrix& to, std::vector<double>& constant) {
  for (std::size_t i = 0; i < At(rows.count()); ++i) {
    to.Begin();
    constant.push_back(0);
    for (auto k = At(rows.start[i]); k < At(rows.start[i + 1]); ++k) {
      const std::int32_t place = rows.place[k];
      if (place == 0) {
        constant.back() += rows.value[k];
      } else {
        to.Add(place < block.num_places ? place - 1 : first_own + place - block.num_places,
               rows.value[k]);
      }
    }
  }
}

/// Does propagation over a vertex's set and constraints close all coordinates?
bool IsClosed(const TermBlock& set, const TermBlock& terms, std::int32_t dim) {
  ProblemData d;
  d.num_vars = dim + set.num_own + terms.num_own;
  RowMatrix A, F;
  for (const TermBlock* block : {&set, &terms}) {
    const std::int32_t first_own = block == &set ? dim : dim + set.num_own;
    std::vector<double> constant;
    WriteRows(block->rows, *block, first_own, A, constant);
    for (std::size_t i = 0; i < constant.size(); ++i) {
      d.row_lower.push_back(block->lower[i] - constant[i]);
      d.row_upper.push_back(block->upper[i] - constant[i]);
    }
    WriteRows(block->cone_rows, *block, first_own, F, d.g);
    d.cones.insert(d.cones.end(), block->cones.begin(), block->cones.end());
  }
  d.q.assign(At(d.num_vars), 0.0);
  d.P = Csc(d.num_vars, d.num_vars);
  d.A = A.Take(d.num_vars);
  d.F = F.Take(d.num_vars);
  const Problem problem(std::move(d));
  const Boxes boxes = ProvenBoxes(problem.view());
  for (std::size_t i = 0; i < At(dim); ++i) {
    if (!std::isfinite(boxes.lower[i]) || !std::isfinite(boxes.upper[i])) return boxes.infeasible;
  }
  return true;
}

}  // namespace

std::vector<const GraphOfConvexSets::Vertex*> UnboundedVertices(const PrunedGraph& graph,
                                                                TermBlocks& blocks) {
  std::vector<std::uint8_t> used(graph.vertices.size(), 0);
  for (std::size_t a = 0; a < graph.edges.size(); ++a) {
    used[At(graph.tail[a])] = used[At(graph.head[a])] = 1;
  }
  std::vector<const GraphOfConvexSets::Vertex*> unbounded;
  for (std::size_t v = 0; v < used.size(); ++v) {
    const GraphOfConvexSets::Vertex& vertex = *graph.vertices[v];
    if (used[v] == 0) continue;
    const SetBox& box = vertex.set().bounding_box();
    if (box.empty || box.is_finite()) continue;
    const VertexBlocks& of = blocks.Of(vertex);
    if (IsClosed(*of.set, *of.terms, vertex.ambient_dimension())) continue;
    unbounded.push_back(&vertex);
  }
  return unbounded;
}

}  // namespace switchyard
