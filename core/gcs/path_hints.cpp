// What a transcription says of its own structure.
#include <algorithm>

#include "core/gcs/transcription.hpp"

namespace switchyard {
namespace {

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

}  // namespace

std::vector<Column> GcsTranscription::PartsOf(std::size_t arc, std::int32_t coordinate) const {
  std::vector<Column> parts;
  if (idle_->At(graph_.head[arc], At(coordinate))) return parts;
  for (const std::int32_t k : plan_.From(arc)) {
    parts.push_back(CopyOf(plan_.all()[At(k)], At(k), coordinate));
  }
  std::sort(parts.begin(), parts.end(),
            [](const Column& a, const Column& b) { return a.variable < b.variable; });
  return parts;
}

/// A column for each coordinate of each arc's tail, or head; empty where it is idle.
void GcsTranscription::WritePoints(bool tails, Csc& matrix, sy_csc& view) const {
  matrix.rows = problem_.data().num_vars;
  matrix.start.assign(1, 0);
  matrix.row.clear();
  matrix.value.clear();
  const auto add = [&](const Column& column) {
    matrix.row.push_back(column.variable);
    matrix.value.push_back(column.factor);
  };
  for (std::size_t a = 0; a < edges_.size(); ++a) {
    std::int32_t coordinate = 0;
    for (const Column& column : tails ? Tail(a) : Head(a)) {
      if (column.variable >= 0) {
        add(column);
      } else {
        for (const Column& part : PartsOf(a, coordinate)) add(part);
      }
      ++coordinate;
      matrix.start.push_back(static_cast<std::int32_t>(matrix.row.size()));
    }
  }
  matrix.cols = static_cast<std::int32_t>(matrix.start.size()) - 1;
  view = matrix.View();
}

Eigen::VectorXd GcsTranscription::TailOf(std::size_t arc, const std::vector<double>& x) const {
  return ValueOf(Tail(arc), x);
}

Eigen::VectorXd GcsTranscription::HeadOf(std::size_t arc, const std::vector<double>& x) const {
  const std::int32_t v = graph_.head[arc];
  Eigen::VectorXd head = ValueOf(Head(arc), x);
  const std::vector<std::uint8_t>& missing = MissingAt(arc);
  if (missing.empty()) return head;
  double flow = 0;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(head.size());
  for (const std::int32_t a : out_->Of(v)) {
    flow += x[At(edges_[At(a)].phi)];
    sum += TailOf(At(a), x);
  }
  const double share = flow > 0 ? x[At(edges_[arc].phi)] / flow : 0;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(head.size()); ++i) {
    if (missing[At(i)] == 0) continue;
    head[i] = idle_->At(v, At(i)) ? share * sum[i] : ValueOf(PartsOf(arc, i), x).sum();
  }
  return head;
}

Eigen::VectorXd GcsTranscription::ValueOf(std::span<const Column> end,
                                          const std::vector<double>& x) {
  Eigen::VectorXd value(static_cast<Eigen::Index>(end.size()));
  for (std::size_t i = 0; i < end.size(); ++i) {
    const Column& column = end[i];
    value[static_cast<Eigen::Index>(i)] =
        column.variable < 0 ? 0 : column.factor * x[At(column.variable)];
  }
  return value;
}

double GcsTranscription::CostOf(const std::vector<std::int32_t>& arcs,
                                const std::vector<double>& x) const {
  std::vector<std::uint8_t> among(edges_.size(), 0);
  for (const std::int32_t a : arcs) among[At(a)] = 1;
  double cost = 0;
  for (std::size_t j = 0; j < p_.block_of_x.size(); ++j) {
    const std::int32_t block = p_.block_of_x[j];
    const bool counts = block >= 0 && among[At(lists_.arc_in[At(block)])] != 0 &&
                        among[At(lists_.arc_out[At(block)])] != 0;
    if (counts) cost += problem_.data().q[j] * x[j];
  }
  return cost;
}

void GcsTranscription::WriteHints() {
  const auto count = static_cast<std::int32_t>(edges_.size());
  lists_.Clear();
  for (std::int32_t a = 0; a < count; ++a) {
    lists_.flow.push_back(edges_[At(a)].phi);
    lists_.arc_in.push_back(a);
  }
  lists_.scale = lists_.flow;
  lists_.arc_out = lists_.arc_in;
  for (std::size_t k = 0; k < transitions_.size(); ++k) {
    if (transitions_[k].block < 0) continue;
    lists_.scale.push_back(transitions_[k].lambda);
    lists_.arc_in.push_back(plan_.all()[k].in);
    lists_.arc_out.push_back(plan_.all()[k].out);
  }
  for (const GraphOfConvexSets::Vertex* v : graph_.vertices) {
    lists_.dim.push_back(v->ambient_dimension());
    lists_.sets.push_back(nullptr);
  }
  for (std::size_t a = 0; a < edges_.size(); ++a) {
    for (const std::int32_t v : {graph_.tail[a], graph_.head[a]}) {
      if (lists_.sets[At(v)] == nullptr)
        lists_.sets[At(v)] = written_.sets.Of(graph_.vertices[At(v)]->set());
    }
  }
  WritePoints(true, lists_.tail_point, paths_.tail_point);
  WritePoints(false, lists_.head_point, paths_.head_point);
  blocks_ = {sizeof blocks_,         p_.num_blocks(),         p_.block_of_x.data(),
             p_.block_of_row.data(), p_.block_of_cone.data(), nullptr};
  paths_.size = sizeof paths_;
  paths_.num_vertices = static_cast<std::int32_t>(graph_.vertices.size());
  paths_.num_arcs = count;
  paths_.source = graph_.source;
  paths_.target = graph_.target;
  paths_.tail = graph_.tail.data();
  paths_.head = graph_.head.data();
  paths_.flow = lists_.flow.data();
  paths_.scale = lists_.scale.data();
  paths_.arc_in = lists_.arc_in.data();
  paths_.arc_out = lists_.arc_out.data();
  paths_.dim = lists_.dim.data();
  paths_.set = lists_.sets.data();
  hints_ = {{"sy.blocks/1", &blocks_}, {"sy.paths/1", &paths_}, {nullptr, nullptr}};
  problem_.Change([this](ProblemData& d) { d.hints = hints_.data(); });
}

}  // namespace switchyard
