#include "tests/solvers/grid_graph.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "core/host/instance.hpp"
#include "solvers/rounding/relax_and_round.hpp"
#include "switchyard/plugin.hpp"

namespace switchyard::test {
namespace {

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

void Extend(const Arcs& arcs, const Leaving& out, std::int32_t u, std::int32_t target,
            std::vector<std::uint8_t>& visited, std::vector<std::int32_t>& path,
            std::vector<std::vector<std::int32_t>>& all) {
  if (u == target) {
    all.push_back(path);
    return;
  }
  visited[At(u)] = 1;
  for (const std::int32_t a : out.Of(u)) {
    if (visited[At(arcs.head[At(a)])] != 0) continue;
    path.push_back(a);
    Extend(arcs, out, arcs.head[At(a)], target, visited, path, all);
    path.pop_back();
  }
  visited[At(u)] = 0;
}

}  // namespace

void GridGraph::Triplets::Add(std::int32_t row, std::int32_t column, double value) {
  if (columns.size() <= At(column)) columns.resize(At(column) + 1);
  columns[At(column)].emplace_back(row, value);
}

Csc GridGraph::Triplets::Matrix(std::int32_t rows) const {
  Csc matrix(rows, static_cast<std::int32_t>(columns.size()));
  for (std::size_t j = 0; j < columns.size(); ++j) {
    auto column = columns[j];
    std::sort(column.begin(), column.end());
    for (const auto& [row, value] : column) {
      matrix.row.push_back(row);
      matrix.value.push_back(value);
    }
    matrix.start[j + 1] = static_cast<std::int32_t>(matrix.row.size());
  }
  return matrix;
}

GridGraph::GridGraph(int width, int height, EdgeCost cost, std::uint64_t seed) {
  Random random(seed);
  num_vertices_ = width * height;
  std::vector<Box> boxes;
  for (int v = 0; v < num_vertices_; ++v) {
    Box box{};
    const double corner[] = {double(v % width), double(v / width)};
    for (int k = 0; k < 2; ++k) {
      box.lower[k] = corner[k] + 0.4 * random.Uniform();
      box.upper[k] = box.lower[k] + 0.5 * random.Uniform();
      if (v == 0 || v == num_vertices_ - 1) box.upper[k] = box.lower[k];
    }
    boxes.push_back(box);
  }
  DrawArcs(width, height, random);
  AddVariables(cost, boxes, random);
  AddCouplingRows();
  for (std::int32_t a = 0; a < static_cast<std::int32_t>(tail_.size()); ++a) {
    AddBlock(a, cost, boxes);
  }
  Seal();
}

void GridGraph::DrawArcs(int width, int height, Random& random) {
  std::vector<std::int32_t> tail, head;
  const auto both = [&](int u, int v) {
    if (random.Uniform() < 0.1) return;
    tail.insert(tail.end(), {u, v});
    head.insert(head.end(), {v, u});
  };
  for (int v = 0; v < width * height; ++v) {
    if (v % width + 1 < width) both(v, v + 1);
    if (v / width + 1 < height) both(v, v + width);
  }
  const auto keep = UsefulArcs({num_vertices_, tail, head}, source(), target());
  tail_ = Keep(tail, keep);
  head_ = Keep(head, keep);
}

std::int32_t GridGraph::AddVariable(std::int32_t block, double lower, double upper, double q) {
  block_of_x_.push_back(block);
  data_.x_lower.push_back(lower);
  data_.x_upper.push_back(upper);
  data_.q.push_back(q);
  data_.integer.push_back(0);
  return data_.num_vars++;
}

std::int32_t GridGraph::AddRow(std::int32_t block, double lower, double upper) {
  block_of_row_.push_back(block);
  data_.row_lower.push_back(lower);
  data_.row_upper.push_back(upper);
  return data_.num_rows() - 1;
}

std::int32_t GridGraph::AddCone(std::int32_t block, sy_cone_kind kind, std::int32_t dim) {
  block_of_cone_.push_back(block);
  data_.cones.push_back({kind, dim, 0});
  const auto first = static_cast<std::int32_t>(data_.g.size());
  data_.g.insert(data_.g.end(), At(dim), 0.0);
  return first;
}

void GridGraph::AddVariables(EdgeCost cost, const std::vector<Box>& boxes, Random& random) {
  const int epigraphs[] = {0, 2, 1, 1, 1};
  for (std::int32_t a = 0; a < static_cast<std::int32_t>(tail_.size()); ++a) {
    const bool linear = cost == EdgeCost::kLinear;
    first_.push_back(AddVariable(a, 0, 1, linear ? 1 + random.Uniform() : 0.1));
    data_.integer.back() = 1;
    for (const std::int32_t v : {tail_[At(a)], head_[At(a)]}) {
      for (int k = 0; k < 2; ++k) {
        const Box& box = boxes[At(v)];
        AddVariable(a, std::min(0.0, box.lower[k]), std::max(0.0, box.upper[k]),
                    linear ? random.Uniform() - 0.3 : 0);
      }
    }
    for (int k = 0; k < epigraphs[static_cast<int>(cost)]; ++k) {
      AddVariable(a, -kInfinity, kInfinity, 0.7 + random.Uniform());
    }
  }
}

void GridGraph::AddCouplingRows() {
  const Leaving out(arcs()), in(Reversed(arcs()));
  for (std::int32_t v = 0; v < num_vertices_; ++v) {
    if (out.Of(v).empty() && in.Of(v).empty()) continue;
    const double side = (v == source() ? 1 : 0) - (v == target() ? 1 : 0);
    const std::int32_t flow = AddRow(-1, side, side);
    const std::int32_t degree = AddRow(-1, -kInfinity, v == target() ? 0 : 1);
    for (const std::int32_t a : out.Of(v)) a_.Add(flow, first_[At(a)], 1);
    for (const std::int32_t a : out.Of(v)) a_.Add(degree, first_[At(a)], 1);
    for (const std::int32_t a : in.Of(v)) a_.Add(flow, first_[At(a)], -1);
    for (int k = 0; k < 2 && v != source() && v != target(); ++k) {
      const std::int32_t row = AddRow(-1, 0, 0);
      for (const std::int32_t a : out.Of(v)) a_.Add(row, first_[At(a)] + 1 + k, 1);
      for (const std::int32_t a : in.Of(v)) a_.Add(row, first_[At(a)] + 3 + k, -1);
    }
  }
}

void GridGraph::AddBlock(std::int32_t arc, EdgeCost cost, const std::vector<Box>& boxes) {
  const std::int32_t phi = first_[At(arc)];
  for (int end = 0; end < 2; ++end) {
    const Box& box = boxes[At(end == 0 ? tail_[At(arc)] : head_[At(arc)])];
    for (int k = 0; k < 2; ++k) {
      const std::int32_t x = phi + 1 + 2 * end + k;
      const std::int32_t below = AddRow(arc, 0, kInfinity), above = AddRow(arc, -kInfinity, 0);
      a_.Add(below, x, 1);
      a_.Add(below, phi, -box.lower[k]);
      a_.Add(above, x, 1);
      a_.Add(above, phi, -box.upper[k]);
    }
  }
  AddCost(arc, cost);
}

void GridGraph::AddCost(std::int32_t arc, EdgeCost cost) {
  const std::int32_t phi = first_[At(arc)], y = phi + 1, z = phi + 3, t = phi + 5;
  const bool one = cost == EdgeCost::kOneNorm;
  if (one || cost == EdgeCost::kInfinityNorm) {
    for (int k = 0; k < 2; ++k) {
      for (const double sign : {1.0, -1.0}) {
        const std::int32_t row = AddRow(arc, 0, kInfinity);
        a_.Add(row, one ? t + k : t, 1);
        a_.Add(row, z + k, sign);
        a_.Add(row, y + k, -sign);
      }
    }
  } else if (cost != EdgeCost::kLinear) {
    const bool squared = cost == EdgeCost::kSquared;
    std::int32_t row =
        AddCone(arc, squared ? SY_CONE_ROTATED : SY_CONE_SECOND_ORDER, squared ? 4 : 3);
    if (squared) f_.Add(row++, phi, 1);
    f_.Add(row++, t, 1);
    for (int k = 0; k < 2; ++k, ++row) {
      f_.Add(row, z + k, 1);
      f_.Add(row, y + k, -1);
    }
  }
}

void GridGraph::Seal() {
  a_.columns.resize(At(data_.num_vars));
  f_.columns.resize(At(data_.num_vars));
  data_.A = a_.Matrix(data_.num_rows());
  data_.F = f_.Matrix(data_.num_cone_rows());
  data_.P = Csc(data_.num_vars, data_.num_vars);
  for (std::int32_t a = 0; a < static_cast<std::int32_t>(tail_.size()); ++a) own_arc_.push_back(a);
  blocks_ = {sizeof blocks_,        static_cast<std::int32_t>(tail_.size()),
             block_of_x_.data(),    block_of_row_.data(),
             block_of_cone_.data(), nullptr};
  paths_.size = sizeof paths_;
  paths_.num_vertices = num_vertices_;
  paths_.num_arcs = static_cast<std::int32_t>(tail_.size());
  paths_.source = source();
  paths_.target = target();
  paths_.tail = tail_.data();
  paths_.head = head_.data();
  paths_.flow = paths_.scale = first_.data();
  paths_.arc_in = paths_.arc_out = own_arc_.data();
  hints_[0] = {"sy.blocks/1", &blocks_};
  hints_[1] = {"sy.paths/1", &paths_};
  data_.hints = hints_;
  problem_ = Problem(data_);
}

std::vector<std::vector<std::int32_t>> GridGraph::SimplePaths() const {
  std::vector<std::vector<std::int32_t>> all;
  std::vector<std::int32_t> path;
  std::vector<std::uint8_t> visited(At(num_vertices_), 0);
  Extend(arcs(), Leaving(arcs()), source(), target(), visited, path, all);
  return all;
}

Problem GridGraph::FixedTo(const std::vector<std::int32_t>& path) const {
  ProblemData fixed = data();
  fixed.hints = nullptr;
  fixed.integer.clear();
  for (const std::int32_t phi : first_) fixed.x_lower[At(phi)] = fixed.x_upper[At(phi)] = 0;
  for (const std::int32_t a : path) {
    const auto phi = At(first_[At(a)]);
    fixed.x_lower[phi] = fixed.x_upper[phi] = 1;
  }
  return Problem(fixed);
}

std::unique_ptr<Host> HostWith(const std::vector<std::string>& backends) {
  HostOptions options;
  options.folders = std::vector<std::string>{};
  for (const std::string& name : backends) {
    const std::string file = std::string(SWITCHYARD_PLUGIN_FOLDER) + "/" + name + ".so";
    if (std::filesystem::exists(file)) options.files.push_back(file);
  }
  auto host = std::make_unique<Host>(options);
  host->Register(plugin::Plugin<rounding::RelaxAndRound>("native", "1.0"));
  return host;
}

sy_control Unlimited(int threads) {
  sy_control c = {};
  c.size = sizeof c;
  c.threads = threads;
  c.seconds = kInfinity;
  c.iterations = c.nodes = std::numeric_limits<std::int64_t>::max();
  c.cutoff = kInfinity;
  c.target = -kInfinity;
  c.feasibility = c.optimality = c.integrality = c.absolute_gap = c.relative_gap = std::nan("");
  return c;
}

StrategyAnswer RelaxAndRoundOn(Host& host, const sy_problem& problem,
                               const std::vector<std::string>& options, const sy_control& control) {
  StrategyAnswer answer;
  const Backend& backend = *host.Find("relax-and-round");
  answer.x.assign(At(problem.num_vars), 0.0);
  answer.relaxed_x = answer.x;
  std::string text(512, '\0');
  sy_result& r = answer.result;
  r.size = sizeof r;
  r.x = answer.x.data();
  r.relaxed_x = answer.relaxed_x.data();
  r.text = text.data();
  r.text_size = text.size();
  try {
    Instance instance(*host.Facade(backend), *host.table());
    for (const std::string& option : options) {
      const std::string name = option.substr(0, option.find('='));
      const std::string value = option.substr(name.size() + 1);
      instance.SetOption(name, ParseOptionValue(*FindOption(backend.facts, name), value));
    }
    instance.Load(problem, 0);
    instance.Solve(control, r);
  } catch (const BackendError& e) {
    answer.status = e.code();
    answer.error = e.reason();
  }
  answer.text = text.c_str();
  return answer;
}

double OptimumBy(Host& host, const sy_problem& problem) {
  const auto ranked = host.Rank(problem);
  if (ranked.empty() || !ranked.front().suitable) return std::nan("");
  Instance instance(*host.Facade(*ranked.front().backend), *host.table());
  instance.Load(problem, 0);
  std::vector<double> x(At(problem.num_vars), 0.0);
  sy_result r{};
  r.size = sizeof r;
  r.x = x.data();
  instance.Solve(Unlimited(), r);
  return r.termination == SY_OPTIMAL ? Objective(problem, x.data()) : kInfinity;
}

double BestPath(Host& host, const GridGraph& graph) {
  double best = kInfinity;
  for (const auto& path : graph.SimplePaths()) {
    best = std::min(best, OptimumBy(host, graph.FixedTo(path).view()));
  }
  return best;
}

}  // namespace switchyard::test
