// One scenario of benchmarks/drake/trajectory_scenarios.py by GcsTrajectoryOptimization.
//
//   trajectories SCENARIO PATHS THREADS
//
// PATHS is how many to round to, 0 for the relaxation alone; THREADS at most so many, 0 for our own
// choice. Writes one line of JSON: status, build and solve (seconds), kilobytes (the most that the
// process took beyond what it had before the build), and where there is an answer cost, bound and,
// after rounding, segments of points and duration.
//
// Reading the file, loading plugins and a first trajectory through two rooms are not timed.
#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "switchyard/host/host.hpp"
#include "switchyard/sets/hpolyhedron.hpp"
#include "switchyard/sets/hyperrectangle.hpp"
#include "switchyard/sets/point.hpp"
#include "switchyard/trajectory/bezier_curve.hpp"
#include "switchyard/trajectory/gcs_trajectory_optimization.hpp"

namespace {

using namespace switchyard;
using Json = nlohmann::json;
using Clock = std::chrono::steady_clock;
using Problem = GcsTrajectoryOptimization;
using Pairs = std::vector<std::pair<int, int>>;

constexpr const char* kTwoRooms = R"({
  "num_positions": 1, "continuous_joints": [], "source": 1, "target": 2, "nonlinear": false,
  "terms": [{"type": "length_cost", "weight": 1}, {"type": "path_continuity", "order": 1}],
  "subgraphs": [
    {"name": "rooms", "order": 3, "h_min": 0.01, "h_max": 20, "pairs": null, "terms": [],
     "regions": [{"type": "box", "lower": [0], "upper": [1]},
                 {"type": "box", "lower": [1], "upper": [2]}]},
    {"name": "start", "order": 0, "h_min": 0, "h_max": 0, "pairs": [], "terms": [],
     "regions": [{"type": "point", "x": [0]}]},
    {"name": "goal", "order": 0, "h_min": 0, "h_max": 0, "pairs": [], "terms": [],
     "regions": [{"type": "point", "x": [2]}]}],
  "edges": [{"from": 1, "to": 0, "subspace": null, "pairs": null, "terms": []},
            {"from": 0, "to": 2, "subspace": null, "pairs": null, "terms": []}]})";

Eigen::VectorXd Vector(const Json& numbers) {
  const auto values = numbers.get<std::vector<double>>();
  return Eigen::Map<const Eigen::VectorXd>(values.data(), Eigen::Index(values.size()));
}

Eigen::MatrixXd Matrix(const Json& rows) {
  Eigen::MatrixXd A(rows.size(), rows.at(0).size());
  for (std::size_t i = 0; i < rows.size(); ++i) A.row(Eigen::Index(i)) = Vector(rows[i]);
  return A;
}

std::shared_ptr<const ConvexSet> Set(const Json& one) {
  const auto type = one.at("type").get<std::string>();
  if (type == "box") {
    return std::make_shared<Hyperrectangle>(Vector(one.at("lower")), Vector(one.at("upper")));
  }
  if (type == "polytope") {
    return std::make_shared<HPolyhedron>(Matrix(one.at("A")), Vector(one.at("b")));
  }
  return std::make_shared<Point>(Vector(one.at("x")));
}

std::optional<Pairs> PairsOf(const Json& one) {
  if (one.at("pairs").is_null()) return std::nullopt;
  return one.at("pairs").get<Pairs>();
}

/// To the whole problem, a subgraph, or the edges between two: what the latter alone lacks are
/// costs, what it alone has are zero derivatives.
template <class To>
void Add(const Json& terms, To& to) {
  for (const Json& term : terms) {
    const auto type = term.at("type").get<std::string>();
    if constexpr (requires { to.AddTimeCost(1.0); }) {
      if (type == "time_cost") to.AddTimeCost(term.at("weight").get<double>());
      if (type == "length_cost") to.AddPathLengthCost(term.at("weight").get<double>());
      if (type == "energy_cost") to.AddPathEnergyCost(term.at("weight").get<double>());
    } else {
      if (type == "zero_derivatives") to.AddZeroDerivativeConstraints(term.at("order"));
    }
    if (type == "velocity_bounds") {
      to.AddVelocityBounds(Vector(term.at("lower")), Vector(term.at("upper")));
    } else if (type == "derivative_bounds") {
      to.AddNonlinearDerivativeBounds(Vector(term.at("lower")), Vector(term.at("upper")),
                                      term.at("order").get<int>());
    } else if (type == "path_continuity") {
      to.AddPathContinuityConstraints(term.at("order").get<int>());
    } else if (type == "continuity") {
      to.AddContinuityConstraints(term.at("order").get<int>());
    }
  }
}

struct Built {
  std::unique_ptr<Problem> problem;
  std::vector<Problem::Subgraph*> subgraphs;
};

Built Build(const Json& scenario) {
  Built built{std::make_unique<Problem>(scenario.at("num_positions").get<int>(),
                                        scenario.at("continuous_joints").get<std::vector<int>>()),
              {}};
  Problem& problem = *built.problem;
  for (const Json& one : scenario.at("subgraphs")) {
    ConvexSets regions;
    for (const Json& region : one.at("regions")) regions.emplace_back(Set(region));
    const int order = one.at("order");
    const double h_min = one.at("h_min"), h_max = one.at("h_max");
    const std::string name = one.at("name");
    const auto pairs = PairsOf(one);
    Problem::Subgraph& subgraph =
        pairs ? problem.AddRegions(regions, *pairs, order, h_min, h_max, name)
              : problem.AddRegions(regions, order, h_min, h_max, name);
    Add(one.at("terms"), subgraph);
    built.subgraphs.push_back(&subgraph);
  }
  for (const Json& one : scenario.at("edges")) {
    const auto subspace = one.at("subspace").is_null() ? nullptr : Set(one.at("subspace"));
    const auto pairs = PairsOf(one);
    Add(one.at("terms"),
        problem.AddEdges(*built.subgraphs[one.at("from")], *built.subgraphs[one.at("to")],
                         subspace.get(), pairs ? &*pairs : nullptr));
  }
  Add(scenario.at("terms"), problem);
  return built;
}

GraphOfConvexSetsOptions Options(const Json& scenario, int paths, int threads) {
  static const SolverInterface ipopt("ipopt");
  GraphOfConvexSetsOptions options;
  options.convex_relaxation = true;
  options.max_rounded_paths = paths;
  options.max_rounding_trials = 100;
  options.flow_tolerance = 1e-5;
  options.rounding_seed = 0;
  if (scenario.at("nonlinear").get<bool>()) options.restriction_solver = &ipopt;
  if (threads > 0) options.parallelism = Parallelism(threads);
  return options;
}

Json Segments(const CompositeTrajectory<double>& trajectory) {
  Json segments = Json::array();
  for (int k = 0; k < trajectory.get_number_of_segments(); ++k) {
    const auto& curve = dynamic_cast<const BezierCurve<double>&>(trajectory.segment(k));
    Json points = Json::array();
    for (const auto& column : curve.control_points().colwise()) {
      points.push_back(std::vector<double>(column.begin(), column.end()));
    }
    segments.push_back({{"points", points}, {"duration", trajectory.duration(k)}});
  }
  return segments;
}

long Kilobytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

Json Solve(const Json& scenario, int paths, int threads) {
  const GraphOfConvexSetsOptions options = Options(scenario, paths, threads);
  const long before = Kilobytes();
  const auto start = Clock::now();
  const Built built = Build(scenario);
  const auto built_at = Clock::now();
  const GcsTrajectory found = built.problem->FindPath(
      *built.subgraphs[scenario.at("source")], *built.subgraphs[scenario.at("target")], options);
  const auto solved = Clock::now();
  const auto seconds = [](auto from, auto to) {
    return std::chrono::duration<double>(to - from).count();
  };
  const MathematicalProgramResult& result = found.result();
  Json answer{{"status", std::string(to_string(result.termination))},
              {"message", result.message},
              {"notes", result.notes},
              {"build", seconds(start, built_at)},
              {"solve", seconds(built_at, solved)},
              {"kilobytes", Kilobytes() - before}};
  if (std::isfinite(result.bound)) answer["bound"] = result.bound;
  if (paths == 0) {
    if (std::isfinite(found.search.relaxation_cost)) answer["cost"] = found.search.relaxation_cost;
  } else if (found.trajectory.get_number_of_segments() > 0) {
    answer["cost"] = result.objective;
    answer["segments"] = Segments(found.trajectory);
  }
  return answer;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 4) throw InvalidArgument("usage: trajectories SCENARIO PATHS THREADS");
  const int paths = std::stoi(argv[2]), threads = std::stoi(argv[3]);
  std::ifstream file(argv[1]);
  const Json scenario = Json::parse(file);
  (void)Host::Default().backends();  // finds the plugins
  (void)Solve(Json::parse(kTwoRooms), 1, threads);
  fmt::print("{}\n", Solve(scenario, paths, threads).dump());
  return 0;
} catch (const std::exception& e) {
  fmt::print(stderr, "trajectories: {}\n", e.what());
  return 2;
}
