#include "core/gcs/transcription.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace switchyard {
namespace {

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

constexpr Column kNone = {-1, 0};  // of an idle coordinate

}  // namespace

GcsTranscription::GcsTranscription(const PrunedGraph& graph, Transcription as, bool transitions,
                                   WrittenProgram* written)
    : graph_(graph),
      own_(written == nullptr ? std::make_unique<WrittenProgram>(as) : nullptr),
      written_(written == nullptr ? *own_ : *written),
      p_(written_.programs.now),
      problem_(written_.problem),
      plan_(graph, transitions),
      point_(graph.vertices.size()),
      edges_(graph.edges.size()),
      transitions_(plan_.all().size()),
      lists_(written_.lists) {
  FindBlocks();
  written_.BeginNext();
  WriteBlocks();
  PlaceBlocks();
  WriteCoupling();
  Finish();
  WriteHints();
}

void GcsTranscription::FindBlocks() {
  TermBlocks& blocks = written_.blocks;
  blocks_of_vertex_.resize(graph_.vertices.size());
  blocks_of_edge_.reserve(edges_.size());
  for (std::size_t a = 0; a < edges_.size(); ++a) {
    for (const std::int32_t v : {graph_.tail[a], graph_.head[a]}) {
      if (blocks_of_vertex_[At(v)].set != nullptr) continue;
      point_[At(v)] = graph_.vertices[At(v)]->set().MaybeGetPoint();
      blocks_of_vertex_[At(v)] = blocks.Of(*graph_.vertices[At(v)]);
      same_terms_ &= blocks_of_vertex_[At(v)].same;
    }
    blocks_of_edge_.push_back(blocks.Of(*graph_.edges[a], graph_.head[a] == graph_.target,
                                        blocks_of_vertex_[At(graph_.tail[a])].stamp,
                                        blocks_of_vertex_[At(graph_.head[a])].stamp));
    same_terms_ &= blocks_of_edge_.back().same;
  }
  idle_.emplace(graph_, plan_, blocks_of_vertex_, blocks_of_edge_);
}

const TermBlock& GcsTranscription::KeptSet(std::int32_t vertex) {
  const std::vector<std::uint8_t>& idle = idle_->At(vertex);
  if (idle.empty()) return *blocks_of_vertex_[At(vertex)].set;
  return written_.blocks.Split(*graph_.vertices[At(vertex)], idle).kept;
}

const std::vector<std::uint8_t>& GcsTranscription::MissingAt(std::size_t arc) const {
  const std::int32_t v = graph_.head[arc];
  return plan_.At(v) && !plan_.OwnsHead(arc) ? idle_->Unread(v) : idle_->At(v);
}

std::uint64_t GcsTranscription::IdleStamp(std::int32_t vertex) const {
  std::uint64_t stamp = 0;
  for (const auto* mask : {&idle_->At(vertex), &idle_->Unread(vertex)}) {
    for (const std::uint8_t bit : *mask) stamp = 0x9e3779b97f4a7c15U * (stamp + bit + 1);
  }
  return stamp;
}

BlockKey GcsTranscription::KeyOf(std::size_t arc) const {
  const GraphOfConvexSets::Edge& edge = *graph_.edges[arc];
  const std::int32_t v = graph_.head[arc];
  std::uint32_t shape = 0;
  for (const bool bit : {edge.phi_value() == true, plan_.OwnsTail(arc), plan_.OwnsHead(arc),
                         v == graph_.target, plan_.At(v)}) {
    shape = 2 * shape + (bit ? 1 : 0);
  }
  const std::uint64_t idle = 31 * IdleStamp(graph_.tail[arc]) + IdleStamp(v);
  return {2 * static_cast<std::uint64_t>(edge.id().value), blocks_of_edge_[arc].stamp ^ idle,
          shape};
}

BlockKey GcsTranscription::KeyOf(const Transition& t) const {
  const auto id = static_cast<std::uint64_t>(graph_.vertices[At(t.vertex)]->id().value);
  return {2 * id + 1, blocks_of_vertex_[At(t.vertex)].stamp ^ IdleStamp(t.vertex), 0};
}

// Those of the program before are copied where they are the same.
void GcsTranscription::WriteBlocks() {
  const BlockProgram& before = written_.programs.before;
  BlockCopies copies(before, p_);
  const auto write = [&](const BlockKey& key, std::int32_t nth, auto&& afresh) {
    if (const std::int32_t same = before.Find(key, nth); same >= 0) return copies.Add(same);
    copies.Flush();
    block_ = p_.num_blocks();
    p_.Begin(key);
    afresh();
  };
  for (std::size_t a = 0; a < edges_.size(); ++a) {
    write(KeyOf(a), 0, [&] { WriteEdge(a); });
  }
  std::int32_t vertex = -1, nth = 0;
  for (const Transition& t : plan_.all()) {
    if (t.copy != Transition::Copy::kOwn) continue;
    nth = t.vertex == vertex ? nth + 1 : 0;
    vertex = t.vertex;
    write(KeyOf(t), nth, [&] { WriteTransition(t); });
  }
  copies.Flush();
  block_ = -1;
  p_.EndBlocks();
}

// Where each edge's and each transition's variables stand.
void GcsTranscription::PlaceBlocks() {
  std::size_t block = 0;
  for (std::size_t a = 0; a < edges_.size(); ++a) {
    const BlockProgram::Place& at = p_.places[block++];
    edges_[a] = {at.x, at.slack < 0 ? -1 : at.x + at.slack, at.end,
                 at.end + DimensionAt(graph_.tail[a])};
  }
  for (std::size_t k = 0; k < transitions_.size(); ++k) {
    const Transition& t = plan_.all()[k];
    if (t.copy != Transition::Copy::kOwn) continue;
    const std::int32_t lambda = p_.places[block].x;
    transitions_[k] = {lambda, PointAt(t.vertex) ? -1 : lambda + 1,
                       static_cast<std::int32_t>(block++)};
  }
}

// ---- variables ----

std::int32_t GcsTranscription::AddVariables(std::int32_t count) {
  const auto first = static_cast<std::int32_t>(p_.q.size());
  const std::size_t all = p_.q.size() + At(count);
  p_.q.resize(all, 0.0);
  p_.x_lower.resize(all, -kInfinity);
  p_.x_upper.resize(all, kInfinity);
  p_.integer.resize(all, 0);
  p_.block_of_x.resize(all, block_);
  return first;
}

/// Of a transition: columns behind the scale's, a variable for each coordinate that is not idle.
void GcsTranscription::AddPoint(std::int32_t vertex) {
  const SetBox& box = graph_.vertices[At(vertex)]->set().bounding_box();
  for (std::int32_t i = 0; i < DimensionAt(vertex); ++i) {
    if (idle_->At(vertex, At(i))) {
      columns_.push_back(kNone);
      continue;
    }
    const std::int32_t j = AddVariables(1);
    p_.x_lower[At(j)] = std::min(0.0, box.lower[i]);
    p_.x_upper[At(j)] = std::max(0.0, box.upper[i]);
    columns_.push_back({j, 1});
  }
}

void GcsTranscription::AddEnd(std::int32_t vertex, std::int32_t scale,
                              std::span<const FixedCoordinate> fixed,
                              const std::vector<std::uint8_t>& idle) {
  const std::int32_t n = DimensionAt(vertex);
  if (PointAt(vertex)) {
    for (std::int32_t i = 0; i < n; ++i) p_.ends.push_back({scale, (*PointAt(vertex))[i]});
    return;
  }
  const SetBox& box = graph_.vertices[At(vertex)]->set().bounding_box();
  auto next = fixed.begin();
  for (std::int32_t i = 0; i < n; ++i) {
    const bool is_fixed = next != fixed.end() && next->place == i;
    if (is_fixed) ++next;
    if (!idle.empty() && idle[At(i)] != 0) {
      p_.ends.push_back(kNone);
      continue;
    }
    if (is_fixed) {
      p_.ends.push_back({scale, std::prev(next)->value});
      continue;
    }
    const std::int32_t j = AddVariables(1);
    p_.x_lower[At(j)] = std::min(0.0, box.lower[i]);
    p_.x_upper[At(j)] = std::max(0.0, box.upper[i]);
    p_.ends.push_back({j, 1});
  }
}

void GcsTranscription::AddEdgeVariables(std::size_t arc) {
  const GraphOfConvexSets::Edge& edge = *graph_.edges[arc];
  EdgeVariables& at = edges_[arc];
  at.phi = AddVariables(1);
  p_.x_lower[At(at.phi)] = edge.phi_value() == true ? 1 : 0;
  p_.x_upper[At(at.phi)] = 1;
  p_.integer[At(at.phi)] = 1;
  const std::vector<FixedCoordinate>& fixed = *FixedOf(arc);
  const std::int32_t of_u = DimensionAt(graph_.tail[arc]);
  const auto of_v = std::find_if(fixed.begin(), fixed.end(),
                                 [&](const FixedCoordinate& c) { return c.place >= of_u; });
  std::vector<FixedCoordinate> at_v(of_v, fixed.end());
  for (FixedCoordinate& c : at_v) c.place -= of_u;
  at.tail = static_cast<std::int32_t>(p_.ends.size());
  AddEnd(graph_.tail[arc], at.phi, {fixed.begin(), of_v}, {});
  at.head = static_cast<std::int32_t>(p_.ends.size());
  AddEnd(graph_.head[arc], at.phi, at_v, MissingAt(arc));
  if (edge.slacks().size() == 0) return;
  at.slack = AddVariables(static_cast<std::int32_t>(edge.slacks().size()));
  p_.places.back().slack = at.slack - at.phi;
}

std::span<const Column> GcsTranscription::Tail(std::size_t arc) const {
  return std::span(p_.ends).subspan(At(edges_[arc].tail), At(DimensionAt(graph_.tail[arc])));
}

std::span<const Column> GcsTranscription::Head(std::size_t arc) const {
  return std::span(p_.ends).subspan(At(edges_[arc].head), At(DimensionAt(graph_.head[arc])));
}

Column GcsTranscription::CopyOf(const Transition& t, std::size_t k, std::int32_t i) const {
  switch (t.copy) {
    case Transition::Copy::kOut:
      return Tail(At(t.out))[At(i)];
    case Transition::Copy::kIn:
      return Head(At(t.in))[At(i)];
    default:
      if (PointAt(t.vertex)) return {transitions_[k].lambda, (*PointAt(t.vertex))[i]};
      std::int32_t place = i;
      for (std::int32_t before = 0; before < i; ++before) {
        if (idle_->At(t.vertex, At(before))) --place;
      }
      return {transitions_[k].w + place, 1};
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
  AddEdgeVariables(arc);
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
  } else if (!PointAt(u) && !idle_->At(u).empty()) {
    columns_.assign(1, {at.phi, 1});
    place(Tail(arc));
    WriteBlock(written_.blocks.Split(*graph_.vertices[At(u)], idle_->At(u)).idle);
  }
  if (plan_.OwnsHead(arc)) {
    columns_.assign(1, {at.phi, 1});
    place(Head(arc));
    const VertexBlocks& of = blocks_of_vertex_[At(v)];
    if (!PointAt(v)) WriteBlock(KeptSet(v));
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

void GcsTranscription::WriteTransition(const Transition& t) {
  const std::int32_t lambda = AddVariables(1);
  p_.x_lower[At(lambda)] = 0;
  p_.x_upper[At(lambda)] = 1;
  columns_.assign(1, {lambda, 1});
  const VertexBlocks& of = blocks_of_vertex_[At(t.vertex)];
  if (PointAt(t.vertex)) {
    for (const double value : *PointAt(t.vertex)) columns_.push_back({lambda, value});
  } else {
    AddPoint(t.vertex);
    WriteBlock(KeptSet(t.vertex));
  }
  WriteBlock(*of.terms);
  WriteSquares(lambda);
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

// Over the places as they are filled.
void GcsTranscription::WriteBlock(const TermBlock& block) {
  const std::int32_t own = block.num_own > 0 ? AddVariables(block.num_own) : 0;
  std::copy(block.own_lower.begin(), block.own_lower.end(), p_.x_lower.begin() + own);
  std::copy(block.own_upper.begin(), block.own_upper.end(), p_.x_upper.begin() + own);
  for (std::size_t j = 0; j < block.cost.size(); ++j) {
    if (block.cost[j] == 0) continue;
    const auto place = static_cast<std::int32_t>(j);
    const Column column =
        place < block.num_places ? columns_[j] : Column{own + place - block.num_places, 1};
    p_.q[At(column.variable)] += block.cost[j] * column.factor;
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
      p_.A.Add(j, value);
      size = std::max(size, std::abs(value));
    });
    const auto columns = p_.A.Columns();
    if (columns.empty() || (columns.size() == 1 && columns[0] == scale)) {
      const double value = columns.empty() ? 0 : p_.A.Values()[0];
      const bool holds = (block.upper[i] == kInfinity || value <= kRounding * size) &&
                         (block.lower[i] == -kInfinity || value >= -kRounding * size);
      if (holds) {
        DropRow();
        continue;
      }
    }
    p_.block_of_row.push_back(block_);
  }
}

void GcsTranscription::WriteCones(const TermBlock& block, std::int32_t own) {
  std::size_t row = 0;
  for (const sy_cone& cone : block.cones) {
    for (std::int32_t i = 0; i < cone.dim; ++i, ++row) {
      p_.F.Begin();
      EachEntry(block.cone_rows, row, block, own,
                [&](std::int32_t j, double value) { p_.F.Add(j, value); });
    }
    p_.cones.push_back(cone);
    p_.block_of_cone.push_back(block_);
  }
}

// 2 t l >= |S_1 x_1|^2 + |S_2 x_2|^2 + ... : one cone for all squares of a block.
void GcsTranscription::WriteSquares(std::int32_t scale) {
  if (square_end_.empty()) return;
  const std::int32_t epigraph = AddVariables(1);
  p_.q[At(epigraph)] = 1;
  p_.F.Begin();
  p_.F.Add(scale, 1);
  p_.F.Begin();
  p_.F.Add(epigraph, 1);
  std::size_t next = 0;
  for (const std::size_t end : square_end_) {
    p_.F.Begin();
    for (; next < end; ++next) p_.F.Add(squares_[next].variable, squares_[next].factor);
  }
  p_.cones.push_back({SY_CONE_ROTATED, 2 + static_cast<std::int32_t>(square_end_.size()), 0});
  p_.block_of_cone.push_back(block_);
  squares_.clear();
  square_end_.clear();
}

// ---- coupling ----

void GcsTranscription::BeginRow(double lower, double upper) {
  p_.row_lower.push_back(lower);
  p_.row_upper.push_back(upper);
  p_.A.Begin();
}

void GcsTranscription::DropRow() {
  p_.row_lower.pop_back();
  p_.row_upper.pop_back();
  p_.A.Drop();
}

void GcsTranscription::WriteCoupling() {
  const Leaving& out = out_.emplace(graph_.arcs());
  const Leaving in(Reversed(graph_.arcs()));
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(graph_.vertices.size()); ++v) {
    if (out.Of(v).empty() && in.Of(v).empty()) continue;
    if (plan_.At(v)) {
      WriteTransitionFlow(v, in.Of(v), out.Of(v));
    } else {
      WriteFlow(v, in.Of(v), out.Of(v));
    }
    if (v == graph_.source || v == graph_.target) continue;
    BeginRow(-kInfinity, 1);
    for (const std::int32_t a : out.Of(v)) p_.A.Add(edges_[At(a)].phi, 1);
  }
  p_.block_of_row.resize(p_.row_lower.size(), -1);
}

// Of flow and, between arcs in and out, of points; a point's spatial rows follow from its flow.
void GcsTranscription::WriteFlow(std::int32_t vertex, std::span<const std::int32_t> in,
                                 std::span<const std::int32_t> out) {
  const double net = vertex == graph_.source ? 1 : vertex == graph_.target ? -1 : 0;
  BeginRow(net, net);
  for (const std::int32_t a : out) p_.A.Add(edges_[At(a)].phi, 1);
  for (const std::int32_t a : in) p_.A.Add(edges_[At(a)].phi, -1);
  if (net != 0 || PointAt(vertex)) return;
  for (std::size_t i = 0; i < At(DimensionAt(vertex)); ++i) {
    if (idle_->At(vertex, i)) continue;
    BeginRow(0, 0);
    for (const std::int32_t a : out) {
      p_.A.Add(Tail(At(a))[i].variable, Tail(At(a))[i].factor);
    }
    for (const std::int32_t a : in) p_.A.Add(Head(At(a))[i].variable, -Head(At(a))[i].factor);
  }
}

void GcsTranscription::WriteTransitionFlow(std::int32_t vertex, std::span<const std::int32_t> in,
                                           std::span<const std::int32_t> out) {
  const bool is_point = PointAt(vertex).has_value();
  for (const std::int32_t a : in) {
    if (plan_.OwnsHead(At(a))) continue;
    WriteSum(plan_.From(At(a)), edges_[At(a)].phi,
             is_point ? std::span<const Column>() : Head(At(a)), idle_->Unread(vertex));
  }
  for (const std::int32_t a : out) {
    if (plan_.OwnsTail(At(a))) continue;
    WriteSum(plan_.To(At(a)), edges_[At(a)].phi, is_point ? std::span<const Column>() : Tail(At(a)),
             idle_->At(vertex));
  }
}

// An arc's flow and the point at its end as the sum of transitions'.
void GcsTranscription::WriteSum(std::span<const std::int32_t> transitions, std::int32_t flow,
                                std::span<const Column> end,
                                const std::vector<std::uint8_t>& missing) {
  BeginRow(0, 0);
  for (const std::int32_t k : transitions) p_.A.Add(ScaleOf(plan_.all()[At(k)], At(k)), 1);
  p_.A.Add(flow, -1);
  for (std::size_t i = 0; i < end.size(); ++i) {
    if (!missing.empty() && missing[i] != 0) continue;
    BeginRow(0, 0);
    for (const std::int32_t k : transitions) {
      const Column copy = CopyOf(plan_.all()[At(k)], At(k), static_cast<std::int32_t>(i));
      p_.A.Add(copy.variable, copy.factor);
    }
    p_.A.Add(end[i].variable, -end[i].factor);
  }
}

void GcsTranscription::Finish() {
  problem_.Change([&](ProblemData& d) {
    d.flags = SY_PROBLEM_CONVEX;
    d.num_vars = static_cast<std::int32_t>(p_.q.size());
    d.P = Csc(d.num_vars, d.num_vars);
    p_.A.WriteByColumns(d.num_vars, d.A);
    p_.F.WriteByColumns(d.num_vars, d.F);
    d.g.assign(At(p_.F.rows()), 0.0);
    written_.SwapLists(d);
  });
}

}  // namespace switchyard
