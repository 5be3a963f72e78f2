// The box of a set: every end proven.
//
// Propagation over rows and cones closes most. Where it leaves ends open, of the set's coordinates
// or of its own variables, each is minimized: over rows alone by the dense simplex method, else by
// a backend. The duals of end i give a bound b_i(M) that holds for all points whose open ends are
// within M: b_i(M) = b_i(0) + e_i M, e_i the sum of the residuals. If M_0 is above every b_i(M_0)
// and e_i < 1, no point lies outside M_0: one whose farthest is M > M_0, attained at i, would have
// M <= b_i(M) = b_i(M_0) + e_i (M - M_0), so M < M_0.
#include "core/sets/box.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "core/host/instance.hpp"
#include "core/sets/section_lp.hpp"
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
/// The duals of min sign v_i, v = (x, w); none where it ended otherwise than at an optimum.
using EndSolver = std::function<std::optional<Duals>(std::size_t i, double sign)>;

void Minimize(Problem& problem, std::size_t i, double sign) {
  problem.Change([&](ProblemData& d) {
    std::fill(d.q.begin(), d.q.end(), 0.0);
    d.q[i] = sign;
  });
}

/// By the first backend that gives duals.
class BackendEnds {
 public:
  explicit BackendEnds(const ProblemData& data) : problem_(data) {
    Host& host = Host::Default();
    for (const Candidate& candidate : host.Rank(problem_.view())) {
      if (!candidate.suitable) break;
      if ((candidate.backend->facts.traits & SY_GIVES_DUALS) == 0) continue;
      instance_ = std::make_unique<Instance>(*host.Facade(*candidate.backend), *host.table());
      instance_->Load(problem_.view(), SY_UPDATES_VECTORS);
      break;
    }
  }

  std::optional<Duals> operator()(std::size_t i, double sign) {
    if (instance_ == nullptr) return std::nullopt;
    Minimize(problem_, i, sign);
    sy_update update{};
    update.size = sizeof update;
    update.whole = SY_UPDATES_VECTORS;
    update.problem = &problem_.view();
    instance_->Update(update);
    AnswerBuffers answer(problem_.data());
    instance_->Solve(PlainControl(), answer.raw);
    if (answer.raw.termination != SY_OPTIMAL || answer.raw.dual == SY_NO_POINT) return std::nullopt;
    return Duals{answer.vectors.row_dual, answer.vectors.cone_dual};
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

/// By the dense simplex method, each from where the last one ended.
class DenseEnds {
 public:
  explicit DenseEnds(const ScaledSet& set) : lp_(SectionLp(set, Eigen::VectorXd::Zero(set.dim))) {}

  std::optional<Duals> operator()(std::size_t i, double sign) {
    std::fill(lp_.c.begin(), lp_.c.end(), 0.0);
    lp_.c[i] = sign;
    const DenseLpAnswer& answer = first_ ? simplex_.Solve(lp_) : simplex_.SolveAgain(lp_);
    first_ = false;
    empty_ = empty_ || answer.status == DenseLpStatus::kInfeasible;
    if (answer.status != DenseLpStatus::kOptimal) return std::nullopt;
    return Duals{answer.row_dual, {}};
  }
  [[nodiscard]] bool empty() const { return empty_; }

 private:
  DenseLp lp_;
  DenseSimplex simplex_;
  bool first_ = true;
  bool empty_ = false;
};

/// The open ends of a box, and what duals prove of them.
class Ends {
 public:
  Ends(ProblemData data, const Boxes& box) : problem_(std::move(data)), box_(box) {
    for (std::size_t i = 0; i < box_.lower.size(); ++i) {
      if (std::isinf(box_.lower[i])) open_.push_back({i, 1, {}});
      if (std::isinf(box_.upper[i])) open_.push_back({i, -1, {}});
    }
  }

  /// Asks for the duals of each; false at the first that has none, unless `rest_anyway`.
  bool Solve(const EndSolver& solve, bool rest_anyway) {
    std::vector<End> solved;
    for (End& end : open_) {
      std::optional<Duals> duals = solve(end.i, end.sign);
      if (!duals && !rest_anyway) return false;
      if (duals) solved.push_back({end.i, end.sign, std::move(*duals)});
    }
    open_ = std::move(solved);
    return true;
  }

  /// The box with the ends that the duals prove; those of the rest are open as they were.
  Boxes Close() {
    double radius = 1;
    for (std::size_t k = 0; k < open_.size();) {
      const double bound = Bound(open_[k], 1);
      if (std::isinf(bound)) {  // then it has no range that another one's residual could be against
        open_.erase(open_.begin() + static_cast<std::ptrdiff_t>(k));
        k = 0;
        radius = 1;
        continue;
      }
      radius = std::max(radius, 2 * std::max(std::abs(bound), OtherEnd(open_[k])));
      ++k;
    }
    Boxes closed = box_;
    for (const End& end : open_) {
      const double at_radius = Bound(end, radius);
      const double at_double = Bound(end, 2 * radius);
      const bool holds = -at_radius < radius && at_radius - at_double < 0.5 * radius;
      if (!holds) return box_;
      if (end.sign > 0) {
        closed.lower[end.i] = at_radius;
      } else {
        closed.upper[end.i] = -at_radius;
      }
    }
    return closed;
  }

 private:
  struct End {
    std::size_t i;
    double sign;
    Duals duals;
  };

  [[nodiscard]] double OtherEnd(const End& end) const {
    const double other = (end.sign > 0 ? box_.upper : box_.lower)[end.i];
    return std::isfinite(other) ? std::abs(other) : 0;
  }

  /// Of sign v_i, where the ends with duals are within `radius`; -infinity where there is none.
  double Bound(const End& end, double radius) {
    Minimize(problem_, end.i, end.sign);
    std::vector<double> lower = box_.lower;
    std::vector<double> upper = box_.upper;
    for (const End& other : open_) {
      (other.sign > 0 ? lower : upper)[other.i] = other.sign * -radius;
    }
    const auto start = [](const std::vector<double>& v) { return v.empty() ? nullptr : v.data(); };
    return SafeDualBound(problem_.view(), nullptr, start(end.duals.row), start(end.duals.cone),
                         lower.data(), upper.data())
        .value;
  }

  Problem problem_;
  Boxes box_;
  std::vector<End> open_;
};

SetBox BoxOfColumns(const Boxes& boxes, int dim) {
  return {Eigen::Map<const Eigen::VectorXd>(boxes.lower.data(), dim),
          Eigen::Map<const Eigen::VectorXd>(boxes.upper.data(), dim), boxes.infeasible};
}

}  // namespace

bool IsProvenEmpty(const ScaledSet& set) {
  const Problem problem(AtScaleOne(set));
  return ProvenBoxes(problem.view()).infeasible;
}

SetBox BoxOf(const ScaledSet& set) {
  const ProblemData data = AtScaleOne(set);
  const Boxes found = ProvenBoxes(Problem(data).view());
  const SetBox box = BoxOfColumns(found, set.dim);
  if (box.empty || box.is_finite()) return box;
  Ends ends(data, found);
  if (IsSmallPolyhedron(set)) {
    DenseEnds dense(set);
    ends.Solve(std::ref(dense), true);
    if (dense.empty()) return {box.lower, box.upper, true};
    return BoxOfColumns(ends.Close(), set.dim);
  }
  try {
    BackendEnds backend(data);
    if (ends.Solve(std::ref(backend), false)) return BoxOfColumns(ends.Close(), set.dim);
  } catch (const BackendError&) {  // then the ends stay open
  }
  return box;
}

}  // namespace switchyard
