// The two forms of a relaxation: both below every path, the one that counts transitions not below
// the other.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "core/gcs/transcription.hpp"
#include "core/solve/choice.hpp"
#include "core/solve/control.hpp"
#include "core/solve/recovery.hpp"
#include "tests/gcs/every_path.hpp"
#include "tests/gcs/random_graphs.hpp"

namespace switchyard::testing {
namespace {

// Before the process's own host is made.
[[maybe_unused]] const int set_before_main =
    setenv("SWITCHYARD_PLUGIN_PATH", SWITCHYARD_PLUGIN_FOLDER, 1);

constexpr const char* kStrategy = "org.switchyard.relax-and-round";

/// Infinite where it has no point, NaN where that is not known.
double CostOfRelaxation(const PrunedGraph& graph, bool transitions) {
  const GcsTranscription program(graph, GraphOfConvexSets::Transcription::kRelaxation, transitions);
  Host& host = Host::Default();
  SolverOptions options;
  options.options[kStrategy] = {{"paths", 0}, {"cut_rounds", 0}};
  const BackendChoice choice =
      ChooseBackend(host, program.problem().view(), {kStrategy, &options, host.table(), 0, {}});
  AnswerBuffers answer(program.problem().data());
  SolveControl control(options, false);
  choice.instance->Solve(control.Record(options.time_limit, false), answer.raw);
  return answer.raw.termination == SY_INFEASIBLE ? kInfinity : answer.raw.relaxed;
}

TEST(Relaxations, AreBelowEveryPathAndNoLooserWithTransitions) {
  if (Host::Default().Find(kStrategy) == nullptr) GTEST_SKIP() << kStrategy << " is not built";
  int tighter = 0;
  for (unsigned seed = 1; seed <= 150; ++seed) {
    SCOPED_TRACE("graph " + std::to_string(seed));
    const RandomGraph g(seed);
    if (g.kind.tagged) continue;
    EveryPath every(g.graph, g.source(), g.target());
    const PrunedGraph pruned = Prune(g.graph, g.source(), g.target(), true);
    if (every.size() > 100 || !pruned.why_no_path.empty()) continue;
    every.Solve();
    const double plain = CostOfRelaxation(pruned, false);
    const double counted = CostOfRelaxation(pruned, true);
    const double slack = 1e-6 * (1 + std::abs(plain));
    EXPECT_LE(counted, every.best() + slack);
    EXPECT_LE(plain, counted + slack);
    tighter += counted > plain + 1e-3 ? 1 : 0;
  }
  EXPECT_GT(tighter, 0);
}

}  // namespace
}  // namespace switchyard::testing
