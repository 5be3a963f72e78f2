#include "tests/mip/enumerate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/host/instance.hpp"
#include "tests/support/answer_errors.hpp"

namespace switchyard::testing {
namespace {

constexpr double kHolds = 1e-9;   // violation up to which what has no variable left holds
constexpr double kBroken = 1e-5;  // from which it does not
constexpr double kProven = 1e-7;  // error of a certificate, relative

enum class Verdict { kOptimal, kInfeasible, kUndecided };

struct RestAnswer {
  Verdict verdict = Verdict::kUndecided;
  double objective = kInfinity;
};

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

/// The columns with keep[j].
Csc KeepColumns(const Csc& m, const std::vector<std::uint8_t>& keep) {
  Csc kept(m.rows, 0);
  for (std::size_t j = 0; j < keep.size(); ++j) {
    if (keep[j] == 0) continue;
    for (auto k = At(m.start[j]); k < At(m.start[j + 1]); ++k) {
      kept.row.push_back(m.row[k]);
      kept.value.push_back(m.value[k]);
    }
    kept.start.push_back(static_cast<std::int32_t>(kept.row.size()));
    ++kept.cols;
  }
  return kept;
}

/// What integers fixed to x leave over the continuous variables.
class Rest {
 public:
  Rest(const ProblemData& whole, const Vector& x) : whole_(whole) {
    std::vector<std::uint8_t> kept(x.size());
    for (std::size_t j = 0; j < x.size(); ++j) kept[j] = whole.integer[j] == 0;
    d_.num_vars = static_cast<std::int32_t>(std::count(kept.begin(), kept.end(), 1));
    d_.flags = whole.flags;
    d_.x_lower = Keep(whole.x_lower, kept);
    d_.x_upper = Keep(whole.x_upper, kept);
    TakeObjective(x, kept);
    TakeRows(x, kept);
    TakeCones(x, kept);
  }
  /// Known without a solve: nothing that is constant holds, or no variable is left.
  [[nodiscard]] bool is_decided() const { return worst_ > kHolds || d_.num_vars == 0; }
  [[nodiscard]] RestAnswer Decided() const {
    if (worst_ > kBroken) return {Verdict::kInfeasible, kInfinity};
    if (worst_ > kHolds) return {};
    return {Verdict::kOptimal, d_.offset};
  }
  [[nodiscard]] const ProblemData& data() const { return d_; }

 private:
  void TakeObjective(const Vector& x, const std::vector<std::uint8_t>& kept) {
    Vector slope = whole_.q;
    SymmetricMultiplyAdd(whole_.P.View(), 1, x.data(), slope.data());
    d_.q = Keep(slope, kept);
    d_.offset = Objective(Problem(whole_).view(), x.data());
    const Csc columns = KeepColumns(whole_.P, kept);
    d_.P = columns.nonzeros() > 0 ? KeepRows(columns, kept) : Csc(d_.num_vars, d_.num_vars);
  }

  void TakeRows(const Vector& x, const std::vector<std::uint8_t>& kept) {
    const Vector fixed = Product(whole_.A, x);
    const Csc A = KeepColumns(whole_.A, kept);
    std::vector<std::uint8_t> varies(fixed.size(), 0);
    for (const std::int32_t i : A.row) varies[At(i)] = 1;
    for (std::size_t i = 0; i < fixed.size(); ++i) {
      const double lower = whole_.row_lower[i] - fixed[i], upper = whole_.row_upper[i] - fixed[i];
      if (varies[i] == 0) {
        worst_ = std::max(worst_, Outside(0, lower, upper));
        continue;
      }
      d_.row_lower.push_back(lower);
      d_.row_upper.push_back(upper);
    }
    d_.A = KeepRows(A, varies);
  }

  void TakeCones(const Vector& x, const std::vector<std::uint8_t>& kept) {
    Vector s = whole_.g;
    MultiplyAdd(whole_.F.View(), 1, x.data(), s.data());
    const Csc F = KeepColumns(whole_.F, kept);
    std::vector<std::uint8_t> varies(s.size(), 0), stays(s.size(), 0), linear(s.size(), 0);
    for (const std::int32_t i : F.row) varies[At(i)] = 1;
    std::size_t first = 0;
    for (const sy_cone& cone : whole_.cones) {
      const std::size_t behind = first + At(cone.dim);
      if (std::count(varies.begin() + std::ptrdiff_t(first),
                     varies.begin() + std::ptrdiff_t(behind), 1) == 0) {
        worst_ =
            std::max(worst_, FactsOf(cone.kind).violation(&s[first], cone.dim, cone.parameter));
      } else if (!TakeFace(cone, first, s, varies, linear)) {
        std::fill(stays.begin() + std::ptrdiff_t(first), stays.begin() + std::ptrdiff_t(behind), 1);
        d_.cones.push_back(cone);
      }
      first = behind;
    }
    d_.F = KeepRows(F, stays);
    d_.g = Keep(s, stays);
    d_.A = StackRows(d_.A, KeepRows(F, linear));
  }

  /// Where a constant entry confines a cone to a face that linear rows describe: those, and true.
  /// Entry i is then 0, at least 0 or at most 0, by `face[i]` = '0', '+', '-'.
  bool TakeFace(const sy_cone& cone, std::size_t first, const Vector& s,
                const std::vector<std::uint8_t>& varies, std::vector<std::uint8_t>& linear) {
    const auto is_zero = [&](std::size_t i) {
      return varies[first + i] == 0 && std::abs(s[first + i]) <= 1e-12;
    };
    std::string face(At(cone.dim), '0');
    const bool two = cone.kind == SY_CONE_ROTATED || cone.kind == SY_CONE_POWER;
    if (cone.kind == SY_CONE_EXPONENTIAL && is_zero(1)) {
      face = "-0+";
    } else if (two && (is_zero(0) || is_zero(1))) {
      face[0] = face[1] = '+';
    } else if (cone.kind != SY_CONE_SECOND_ORDER || !is_zero(0)) {
      return false;
    }
    for (std::size_t i = 0; i < face.size(); ++i) {
      const double lower = face[i] == '-' ? -kInfinity : 0, upper = face[i] == '+' ? kInfinity : 0;
      const double at = s[first + i];
      if (varies[first + i] == 0) {
        worst_ = std::max(worst_, Outside(at, lower, upper));
        continue;
      }
      linear[first + i] = 1;
      d_.row_lower.push_back(lower - at);
      d_.row_upper.push_back(upper - at);
    }
    return true;
  }

  const ProblemData& whole_;
  ProblemData d_;
  double worst_ = 0;  // violation of what is constant
};

/// By the first backend whose certificate holds.
RestAnswer Solved(Host& host, const ProblemData& d, const std::vector<std::string>& backends) {
  const Problem problem(d);
  for (const std::string& name : backends) {
    if (host.Find(name) == nullptr) continue;
    const BackendAnswer found = SolveThroughHost(host, name, problem.view(), Unlimited());
    const Vectors at{found.x, found.x_dual, found.row_dual, found.cone_dual};
    const double size = 1 + std::abs(found.result.objective);
    if (found.result.termination == SY_OPTIMAL && OptimumError(d, at) <= kProven * size) {
      return {Verdict::kOptimal, Objective(problem.view(), found.x.data())};
    }
    if (found.result.termination == SY_INFEASIBLE && ContradictionError(d, at) <= kProven) {
      return {Verdict::kInfeasible, kInfinity};
    }
  }
  return {};
}

/// The next assignment in the order of an odometer; false behind the last.
bool Advance(const ProblemData& d, Vector& x) {
  for (std::size_t j = 0; j < x.size(); ++j) {
    if (d.integer[j] == 0) continue;
    if (++x[j] <= d.x_upper[j]) return true;
    x[j] = d.x_lower[j];
  }
  return false;
}

/// No objective of a rest, whose curvature is at least 0, is below this over its box.
double LeastObjective(const ProblemData& rest) {
  double least = rest.offset;
  for (std::size_t j = 0; j < rest.q.size(); ++j) {
    if (rest.q[j] != 0) least += std::min(rest.q[j] * rest.x_lower[j], rest.q[j] * rest.x_upper[j]);
  }
  return least;
}

}  // namespace

sy_control Unlimited(int threads) {
  sy_control c = {};
  c.size = sizeof c;
  c.threads = threads;
  c.seconds = kInfinity;
  c.iterations = c.nodes = std::numeric_limits<std::int64_t>::max();
  c.cutoff = kInfinity;
  c.target = -kInfinity;
  c.feasibility = c.optimality = c.integrality = c.absolute_gap = c.relative_gap = std::nan("");
  return c;
}

BackendAnswer SolveThroughHost(Host& host, const std::string& backend, const sy_problem& problem,
                               const sy_control& control, const std::vector<std::string>& options) {
  BackendAnswer answer;
  answer.x.assign(At(problem.num_vars), 0.0);
  answer.x_dual = answer.x;
  answer.row_dual.assign(At(problem.num_rows), 0.0);
  answer.cone_dual.assign(At(problem.num_cone_rows), 0.0);
  std::string text(512, '\0');
  sy_result& r = answer.result;
  r.size = sizeof r;
  r.x = answer.x.data();
  r.x_dual = answer.x_dual.data();
  r.row_dual = answer.row_dual.data();
  r.cone_dual = answer.cone_dual.data();
  r.text = text.data();
  r.text_size = text.size();
  try {
    const Backend& found = *host.Find(backend);
    Instance instance(*host.Facade(found), *host.table());
    for (const std::string& option : options) {
      const std::string name = option.substr(0, option.find('='));
      const std::string value = option.substr(name.size() + 1);
      instance.SetOption(name, ParseOptionValue(*FindOption(found.facts, name), value));
    }
    instance.Load(problem, 0);
    instance.Solve(control, r);
  } catch (const BackendError& e) {
    answer.status = e.code();
    answer.error = e.reason();
  }
  answer.text = text.c_str();
  return answer;
}

Enumerated Enumerate(Host& host, const ProblemData& problem,
                     const std::vector<std::string>& continuous) {
  Enumerated found;
  Vector x(At(problem.num_vars), 0.0);
  for (std::size_t j = 0; j < x.size(); ++j) {
    if (problem.integer[j] != 0) x[j] = problem.x_lower[j];
  }
  do {
    const Rest rest(problem, x);
    if (LeastObjective(rest.data()) >= found.optimum) continue;
    const RestAnswer answer =
        rest.is_decided() ? rest.Decided() : Solved(host, rest.data(), continuous);
    if (answer.verdict == Verdict::kUndecided) ++found.undecided;
    if (answer.objective >= found.optimum) continue;
    found.optimum = answer.objective;
    found.integers = x;
  } while (Advance(problem, x));
  return found;
}

}  // namespace switchyard::testing
