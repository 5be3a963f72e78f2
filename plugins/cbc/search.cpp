#include "search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "CbcBranchDynamic.hpp"
#include "CbcCompareActual.hpp"
#include "CbcEventHandler.hpp"
#include "CbcHeuristic.hpp"
#include "CbcHeuristicDiveCoefficient.hpp"
#include "CbcHeuristicFPump.hpp"
#include "CbcHeuristicGreedy.hpp"
#include "CbcHeuristicLocal.hpp"
#include "CbcHeuristicRINS.hpp"
#include "CbcModel.hpp"
#include "CbcTree.hpp"
#include "CglClique.hpp"
#include "CglFlowCover.hpp"
#include "CglGomory.hpp"
#include "CglKnapsackCover.hpp"
#include "CglMixedIntegerRounding.hpp"
#include "CglMixedIntegerRounding2.hpp"
#include "CglProbing.hpp"
#include "CglTwomir.hpp"
#include "CglZeroHalf.hpp"

namespace switchyard::cbc {
namespace {

using coin::ClpSession;
using linear::Watch;

constexpr const char* kOnOff[] = {"on", "off", nullptr};
// Preprocessing of CBC 2.10 has been seen to lose the optimum: off unless asked for.
constexpr const char* kOffOn[] = {"off", "on", nullptr};

// Named as CBC's own command line names them.
constexpr std::array kOptions = {
    linear::WordOption("preprocess", kOffOn, "Preprocess the integer problem"),
    linear::WordOption("cutsOnOff", kOnOff, "Generate cuts"),
    linear::WordOption("heuristicsOnOff", kOnOff, "Look for incumbents beside the tree"),
    linear::IntegerOption("strongBranching", 5, 0, 999999, "Variables to try in strong branching"),
    linear::IntegerOption("trustPseudoCosts", 10, -3, 2000000,
                          "Branches before a pseudocost is trusted"),
    linear::IntegerOption("passCuts", 100, 0, 999999, "Rounds of cuts at the root"),
    linear::IntegerOption("passTreeCuts", 10, 0, 999999, "Rounds of cuts in the tree"),
    linear::IntegerOption("passFeasibilityPump", 30, 0, 10000, "Rounds of the feasibility pump"),
};

constexpr auto kOptionList = [] {
  std::array<const sy_option*, kOptions.size() + 1> list{};
  for (std::size_t k = 0; k < kOptions.size(); ++k) list[k] = &kOptions[k];
  return list;
}();

// The gap that CBC leaves open on its own beside those that are asked for: a point must be better
// by this much to be an incumbent.
double Increment(const sy_control& control) {
  constexpr double kOwn = 1e-5;
  return std::isnan(control.absolute_gap) && std::isnan(control.relative_gap) ? kOwn : 0;
}

// Hears of nodes and points, keeps the last bound that holds, and stops the search. A relaxation
// that was stopped counts as infeasible inside CBC, so no bound counts from then on.
class SearchWatch : public CbcEventHandler {
 public:
  struct Seen {
    ClpSession& session;
    double bound;
  };
  explicit SearchWatch(Seen& seen) : seen_(&seen) {}

  CbcAction event(CbcEvent which) override {
    constexpr int kInsideAHeuristic = 2048;
    Watch& watch = seen_->session.watch;
    if ((model_->specialOptions() & kInsideAHeuristic) == 0) Hear(which, watch);
    return watch.Stopped() ? stop : noAction;
  }
  [[nodiscard]] CbcEventHandler* clone() const override { return new SearchWatch(*this); }

 private:
  void Hear(CbcEvent which, Watch& watch) {
    const sy_control& control = watch.control();
    if (watch.Stopped()) return;
    if (which == node || which == treeStatus) {
      seen_->bound = std::max(seen_->bound, model_->getBestPossibleObjValue());
    }
    const double best = model_->bestSolution() != nullptr ? model_->getObjValue() : kInfinity;
    watch.Tell(model_->getIterationCount(), best, seen_->bound, model_->getNodeCount(),
               model_->tree() != nullptr ? model_->tree()->size() : 0);
    if (best <= control.target) watch.Stop(SY_TARGET);
    if (seen_->bound >= control.cutoff) watch.Stop(SY_CUTOFF);
    if (model_->getNodeCount() >= control.nodes) watch.Stop(SY_NODE_LIMIT);
    if (model_->getIterationCount() >= control.iterations) watch.Stop(SY_ITERATION_LIMIT);
  }

  Seen* seen_;
};

void AddCuts(CbcModel& model, int root_rounds, int tree_rounds) {
  constexpr int kWhereTheyHelp = -1;  // in the tree where they helped at the root
  constexpr int kAlmostAlways = -98;
  CglProbing probing;
  probing.setUsingObjective(1);
  probing.setMaxPass(1);
  probing.setMaxPassRoot(1);
  probing.setMaxProbe(10);
  probing.setMaxProbeRoot(50);
  probing.setMaxLook(10);
  probing.setMaxLookRoot(50);
  probing.setMaxElements(200);
  probing.setMaxElementsRoot(300);
  probing.setRowCuts(3);
  model.addCutGenerator(&probing, kAlmostAlways, "Probing");
  CglGomory gomory;
  gomory.setLimitAtRoot(1000);
  gomory.setLimit(50);
  model.addCutGenerator(&gomory, kAlmostAlways, "Gomory");
  CglKnapsackCover knapsack;
  model.addCutGenerator(&knapsack, kAlmostAlways, "Knapsack");
  CglClique clique;
  clique.setStarCliqueReport(false);
  clique.setRowCliqueReport(false);
  clique.setMinViolation(0.05);
  model.addCutGenerator(&clique, kAlmostAlways, "Clique");
  CglMixedIntegerRounding2 rounding(1, true, 1);
  rounding.setDoPreproc(1);
  model.addCutGenerator(&rounding, kAlmostAlways, "MixedIntegerRounding2");
  // Rows aggregated along paths close fixed-charge networks, which single rows leave open.
  constexpr int kRowsToAggregate = 6;
  CglMixedIntegerRounding aggregated(kRowsToAggregate, true, 1);
  aggregated.setDoPreproc(1);
  model.addCutGenerator(&aggregated, kAlmostAlways, "MixedIntegerRounding");
  CglFlowCover flow;
  model.addCutGenerator(&flow, kAlmostAlways, "FlowCover");
  CglTwomir twomir;
  twomir.setMaxElements(250);
  model.addCutGenerator(&twomir, kAlmostAlways, "TwoMirCuts");
  CglZeroHalf zero_half;
  model.addCutGenerator(&zero_half, kWhereTheyHelp, "ZeroHalf");
  // Small problems go through all rounds at the root, whatever a round gains (CBC reads a negative
  // number so).
  constexpr int kSmall = 500;
  model.setMaximumCutPassesAtRoot(model.getNumCols() < kSmall ? -root_rounds : root_rounds);
  model.setMaximumCutPasses(tree_rounds);
  model.setMinimumDrop(std::min(5e-2, std::abs(model.getMinimizationObjValue()) * 1e-3 + 1e-4));
}

void AddHeuristics(CbcModel& model, int pump_rounds) {
  if (pump_rounds > 0) {
    constexpr double kWholeTree = 0.5;  // of the variables fixed: worth a small branch and bound
    CbcHeuristicFPump pump(model);
    pump.setMaximumPasses(pump_rounds);
    pump.setFractionSmall(kWholeTree);
    pump.setAccumulate(1);
    pump.setWhen(13);
    pump.setMaximumRetries(2);
    model.addHeuristic(&pump, "feasibility pump");
  }
  CbcRounding rounding(model);
  model.addHeuristic(&rounding, "rounding");
  CbcHeuristicGreedyCover cover(model);
  model.addHeuristic(&cover, "greedy cover");
  CbcHeuristicLocal combine(model);
  combine.setFractionSmall(0.5);
  combine.setSearchType(1);
  model.addHeuristic(&combine, "combine solutions");
  CbcHeuristicDiveCoefficient dive(model);
  dive.setWhen(3);
  model.addHeuristic(&dive, "DiveCoefficient");
  CbcHeuristicRINS rins(model);
  rins.setFractionSmall(0.5);
  model.addHeuristic(&rins, "RINS");
}

void Configure(CbcModel& model, const linear::Settings& settings, double cutoff,
               const sy_control& control) {
  constexpr int kDefaultSeed = 1234567;  // CBC's
  // Beyond its first level CBC prints on standard output.
  model.setLogLevel(std::clamp(control.verbosity, 0, 1));
  model.setRandomSeed(control.seed == 0 ? kDefaultSeed
                                        : static_cast<int>(control.seed % 0x7fffffff));
  model.setUseElapsedTime(true);
  if (cutoff < kInfinity) model.setCutoff(cutoff);
  model.setCutoffIncrement(Increment(control));
  if (!std::isnan(control.absolute_gap)) model.setAllowableGap(control.absolute_gap);
  if (!std::isnan(control.relative_gap)) model.setAllowableFractionGap(control.relative_gap);
  if (!std::isnan(control.integrality)) model.setIntegerTolerance(control.integrality);
  model.setMaximumNodes(static_cast<int>(std::clamp<std::int64_t>(control.nodes, 0, 2147483647)));
  model.setNumberStrong(settings.Integer("strongBranching"));
  model.setNumberBeforeTrust(settings.Integer("trustPseudoCosts"));
  if (settings.Text("cutsOnOff") == "on") {
    AddCuts(model, settings.Integer("passCuts"), settings.Integer("passTreeCuts"));
  }
  if (settings.Text("heuristicsOnOff") == "on") {
    AddHeuristics(model, settings.Integer("passFeasibilityPump"));
  }
  // Small problems are searched to the end from depth 10 on, without cuts and heuristics; CLP
  // prints on standard output there unless the hint stands.
  constexpr int kSmall = 1000;
  constexpr int kCompleteFromTen = -12;
  model.solver()->setHintParam(OsiDoReducePrint, true, OsiHintTry);
  if (model.getNumRows() + model.getNumCols() < kSmall) model.setFastNodeDepth(kCompleteFromTen);
  CbcBranchDynamicDecision branching;
  model.setBranchingMethod(&branching);
  CbcCompareDefault compare;
  model.setNodeComparison(compare);
}

sy_termination Reason(const CbcModel& model, const Watch& watch) {
  if (watch.reason() != SY_NOT_SOLVED) return watch.reason();
  if (model.isProvenInfeasible()) return SY_INFEASIBLE;
  if (model.isProvenOptimal()) return SY_OPTIMAL;
  if (model.isContinuousUnbounded()) return SY_INFEASIBLE_OR_UNBOUNDED;
  if (model.isNodeLimitReached()) return SY_NODE_LIMIT;
  if (model.isSecondsLimitReached()) return SY_TIME_LIMIT;
  return SY_NUMERICAL_TROUBLE;
}

const char* Words(const CbcModel& model) {
  constexpr const char* kWords[] = {"search completed with solution",
                                    "linear relaxation not feasible (or worse than cutoff)",
                                    "stopped on gap",
                                    "stopped on nodes",
                                    "stopped on time",
                                    "stopped on user event",
                                    "stopped on solutions",
                                    "linear relaxation unbounded",
                                    "stopped on iteration limit"};
  const int status = model.secondaryStatus();
  return status >= 0 && status < 9 ? kWords[status] : "status unknown";
}

// The problem as preprocessing leaves it, owned by `process`; null where it found no point to be
// left.
OsiSolverInterface* Reduced(CglPreProcess& process, OsiClpSolverInterface& solver) {
  constexpr int kNoEqualities = 0;
  constexpr int kPasses = 10;
  CglProbing probing;
  probing.setUsingObjective(1);
  probing.setMaxPass(3);
  probing.setMaxProbeRoot(solver.getNumCols());
  probing.setMaxElements(100);
  probing.setMaxLookRoot(50);
  probing.setRowCuts(3);
  process.addCutGenerator(&probing);
  return process.preProcessNonDefault(solver, kNoEqualities, kPasses);
}

}  // namespace

const sy_option* const* OptionTable() { return kOptionList.data(); }

Found Search(OsiClpSolverInterface& solver, const linear::Settings& settings, double cutoff,
             CoinMessageHandler& log, CoinMessageHandler& quiet, ClpSession& session) {
  Watch& watch = session.watch;
  Found found;
  SearchWatch::Seen seen = {session, solver.getObjValue()};
  found.bound = seen.bound;
  const bool preprocesses = settings.Text("preprocess") == "on";
  CglPreProcess process;
  process.passInMessageHandler(&log);
  OsiSolverInterface* reduced = preprocesses ? Reduced(process, solver) : &solver;
  if (reduced == nullptr || watch.Stopped()) {
    found.termination = watch.reason() != SY_NOT_SOLVED ? watch.reason() : SY_INFEASIBLE;
    found.text = "stopped or found infeasible by preprocessing";
    return found;
  }
  CbcModel model(*reduced);
  model.passInMessageHandler(&log);
  model.solver()->passInMessageHandler(&quiet);
  model.initialSolve();
  Configure(model, settings, cutoff, watch.control());
  const SearchWatch handler(seen);
  model.passInEventHandler(&handler);
  model.setMaximumSeconds(watch.Left());
  model.branchAndBound();

  found.termination = Reason(model, watch);
  found.bound = seen.bound;
  found.iterations = model.getIterationCount();
  found.nodes = model.getNodeCount();
  // A relaxation that was stopped may look to CBC like the end of a search.
  found.text = watch.reason() != SY_NOT_SOLVED ? "stopped on user event" : Words(model);
  if (watch.reason() == SY_NOT_SOLVED) {
    found.bound =
        std::max(seen.bound, model.getBestPossibleObjValue() - Increment(watch.control()));
  }
  if (model.bestSolution() == nullptr) return found;
  session.deaf = true;  // what follows is short, and leads to the point
  if (preprocesses) process.postProcess(*model.solver());
  const double* x = preprocesses ? solver.getColSolution() : model.bestSolution();
  found.x.emplace(x, x + solver.getNumCols());
  return found;
}

}  // namespace switchyard::cbc
