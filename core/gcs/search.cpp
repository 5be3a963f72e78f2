#include "core/gcs/search.hpp"

#include <algorithm>
#include <cmath>

#include "core/gcs/boundedness.hpp"
#include "core/gcs/detached_cycles.hpp"
#include "core/gcs/restriction.hpp"
#include "core/solve/control.hpp"
#include "core/solve/dump.hpp"
#include "switchyard/arcs.hpp"
#include "switchyard/error.hpp"
#include "switchyard/plugin.hpp"

namespace switchyard {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kRelaxAndRound = "org.switchyard.relax-and-round";
constexpr const char* kBranchAndBound = "org.switchyard.branch-and-bound";
constexpr int kPaths = 10;

std::string NamesOf(const SolverInterface* solver) {
  return solver == nullptr ? "" : solver->solver_id().name();
}

void Say(const std::string& text, sy_result& result) {
  if (result.text == nullptr || result.text_size == 0) return;
  const std::size_t length = std::min<std::size_t>(text.size(), result.text_size - 1);
  std::copy_n(text.data(), length, result.text);
  result.text[length] = '\0';
}

// A start on an axis of symmetry, as optima of convex terms are, may stay there: at a saddle.
void LeaveSymmetry(Eigen::VectorXd& start) {
  constexpr double kApart = 1e-4;
  Random random(1);
  for (double& x : start) x += kApart * (1 + std::abs(x)) * (2 * random.Uniform() - 1);
}

}  // namespace

Search::Search(const GraphOfConvexSets& graph, const Vertex& source, const Vertex& target,
               const GraphOfConvexSetsOptions& options, WrittenProgram& written, Host& host)
    : graph_(graph),
      source_(source),
      target_(target),
      options_(options),
      written_(written),
      host_(host),
      as_(TranscriptionOf(options)) {}

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

bool Search::rounds() const {
  return as_ == Transcription::kRelaxation && options_.max_rounded_paths.value_or(kPaths) > 0;
}

// The path of one vertex: its set, its terms. No edge is on it.
void Search::OneVertex() {
  for (const Edge* edge : graph_.Edges()) {
    if (edge->phi_value() != true) continue;
    result().termination = Termination::kInfeasible;
    result().message = Text("the path of vertex ", source_.name(), " alone has no edges, and edge ",
                            edge->name(), " must be on it");
    return;
  }
  SolverOptions options = options_.restriction_solver_options.value_or(options_.solver_options);
  answer_.result = SolveRestriction({}, options, nullptr).result;
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
  transcription_ = std::make_unique<GcsTranscription>(pruned_, as_, true, &written_);
  sy_paths& paths = transcription_->paths();
  paths.context = this;
  paths.tried = [](void* context, const std::int32_t* arcs, std::int32_t count,
                   const sy_result* result) noexcept {
    try {
      static_cast<Search*>(context)->Hear(arcs, count, *result);
    } catch (...) {  // a path that is not listed is not lost: the answer is the strategy's
    }
  };
  tags_ = transcription_->same_terms() ? TermTags() : TagsOf(pruned_, as_);
  const bool by_another =
      options_.restriction_solver != nullptr || options_.restriction_solver_options.has_value();
  if (!tags_.same || by_another) {
    paths.flags = tags_.bounds ? SY_PATHS_BOUND : 0;
    paths.solve_path = [](void* context, const std::int32_t* arcs, std::int32_t count,
                          const sy_control* control, sy_result* result, sy_error* error) noexcept {
      return plugin::Guarded(error, [&] {
        static_cast<Search*>(context)->SolvePath(arcs, count, plugin::Whole(*control), *result);
      });
    };
  }
  WarnOfUnbounded();
  result().seconds.lower += Since(start);
}

void Search::WarnOfUnbounded() {
  constexpr std::size_t kNamed = 3;
  const std::vector<const Vertex*> unbounded = UnboundedVertices(pruned_, written_.blocks);
  for (std::size_t k = 0; k < std::min(unbounded.size(), kNamed); ++k) {
    result().notes.push_back(Text(
        "vertex ", unbounded[k]->name(),
        ": its set is not known to be bounded, so that at a flow of 0 a point may be far away: "
        "bounds hold, and paths come from their restrictions alone"));
  }
  if (unbounded.size() <= kNamed) return;
  result().notes.push_back(Text("and ", unbounded.size() - kNamed, " more vertices like it"));
}

// Who is asked, with what options of its own. The integer program goes to a backend that was named
// and takes it whole; else to branch and bound, over the one that was named.
std::string Search::AskedFirst(SolverOptions& options) const {
  const std::string named = NamesOf(options_.solver);
  if (as_ == Transcription::kRelaxation) {
    auto& own = options.options[kRelaxAndRound];
    own["solver"] = named;
    own["paths"] = options_.max_rounded_paths.value_or(kPaths);
    own["trials"] = options_.max_rounding_trials;
    own["flow_tolerance"] = options_.flow_tolerance;
    return kRelaxAndRound;
  }
  if (host_.Find(kBranchAndBound) == nullptr) return named;
  const auto ranked = host_.Rank(transcription_->problem().view(), named);
  const bool takes_it = !named.empty() && std::any_of(ranked.begin(), ranked.end(),
                                                      [](const auto& c) { return c.suitable; });
  if (takes_it) return named;
  if (!named.empty()) options.options[kBranchAndBound]["solver"] = named;
  return kBranchAndBound;
}

bool Search::Load() {
  const auto start = Clock::now();
  SolverOptions options = options_.solver_options;
  options.seed = static_cast<std::uint64_t>(options_.rounding_seed);
  const std::string asked = AskedFirst(options);
  const BackendWish wish{asked, &options, host_.table(), 0, {}};
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
  if (as_ == Transcription::kMIP) {
    SolveWhole();
  } else {
    SolveOnce(transcription_->problem().data());
  }
  result().seconds.solve += Since(start);
}

// Did anything come back?
bool Search::SolveOnce(const ProblemData& data) {
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
  return !failed_;
}

// Flows that are integral may hold cycles beside the path. One that costs less than nothing, or
// that holds an edge that must be on the path, is forbidden, and the program solved again; others
// are left out of the answer.
void Search::SolveWhole() {
  ProblemData data = transcription_->problem().data();
  while (SolveOnce(data)) {
    if (raw_->raw.primal != SY_FEASIBLE && raw_->raw.primal != SY_NEARLY_FEASIBLE) return;
    if (!ForbidCycles(pruned_, *transcription_, raw_->vectors.x, data)) return;
    data.hints = nullptr;  // they know nothing of the new rows
    forbidding_ = Problem(data);
    choice_.instance->Load(forbidding_.view(), 0);
    ++answer_.cycle_rounds;
  }
}

std::vector<const Search::Edge*> Search::EdgesOf(const std::int32_t* arcs,
                                                 std::int32_t count) const {
  std::vector<const Edge*> edges;
  for (std::int32_t k = 0; k < count; ++k) {
    edges.push_back(pruned_.edges[static_cast<std::size_t>(arcs[k])]);
  }
  return edges;
}

Search::Tried Search::SolveRestriction(const std::vector<const Edge*>& edges, SolverOptions options,
                                       const MathematicalProgramResult* guide) const {
  Tried tried;
  tried.program =
      edges.empty() ? RestrictionOf({&source_}, {}) : RestrictionOf(VerticesOf(edges), edges);
  std::optional<Eigen::VectorXd> start;
  if (guide != nullptr) start = StartFrom(*guide, *tried.program, edges);
  if (start) LeaveSymmetry(*start);
  const bool own = options_.restriction_solver != nullptr;
  const SolverInterface named(NamesOf(own ? options_.restriction_solver : options_.solver), host_);
  tried.result = named.Solve(*tried.program, start, options);
  // The solver was named for the relaxation: a restriction may be of a class that it does not take.
  if (own || options_.solver == nullptr || !options_.solver->available() ||
      tried.result.termination != Termination::kNoBackend) {
    return tried;
  }
  const std::string why = tried.result.message;
  tried.result = SolverInterface("", host_).Solve(*tried.program, start, options);
  tried.result.notes.push_back(
      Text("the restriction was not solved by ", NamesOf(options_.solver), ": ", why));
  return tried;
}

void Search::SolvePath(const std::int32_t* arcs, std::int32_t count, const sy_control& control,
                       sy_result& result) {
  const std::vector<const Edge*> edges = EdgesOf(arcs, count);
  for (const Edge* edge : pruned_.edges) {
    const bool missing =
        edge->phi_value() == true && std::find(edges.begin(), edges.end(), edge) == edges.end();
    if (!missing) continue;
    result.termination = SY_INFEASIBLE;
    result.primal = SY_NO_POINT;
    return Say(Text("edge ", edge->name(), " must be on the path"), result);
  }
  SolverOptions options = options_.restriction_solver_options.value_or(options_.solver_options);
  options.time_limit = std::min(options.time_limit, control.seconds);
  options.threads = control.threads;
  MathematicalProgramResult along;
  const bool guided = result.relaxed_x != nullptr && GuideAlong(edges, result.relaxed_x, along);
  Tried tried = SolveRestriction(edges, std::move(options), guided ? &along : guide_.get());
  constexpr auto kOurs = static_cast<int>(Termination::kNoBackend);
  const auto termination = static_cast<int>(tried.result.termination);
  result.termination = termination < kOurs ? static_cast<sy_termination>(termination)
                                           : static_cast<sy_termination>(SY_NOT_SOLVED);
  result.objective = tried.result.objective;
  result.primal = tried.result.primal == PointKind::kFeasible ? SY_FEASIBLE : SY_NO_POINT;
  std::fill(result.x, result.x + transcription_->problem().data().num_vars, std::nan(""));
  Say(tried.result.message, result);
  const std::lock_guard lock(mutex_);
  tried_.insert_or_assign(edges, std::move(tried));
}

// Where restrictions start.
void Search::Guide(const double* x) {
  const std::vector<double> point(x, x + transcription_->problem().data().num_vars);
  auto guide = std::make_unique<MathematicalProgramResult>();
  SetFlowPoint(graph_, pruned_, *transcription_, point, *guide);
  guide_ = std::move(guide);
}

// Where one path's restriction starts: at the best point by the relaxation's terms, if it is one.
bool Search::GuideAlong(const std::vector<const Edge*>& edges, const double* x,
                        MathematicalProgramResult& guide) const {
  const std::vector<double> point(x, x + transcription_->problem().data().num_vars);
  const PathPoints path = PathIn(pruned_, *transcription_, point);
  if (path.edges != edges) return false;
  SetPathPoint(graph_, path, guide);
  return true;
}

void Search::Hear(const std::int32_t* arcs, std::int32_t count, const sy_result& result) {
  if (count == 0) {
    relaxation_ended_ =
        result.termination == SY_OPTIMAL || result.termination == SY_NUMERICAL_TROUBLE;
    answer_.relaxation_seconds = result.seconds;
    answer_.subsolvers = {result.text};
    if (result.relaxed_x != nullptr) Guide(result.relaxed_x);
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

}  // namespace switchyard
