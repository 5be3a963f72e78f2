#include "json_result.hpp"

#include <sys/resource.h>

#include <cmath>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "answer.hpp"
#include "switchyard/error.hpp"

namespace switchyard::cli {
namespace {

using Json = nlohmann::ordered_json;
using Edge = GraphOfConvexSets::Edge;

/// Unknown is null, infinities are strings.
Json Number(double value) {
  if (std::isnan(value)) return nullptr;
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return value;
}

std::int64_t PeakMemoryBytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  constexpr std::int64_t kKibibyte = 1024;
  return usage.ru_maxrss * kKibibyte;
}

void Write(const Json& json, const std::string& path) {
  if (path == "-") {
    std::cout << json.dump(2) << '\n' << std::flush;
    return;
  }
  std::ofstream out(path);
  out << json.dump(2) << '\n';
  out.close();
  Require(!out.fail(), path, ": the file cannot be written");
}

Json Seconds(const SolveTimes& t) {
  return {{"read", t.read},   {"build", t.build},     {"lower", t.lower}, {"presolve", t.presolve},
          {"solve", t.solve}, {"recover", t.recover}, {"total", t.total}};
}

/// What the results of all commands have.
Json Common(const char* command, const std::string& name, const MathematicalProgramResult& result) {
  Json json = {{"format", "result/1"}, {"command", command}, {"name", name}};
  if (!result.solver.empty()) {
    json["solver"] = result.solver;
    json["solver_version"] = result.solver_version;
  }
  json["termination"] = to_string(result.termination);
  json["primal"] = to_string(result.primal);
  json["dual"] = to_string(result.dual);
  json["message"] = result.message;
  const bool has_point = result.primal != PointKind::kNone && result.primal != PointKind::kRay;
  json["objective"] = Number(result.objective);
  json["bound"] = Number(result.bound);
  if (!std::isnan(result.gap())) json["gap"] = Number(result.gap());
  if (has_point) {
    const Violation& v = result.violation;
    json["violation"] = {{"bounds", Number(v.bounds)},
                         {"rows", Number(v.rows)},
                         {"cones", Number(v.cones)},
                         {"integrality", Number(v.integrality)},
                         {"nonlinear", Number(v.nonlinear)}};
  }
  if (result.iterations >= 0) json["iterations"] = result.iterations;
  if (result.nodes >= 0) json["nodes"] = result.nodes;
  json["seconds"] = Seconds(result.seconds);
  json["peak_memory_bytes"] = PeakMemoryBytes();
  json["subsolvers"] = Json::array();
  json["considered"] = Json::array();
  for (const Considered& one : result.considered) {
    json["considered"].push_back(
        {{"solver", one.solver}, {"verdict", one.chosen ? "chosen" : "skipped"}, {"why", one.why}});
  }
  if (!result.bridges.empty()) json["bridges"] = result.bridges;
  if (!result.notes.empty()) json["notes"] = result.notes;
  return json;
}

Json Numbers(const Eigen::VectorXd& x) {
  Json numbers = Json::array();
  for (const double value : x) numbers.push_back(Number(value));
  return numbers;
}

Json VertexNames(const GraphProblem& problem, const std::vector<const Edge*>& edges) {
  Json names = Json::array();
  names.push_back(problem.source->name());
  for (const Edge* edge : edges) names.push_back(edge->v().name());
  return names;
}

}  // namespace

void WriteResult(const MathematicalProgram& program, const MathematicalProgramResult& result,
                 const std::optional<StartCounts>& starts, const std::string& path) {
  Json json = Common("solve", program.name(), result);
  if (HasFunctions(program)) {
    const EvaluationCounts& n = result.evaluations;
    json["evaluations"] = {{"objective", n.objective},
                           {"gradient", n.gradient},
                           {"constraints", n.constraints},
                           {"jacobian", n.jacobian},
                           {"hessian", n.hessian}};
  }
  if (starts) {
    json["starts"] = {
        {"tried", starts->tried}, {"answered", starts->answered}, {"distinct", starts->distinct}};
  }
  Write(json, path);
}

void WritePlanResult(const GraphProblem& problem, const ShortestPath& found,
                     const std::string& path) {
  Json json = Common("plan", problem.name, found.result);
  json["subsolvers"] = found.subsolvers;
  if (!std::isnan(found.relaxation_cost)) {
    json["relaxation"] = {{"cost", Number(found.relaxation_cost)},
                          {"seconds", Number(found.relaxation_seconds)}};
  }
  std::unordered_map<const Edge*, std::size_t> index;
  for (const Edge* edge : std::as_const(*problem.graph).Edges()) index.emplace(edge, index.size());
  if (!found.points.empty()) {
    json["path"] = VertexNames(problem, found.edges);
    json["edges"] = Json::array();
    for (const Edge* edge : found.edges) json["edges"].push_back(index.at(edge));
    json["points"] = Json::array();
    for (const Eigen::VectorXd& x : found.points) json["points"].push_back(Numbers(x));
  }
  json["rounded"] = Json::array();
  for (const RoundedPath& tried : found.rounded) {
    Json one = {{"path", VertexNames(problem, tried.edges)},
                {"cost", Number(tried.cost)},
                {"termination", to_string(tried.termination)}};
    if (!tried.reason.empty()) one["reason"] = tried.reason;
    json["rounded"].push_back(std::move(one));
  }
  json["pruned"] = {{"edges_before", problem.graph->num_edges()},
                    {"edges_after", found.edges_after}};
  Write(json, path);
}

void WritePlanSolution(const GraphProblem& problem, const ShortestPath& found,
                       const std::string& path) {
  Json variables = Json::object();
  const GraphOfConvexSets& graph = *problem.graph;
  for (const auto* vertex : graph.Vertices()) {
    const auto x = vertex->GetSolution(found.result);
    if (!x.has_value()) continue;
    for (Eigen::Index i = 0; i < x->size(); ++i) {
      variables[vertex->name() + ".x[" + std::to_string(i) + "]"] = Number((*x)[i]);
    }
  }
  for (const Edge* edge : graph.Edges()) {
    if (!found.result.Knows(edge->phi())) continue;
    const double flow = found.result.GetSolution(edge->phi());
    if (flow != 0) variables[edge->name() + ".flow"] = Number(flow);
  }
  Write({{"variables", std::move(variables)}, {"rows", Json::object()}}, path);
}

void WriteSolution(const MathematicalProgram& program, const MathematicalProgramResult& result,
                   const std::string& path) {
  Json variables = Json::object();
  const Eigen::VectorXd& x = result.get_x_val();
  for (int j = 0; j < static_cast<int>(x.size()); ++j) {
    variables[program.VariableName(j)] = Number(x[j]);
  }
  Json rows = Json::object();
  if (result.has_duals()) {
    const auto add = [&](const Binding<Constraint>& binding) {
      const Eigen::VectorXd dual = result.GetDualSolution(binding);
      for (int i = 0; i < static_cast<int>(dual.size()); ++i) {
        rows[binding.evaluator()->RowName(i)] = Number(dual[i]);
      }
    };
    for (const auto& binding : program.affine_constraints()) add(binding);
    for (const auto& binding : program.cone_constraints()) add(binding);
    for (const auto& binding : program.quadratic_constraints()) add(binding);
    for (const auto& binding : program.generic_constraints()) add(binding);
  }
  Write({{"variables", std::move(variables)}, {"rows", std::move(rows)}}, path);
}

}  // namespace switchyard::cli
