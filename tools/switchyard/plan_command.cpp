#include <cmath>
#include <iostream>
#include <sstream>
#include <unordered_set>

#include <fmt/format.h>

#include "answer.hpp"
#include "commands.hpp"
#include "interrupt.hpp"
#include "json_result.hpp"
#include "no_backend.hpp"
#include "picture.hpp"
#include "solve_options.hpp"
#include "switchyard/error.hpp"

namespace switchyard::cli {
namespace {

constexpr int kPaths = 10;

struct PlanOptions {
  SolveOptions solve;
  bool relaxation = false;
  bool round = false;  // the default, so that scripts can say it
  bool exact = false;
  int paths = kPaths;
  std::string nonlinear;
  std::string picture;

  void AddTo(CLI::App& command);
};

void PlanOptions::AddTo(CLI::App& command) {
  solve.AddTo(command);
  command.get_option("--solver")
      ->description(
          "The backend underneath, of relaxation and restrictions: id or short name; a "
          "list with commas is an order of preference");
  command.get_option("--option")
      ->description(
          "The strategy's own option, NAME=VALUE, or that of a backend underneath, "
          "BACKEND:NAME=VALUE (repeatable)");
  command.get_option("--gap")->description(
      "Relative gap at which a path is optimal (default 1e-4)");
  command.get_option("--solution")->description("Write points and flows by name, as JSON");
  CLI::Option* only = command.add_flag("--relaxation", relaxation,
                                       "Solve the convex relaxation alone: a bound, no path");
  CLI::Option* rounding =
      command
          .add_flag("--round", round,
                    "Solve the relaxation, sample paths from its flow and solve each (default)")
          ->excludes(only);
  CLI::Option* to_the_gap = command
                                .add_flag("--exact", exact,
                                          "Branch and bound until the best path is proven to be "
                                          "within the gap; a named backend that takes the whole "
                                          "integer program replaces it")
                                ->excludes(only)
                                ->excludes(rounding);
  command.add_option("--dump", solve.dump, "Write the transcribed problem to this file");
  command.add_option("--paths", paths, "Distinct paths to try at most (default 10)")
      ->check(CLI::Range(1, 100000))
      ->excludes(only)
      ->excludes(to_the_gap);
  command
      .add_option("--nonlinear", nonlinear,
                  "The backend of the paths' restrictions, which may be nonlinear (default: as "
                  "--solver, or the best that takes them)")
      ->excludes(only);
  command.add_option("--picture", picture, "Draw sets, flow and path to this file (.svg)")
      ->check(
          [](const std::string& path) {
            const bool known = path == "-" || path.ends_with(".svg");
            return known ? std::string() : "needs a file that ends in .svg, got \"" + path + "\"";
          },
          "", "ending");
}

/// Throws NoBackend where an option names no backend that is there.
void CheckSolver(const char* option, const std::string& names, const Host& host) {
  std::stringstream list(names);
  std::string name;
  while (std::getline(list, name, ',')) {
    if (host.Find(name) != nullptr) return;
  }
  if (name.empty()) return;
  std::vector<std::string> others;
  for (const Backend* one : host.backends()) others.push_back(one->short_name);
  throw NoBackend(Text(option, " ", names, ": there is no such backend; there are ",
                       fmt::format("{}", fmt::join(others, ", "))));
}

GraphOfConvexSetsOptions ForSearch(const PlanOptions& options, const SolverInterface& solver,
                                   const SolverOptions& given) {
  GraphOfConvexSetsOptions search;
  search.convex_relaxation = !options.exact;
  search.max_rounded_paths = options.relaxation ? 0 : options.paths;
  constexpr auto kMost = static_cast<std::uint64_t>(std::numeric_limits<int>::max());
  Require(given.seed <= kMost, "plan: --seed needs 0 to ", kMost, ", got ", given.seed);
  search.rounding_seed = static_cast<int>(given.seed);
  search.solver = &solver;
  search.solver_options = given;
  search.dump = options.solve.dump;
  if (given.threads > 0) search.parallelism = Parallelism(given.threads);
  return search;
}

/// "a b c d ... 38 more ... w x y z (46)": how many vertices it has stands last.
std::string PathInWords(const GraphProblem& problem, const ShortestPath& found) {
  std::vector<std::string> names{problem.source->name()};
  for (const auto* edge : found.edges) names.push_back(edge->v().name());
  constexpr std::size_t kEnd = 4;
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i == kEnd && names.size() > 2 * kEnd + 1) {
      const std::size_t left_out = names.size() - 2 * kEnd;
      text += fmt::format(" ... {} more ...", left_out);
      i += left_out;
    }
    text += (i == 0 ? "" : " ") + names[i];
  }
  return fmt::format("{} ({})", text, names.size());
}

std::string RoundedInWords(const ShortestPath& found) {
  std::size_t solved = 0;
  for (const RoundedPath& one : found.rounded) solved += std::isfinite(one.cost) ? 1 : 0;
  return fmt::format("{} paths drawn, {} with a feasible point", found.rounded.size(), solved);
}

std::string StagesInWords(const SolveTimes& t) {
  std::string text = fmt::format("{:.3f}", t.total);
  const char* separator = ": ";
  const auto add = [&](const char* name, double seconds) {
    if (!(seconds >= 0.0005)) return;
    text += fmt::format("{}{} {:.3f}", separator, name, seconds);
    separator = ", ";
  };
  add("read", t.read);
  add("prune", t.presolve);
  add("build", t.build);
  add("lower", t.lower);
  add("solve", t.solve);
  add("recover", t.recover);
  return text;
}

void SayInWords(const GraphProblem& problem, const ShortestPath& found) {
  const MathematicalProgramResult& r = found.result;
  std::cout << (r.termination == Termination::kLocallyOptimal ? "a path beyond the gap"
                                                              : to_string(r.termination));
  if (!r.solver.empty()) std::cout << fmt::format(" by {} {}", r.solver, r.solver_version);
  for (const std::string& one : found.subsolvers) std::cout << ", " << one;
  std::cout << fmt::format("\ngraph      {} vertices, {} edges, {} after pruning\n",
                           problem.graph->num_vertices(), problem.graph->num_edges(),
                           found.edges_after);
  const auto line = [](const char* name, double value, int digits) {
    if (!std::isnan(value)) std::cout << fmt::format("{:<10} {:.{}g}\n", name, value, digits);
  };
  if (r.termination == Termination::kInfeasible) std::cout << "reason     " << r.message << '\n';
  constexpr int kDigits = 12;
  line("relaxation", found.relaxation_cost, kDigits);
  line("bound", r.bound, kDigits);
  if (!found.points.empty()) {
    line("cost", r.objective, kDigits);
    line("gap", r.gap(), 3);
    std::cout << "path       " << PathInWords(problem, found) << '\n';
  }
  if (!found.rounded.empty()) std::cout << "rounding   " << RoundedInWords(found) << '\n';
  std::cout << "seconds    " << StagesInWords(r.seconds) << '\n';
  for (const std::string& note : r.notes) std::cerr << "note: " << note << '\n';
}

void WriteAll(const PlanOptions& options, const GraphProblem& problem, const ShortestPath& found) {
  if (!options.solve.json.empty()) WritePlanResult(problem, found, options.solve.json);
  if (!options.solve.solution.empty()) WritePlanSolution(problem, found, options.solve.solution);
  if (!options.picture.empty()) WritePicture(problem, found, options.picture);
  const bool taken = options.solve.json == "-" || options.solve.solution == "-" ||
                     options.picture == "-";  // standard output
  if (!options.solve.quiet && !taken) SayInWords(problem, found);
}

/// Throws FileError where no edges lead from the source to the target, whatever the sets: a file
/// that asks for what cannot be.
void CheckTarget(const GraphProblem& problem, const std::string& file) {
  std::vector<const GraphOfConvexSets::Vertex*> open = {problem.source};
  std::unordered_set<const GraphOfConvexSets::Vertex*> reached = {problem.source};
  while (!open.empty()) {
    const GraphOfConvexSets::Vertex* v = open.back();
    open.pop_back();
    for (const auto* edge : v->outgoing_edges()) {
      if (reached.insert(&edge->v()).second) open.push_back(&edge->v());
    }
  }
  if (reached.count(problem.target) > 0) return;
  throw FileError(file, "/target", "a vertex that edges lead to from " + problem.source->name(),
                  problem.target->name() + ", which none lead to");
}

int Plan(const std::string& file, PlanOptions& options) {
  const Clock::time_point start = Clock::now();
  WatchInterrupts();
  std::vector<std::string> notes;
  ReadOptions reading;
  reading.notes = &notes;
  const GraphProblem problem = ReadGraph(file, reading);
  CheckTarget(problem, file);
  const double read = Since(start);
  for (const std::string& note : notes) {
    if (!options.solve.quiet) std::cerr << "note: " << note << '\n';
  }
  const auto host = options.solve.MakeHost();
  CheckSolver("--solver", options.solve.solver, *host);
  CheckSolver("--nonlinear", options.nonlinear, *host);
  SolverOptions given = options.solve.ForSolver(*host, Since(start));
  given.progress = TerminalProgress(options.solve.quiet);
  const SolverInterface solver(options.solve.solver, *host);
  const SolverInterface restriction(options.nonlinear, *host);
  GraphOfConvexSetsOptions search = ForSearch(options, solver, given);
  if (!options.nonlinear.empty()) search.restriction_solver = &restriction;
  ShortestPath found =
      FindShortestPath(*problem.graph, *problem.source, *problem.target, search, *host);
  EndProgress(given.progress);
  found.result.seconds.read = read;
  found.result.seconds.total = Since(start);
  if (options.solve.explain) Explain(found.result);
  WriteAll(options, problem, found);
  const int code = ExitCodeOf(found.result);
  if (!options.solve.quiet) SayWhyNot(file, found.result, code);
  return code;
}

}  // namespace

void AddPlanCommand(CLI::App& app, int& code) {
  CLI::App* command = app.add_subcommand(
      "plan", "Find a shortest path through a graph of convex sets from a file (gcs/1)");
  command->footer("Example: switchyard plan building.json --solver highs --picture building.svg");
  auto options = std::make_shared<PlanOptions>();
  auto file = std::make_shared<std::string>();
  command->add_option("FILE", *file, "The graph; - is standard input, .gz is read as it is")
      ->required();
  options->AddTo(*command);
  command->callback([options, file, &code] {
    try {
      code = Plan(*file, *options);
    } catch (const NoBackend& e) {
      std::cerr << "switchyard: no_backend: " << e.what() << '\n';
      code = kNotAnswered;
    }
  });
}

}  // namespace switchyard::cli
