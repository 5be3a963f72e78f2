#include "core/gcs/transcription.hpp"

#include <algorithm>

#include "switchyard/error.hpp"

namespace switchyard {
namespace {

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

}  // namespace

GcsTranscription::GcsTranscription(const PrunedGraph& graph, Transcription as)
    : graph_(graph), as_(as), edges_(graph.edges.size()) {
  builder_.flags = SY_PROBLEM_CONVEX;
  for (std::size_t arc = 0; arc < edges_.size(); ++arc) WriteEdge(arc);
  block_ = -1;
  WriteCoupling();
  CloseBlock();
  problem_ = Problem(builder_.FinishOnce());
  WriteHints();
}

// What was added since the last block belongs to this one.
void GcsTranscription::CloseBlock() {
  block_of_x_.resize(builder_.q.size(), block_);
  block_of_row_.resize(builder_.row_lower.size(), block_);
  block_of_cone_.resize(builder_.cones.size(), block_);
}

void GcsTranscription::WriteEdge(std::size_t arc) {
  const GraphOfConvexSets::Edge& edge = *graph_.edges[arc];
  block_ = static_cast<std::int32_t>(arc);
  AddEdgeVariables(arc);
  const EdgeVariables& at = edges_[arc];
  if (at.y >= 0) WriteMembership(edge.u().set(), at.phi, at.y);
  if (at.z >= 0) WriteMembership(edge.v().set(), at.phi, at.z);
  squares_.clear();
  square_columns_.clear();
  const bool ends = graph_.head[arc] == graph_.target;
  WriteTerms(edge, edge.costs(), arc);
  WriteTerms(edge.u(), edge.u().costs(), arc);
  if (ends) WriteTerms(edge.v(), edge.v().costs(), arc);
  WriteTerms(edge, edge.constraints(), arc);
  WriteTerms(edge.u(), edge.u().constraints(), arc);
  if (ends) WriteTerms(edge.v(), edge.v().constraints(), arc);
  WriteSquares(at.phi);
  CloseBlock();
}

void GcsTranscription::AddEdgeVariables(std::size_t arc) {
  const GraphOfConvexSets::Edge& edge = *graph_.edges[arc];
  EdgeVariables& at = edges_[arc];
  at.phi = builder_.AddVariables(1);
  builder_.x_lower[At(at.phi)] = edge.phi_value() == true ? 1 : 0;
  builder_.x_upper[At(at.phi)] = 1;
  builder_.integer[At(at.phi)] = 1;
  at.y = AddPoint(edge.u().set());
  at.z = AddPoint(edge.v().set());
  if (edge.slacks().size() > 0) {
    at.slack = builder_.AddVariables(static_cast<std::int32_t>(edge.slacks().size()));
  }
}

std::int32_t GcsTranscription::AddPoint(const ConvexSet& set) {
  if (set.MaybeGetPoint().has_value()) return -1;
  const SetBox& box = set.bounding_box();
  const std::int32_t first = builder_.AddVariables(set.ambient_dimension());
  for (int i = 0; i < set.ambient_dimension(); ++i) {
    builder_.x_lower[At(first + i)] = std::min(0.0, box.lower[i]);
    builder_.x_upper[At(first + i)] = std::max(0.0, box.upper[i]);
  }
  return first;
}

void GcsTranscription::WriteMembership(const ConvexSet& set, std::int32_t phi, std::int32_t first) {
  const ScaledSet& scaled = set.scaled();
  columns_.assign(1, {phi, 1});
  for (std::int32_t i = 0; i < scaled.dim; ++i) columns_.push_back({first + i, 1});
  const std::int32_t aux = scaled.num_aux > 0 ? builder_.AddVariables(scaled.num_aux) : 0;
  for (std::int32_t i = 0; i < scaled.num_aux; ++i) columns_.push_back({aux + i, 1});
  WriteCone(scaled);
}

/// Those that count in this transcription.
template <class Owner, class Terms>
void GcsTranscription::WriteTerms(const Owner& owner, const Terms& terms, std::size_t arc) {
  const auto perspective_of = [&](const auto& evaluator) -> const Perspective& {
    try {
      return perspectives_.Of(evaluator);
    } catch (const InvalidArgument& why) {
      Refuse("at ", owner.name(), ": ", why.what(),
             "; a term for the restriction alone may be any");
    }
  };
  for (const auto& term : terms) {
    if (!term.in.contains(as_)) continue;
    WriteTerm(perspective_of(term.binding.evaluator()), term.binding.variables(), arc);
  }
}

GcsTranscription::Column GcsTranscription::ColumnOf(Variable variable, std::size_t arc) const {
  const GraphOfConvexSets::Edge& edge = *graph_.edges[arc];
  const EdgeVariables& at = edges_[arc];
  const auto among = [&](const VectorXDecisionVariable& x) {
    const Variable::Id offset = x.size() > 0 ? variable.get_id() - x[0].get_id() : -1;
    return offset >= 0 && offset < x.size() ? static_cast<std::int32_t>(offset) : -1;
  };
  const auto of_end = [&](const GraphOfConvexSets::Vertex& v, std::int32_t first,
                          std::int32_t i) -> Column {
    if (first >= 0) return {first + i, 1};
    return {at.phi, (*v.set().MaybeGetPoint())[i]};
  };
  if (const std::int32_t i = among(edge.xu()); i >= 0) return of_end(edge.u(), at.y, i);
  if (const std::int32_t i = among(edge.xv()); i >= 0) return of_end(edge.v(), at.z, i);
  for (Eigen::Index i = 0; i < edge.slacks().size(); ++i) {
    if (edge.slacks()[i] == variable) return {at.slack + static_cast<std::int32_t>(i), 1};
  }
  return {at.phi, 1};  // AddCost and AddConstraint let nothing else in
}

void GcsTranscription::WriteTerm(const Perspective& term, const VectorXDecisionVariable& variables,
                                 std::size_t arc) {
  columns_.assign(1, {edges_[arc].phi, 1});
  for (const Variable v : variables) columns_.push_back(ColumnOf(v, arc));
  if (term.S.rows > 0) {
    squares_.push_back({&term.S, square_columns_.size()});
    square_columns_.insert(square_columns_.end(), columns_.begin() + 1, columns_.end());
  }
  const std::int32_t aux = term.cone.num_aux > 0 ? builder_.AddVariables(term.cone.num_aux) : 0;
  for (std::int32_t i = 0; i < term.cone.num_aux; ++i) columns_.push_back({aux + i, 1});
  for (std::size_t j = 0; j < term.cost.size(); ++j) {
    builder_.q[At(columns_[j].variable)] += term.cost[j] * columns_[j].factor;
  }
  WriteCone(term.cone);
}

/// The rows and cones with columns_ for (t, x, w).
void GcsTranscription::WriteCone(const ScaledSet& cone) {
  if (cone.A.rows > 0) {
    const std::int32_t row = builder_.AddRows(cone.A.rows);
    std::copy(cone.lower.begin(), cone.lower.end(), builder_.row_lower.begin() + row);
    std::copy(cone.upper.begin(), cone.upper.end(), builder_.row_upper.begin() + row);
    for (std::size_t j = 0; j < columns_.size(); ++j) {
      for (auto k = At(cone.A.start[j]); k < At(cone.A.start[j + 1]); ++k) {
        const double value = cone.A.value[k] * columns_[j].factor;
        if (value != 0) builder_.A.Add(row + cone.A.row[k], columns_[j].variable, value);
      }
    }
  }
  if (cone.cones.empty()) return;
  const auto row = static_cast<std::int32_t>(builder_.g.size());
  for (const sy_cone& one : cone.cones) builder_.AddCone(one);
  for (std::size_t j = 0; j < columns_.size(); ++j) {
    for (auto k = At(cone.F.start[j]); k < At(cone.F.start[j + 1]); ++k) {
      const double value = cone.F.value[k] * columns_[j].factor;
      if (value != 0) builder_.F.Add(row + cone.F.row[k], columns_[j].variable, value);
    }
  }
}

// 2 phi l >= |S_1 x_1|^2 + |S_2 x_2|^2 + ... : one cone for all squares of an edge.
void GcsTranscription::WriteSquares(std::int32_t phi) {
  if (squares_.empty()) return;
  std::int32_t rows = 2;
  for (const Square& square : squares_) rows += square.S->rows;
  const std::int32_t epigraph = builder_.AddVariables(1);
  builder_.q[At(epigraph)] = 1;
  const std::int32_t first = builder_.AddCone({SY_CONE_ROTATED, rows, 0});
  builder_.F.Add(first, phi, 1);
  builder_.F.Add(first + 1, epigraph, 1);
  std::int32_t row = first + 2;
  for (const Square& square : squares_) {
    const Csc& S = *square.S;
    for (std::size_t j = 0; j < At(S.cols); ++j) {
      const Column& column = square_columns_[square.first + j];
      for (auto k = At(S.start[j]); k < At(S.start[j + 1]); ++k) {
        const double value = S.value[k] * column.factor;
        if (value != 0) builder_.F.Add(row + S.row[k], column.variable, value);
      }
    }
    row += S.rows;
  }
}

// Flow, degree and spatial rows. A vertex without edges has none; a point's spatial rows follow
// from its flow.
void GcsTranscription::WriteCoupling() {
  const std::size_t count = graph_.vertices.size();
  std::vector<std::int32_t> degree(count, 0), flow(count, -1), most(count, -1), spatial(count, -1);
  for (std::size_t a = 0; a < edges_.size(); ++a) {
    ++degree[At(graph_.tail[a])];
    ++degree[At(graph_.head[a])];
  }
  for (std::size_t v = 0; v < count; ++v) {
    if (degree[v] == 0) continue;
    const bool source = static_cast<std::int32_t>(v) == graph_.source;
    const bool target = static_cast<std::int32_t>(v) == graph_.target;
    flow[v] = builder_.AddRows(1);
    const double net = source ? 1 : target ? -1 : 0;
    builder_.row_lower[At(flow[v])] = builder_.row_upper[At(flow[v])] = net;
    if (source || target) continue;
    most[v] = builder_.AddRows(1);
    builder_.row_upper[At(most[v])] = 1;
    const ConvexSet& set = graph_.vertices[v]->set();
    if (set.MaybeGetPoint().has_value() || set.ambient_dimension() == 0) continue;
    spatial[v] = builder_.AddRows(set.ambient_dimension());
    for (std::int32_t i = 0; i < set.ambient_dimension(); ++i) {
      builder_.row_lower[At(spatial[v] + i)] = builder_.row_upper[At(spatial[v] + i)] = 0;
    }
  }
  for (std::size_t a = 0; a < edges_.size(); ++a) {
    const auto u = At(graph_.tail[a]);
    const auto v = At(graph_.head[a]);
    builder_.A.Add(flow[u], edges_[a].phi, 1);
    builder_.A.Add(flow[v], edges_[a].phi, -1);
    if (most[u] >= 0) builder_.A.Add(most[u], edges_[a].phi, 1);
    const auto points = [&](std::int32_t first_row, const ConvexSet& set, std::int32_t first,
                            double sign) {
      for (std::int32_t i = 0; first_row >= 0 && i < set.ambient_dimension(); ++i) {
        builder_.A.Add(first_row + i, first + i, sign);
      }
    };
    points(spatial[u], graph_.vertices[u]->set(), edges_[a].y, 1);
    points(spatial[v], graph_.vertices[v]->set(), edges_[a].z, -1);
  }
}

const sy_set* GcsTranscription::RecordOf(const ConvexSet& set) {
  const auto [place, fresh] = record_of_.try_emplace(&set, nullptr);
  if (!fresh) return place->second;
  const ScaledSet& scaled = set.scaled();
  SetRecord& r = records_.emplace_back();
  r.At = Transpose(scaled.A.View());
  r.Ft = Transpose(scaled.F.View());
  r.at = r.At.View();
  r.ft = r.Ft.View();
  r.record = {};
  r.record.size = sizeof r.record;
  r.record.dim = scaled.dim;
  r.record.num_aux = scaled.num_aux;
  r.record.num_rows = scaled.A.rows;
  r.record.num_cones = static_cast<std::int32_t>(scaled.cones.size());
  r.record.num_cone_rows = scaled.F.rows;
  r.record.At = &r.at;
  r.record.row_lower = scaled.lower.data();
  r.record.row_upper = scaled.upper.data();
  r.record.Ft = &r.ft;
  r.record.cones = scaled.cones.data();
  return place->second = &r.record;
}

/// A column for each coordinate of each arc's tail, or head: the variable, or phi times the point.
void GcsTranscription::WritePoints(bool tails, Csc& matrix, sy_csc& view) {
  matrix = Csc(problem_.data().num_vars, 0);
  for (std::size_t a = 0; a < edges_.size(); ++a) {
    const GraphOfConvexSets::Edge& edge = *graph_.edges[a];
    const ConvexSet& set = (tails ? edge.u() : edge.v()).set();
    const std::int32_t first = tails ? edges_[a].y : edges_[a].z;
    const std::optional<Eigen::VectorXd> point = set.MaybeGetPoint();
    for (std::int32_t i = 0; i < set.ambient_dimension(); ++i) {
      matrix.row.push_back(first >= 0 ? first + i : edges_[a].phi);
      matrix.value.push_back(first >= 0 ? 1 : (*point)[i]);
      matrix.start.push_back(static_cast<std::int32_t>(matrix.row.size()));
    }
  }
  matrix.cols = static_cast<std::int32_t>(matrix.start.size()) - 1;
  view = matrix.View();
}

void GcsTranscription::WriteHints() {
  const auto count = static_cast<std::int32_t>(edges_.size());
  for (const EdgeVariables& edge : edges_) flow_.push_back(edge.phi);
  arcs_.resize(edges_.size());
  for (std::int32_t a = 0; a < count; ++a) arcs_[At(a)] = a;
  for (const GraphOfConvexSets::Vertex* v : graph_.vertices) {
    dim_.push_back(v->ambient_dimension());
    sets_.push_back(nullptr);
  }
  for (std::size_t a = 0; a < edges_.size(); ++a) {
    for (const std::int32_t v : {graph_.tail[a], graph_.head[a]}) {
      if (sets_[At(v)] == nullptr) sets_[At(v)] = RecordOf(graph_.vertices[At(v)]->set());
    }
  }
  WritePoints(true, tail_point_, paths_.tail_point);
  WritePoints(false, head_point_, paths_.head_point);
  blocks_ = {sizeof blocks_,        count,  block_of_x_.data(), block_of_row_.data(),
             block_of_cone_.data(), nullptr};
  paths_.size = sizeof paths_;
  paths_.num_vertices = static_cast<std::int32_t>(graph_.vertices.size());
  paths_.num_arcs = count;
  paths_.source = graph_.source;
  paths_.target = graph_.target;
  paths_.tail = graph_.tail.data();
  paths_.head = graph_.head.data();
  paths_.flow = paths_.scale = flow_.data();
  paths_.arc_in = paths_.arc_out = arcs_.data();
  paths_.dim = dim_.data();
  paths_.set = sets_.data();
  hints_ = {{"sy.blocks/1", &blocks_}, {"sy.paths/1", &paths_}, {nullptr, nullptr}};
  problem_.Change([this](ProblemData& d) { d.hints = hints_.data(); });
}

}  // namespace switchyard
