#include "core/solve/dump.hpp"

#include <cmath>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "switchyard/cones.hpp"
#include "switchyard/error.hpp"

namespace switchyard {
namespace {

using Json = nlohmann::ordered_json;

Json Number(double value) {
  if (std::isfinite(value)) return value;
  return value > 0 ? "inf" : value < 0 ? "-inf" : "nan";
}

Json Numbers(const double* values, std::int32_t count) {
  Json list = Json::array();
  for (std::int32_t i = 0; i < count; ++i) list.push_back(Number(values[i]));
  return list;
}

Json Matrix(const sy_csc& m) {
  Json entries = Json::array();
  for (std::int32_t j = 0; j < m.cols; ++j) {
    for (std::int32_t k = m.start[j]; k < m.start[j + 1]; ++k) {
      entries.push_back({m.row[k], j, Number(m.value[k])});
    }
  }
  return {{"rows", m.rows}, {"cols", m.cols}, {"entries", std::move(entries)}};
}

Json Pattern(const sy_csc& m) {
  Json entries = Json::array();
  for (std::int32_t j = 0; j < m.cols; ++j) {
    for (std::int32_t k = m.start[j]; k < m.start[j + 1]; ++k) entries.push_back({m.row[k], j});
  }
  return {{"rows", m.rows}, {"cols", m.cols}, {"entries", std::move(entries)}};
}

}  // namespace

void WriteProblem(const sy_problem& problem, const std::string& path) {
  Json json = {{"format", "problem/1"}, {"num_vars", problem.num_vars}};
  json["convex"] = (problem.flags & SY_PROBLEM_CONVEX) != 0;
  if (problem.P != nullptr) json["P"] = Matrix(*problem.P);
  if (problem.q != nullptr) json["q"] = Numbers(problem.q, problem.num_vars);
  json["offset"] = problem.offset;
  if (problem.x_lower != nullptr) {
    json["x_lower"] = Numbers(problem.x_lower, problem.num_vars);
    json["x_upper"] = Numbers(problem.x_upper, problem.num_vars);
  }
  if (problem.integer != nullptr) {
    json["integer"] = std::vector<int>(problem.integer, problem.integer + problem.num_vars);
  }
  if (problem.A != nullptr) {
    json["A"] = Matrix(*problem.A);
    json["row_lower"] = Numbers(problem.row_lower, problem.num_rows);
    json["row_upper"] = Numbers(problem.row_upper, problem.num_rows);
  }
  if (problem.F != nullptr) {
    json["F"] = Matrix(*problem.F);
    json["g"] = Numbers(problem.g, problem.num_cone_rows);
    json["cones"] = Json::array();
    for (std::int32_t c = 0; c < problem.num_cones; ++c) {
      const sy_cone& cone = problem.cones[c];
      json["cones"].push_back(
          {{"kind", FactsOf(cone.kind).name}, {"dim", cone.dim}, {"parameter", cone.parameter}});
    }
  }
  if (problem.nlp != nullptr) {
    const sy_nlp& nlp = *problem.nlp;
    json["nlp"] = {{"num_constraints", nlp.num_constraints},
                   {"lower", Numbers(nlp.lower, nlp.num_constraints)},
                   {"upper", Numbers(nlp.upper, nlp.num_constraints)}};
    if ((nlp.provides & SY_JACOBIAN) != 0) json["nlp"]["jacobian"] = Pattern(nlp.jacobian);
    if ((nlp.provides & SY_HESSIAN) != 0) json["nlp"]["hessian"] = Pattern(nlp.hessian);
  }
  if (path == "-") {
    std::cout << json << '\n';
    return;
  }
  std::ofstream out(path);
  out << json << '\n';
  out.close();
  Require(!out.fail(), path, " cannot be written");
}

}  // namespace switchyard
