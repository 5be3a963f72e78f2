// The box of a set: every end proven.
//
// Propagation over rows and cones closes most. Where it leaves ends open, each coordinate is
// minimized and maximized over the set by a backend, and its duals give a bound b_i(M) that holds
// for all points with |x|_inf <= M: b_i(M) = b_i(0) + e_i M, e_i the sum of the residuals. If M_0
// is above every b_i(M_0) and e_i < 1, no point lies outside M_0: one with |x|_inf = M > M_0
// attained at i would have M <= b_i(M) = b_i(M_0) + e_i (M - M_0), so M < M_0.
#include "core/sets/box.hpp"

#include <algorithm>
#include <cmath>

#include "core/host/instance.hpp"
#include "core/solve/recovery.hpp"
#include "switchyard/boxes.hpp"
#include "switchyard/host/host.hpp"
#include "switchyard/safe_bound.hpp"

namespace switchyard {
namespace {

struct Duals {
  std::vector<double> row;
  std::vector<double> cone;
};

/// The duals of min sign x_i over the set; none where it ended otherwise than at an optimum.
class CoordinateSolver {
 public:
  explicit CoordinateSolver(ProblemData data) : problem_(std::move(data)) {
    Host& host = Host::Default();
    for (const Candidate& candidate : host.Rank(problem_.view())) {
      if (!candidate.suitable) break;
      if ((candidate.backend->facts.traits & SY_GIVES_DUALS) == 0) continue;
      instance_ = std::make_unique<Instance>(*host.Facade(*candidate.backend), *host.table());
      instance_->Load(problem_.view(), SY_UPDATES_VECTORS);
      break;
    }
  }

  [[nodiscard]] bool Solve(int i, double sign, Duals* duals) {
    if (instance_ == nullptr) return false;
    problem_.Change([&](ProblemData& d) {
      std::fill(d.q.begin(), d.q.end(), 0.0);
      d.q[static_cast<std::size_t>(i)] = sign;
    });
    sy_update update{};
    update.size = sizeof update;
    update.whole = SY_UPDATES_VECTORS;
    update.problem = &problem_.view();
    instance_->Update(update);
    AnswerBuffers answer(problem_.data());
    instance_->Solve(PlainControl(), answer.raw);
    if (answer.raw.termination != SY_OPTIMAL || answer.raw.dual == SY_NO_POINT) return false;
    *duals = {answer.vectors.row_dual, answer.vectors.cone_dual};
    return true;
  }

  /// An end of sign x_i from these duals over |x|_inf <= radius.
  [[nodiscard]] double Bound(int i, double sign, const Duals& duals, double radius) {
    problem_.Change([&](ProblemData& d) {
      std::fill(d.q.begin(), d.q.end(), 0.0);
      d.q[static_cast<std::size_t>(i)] = sign;
    });
    const std::vector<double> lower(problem_.data().q.size(), -radius);
    const std::vector<double> upper(problem_.data().q.size(), radius);
    return SafeDualBound(problem_.view(), nullptr, duals.row.empty() ? nullptr : duals.row.data(),
                         duals.cone.empty() ? nullptr : duals.cone.data(), lower.data(),
                         upper.data())
        .value;
  }

 private:
  static sy_control PlainControl() {
    sy_control control{};
    control.size = sizeof control;
    control.threads = 1;
    control.seconds = control.cutoff = kInfinity;
    control.iterations = control.nodes = std::numeric_limits<std::int64_t>::max();
    control.target = -kInfinity;
    control.feasibility = control.optimality = control.integrality = std::nan("");
    control.absolute_gap = control.relative_gap = std::nan("");
    return control;
  }

  Problem problem_;
  std::unique_ptr<Instance> instance_;
};

/// One end of one coordinate: sign x_i >= the bound.
struct End {
  int i;
  double sign;
  Duals duals;
};

/// Every end by a program of its own; false where one has no optimum, or the ends prove nothing.
bool CloseByPrograms(const ScaledSet& set, SetBox& box) {
  CoordinateSolver solver(AtScaleOne(set));
  std::vector<End> ends;
  double radius = 1;
  for (int i = 0; i < set.dim; ++i) {
    for (const double sign : {1.0, -1.0}) {
      End end{i, sign, {}};
      if (!solver.Solve(i, sign, &end.duals)) return false;
      radius = std::max(radius, 2 * std::abs(solver.Bound(i, sign, end.duals, 1)));
      ends.push_back(std::move(end));
    }
  }
  for (const End& end : ends) {
    const double at_radius = solver.Bound(end.i, end.sign, end.duals, radius);
    const double at_double = solver.Bound(end.i, end.sign, end.duals, 2 * radius);
    const bool holds = -at_radius < radius && at_radius - at_double < 0.5 * radius;
    if (!holds) return false;
    if (end.sign > 0) {
      box.lower[end.i] = std::max(box.lower[end.i], at_radius);
    } else {
      box.upper[end.i] = std::min(box.upper[end.i], -at_radius);
    }
  }
  return true;
}

}  // namespace

bool IsProvenEmpty(const ScaledSet& set) {
  const Problem problem(AtScaleOne(set));
  return ProvenBoxes(problem.view()).infeasible;
}

SetBox BoxOf(const ScaledSet& set) {
  const Problem problem(AtScaleOne(set));
  const Boxes found = ProvenBoxes(problem.view());
  SetBox box{Eigen::Map<const Eigen::VectorXd>(found.lower.data(), set.dim),
             Eigen::Map<const Eigen::VectorXd>(found.upper.data(), set.dim), found.infeasible};
  if (box.empty || box.is_finite()) return box;
  SetBox closed = box;
  try {
    if (CloseByPrograms(set, closed)) return closed;
  } catch (const BackendError&) {  // then the ends stay open
  }
  return box;
}

}  // namespace switchyard
