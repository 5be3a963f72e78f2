#include "core/gcs/transcription.hpp"

#include <algorithm>
#include <cmath>

namespace switchyard {
namespace {

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

}  // namespace

GcsTranscription::GcsTranscription(const PrunedGraph& graph, Transcription as, bool transitions,
                                   TermBlocks* blocks)
    : graph_(graph),
      own_blocks_(as),
      plan_(graph, transitions),
      point_(graph.vertices.size()),
      edges_(graph.edges.size()),
      transitions_(plan_.all().size()) {
  FindBlocks(blocks != nullptr ? *blocks : own_blocks_);
  num_blocks_ = static_cast<std::int32_t>(edges_.size());
  for (std::size_t a = 0; a < edges_.size(); ++a) AddEdgeVariables(a);
  for (std::size_t k = 0; k < transitions_.size(); ++k) AddTransitionVariables(k);
  for (std::size_t a = 0; a < edges_.size(); ++a) WriteEdge(a);
  for (std::size_t k = 0; k < transitions_.size(); ++k) WriteTransition(k);
  block_ = -1;
  WriteCoupling();
  Finish();
  WriteHints();
}

void GcsTranscription::FindBlocks(TermBlocks& blocks) {
  blocks_of_vertex_.resize(graph_.vertices.size());
  for (std::size_t a = 0; a < edges_.size(); ++a) {
    for (const std::int32_t v : {graph_.tail[a], graph_.head[a]}) {
      if (blocks_of_vertex_[At(v)].set != nullptr) continue;
      point_[At(v)] = graph_.vertices[At(v)]->set().MaybeGetPoint();
      blocks_of_vertex_[At(v)] = blocks.Of(*graph_.vertices[At(v)]);
    }
    blocks_of_edge_.push_back(blocks.Of(*graph_.edges[a], graph_.head[a] == graph_.target));
  }
}

// ---- variables ----

std::int32_t GcsTranscription::AddVariables(std::int32_t count) {
  const auto first = static_cast<std::int32_t>(data_.q.size());
  const std::size_t all = data_.q.size() + At(count);
  data_.q.resize(all, 0.0);
  data_.x_lower.resize(all, -kInfinity);
  data_.x_upper.resize(all, kInfinity);
  data_.integer.resize(all, 0);
  block_of_x_.resize(all, block_);
  return first;
}

std::int32_t GcsTranscription::AddPoint(std::int32_t vertex) {
  if (PointAt(vertex)) return -1;
  const ConvexSet& set = graph_.vertices[At(vertex)]->set();
  const SetBox& box = set.bounding_box();
  const std::int32_t first = AddVariables(set.ambient_dimension());
  for (int i = 0; i < set.ambient_dimension(); ++i) {
    data_.x_lower[At(first + i)] = std::min(0.0, box.lower[i]);
    data_.x_upper[At(first + i)] = std::max(0.0, box.upper[i]);
  }
  return first;
}

void GcsTranscription::AddEnd(std::int32_t vertex, std::int32_t scale,
                              std::span<const FixedCoordinate> fixed) {
  const std::int32_t n = DimensionAt(vertex);
  if (PointAt(vertex)) {
    for (std::int32_t i = 0; i < n; ++i) ends_.push_back({scale, (*PointAt(vertex))[i]});
    return;
  }
  const SetBox& box = graph_.vertices[At(vertex)]->set().bounding_box();
  auto next = fixed.begin();
  for (std::int32_t i = 0; i < n; ++i) {
    if (next != fixed.end() && next->place == i) {
      ends_.push_back({scale, next++->value});
      continue;
    }
    const std::int32_t j = AddVariables(1);
    data_.x_lower[At(j)] = std::min(0.0, box.lower[i]);
    data_.x_upper[At(j)] = std::max(0.0, box.upper[i]);
    ends_.push_back({j, 1});
  }
}

void GcsTranscription::AddEdgeVariables(std::size_t arc) {
  block_ = static_cast<std::int32_t>(arc);
  const GraphOfConvexSets::Edge& edge = *graph_.edges[arc];
  EdgeVariables& at = edges_[arc];
  at.phi = AddVariables(1);
  data_.x_lower[At(at.phi)] = edge.phi_value() == true ? 1 : 0;
  data_.x_upper[At(at.phi)] = 1;
  data_.integer[At(at.phi)] = 1;
  const std::vector<FixedCoordinate>& fixed = *FixedOf(arc);
  const std::int32_t of_u = DimensionAt(graph_.tail[arc]);
  const auto of_v = std::find_if(fixed.begin(), fixed.end(),
                                 [&](const FixedCoordinate& c) { return c.place >= of_u; });
  std::vector<FixedCoordinate> at_v(of_v, fixed.end());
  for (FixedCoordinate& c : at_v) c.place -= of_u;
  at.tail = static_cast<std::int32_t>(ends_.size());
  AddEnd(graph_.tail[arc], at.phi, {fixed.begin(), of_v});
  at.head = static_cast<std::int32_t>(ends_.size());
  AddEnd(graph_.head[arc], at.phi, at_v);
  if (edge.slacks().size() > 0) {
    at.slack = AddVariables(static_cast<std::int32_t>(edge.slacks().size()));
  }
}

void GcsTranscription::AddTransitionVariables(std::size_t k) {
  const Transition& t = plan_.all()[k];
  if (t.copy != Transition::Copy::kOwn) return;
  block_ = transitions_[k].block = num_blocks_++;
  transitions_[k].lambda = AddVariables(1);
  data_.x_lower[At(transitions_[k].lambda)] = 0;
  data_.x_upper[At(transitions_[k].lambda)] = 1;
  if (!PointAt(t.vertex)) transitions_[k].w = AddPoint(t.vertex);
}

std::span<const GcsTranscription::Column> GcsTranscription::Tail(std::size_t arc) const {
  return std::span(ends_).subspan(At(edges_[arc].tail), At(DimensionAt(graph_.tail[arc])));
}

std::span<const GcsTranscription::Column> GcsTranscription::Head(std::size_t arc) const {
  return std::span(ends_).subspan(At(edges_[arc].head), At(DimensionAt(graph_.head[arc])));
}

GcsTranscription::Column GcsTranscription::CopyOf(const Transition& t, std::size_t k,
                                                  std::int32_t i) const {
  switch (t.copy) {
    case Transition::Copy::kOut:
      return Tail(At(t.out))[At(i)];
    case Transition::Copy::kIn:
      return Head(At(t.in))[At(i)];
    default:
      if (PointAt(t.vertex)) return {transitions_[k].lambda, (*PointAt(t.vertex))[i]};
      return {transitions_[k].w + i, 1};
  }
}

std::int32_t GcsTranscription::ScaleOf(const Transition& t, std::size_t k) const {
  switch (t.copy) {
    case Transition::Copy::kOut:
      return edges_[At(t.out)].phi;
    case Transition::Copy::kIn:
      return edges_[At(t.in)].phi;
    default:
      return transitions_[k].lambda;
  }
}

// ---- blocks ----

void GcsTranscription::WriteEdge(std::size_t arc) {
  block_ = static_cast<std::int32_t>(arc);
  const GraphOfConvexSets::Edge& edge = *graph_.edges[arc];
  const std::int32_t u = graph_.tail[arc], v = graph_.head[arc];
  const EdgeVariables& at = edges_[arc];
  const auto place = [&](std::span<const Column> end) {
    columns_.insert(columns_.end(), end.begin(), end.end());
  };
  if (plan_.OwnsTail(arc)) {
    columns_.assign(1, {at.phi, 1});
    place(Tail(arc));
    if (!PointAt(u)) WriteBlock(*blocks_of_vertex_[At(u)].set);
    WriteBlock(*blocks_of_vertex_[At(u)].terms);
  }
  if (plan_.OwnsHead(arc)) {
    columns_.assign(1, {at.phi, 1});
    place(Head(arc));
    const VertexBlocks& of = blocks_of_vertex_[At(v)];
    if (!PointAt(v)) WriteBlock(*of.set);
    if (v == graph_.target || plan_.At(v)) {
      WriteBlock(*of.terms);
    } else if (of.constraints != nullptr) {
      WriteBlock(*of.constraints);
    }
  }
  columns_.assign(1, {at.phi, 1});
  place(Tail(arc));
  place(Head(arc));
  for (std::int32_t i = 0; i < edge.slacks().size(); ++i) columns_.push_back({at.slack + i, 1});
  WriteBlock(*blocks_of_edge_[arc].terms);
  WriteSquares(at.phi);
}

void GcsTranscription::WriteTransition(std::size_t k) {
  const Transition& t = plan_.all()[k];
  if (t.copy != Transition::Copy::kOwn) return;
  block_ = transitions_[k].block;
  columns_.assign(1, {transitions_[k].lambda, 1});
  for (std::int32_t i = 0; i < DimensionAt(t.vertex); ++i) columns_.push_back(CopyOf(t, k, i));
  const VertexBlocks& of = blocks_of_vertex_[At(t.vertex)];
  if (!PointAt(t.vertex)) WriteBlock(*of.set);
  WriteBlock(*of.terms);
  WriteSquares(transitions_[k].lambda);
}

template <class Take>
void GcsTranscription::EachEntry(const PlacedRows& rows, std::size_t row, const TermBlock& block,
                                 std::int32_t own, Take&& take) const {
  for (auto k = At(rows.start[row]); k < At(rows.start[row + 1]); ++k) {
    const std::int32_t place = rows.place[k];
    if (place >= block.num_places) {
      take(own + place - block.num_places, rows.value[k]);
    } else {
      const Column& column = columns_[At(place)];
      take(column.variable, rows.value[k] * column.factor);
    }
  }
}

/// The block of all variables of the row that was begun last, if they have but one.
std::int32_t GcsTranscription::BlockOfRow(const RowMatrix& matrix) const {
  const auto columns = matrix.Columns();
  const bool within = std::all_of(columns.begin(), columns.end(),
                                  [&](std::int32_t j) { return block_of_x_[At(j)] == block_; });
  return within ? block_ : -1;
}

// Over the places as they are filled.
void GcsTranscription::WriteBlock(const TermBlock& block) {
  const std::int32_t own = block.num_own > 0 ? AddVariables(block.num_own) : 0;
  std::copy(block.own_lower.begin(), block.own_lower.end(), data_.x_lower.begin() + own);
  std::copy(block.own_upper.begin(), block.own_upper.end(), data_.x_upper.begin() + own);
  for (std::size_t j = 0; j < block.cost.size(); ++j) {
    if (block.cost[j] == 0) continue;
    const auto place = static_cast<std::int32_t>(j);
    const Column column =
        place < block.num_places ? columns_[j] : Column{own + place - block.num_places, 1};
    data_.q[At(column.variable)] += block.cost[j] * column.factor;
  }
  WriteRows(block, own);
  WriteCones(block, own);
  for (std::size_t i = 0; i < At(block.squares.count()); ++i) {
    EachEntry(block.squares, i, block, own, [&](std::int32_t j, double value) {
      squares_.push_back({j, value});
    });
    square_end_.push_back(squares_.size());
  }
}

// What fixed coordinates leave of a row may be of the scale alone: then it holds, but for rounding,
// or it says that the scale is 0.
void GcsTranscription::WriteRows(const TermBlock& block, std::int32_t own) {
  constexpr double kRounding = 1e-12;
  const std::int32_t scale = columns_.front().variable;
  for (std::size_t i = 0; i < At(block.rows.count()); ++i) {
    BeginRow(block.lower[i], block.upper[i]);
    double size = 0;
    EachEntry(block.rows, i, block, own, [&](std::int32_t j, double value) {
      A_.Add(j, value);
      size = std::max(size, std::abs(value));
    });
    const auto columns = A_.Columns();
    if (columns.empty() || (columns.size() == 1 && columns[0] == scale)) {
      const double value = columns.empty() ? 0 : A_.Values()[0];
      const bool holds = (block.upper[i] == kInfinity || value <= kRounding * size) &&
                         (block.lower[i] == -kInfinity || value >= -kRounding * size);
      if (holds) {
        DropRow();
        continue;
      }
    }
    block_of_row_.push_back(BlockOfRow(A_));
  }
}

void GcsTranscription::WriteCones(const TermBlock& block, std::int32_t own) {
  std::size_t row = 0;
  for (const sy_cone& cone : block.cones) {
    std::int32_t of = block_;
    for (std::int32_t i = 0; i < cone.dim; ++i, ++row) {
      F_.Begin();
      EachEntry(block.cone_rows, row, block, own,
                [&](std::int32_t j, double value) { F_.Add(j, value); });
      if (BlockOfRow(F_) != block_) of = -1;
    }
    data_.cones.push_back(cone);
    block_of_cone_.push_back(of);
  }
}

// 2 t l >= |S_1 x_1|^2 + |S_2 x_2|^2 + ... : one cone for all squares of a block.
void GcsTranscription::WriteSquares(std::int32_t scale) {
  if (square_end_.empty()) return;
  const std::int32_t epigraph = AddVariables(1);
  data_.q[At(epigraph)] = 1;
  std::int32_t of = block_;
  F_.Begin();
  F_.Add(scale, 1);
  F_.Begin();
  F_.Add(epigraph, 1);
  std::size_t next = 0;
  for (const std::size_t end : square_end_) {
    F_.Begin();
    for (; next < end; ++next) F_.Add(squares_[next].variable, squares_[next].factor);
    if (BlockOfRow(F_) != block_) of = -1;
  }
  data_.cones.push_back({SY_CONE_ROTATED, 2 + static_cast<std::int32_t>(square_end_.size()), 0});
  block_of_cone_.push_back(of);
  squares_.clear();
  square_end_.clear();
}

// ---- coupling ----

void GcsTranscription::BeginRow(double lower, double upper) {
  data_.row_lower.push_back(lower);
  data_.row_upper.push_back(upper);
  A_.Begin();
}

void GcsTranscription::DropRow() {
  data_.row_lower.pop_back();
  data_.row_upper.pop_back();
  A_.Drop();
}

void GcsTranscription::WriteCoupling() {
  const Leaving out(graph_.arcs()), in(Reversed(graph_.arcs()));
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(graph_.vertices.size()); ++v) {
    if (out.Of(v).empty() && in.Of(v).empty()) continue;
    if (plan_.At(v)) {
      WriteTransitionFlow(v, in.Of(v), out.Of(v));
    } else {
      WriteFlow(v, in.Of(v), out.Of(v));
    }
    if (v == graph_.source || v == graph_.target) continue;
    BeginRow(-kInfinity, 1);
    for (const std::int32_t a : out.Of(v)) A_.Add(edges_[At(a)].phi, 1);
  }
  block_of_row_.resize(data_.row_lower.size(), -1);
}

// Of flow and, between arcs in and out, of points; a point's spatial rows follow from its flow.
void GcsTranscription::WriteFlow(std::int32_t vertex, std::span<const std::int32_t> in,
                                 std::span<const std::int32_t> out) {
  const double net = vertex == graph_.source ? 1 : vertex == graph_.target ? -1 : 0;
  BeginRow(net, net);
  for (const std::int32_t a : out) A_.Add(edges_[At(a)].phi, 1);
  for (const std::int32_t a : in) A_.Add(edges_[At(a)].phi, -1);
  if (net != 0 || PointAt(vertex)) return;
  for (std::size_t i = 0; i < At(DimensionAt(vertex)); ++i) {
    BeginRow(0, 0);
    for (const std::int32_t a : out) {
      A_.Add(Tail(At(a))[i].variable, Tail(At(a))[i].factor);
    }
    for (const std::int32_t a : in) A_.Add(Head(At(a))[i].variable, -Head(At(a))[i].factor);
  }
}

void GcsTranscription::WriteTransitionFlow(std::int32_t vertex, std::span<const std::int32_t> in,
                                           std::span<const std::int32_t> out) {
  const bool is_point = PointAt(vertex).has_value();
  for (const std::int32_t a : in) {
    if (plan_.OwnsHead(At(a))) continue;
    WriteSum(plan_.From(At(a)), edges_[At(a)].phi,
             is_point ? std::span<const Column>() : Head(At(a)));
  }
  for (const std::int32_t a : out) {
    if (plan_.OwnsTail(At(a))) continue;
    WriteSum(plan_.To(At(a)), edges_[At(a)].phi,
             is_point ? std::span<const Column>() : Tail(At(a)));
  }
}

// An arc's flow and the point at its end as the sum of transitions'.
void GcsTranscription::WriteSum(std::span<const std::int32_t> transitions, std::int32_t flow,
                                std::span<const Column> end) {
  BeginRow(0, 0);
  for (const std::int32_t k : transitions) A_.Add(ScaleOf(plan_.all()[At(k)], At(k)), 1);
  A_.Add(flow, -1);
  for (std::size_t i = 0; i < end.size(); ++i) {
    BeginRow(0, 0);
    for (const std::int32_t k : transitions) {
      const Column copy = CopyOf(plan_.all()[At(k)], At(k), static_cast<std::int32_t>(i));
      A_.Add(copy.variable, copy.factor);
    }
    A_.Add(end[i].variable, -end[i].factor);
  }
}

void GcsTranscription::Finish() {
  data_.flags = SY_PROBLEM_CONVEX;
  data_.num_vars = static_cast<std::int32_t>(data_.q.size());
  data_.P = Csc(data_.num_vars, data_.num_vars);
  data_.A = A_.Take(data_.num_vars);
  data_.g.assign(At(F_.rows()), 0.0);
  data_.F = F_.Take(data_.num_vars);
  problem_ = Problem(std::move(data_));
}

}  // namespace switchyard
