#include "run.hpp"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "host_journal.hpp"
#include "kkt_choice.hpp"
#include "kkt_slot.hpp"
#include "shape.hpp"
#include "switchyard/plugin.hpp"

namespace switchyard::ipopt {
namespace {

/// Throws Failure: Ipopt gave up for a reason that is not the program's.
void CheckStatus(Ipopt::ApplicationReturnStatus status) {
  if (status == Ipopt::Invalid_Option) {
    throw plugin::Failure(SY_E_ARGUMENT,
                          "Ipopt refuses these options together; its log says which");
  }
  constexpr Ipopt::ApplicationReturnStatus kBroken[] = {
      Ipopt::Invalid_Problem_Definition, Ipopt::Unrecoverable_Exception,
      Ipopt::NonIpopt_Exception_Thrown, Ipopt::Internal_Error};
  if (std::find(std::begin(kBroken), std::end(kBroken), status) != std::end(kBroken)) {
    throw plugin::Failure(SY_E_INTERNAL,
                          "Ipopt broke down with its status " + std::to_string(status));
  }
}

Derivatives DerivativesOf(const sy_problem& p) {
  Derivatives d;
  d.constant_jacobian = !HasConstraints(p);
  d.constant_hessian = !HasFunctions(p);
  d.has_hessian = !HasFunctions(p) || (p.nlp->provides & SY_HESSIAN) != 0;
  return d;
}

/// A program, and how it is given to Ipopt.
struct Given {
  const sy_problem& problem;
  const Shape& shape;
  const Derivatives& derivatives;
  const Point& start;
};

Found RunOnce(const Given& given, Functions& functions, Way way, const KktPlan& kkt,
              const Session& session, std::int64_t before) {
  constexpr bool kConsole = false;
  Ipopt::SmartPtr<Ipopt::IpoptApplication> solver = new Ipopt::IpoptApplication(kConsole);
  Ipopt::SmartPtr<Ipopt::Journal> journal = new HostJournal(session.host);
  solver->Jnlst()->AddJournal(journal);
  session.options.Give(session.watch.control(), way, given.derivatives, kkt, *solver->Options());
  const Setting setting = {before, session.options.Real("bound_relax_factor")};
  std::istringstream no_file;  // else Ipopt reads the ipopt.opt of the folder it is run in
  Found found;
  found.status = solver->Initialize(no_file);
  if (found.status == Ipopt::Solve_Succeeded) {
    Ipopt::SmartPtr<Program> program =
        new Program(given.problem, given.shape, functions, given.start, session.watch, setting);
    const auto status = solver->OptimizeTNLP(Ipopt::GetRawPtr(program));
    found = program->found();
    found.status = status;
  }
  return found;
}

/// A limit of the user's own? Full steps have one that is not.
bool IsLimit(Ipopt::ApplicationReturnStatus status, Way way) {
  return status == Ipopt::Maximum_CpuTime_Exceeded ||
         (status == Ipopt::Maximum_Iterations_Exceeded && way != Way::kFullSteps);
}

bool IsOver(const Found& found, Way way, const Functions& functions, const Session& session) {
  return found.status == Ipopt::Solve_Succeeded || IsLimit(found.status, way) ||
         functions.ended() || session.watch.reason() != SY_NOT_SOLVED;
}

/// Where a condensed system could not be trusted, the run starts over with the augmented ones, and
/// so do later runs.
Found RunKkt(const Given& given, Functions& functions, Way way, const CondensedKkt::Counts& counts,
             KktPlan& kkt, const Session& session, std::int64_t before) {
  std::int64_t iterations = 0;
  if (kkt.condensed) {
    const KktSlot slot(counts);
    Found found = RunOnce(given, functions, way, kkt, session, before);
    if (!slot.failed() || IsOver(found, way, functions, session)) return found;
    iterations = found.iterations;
    kkt.condensed = false;
  }
  Found found = RunOnce(given, functions, way, kkt, session, before + iterations);
  found.iterations += iterations;
  return found;
}

KktPlan PlanOf(KktForm form, const KktShape& shape) {
  const bool wanted =
      form == KktForm::kCondensed || (form == KktForm::kAuto && shape.condensed_is_cheaper);
  return {wanted && KktSlot::IsOpen(), shape.has_dense_column};
}

std::vector<Way> Ways(const sy_problem& p, const Point& start, const Options& options) {
  if (start.Complete(p)) return {Way::kWarm, Way::kLineSearch};
  const bool convex = p.P == nullptr || (p.flags & SY_PROBLEM_CONVEX) != 0;
  const bool full_steps = convex && !HasFunctions(p) && !options.ChoosesItsWay();
  if (full_steps) return {Way::kFullSteps, Way::kLineSearch};
  return {Way::kLineSearch};
}

}  // namespace

// Once the budget is spent or a function has ended the solve every evaluation fails, and Ipopt ends
// with whatever its algorithm was in.
Found Run(const sy_problem& problem, Functions& functions, const Point& start,
          const Session& session, std::int64_t before) {
  const Derivatives derivatives = DerivativesOf(problem);
  const Shape shape(problem, session.options.UsesHessian(derivatives));
  const KktShape kkt_shape = KktShapeOf(problem, shape);
  KktPlan kkt = PlanOf(session.options.Form(), kkt_shape);
  const Given given = {problem, shape, derivatives, start};
  Found found;
  std::int64_t iterations = 0;
  for (const Way way : Ways(problem, start, session.options)) {
    found = RunKkt(given, functions, way, kkt_shape.counts, kkt, session, before + iterations);
    iterations += found.iterations;
    if (found.status == Ipopt::Solve_Succeeded || IsLimit(found.status, way)) break;
    if (functions.ended() || session.watch.reason() != SY_NOT_SOLVED) {
      found.status = Ipopt::User_Requested_Stop;
      break;
    }
    CheckStatus(found.status);
  }
  found.iterations = iterations;
  return found;
}

}  // namespace switchyard::ipopt
