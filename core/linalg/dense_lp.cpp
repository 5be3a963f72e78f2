#include "core/linalg/dense_lp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/linalg/dense_lp_certificate.hpp"
#include "core/linalg/working_set.hpp"

namespace switchyard {
namespace {

using Index = WorkingSet::Index;
constexpr Index kNone = static_cast<Index>(-1);
constexpr double kInfinite = std::numeric_limits<double>::infinity();
// A scaled coefficient below this is rounding; a pivot never divides by one.
constexpr double kPivot = 1e-9;
/// How far a row may be left, relative to its side and the point, and what is a slope, relative to
/// the terms that make it. Sharper on a second try; on the third, slopes of 0 that are rounding's
/// are not followed.
struct Care {
  double rows;
  double slopes;
};
constexpr Care kTries[] = {{1e-10, 1e-10}, {1e-13, 1e-13}, {1e-13, 1e-8}};
// An entry below this part of the largest one is what rounding left of 0.
constexpr double kDust = 1e-13;

void Dust(std::vector<double>& v) {
  double largest = 0;
  for (const double entry : v) largest = std::max(largest, std::abs(entry));
  for (double& entry : v) {
    if (std::abs(entry) <= kDust * largest) entry = 0;
  }
}

}  // namespace

void DenseLp::Clear(int n) {
  const auto size = static_cast<std::size_t>(n);
  c.assign(size, 0);
  x_lower.assign(size, -kInfinite);
  x_upper.assign(size, kInfinite);
  A.clear();
  row_lower.clear();
  row_upper.clear();
}

double* DenseLp::AddRow(double lower, double upper) {
  row_lower.push_back(lower);
  row_upper.push_back(upper);
  A.resize(A.size() + c.size(), 0);
  return A.data() + (A.size() - c.size());
}

std::string_view to_string(DenseLpStatus status) {
  constexpr std::string_view kNames[] = {"optimal", "infeasible", "unbounded", "undecided"};
  return kNames[static_cast<std::size_t>(status)];
}

/// y are the multipliers of the working rows: a cost is sum y_k g_k over them. In the dual phase y
/// is what the shifted costs are known by, and it has the signs that its rows' sides ask for.
struct DenseSimplex::Method {
  enum class End : std::uint8_t { kDone, kBlocked, kTrouble };

  const DenseLpAnswer& Solve(const DenseLp& lp);
  const DenseLpAnswer& SolveAgain(const DenseLp& lp);

  void TakeCosts(const DenseLp& lp);
  const DenseLpAnswer& Run(const DenseLp& lp);
  bool Answered(const DenseLp& lp, End dual);

  void ShiftCosts();
  double Shift();
  End DualPhase();
  [[nodiscard]] Index MostViolated() const;
  [[nodiscard]] Index DualLeaving(double sign) const;
  void DualStep(Index k, double sign);

  End PrimalPhase();
  void Price();
  [[nodiscard]] Index PrimalLeaving(bool lowest) const;
  [[nodiscard]] double Room(Index i) const;
  [[nodiscard]] Index Stop(bool lowest) const;
  double PrimalStep(Index k, bool lowest);

  void WritePoint(const DenseLp& lp);
  void WriteDuals();
  void Put(Index row, double multiplier);

  WorkingSet set;
  std::vector<double> c;      // scaled
  std::vector<double> y;      // of the working rows
  std::vector<double> alpha;  // a row as a combination of the working ones
  std::vector<double> d;      // a direction
  Care care{};
  double cost_unit = 1;
  Index entering = kNone;     // of the dual phase
  bool enters_below = false;  // it is below its lower side
  std::uint32_t random = 1;
  int pivot_limit = 0;
  DenseLpAnswer answer;
};

const DenseLpAnswer& DenseSimplex::Method::Solve(const DenseLp& lp) {
  set.Load(lp);
  TakeCosts(lp);
  random = 1;
  set.HoldBounds(c);
  y = c;  // the working rows are those of I
  return Run(lp);
}

const DenseLpAnswer& DenseSimplex::Method::SolveAgain(const DenseLp& lp) {
  if (set.n != lp.c.size() || set.m != lp.row_lower.size()) return Solve(lp);
  TakeCosts(lp);
  Price();
  return Run(lp);
}

void DenseSimplex::Method::TakeCosts(const DenseLp& lp) {
  c.resize(set.n);
  cost_unit = 0;
  for (Index j = 0; j < set.n; ++j) {
    c[j] = lp.c[j] * set.col_scale[j];
    cost_unit = std::max(cost_unit, std::abs(c[j]));
  }
  if (cost_unit == 0) cost_unit = 1;
  pivot_limit = 200 + 50 * static_cast<int>(set.n) + 10 * static_cast<int>(set.m);
}

const DenseLpAnswer& DenseSimplex::Method::Run(const DenseLp& lp) {
  answer.pivots = 0;
  for (const Care& a_try : kTries) {
    care = a_try;
    ShiftCosts();
    if (Answered(lp, DualPhase())) return answer;
    if (!set.Factor()) set.HoldBounds(c);
    Price();
  }
  answer.status = DenseLpStatus::kUndecided;
  return answer;
}

/// Does what the phases end with prove an answer?
bool DenseSimplex::Method::Answered(const DenseLp& lp, End dual) {
  if (dual == End::kTrouble) return false;
  if (dual == End::kBlocked) {
    const double sign = enters_below ? 1 : -1;
    set.Correct(entering, alpha);
    Dust(alpha);
    for (Index k = 0; k < set.n; ++k) y[k] = -sign * alpha[k];
    WriteDuals();
    Put(entering, sign);
    answer.status = DenseLpStatus::kInfeasible;
    return CertifiesInfeasibility(lp, answer);
  }
  const End primal = PrimalPhase();
  if (primal == End::kTrouble) return false;
  WritePoint(lp);
  if (primal == End::kDone) {
    Dust(y);
    WriteDuals();
    answer.status = DenseLpStatus::kOptimal;
    return CertifiesOptimum(lp, answer);
  }
  Dust(d);
  answer.ray.resize(set.n);
  for (Index j = 0; j < set.n; ++j) answer.ray[j] = d[j] * set.col_scale[j];
  answer.status = DenseLpStatus::kUnbounded;
  return CertifiesUnboundedness(lp, answer);
}

/// A cost that keeps ties away: between one half and three halves of the unit.
double DenseSimplex::Method::Shift() {
  random = random * 1664525u + 1013904223u;
  return cost_unit * (0.5 + static_cast<double>(random >> 8) * 0x1p-24);
}

/// Multipliers of the wrong sign, or 0, are replaced: the costs are then others.
void DenseSimplex::Method::ShiftCosts() {
  for (Index k = 0; k < set.n; ++k) {
    if (set.side[k] == Side::kFree) y[k] = 0;
    if (set.side[k] == Side::kLower && !(y[k] > 0)) y[k] = Shift();
    if (set.side[k] == Side::kUpper && !(y[k] < 0)) y[k] = -Shift();
  }
}

DenseSimplex::Method::End DenseSimplex::Method::DualPhase() {
  for (int pivot = 0; pivot < pivot_limit; ++pivot) {
    entering = MostViolated();
    if (entering == kNone) return End::kDone;
    if (set.is_working[entering] != 0) return End::kTrouble;
    enters_below = set.activity[entering] < set.lower[entering];
    const double sign = enters_below ? 1 : -1;
    set.Combine(entering, alpha);
    const Index k = DualLeaving(sign);
    if (k == kNone) return End::kBlocked;
    DualStep(k, sign);
    if (set.exchanges >= 50 && !set.Factor()) return End::kTrouble;
  }
  return End::kTrouble;
}

Index DenseSimplex::Method::MostViolated() const {
  const double size = set.SizeOfX();
  Index worst = kNone;
  double most = 0;
  for (Index i = 0; i < set.m + set.n; ++i) {
    const double beyond = set.Violation(i) - care.rows * (set.side_size[i] + size);
    if (beyond > most) {
      most = beyond;
      worst = i;
    }
  }
  return worst;
}

/// The working row whose multiplier reaches 0 first when that of the entering row grows, in two
/// passes: how far it may grow if signs may be wrong by the slack, then the largest divisor of
/// those that are met until there (Harris 1973).
Index DenseSimplex::Method::DualLeaving(double sign) const {
  const auto divisor = [&](Index k) -> double {
    const double a = sign * alpha[k];
    switch (set.side[k]) {
      case Side::kLower:
        return a;
      case Side::kUpper:
        return -a;
      case Side::kFree:
        return std::abs(a);
      case Side::kFixed:
        return 0;
    }
    return 0;
  };
  double reach = kInfinite;
  for (Index k = 0; k < set.n; ++k) {
    const double a = divisor(k);
    if (a > kPivot) reach = std::min(reach, (std::abs(y[k]) + care.rows * cost_unit) / a);
  }
  Index leaving = kNone;
  double largest = 0;
  for (Index k = 0; k < set.n; ++k) {
    const double a = divisor(k);
    if (a > kPivot && a > largest && std::abs(y[k]) <= reach * a) {
      largest = a;
      leaving = k;
    }
  }
  return leaving;
}

void DenseSimplex::Method::DualStep(Index k, double sign) {
  const double step = std::abs(y[k]) / std::abs(alpha[k]);
  for (Index l = 0; l < set.n; ++l) {
    if (l == k) continue;
    y[l] -= sign * step * alpha[l];
    if (set.side[l] == Side::kLower) y[l] = std::max(y[l], 0.0);
    if (set.side[l] == Side::kUpper) y[l] = std::min(y[l], 0.0);
    if (set.side[l] == Side::kFree) y[l] = 0;
  }
  y[k] = sign * (step > 1e-12 * cost_unit ? step : Shift());
  const double side = enters_below ? set.lower[entering] : set.upper[entering];
  d.assign(set.column(k), set.column(k) + set.n);
  set.Along(d.data());
  set.Move(d.data(), (side - set.activity[entering]) / alpha[k]);
  const bool fixed = set.lower[entering] == set.upper[entering];
  set.Exchange(k, entering,
               fixed          ? Side::kFixed
               : enters_below ? Side::kLower
                              : Side::kUpper,
               alpha);
  ++answer.pivots;
}

DenseSimplex::Method::End DenseSimplex::Method::PrimalPhase() {
  const Index patience = 20 + 2 * set.n;  // with steps of length 0, before Bland's rule ends them
  Index idle = 0;
  for (int pivot = 0; pivot < pivot_limit; ++pivot) {
    Price();
    const bool lowest = idle > patience;
    const Index k = PrimalLeaving(lowest);
    if (k == kNone) return End::kDone;
    const double moved = PrimalStep(k, lowest);
    if (std::isinf(moved)) return End::kBlocked;
    idle = moved > care.rows * set.SizeOfX() ? 0 : idle + 1;
    if (set.exchanges >= 50 && !set.Factor()) return End::kTrouble;
  }
  return End::kTrouble;
}

/// The multipliers of the true costs.
void DenseSimplex::Method::Price() {
  y.assign(set.n, 0);
  for (Index k = 0; k < set.n; ++k) {
    const double* column = set.column(k);
    for (Index j = 0; j < set.n; ++j) y[k] += c[j] * column[j];
  }
}

/// A working row that c'x decreases from: of the steepest slope, or the lowest number (Bland 1977).
Index DenseSimplex::Method::PrimalLeaving(bool lowest) const {
  Index leaving = kNone;
  double best = 0;
  for (Index k = 0; k < set.n; ++k) {
    const Side side = set.side[k];
    const double slope = side == Side::kLower   ? -y[k]
                         : side == Side::kUpper ? y[k]
                         : side == Side::kFree  ? std::abs(y[k])
                                                : 0;
    if (slope <= 0) continue;
    double size = 0;
    double square = 0;
    for (Index j = 0; j < set.n; ++j) {
      size += std::abs(c[j] * set.column(k)[j]);
      square += set.column(k)[j] * set.column(k)[j];
    }
    if (slope <= care.slopes * size + kDust * cost_unit * std::sqrt(square)) continue;
    const double score = lowest ? -static_cast<double>(set.working[k]) : slope * slope / square;
    if (leaving == kNone || score > best) {
      best = score;
      leaving = k;
    }
  }
  return leaving;
}

/// How far row i is from the side that it moves to.
double DenseSimplex::Method::Room(Index i) const {
  return set.along[i] > 0 ? set.upper[i] - set.activity[i] : set.activity[i] - set.lower[i];
}

/// The row that stops a step along d, in two passes as DualLeaving.
Index DenseSimplex::Method::Stop(bool lowest) const {
  const double size = set.SizeOfX();
  double longest = 0;
  for (const double entry : d) longest = std::max(longest, std::abs(entry));
  const auto moves = [&](Index i) {
    return std::abs(set.along[i]) > kPivot * longest && set.is_working[i] == 0;
  };
  double reach = kInfinite;
  for (Index i = 0; i < set.m + set.n; ++i) {
    if (!moves(i)) continue;
    const double room = Room(i) + care.rows * (set.side_size[i] + size);
    reach = std::min(reach, std::max(room, 0.0) / std::abs(set.along[i]));
  }
  Index stop = kNone;
  double largest = 0;
  if (std::isinf(reach)) return stop;
  for (Index i = 0; i < set.m + set.n; ++i) {
    const double rate = std::abs(set.along[i]);
    if (!moves(i) || Room(i) > reach * rate) continue;
    if (stop == kNone || (!lowest && rate > largest)) {
      largest = rate;
      stop = i;
    }
  }
  return stop;
}

/// How far x moves, in the largest coordinate; infinitely where nothing stops it, and d then says
/// where to.
double DenseSimplex::Method::PrimalStep(Index k, bool lowest) {
  const bool up = set.side[k] == Side::kLower || (set.side[k] == Side::kFree && y[k] < 0);
  d.resize(set.n);
  double longest = 0;
  for (Index j = 0; j < set.n; ++j) {
    d[j] = up ? set.column(k)[j] : -set.column(k)[j];
    longest = std::max(longest, std::abs(d[j]));
  }
  set.Along(d.data());
  const Index stop = Stop(lowest);
  const Index row = set.working[k];
  const double range = set.side[k] == Side::kFree ? kInfinite : set.upper[row] - set.lower[row];
  const double room =
      stop == kNone ? kInfinite : std::max(0.0, Room(stop)) / std::abs(set.along[stop]);
  const double length = std::min(range, room);
  if (std::isinf(length)) return length;
  ++answer.pivots;
  set.Move(d.data(), length);
  if (range <= room) {
    set.Hold(k, up ? Side::kUpper : Side::kLower);
    return length * longest;
  }
  const bool fixed = set.lower[stop] == set.upper[stop];
  const Side side = fixed ? Side::kFixed : set.along[stop] > 0 ? Side::kUpper : Side::kLower;
  set.Combine(stop, alpha);
  set.Exchange(k, stop, side, alpha);
  return length * longest;
}

void DenseSimplex::Method::WritePoint(const DenseLp& lp) {
  answer.x = set.x;
  Dust(answer.x);
  answer.objective = 0;
  for (Index j = 0; j < set.n; ++j) {
    answer.x[j] *= set.col_scale[j];
    answer.objective += lp.c[j] * answer.x[j];
  }
}

/// y without those of a wrong sign.
void DenseSimplex::Method::WriteDuals() {
  answer.row_dual.assign(set.m, 0);
  answer.x_dual.assign(set.n, 0);
  for (Index k = 0; k < set.n; ++k) {
    const Side side = set.side[k];
    const bool wrong = side == Side::kFree || (side == Side::kLower && y[k] < 0) ||
                       (side == Side::kUpper && y[k] > 0);
    if (!wrong) Put(set.working[k], y[k]);
  }
}

/// The multiplier of a row of G as that of a row, or a bound, as given.
void DenseSimplex::Method::Put(Index row, double multiplier) {
  if (row < set.m) {
    answer.row_dual[row] = multiplier * set.row_scale[row];
  } else {
    answer.x_dual[row - set.m] = multiplier / set.col_scale[row - set.m];
  }
}

DenseSimplex::DenseSimplex() : method_(std::make_unique<Method>()) {}
DenseSimplex::~DenseSimplex() = default;
DenseSimplex::DenseSimplex(DenseSimplex&&) noexcept = default;
DenseSimplex& DenseSimplex::operator=(DenseSimplex&&) noexcept = default;

const DenseLpAnswer& DenseSimplex::Solve(const DenseLp& lp) { return method_->Solve(lp); }
const DenseLpAnswer& DenseSimplex::SolveAgain(const DenseLp& lp) { return method_->SolveAgain(lp); }

}  // namespace switchyard
