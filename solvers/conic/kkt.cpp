#include "solvers/conic/kkt.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solvers/cones/kinds.hpp"
#include "solvers/conic/slacks.hpp"
#include "solvers/conic/twofold_condensing.hpp"
#include "solvers/linalg/vector.hpp"

namespace switchyard::conic {
namespace {

constexpr int kFactorizations = 20;  // that an order is chosen for
constexpr int kCorrections = 10;
constexpr std::size_t kDirections = 5;  // that a correction is made orthogonal to
constexpr double kStalled = 0.9;        // a correction that leaves more than this of it is the last
// Weights up to 1 / r are added to curvatures from r on: rounding must not reach these.
constexpr double kRounding = 1e-16, kCondensed = 1e-12, kKept = 1e-13, kMixedOrder = 1e-9;
constexpr double kTwofold = 1e-16;
// Factors that leave less than this of a goal at once leave little of the next, too.
constexpr double kTrusted = 1e-3;
constexpr double kUncurved = 1e-8;  // the least r of a variable without a curvature of its own

void Add(double alpha, const Triple& from, Triple& to) {
  linalg::AddMultiple(alpha, from.x, to.x);
  linalg::AddMultiple(alpha, from.y, to.y);
  linalg::AddMultiple(alpha, from.z, to.z);
}

void AddStep(double alpha, const KktStep& from, KktStep& to) {
  Add(alpha, from, to);
  linalg::AddMultiple(alpha, from.a_x, to.a_x);
}

void Clear(KktStep& step) {
  for (Vector* v : {&step.x, &step.y, &step.z, &step.a_x}) std::fill(v->begin(), v->end(), 0.0);
}

}  // namespace

Kkt::Kkt(const Form& form, const Blocks& blocks)
    : Kkt(std::make_shared<const KktPlan>(form, blocks), form) {}

Kkt::Kkt(const std::shared_ptr<const KktPlan>& plan, const Form& form)
    : Kkt(form, plan,
          linalg::BlockLdl(plan->pattern, plan->sign, {plan->group, kFactorizations}, plan->block,
                           plan->num_blocks)) {}

Kkt::Kkt(const Form& form, const Kkt& alike) : Kkt(form, alike.plan_, alike.ldl_) {}

Kkt::Kkt(const Form& form, std::shared_ptr<const KktPlan> plan, const linalg::BlockLdl& symbolic)
    : form_(form),
      plan_(std::move(plan)),
      ldl_(symbolic),
      constant_(plan_->Constant(form)),
      left_(form.shape),
      image_(form.shape),
      step_(form.shape) {
  ListKeptCones();
  MakeRoom();
  Restart();
}

void Kkt::ListKeptCones() {
  for (const KktPlan::Cone& cone : plan_->cones) {
    if (!cone.kept()) continue;
    const ConeGroup& group = form_.cones[cone.part];
    KeptCone& kept = kept_cones_.emplace_back();
    kept.column = cone.kept_column;
    kept.part = cone.part;
    kept.first = group.first;
    kept.rank = cones::FindKind(group.kind)->rank(group.layout.dim);
    for (Index i = 0; i < group.layout.dim; ++i) {
      kept.row.push_back(group.first + group.layout.Row(cone.cone, i));
    }
  }
}

void Kkt::Restart() {
  digits_ = linalg::Digits::kPlain;
  value_low_.clear();
  right_low_.clear();
  corrections_ = solves_ = 0;
  const double curvature = plan_->LeastCurvature(form_);
  least_proximal_ = curvature < kInfinity
                        ? std::clamp(kRounding / std::max(curvature, kRounding), kKept, kCondensed)
                        : kKept;
  if (!ldl_.rest().respects_groups()) least_proximal_ = std::max(least_proximal_, kMixedOrder);
  next_ = std::max(least_proximal_, 1e-9);
}

void Kkt::MakeRoom() {
  const Shape& s = form_.shape;
  weights_.slack.resize(s.slacks() - s.cone_rows);
  weights_.cone_row.resize(s.cone_rows);
  value_.resize(plan_->pattern.nonzeros());
  right_.resize(plan_->pattern.n);
  rows_.resize(s.rows());
  slack_.resize(s.slacks());
}

double Kkt::Largest(const Remainder& left, const Goal& goal) {
  return std::max(linalg::MaxAbs(left.raw.x) / goal.dual,
                  std::max(linalg::MaxAbs(left.raw.y), linalg::MaxAbs(left.z)) / goal.primal);
}

double Kkt::Measure(const ProductCone& cones, const Triple& left, const Goal& goal) {
  image_.raw = left;
  image_.z = left.z;
  cones.Unmended(image_.z);
  return Largest(image_, goal);
}

double Kkt::Dot(const Remainder& a, const Remainder& b, const Goal& goal) {
  return linalg::Dot(a.raw.x, b.raw.x) / (goal.dual * goal.dual) +
         (linalg::Dot(a.raw.y, b.raw.y) + linalg::Dot(a.z, b.z)) / (goal.primal * goal.primal);
}

void Kkt::AddMultiple(double alpha, const Remainder& from, Remainder& to) {
  Add(alpha, from.raw, to.raw);
  linalg::AddMultiple(alpha, from.z, to.z);
}

void Kkt::Reverse(const Remainder& u, Remainder& v) {
  const auto each = [](const Vector& a, Vector& b) {
    for (std::size_t i = 0; i < a.size(); ++i) b[i] = a[i] - b[i];
  };
  each(u.raw.x, v.raw.x);
  each(u.raw.y, v.raw.y);
  each(u.raw.z, v.raw.z);
  each(u.z, v.z);
}

void Kkt::TakeMoreDigits() {
  digits_ = linalg::Digits::kTwofold;
  value_low_.resize(value_.size());
  right_low_.resize(right_.size());
  least_proximal_ = kTwofold;
  next_ = kTwofold;
}

void Kkt::Factor(const ProductCone& cones) {
  proximal_ = next_;
  trusted_ = false;
  Weigh(cones);
  const linalg::NumbersOf<double> value{value_.data(), twofold() ? value_low_.data() : nullptr};
  std::copy(constant_.begin(), constant_.end(), value_.begin());
  std::fill(value_low_.begin(), value_low_.end(), 0.0);
  FillValues(form_, *plan_, weights_, value);
  raised_ = ldl_.Factor({value.high, value.low}, linalg::PivotRule{proximal_}, cones.workers());
}

void Kkt::Weigh(const ProductCone& cones) {
  const Vector& h = cones.orthant();
  for (std::size_t i = 0; i < h.size(); ++i) weights_.slack[i] = 1 / (h[i] + proximal_);
  weights_.proximal = proximal_;
  weights_.uncurved = twofold() ? proximal_ : std::max(proximal_, kUncurved);
  weights_.cones.resize(cones.parts().size());
  const auto weigh = [&](std::size_t p) {
    const cones::Group& group = *cones.parts()[p].group;
    KktWeights::Part& part = weights_.cones[p];
    part.v.resize(static_cast<std::size_t>(group.layout().rows()) * group.rank());
    part.w.resize(static_cast<std::size_t>(group.layout().count) * group.rank());
    group.Inverse(proximal_, weights_.cone_row.data() + cones.parts()[p].first, part.v.data(),
                  part.w.data());
  };
  linalg::EachPart(cones.workers(), cones.parts().size(), 1,
                   [&](std::size_t begin, std::size_t end) {
                     for (std::size_t p = begin; p < end; ++p) weigh(p);
                   });
}

/// Of a kept row: what its sides say together, and what each then says alone.
///   w_l (c_l - v) - w_t (c_t + v) = -t,   t = (w_l + w_t) (v - c)
/// with v = g'dx: the one with the smaller weight is taken from v, the other from the multiplier t.
double Kkt::SideOfRow(Index r, const Vector& c) const {
  const Shape& s = form_.shape;
  const Index range = r - s.cone_rows;
  if (range >= s.ranges) return c[r];
  const Index top = s.range_tops() + range;
  const double w = weights_.slack[range], w_top = weights_.slack[top - s.cone_rows];
  return (w * c[r] - w_top * c[top]) / (w + w_top);
}

void Kkt::SlacksOfRow(Index r, double multiplier, const Vector& c, KktStep& step) const {
  const Shape& s = form_.shape;
  const Index range = r - s.cone_rows;
  if (range >= s.ranges) {
    step.z[r] = -multiplier;
    return;
  }
  const Index top = s.range_tops() + range;
  const double w = weights_.slack[range], w_top = weights_.slack[top - s.cone_rows];
  if (w >= w_top) {
    step.z[top] = w_top * (c[top] + step.a_x[r]);
    step.z[r] = step.z[top] - multiplier;
  } else {
    step.z[r] = w * (c[r] - step.a_x[r]);
    step.z[top] = step.z[r] + multiplier;
  }
}

void Kkt::TakeSides(const KeptCone& cone, const Vector& c) {
  const Vector& v = weights_.cones[cone.part].v;
  const std::size_t stride = v.size() / cone.rank;
  for (Index k = 0; k < cone.rank; ++k) {
    double sum = 0;
    for (const Index r : cone.row) sum += v[k * stride + r - cone.first] * c[r];
    right_[cone.column + k] = sum;
  }
  for (const Index r : cone.row) rows_[r] = weights_.cone_row[r] * c[r];
}

/// slack_ has the differences c - F dx.
void Kkt::GiveSlacks(const KeptCone& cone, Vector& z) const {
  const Vector& v = weights_.cones[cone.part].v;
  const std::size_t stride = v.size() / cone.rank;
  for (const Index r : cone.row) z[r] = weights_.cone_row[r] * slack_[r];
  for (Index k = 0; k < cone.rank; ++k) {
    const double multiplier = right_[cone.column + k];
    for (const Index r : cone.row) z[r] -= v[k * stride + r - cone.first] * multiplier;
  }
}

/// What the factors say to the right side.
void Kkt::Approximate(const ProductCone& cones, const Triple& right, KktStep& step) {
  if (twofold()) {
    const linalg::NumbersOf<double> condensed{right_.data(), right_low_.data()};
    CondenseTwofold(form_, weights_, right, right_.size() - right.x.size() - right.y.size(),
                    cones.workers(), condensed);
    ldl_.Solve(condensed, cones.workers());
    ExpandTwofold(form_, weights_, right, {condensed.high, condensed.low}, cones.workers(), step);
  } else {
    CondensePlain(cones, right);
    ldl_.Solve({right_.data(), nullptr}, cones.workers());
    ExpandPlain(cones, right, step);
  }
}

/// right_: a + G'R^-1 c and b; what is kept has its part of c in an equation of its own.
void Kkt::CondensePlain(const ProductCone& cones, const Triple& right) {
  const Shape& s = form_.shape;
  const double* weight = weights_.slack.data();
  const Vector& c = right.z;
  std::fill(right_.begin() + s.vars + s.equations, right_.end(), 0.0);
  cones.Divide(c, proximal_, rows_);
  for (Index i = 0; i < s.inequalities; ++i)
    rows_[s.cone_rows + i] = weight[i] * c[s.cone_rows + i];
  for (Index i = 0; i < s.ranges; ++i) {
    const Index top = s.range_tops() + i;
    rows_[s.cone_rows + i] -= weight[top - s.cone_rows] * c[top];
  }
  std::fill(rows_.begin() + s.conic_rows(), rows_.end(), 0.0);
  for (std::size_t k = 0; k < plan_->kept_row.size(); ++k) {
    const Index r = plan_->kept_row[k];
    if (r < s.cone_rows) continue;
    right_[plan_->kept_column + k] = SideOfRow(r, c);
    rows_[r] = 0;
  }
  for (const KeptCone& cone : kept_cones_) TakeSides(cone, c);
  std::copy(right.x.begin(), right.x.end(), right_.begin());
  AddTransposed(form_.A, 1, rows_.data(), right_.data(), cones.workers());
  for (Index j = 0; j < s.bounded; ++j) {
    right_[j] += weight[s.lower_bounds() - s.cone_rows + j] * c[s.lower_bounds() + j];
  }
  for (Index j = 0; j < s.boxed; ++j) {
    right_[j] -= weight[s.upper_bounds() - s.cone_rows + j] * c[s.upper_bounds() + j];
  }
  std::copy(right.y.begin(), right.y.end(), right_.begin() + s.vars);
}

/// dx, dy from the solution, dz = R^-1 (c - G dx).
void Kkt::ExpandPlain(const ProductCone& cones, const Triple& right, KktStep& step) {
  const Shape& s = form_.shape;
  const double* weight = weights_.slack.data();
  const Vector& c = right.z;
  std::copy_n(right_.begin(), s.vars, step.x.begin());
  for (Index i = 0; i < s.equations; ++i) step.y[i] = -right_[s.vars + i];
  linalg::Multiply(form_.A, step.x.data(), step.a_x.data(), cones.workers());
  for (Index i = 0; i < s.cone_rows; ++i) slack_[i] = c[i] - step.a_x[i];
  cones.Divide(slack_, proximal_, step.z);
  EachSlack(s, step.x, step.a_x, cones.workers(), [&](Index slack, double g_x) {
    if (slack >= s.cone_rows) step.z[slack] = weight[slack - s.cone_rows] * (c[slack] - g_x);
  });
  for (std::size_t k = 0; k < plan_->kept_row.size(); ++k) {
    const Index r = plan_->kept_row[k];
    if (r >= s.cone_rows) SlacksOfRow(r, right_[plan_->kept_column + k], c, step);
  }
  for (const KeptCone& cone : kept_cones_) GiveSlacks(cone, step.z);
}

void Kkt::Leave(const ProductCone& cones, const Triple& right, const KktStep& step,
                Remainder& left) {
  const Shape& s = form_.shape;
  Triple& raw = left.raw;
  raw.x = right.x;
  AddProduct(form_.P, -1, step.x.data(), raw.x.data());
  AddSlackColumns(form_, step.y, step.z, cones.workers(), rows_, raw.x);
  for (Index i = 0; i < s.equations; ++i) {
    raw.y[i] = right.y[i] - step.a_x[s.conic_rows() + i];
  }
  cones.Multiply(step.z, raw.z);
  EachSlack(s, step.x, step.a_x, cones.workers(),
            [&](Index slack, double g_x) { raw.z[slack] = right.z[slack] - g_x - raw.z[slack]; });
  left.z = raw.z;
  cones.Unmended(left.z);
}

/// Makes the image orthogonal to those of the last of `used` steps before, and the step with it.
void Kkt::Orthogonalize(std::size_t used, const Goal& goal) {
  for (std::size_t k = used - std::min(used, kDirections); k < used; ++k) {
    const Direction& d = directions_[k % kDirections];
    const double overlap = Dot(image_, d.image, goal) / d.square;
    AddMultiple(-overlap, d.image, image_);
    AddStep(-overlap, d.step, step_);
  }
}

/// Step and image go to the place of the oldest, whose room is theirs from now on.
void Kkt::KeepDirection(std::size_t number, double square) {
  if (directions_.size() < std::min(number + 1, kDirections)) {
    directions_.push_back({KktStep(form_.shape), Remainder(form_.shape), 0});
  }
  Direction& kept = directions_[number % kDirections];
  std::swap(kept.step, step_);
  std::swap(kept.image, image_);
  kept.square = square;
}

Kkt::Outcome Kkt::Solve(const ProductCone& cones, const Triple& right, const Goal& goal,
                        KktStep& found) {
  ++solves_;
  Approximate(cones, right, found);
  if (trusted_) return {trusted_left_, 0, 0};
  Leave(cones, right, found, left_);
  const double left = Largest(left_, goal);
  trusted_ = left <= kTrusted;
  trusted_left_ = left;
  return left <= 1 ? Outcome{left, 0, 0} : Correct(cones, right, goal, found);
}

double Kkt::SolveOnce(const ProductCone& cones, const Triple& right, const Goal& goal,
                      KktStep& found) {
  ++solves_;
  Approximate(cones, right, found);
  Leave(cones, right, found, left_);
  return Largest(left_, goal);
}

// Generalized conjugate residuals (Eisenstat, Elman and Schultz, SIAM J. Numer. Anal. 20, 1983),
// from the step that was not good enough: each takes away as much of what is left as it can, so
// that none makes it worse.
Kkt::Outcome Kkt::Correct(const ProductCone& cones, const Triple& right, const Goal& goal,
                          KktStep& found) {
  Outcome outcome;
  std::size_t used = 0;
  std::swap(step_, found);
  Clear(found);
  image_.raw = right;
  image_.z = right.z;
  cones.Unmended(image_.z);
  Reverse(image_, left_);  // the image of the first step
  std::swap(image_, left_);
  double left_square = Dot(left_, left_, goal);
  for (int k = 0; k <= kCorrections; ++k) {
    if (k > 0) {
      Approximate(cones, left_.raw, step_);
      Leave(cones, left_.raw, step_, image_);  // image = left - that
      Reverse(left_, image_);
      Orthogonalize(used, goal);
      ++corrections_;
    }
    const double square = Dot(image_, image_, goal);
    const double length = Dot(image_, left_, goal) / square;
    if (!std::isfinite(length) || length == 0) break;
    AddStep(length, step_, found);
    AddMultiple(-length, image_, left_);
    const double before = left_square;
    left_square = Dot(left_, left_, goal);
    outcome.left = Largest(left_, goal);
    outcome.contraction = k > 0 ? std::sqrt(left_square / before) : 0;
    outcome.corrections = k;
    if (outcome.left <= 1 || outcome.contraction > kStalled) return outcome;
    KeepDirection(used++, square);
  }
  outcome.left = Largest(left_, goal);
  return outcome;
}

}  // namespace switchyard::conic
