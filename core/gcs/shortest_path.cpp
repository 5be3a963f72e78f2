// A shortest path, from the graph to the answer in its own terms.
#include "switchyard/gcs/shortest_path.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <mutex>

#include "core/gcs/path_point.hpp"
#include "core/gcs/restriction.hpp"
#include "core/lower/lowering.hpp"
#include "core/solve/check.hpp"
#include "core/solve/choice.hpp"
#include "core/solve/control.hpp"
#include "core/solve/dump.hpp"
#include "core/solve/recovery.hpp"
#include "switchyard/error.hpp"
#include "switchyard/plugin.hpp"

namespace switchyard {
namespace {

using Vertex = GraphOfConvexSets::Vertex;
using Edge = GraphOfConvexSets::Edge;
using Transcription = GraphOfConvexSets::Transcription;
using Clock = std::chrono::steady_clock;

constexpr const char* kRelaxAndRound = "org.switchyard.relax-and-round";
constexpr int kPaths = 10;

double Since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string NamesOf(const SolverInterface* solver) {
  return solver == nullptr ? "" : solver->solver_id().name();
}

/// One search: its steps are the members, in the order in which Run calls them.
class Search {
 public:
  Search(const GraphOfConvexSets& graph, const Vertex& source, const Vertex& target,
         const GraphOfConvexSetsOptions& options, Host& host)
      : graph_(graph), source_(source), target_(target), options_(options), host_(host) {
    const bool whole = options.convex_relaxation == false;
    as_ = whole ? Transcription::kMIP : Transcription::kRelaxation;
  }

  ShortestPath Run();

 private:
  struct Tried {
    std::unique_ptr<MathematicalProgram> program;
    MathematicalProgramResult result;
  };

  void OneVertex();
  bool Prune();
  void Transcribe();
  bool Load();
  void Solve();
  void Recover();
  void RecoverPath(const PathPoints& path, const MathematicalProgramResult* slacks);
  void CapRelaxation();
  void RecoverRelaxation();
  void RecoverBestTried();
  [[nodiscard]] bool rounds() const {
    return as_ == Transcription::kRelaxation && options_.max_rounded_paths.value_or(kPaths) > 0;
  }
  /// Has every term of a restriction its part in this transcription, and the other way round?
  [[nodiscard]] bool SameTerms() const;
  [[nodiscard]] bool Bounds() const;
  template <class Holds>
  [[nodiscard]] bool AllTerms(Holds&& holds) const;
  [[nodiscard]] std::vector<const Edge*> EdgesOf(const std::int32_t* arcs,
                                                 std::int32_t count) const;
  void SolvePath(const std::int32_t* arcs, std::int32_t count, const sy_control& control,
                 sy_result& result);
  void Hear(const std::int32_t* arcs, std::int32_t count, const sy_result& result);
  MathematicalProgramResult& result() { return answer_.result; }

  const GraphOfConvexSets& graph_;
  const Vertex& source_;
  const Vertex& target_;
  const GraphOfConvexSetsOptions& options_;
  Host& host_;
  Transcription as_;
  Clock::time_point began_ = Clock::now();
  ShortestPath answer_;
  PrunedGraph pruned_;
  std::unique_ptr<GcsTranscription> transcription_;
  BackendChoice choice_;
  std::unique_ptr<AnswerBuffers> raw_;
  bool failed_ = false;            // nothing came back
  bool relaxation_ended_ = false;  // by itself, not at a limit
  std::vector<double> relaxed_;
  std::mutex mutex_;
  std::map<std::vector<const Edge*>, Tried> tried_;  // by solve_path
};

ShortestPath Search::Run() {
  if (&source_ == &target_) {
    OneVertex();
  } else if (Prune()) {
    Transcribe();
    if (Load()) {
      Solve();
      Recover();
    }
  }
  result().seconds.total = Since(began_);
  return std::move(answer_);
}

// The path of one vertex: its set, its terms.
void Search::OneVertex() {
  const auto program = RestrictionOf({&source_}, {});
  SolverInterface solver(
      NamesOf(options_.restriction_solver != nullptr ? options_.restriction_solver
                                                     : options_.solver),
      host_);
  answer_.result = solver.Solve(*program, std::nullopt, options_.solver_options);
  if (result().primal != PointKind::kFeasible) return;
  answer_.points = {result().GetSolution(source_.x())};
}

bool Search::Prune() {
  pruned_ = switchyard::Prune(graph_, source_, target_, options_.preprocessing.value_or(true));
  answer_.edges_before = graph_.num_edges();
  answer_.edges_after = static_cast<int>(pruned_.edges.size());
  result().seconds.presolve += Since(began_);
  if (pruned_.why_no_path.empty()) return true;
  result().termination = Termination::kInfeasible;
  result().message = pruned_.why_no_path;
  return false;
}

void Search::Transcribe() {
  const auto start = Clock::now();
  transcription_ = std::make_unique<GcsTranscription>(pruned_, as_);
  sy_paths& paths = transcription_->paths();
  paths.context = this;
  paths.tried = [](void* context, const std::int32_t* arcs, std::int32_t count,
                   const sy_result* result) noexcept {
    try {
      static_cast<Search*>(context)->Hear(arcs, count, *result);
    } catch (...) {  // a path that is not listed is not lost: the answer is the strategy's
    }
  };
  if (!SameTerms()) {
    paths.solve_path = [](void* context, const std::int32_t* arcs, std::int32_t count,
                          const sy_control* control, sy_result* result, sy_error* error) noexcept {
      return plugin::Guarded(error, [&] {
        static_cast<Search*>(context)->SolvePath(arcs, count, plugin::Whole(*control), *result);
      });
    };
  }
  result().seconds.lower += Since(start);
}

template <class Holds>
bool Search::AllTerms(Holds&& holds) const {
  const auto all = [&](const auto& terms) {
    return std::all_of(terms.begin(), terms.end(),
                       [&](const auto& term) { return holds(term.in); });
  };
  return std::all_of(pruned_.vertices.begin(), pruned_.vertices.end(),
                     [&](const Vertex* v) { return all(v->costs()) && all(v->constraints()); }) &&
         std::all_of(pruned_.edges.begin(), pruned_.edges.end(),
                     [&](const Edge* e) { return all(e->costs()) && all(e->constraints()); });
}

bool Search::SameTerms() const {
  return AllTerms([this](GraphOfConvexSets::TranscriptionSet in) {
    return in.contains(as_) == in.contains(Transcription::kRestriction);
  });
}

// A bound counts only terms that the restriction has too.
bool Search::Bounds() const {
  return AllTerms([this](GraphOfConvexSets::TranscriptionSet in) {
    return !in.contains(as_) || in.contains(Transcription::kRestriction);
  });
}

bool Search::Load() {
  const auto start = Clock::now();
  const bool strategy = as_ == Transcription::kRelaxation;
  SolverOptions options = options_.solver_options;
  options.seed = static_cast<std::uint64_t>(options_.rounding_seed);
  if (strategy) {
    auto& own = options.options[kRelaxAndRound];
    own["solver"] = NamesOf(options_.solver);
    own["paths"] = options_.max_rounded_paths.value_or(kPaths);
    own["trials"] = options_.max_rounding_trials;
    own["flow_tolerance"] = options_.flow_tolerance;
  }
  const BackendWish wish{
      strategy ? kRelaxAndRound : NamesOf(options_.solver), &options, host_.table(), 0, {}};
  if (!options_.dump.empty()) WriteProblem(transcription_->problem().view(), options_.dump);
  choice_ = ChooseBackend(host_, transcription_->problem().view(), wish);
  result().considered = choice_.considered;
  result().seconds.lower += Since(start);
  if (choice_.backend != nullptr) {
    result().solver = choice_.backend->id;
    result().solver_version = host_.Ready(*choice_.backend).version;
    return true;
  }
  result().termination = Termination::kNoBackend;
  result().message = choice_.why_none;
  return false;
}

void Search::Solve() {
  const auto start = Clock::now();
  const ProblemData& data = transcription_->problem().data();
  raw_ = std::make_unique<AnswerBuffers>(data);
  relaxed_.assign(data.q.size(), std::nan(""));
  raw_->raw.relaxed_x = relaxed_.data();
  SolverOptions options = options_.solver_options;
  options.seed = static_cast<std::uint64_t>(options_.rounding_seed);
  if (options.threads == 0) options.threads = options_.parallelism.num_threads();
  SolveControl control(options, false);
  try {
    choice_.instance->Solve(control.Record(options.time_limit - Since(began_), false), raw_->raw);
  } catch (const BackendError& e) {  // a strategy that finds nobody to ask is no failure of it
    failed_ = true;
    const bool nobody = e.code() == SY_E_UNSUPPORTED;
    result().termination = nobody ? Termination::kNoBackend : Termination::kBackendFailed;
    result().message = nobody ? e.reason() : e.what();
  }
  control.RethrowWhatWasThrown();
  result().seconds.solve += Since(start);
}

void Search::Recover() {
  if (failed_) return;
  const auto start = Clock::now();
  const sy_result& raw = raw_->raw;
  result().termination = static_cast<Termination>(raw.termination);
  result().message = raw_->text.data();
  result().iterations = raw.iterations;
  result().nodes = raw.nodes;
  if (Bounds() && std::isfinite(raw.bound)) {
    result().bound = raw.bound;
  } else if (!Bounds()) {
    result().notes.emplace_back("no bound: a term of the relaxation is not one of the restriction");
  }
  const auto has_flow = std::isfinite(raw.relaxed);
  if (has_flow) {
    if (relaxation_ended_) answer_.relaxation_cost = raw.relaxed;
    answer_.relaxed_flow.assign(static_cast<std::size_t>(graph_.num_edges()), 0);
    for (std::size_t a = 0; a < pruned_.edges.size(); ++a) {
      answer_.relaxed_flow[static_cast<std::size_t>(pruned_.place[a])] =
          relaxed_[static_cast<std::size_t>(transcription_->variables(a).phi)];
    }
  }
  if (!tried_.empty()) {
    RecoverBestTried();
  } else if (raw.primal == SY_FEASIBLE || raw.primal == SY_NEARLY_FEASIBLE) {
    RecoverPath(PathIn(pruned_, *transcription_, raw_->vectors.x), nullptr);
  } else if (has_flow && relaxation_ended_ && !rounds()) {
    RecoverRelaxation();
  }
  result().seconds.recover += Since(start);
}

void Search::RecoverPath(const PathPoints& path, const MathematicalProgramResult* slacks) {
  if (path.edges.empty()) {
    result().termination = Termination::kNumericalTrouble;
    result().notes.emplace_back("the flows of the answer form no path");
    return;
  }
  answer_.edges = path.edges;
  answer_.points = path.points;
  SetPathPoint(graph_, path, slacks, result());
  const auto program = RestrictionOf(VerticesOf(path.edges), path.edges);
  Eigen::VectorXd x(program->num_vars());
  for (int j = 0; j < program->num_vars(); ++j) {
    x[j] = result().GetSolution(program->decision_variable(j));
  }
  result().objective = program->EvalCosts(x);
  result().violation = ViolationOf(*program, x);
  const Lowering lowering(*program);
  const double violation =
      RelativeViolation(lowering.problem().view(), lowering.Extend(*program, x));
  result().primal = violation <= kSupported ? PointKind::kFeasible : PointKind::kNearlyFeasible;
  if (violation <= kSupported) return CapRelaxation();
  result().notes.push_back(Text("our check finds the path's points violated by ",
                                result().violation.rows, " in rows and ", result().violation.cones,
                                " in cones"));
  result().termination = Termination::kNumericalTrouble;
}

// A path's points are points of the relaxation too, so its optimum is no higher than the path's
// cost, whatever an inexact solve of it says.
void Search::CapRelaxation() {
  if (!(answer_.relaxation_cost > result().objective) || !Bounds()) return;
  const double above = answer_.relaxation_cost - result().objective;
  answer_.relaxation_cost = result().objective;
  if (above <= kSupported * (1 + std::abs(result().objective))) return;
  result().notes.push_back(Text("the relaxation was solved inexactly: its point costs ", above,
                                " more than the path, which is one of its points"));
}

// The restriction as the front end means it: the best of those that were solved here.
void Search::RecoverBestTried() {
  const Tried* best = nullptr;
  const std::vector<const Edge*>* edges = nullptr;
  for (const auto& [path, tried] : tried_) {
    if (tried.result.primal != PointKind::kFeasible) continue;
    if (best != nullptr && tried.result.objective >= best->result.objective) continue;
    best = &tried;
    edges = &path;
  }
  if (best == nullptr) return;
  PathPoints path{*edges, {}};
  for (const Vertex* v : VerticesOf(*edges)) {
    path.points.push_back(best->result.GetSolution(v->x()));
  }
  RecoverPath(path, &best->result);
}

void Search::RecoverRelaxation() {
  SetFlowPoint(graph_, pruned_, *transcription_, relaxed_, result());
  sy_problem relaxation = transcription_->problem().view();
  relaxation.integer = nullptr;
  const bool feasible = RelativeViolation(relaxation, relaxed_) <= kSupported;
  result().primal = feasible ? PointKind::kFeasible : PointKind::kNearlyFeasible;
  result().objective = answer_.relaxation_cost;
  const double apart = std::abs(result().objective - raw_->raw.bound);
  const bool supported = apart <= kSupported * (1 + std::abs(result().objective));
  if (result().termination != Termination::kNotSolved) return;
  result().termination =
      feasible && supported ? Termination::kOptimal : Termination::kNumericalTrouble;
  result().dual = supported ? PointKind::kFeasible : PointKind::kInfeasible;
  if (supported) return;
  result().notes.push_back(
      Text("the relaxation's cost is supported only to the bound ", raw_->raw.bound));
}

std::vector<const Edge*> Search::EdgesOf(const std::int32_t* arcs, std::int32_t count) const {
  std::vector<const Edge*> edges;
  for (std::int32_t k = 0; k < count; ++k) {
    edges.push_back(pruned_.edges[static_cast<std::size_t>(arcs[k])]);
  }
  return edges;
}

void Search::SolvePath(const std::int32_t* arcs, std::int32_t count, const sy_control& control,
                       sy_result& result) {
  const std::vector<const Edge*> edges = EdgesOf(arcs, count);
  Tried tried;
  tried.program = RestrictionOf(VerticesOf(edges), edges);
  SolverOptions options = options_.restriction_solver_options.value_or(options_.solver_options);
  options.time_limit = std::min(options.time_limit, control.seconds);
  options.threads = control.threads;
  const SolverInterface solver(
      NamesOf(options_.restriction_solver != nullptr ? options_.restriction_solver
                                                     : options_.solver),
      host_);
  tried.result = solver.Solve(*tried.program, std::nullopt, options);
  constexpr auto kOurs = static_cast<int>(Termination::kNoBackend);
  const auto termination = static_cast<int>(tried.result.termination);
  result.termination = termination < kOurs ? static_cast<sy_termination>(termination)
                                           : static_cast<sy_termination>(SY_NOT_SOLVED);
  result.objective = tried.result.objective;
  result.primal = tried.result.primal == PointKind::kFeasible ? SY_FEASIBLE : SY_NO_POINT;
  std::fill(result.x, result.x + transcription_->problem().data().num_vars, std::nan(""));
  if (result.text != nullptr && result.text_size > 0) {
    const std::string& said = tried.result.message;
    const std::size_t length = std::min<std::size_t>(said.size(), result.text_size - 1);
    std::copy_n(said.data(), length, result.text);
    result.text[length] = '\0';
  }
  const std::lock_guard lock(mutex_);
  tried_.insert_or_assign(edges, std::move(tried));
}

void Search::Hear(const std::int32_t* arcs, std::int32_t count, const sy_result& result) {
  if (count == 0) {
    relaxation_ended_ =
        result.termination == SY_OPTIMAL || result.termination == SY_NUMERICAL_TROUBLE;
    answer_.relaxation_seconds = result.seconds;
    answer_.subsolvers = {result.text};
    return;
  }
  RoundedPath path;
  path.edges = EdgesOf(arcs, count);
  path.cost = result.objective;
  path.termination = static_cast<Termination>(result.termination);
  if (result.text != nullptr) path.reason = result.text;
  const std::lock_guard lock(mutex_);
  answer_.rounded.push_back(std::move(path));
}

}  // namespace

ShortestPath FindShortestPath(const GraphOfConvexSets& graph, const Vertex& source,
                              const Vertex& target, const GraphOfConvexSetsOptions& options,
                              Host& host) {
  Require(graph.IsValid(source) && graph.IsValid(target),
          "a shortest path needs a source and a target of this graph");
  return Search(graph, source, target, options, host).Run();
}

MathematicalProgramResult GraphOfConvexSets::SolveShortestPath(
    const Vertex& source, const Vertex& target, const GraphOfConvexSetsOptions& options) const {
  return FindShortestPath(*this, source, target, options).result;
}

MathematicalProgramResult GraphOfConvexSets::SolveConvexRestriction(
    const std::vector<const Edge*>& active_edges, const GraphOfConvexSetsOptions& options,
    const MathematicalProgramResult* initial_guess) const {
  const auto vertices = VerticesOf(active_edges);
  for (const Edge* edge : active_edges) {
    Require(IsValid(*edge), "SolveConvexRestriction needs edges of this graph");
  }
  const auto program = RestrictionOf(vertices, active_edges);
  std::optional<Eigen::VectorXd> guess;
  if (initial_guess != nullptr) {
    guess = Eigen::VectorXd::Constant(program->num_vars(), std::nan(""));
    for (int j = 0; j < program->num_vars(); ++j) {
      const Variable v = program->decision_variable(j);
      if (initial_guess->Knows(v)) (*guess)[j] = initial_guess->GetSolution(v);
    }
  }
  const SolverInterface solver(
      NamesOf(options.restriction_solver != nullptr ? options.restriction_solver : options.solver));
  MathematicalProgramResult result = solver.Solve(
      *program, guess, options.restriction_solver_options.value_or(options.solver_options));
  if (result.primal != PointKind::kFeasible && result.primal != PointKind::kNearlyFeasible) {
    return result;
  }
  PathPoints path{active_edges, {}};
  for (const Vertex* v : vertices) path.points.push_back(result.GetSolution(v->x()));
  const MathematicalProgramResult slacks = result;
  SetPathPoint(*this, path, &slacks, result);
  return result;
}

}  // namespace switchyard
