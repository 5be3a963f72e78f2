#include "solvers/mip/mir_cuts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace switchyard::mip {

using rounding::Entry;

namespace {

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

constexpr double kLeastFraction = 0.05;  // of f, and of 1 - f
constexpr double kLargestRatio = 1e6;    // of coefficients
constexpr double kFar = 1e7;             // bounds beyond are none
constexpr std::size_t kDeltas = 10;
constexpr int kFlips = 12;

double QuotientDown(double a, double b) { return std::fmod(a, b) == 0 ? a / b : Below(a / b); }
double QuotientUp(double a, double b) { return std::fmod(a, b) == 0 ? a / b : Above(a / b); }

/// At least side - a v.
double Moved(double side, double a, double v) {
  return Plus({side, side}, Minus(Times({a, a}, {v, v}))).upper;
}

}  // namespace

/// Sums of rows at one point.
class Adder {
 public:
  Adder(const MirCuts& of, const std::vector<double>& x) : of_(of), x_(x), sum_(x.size(), 0.0) {}

  /// The base and a known row, so that the continuous variable farthest from its bounds is gone.
  std::optional<Inequality> Add(const Inequality& base) {
    const Entry* away = nullptr;
    double farthest = 1e-6;
    for (const Entry& e : base.entries) {
      const std::size_t j = At(e.variable);
      if (of_.integer_[j] != 0 || of_.lower_[j] < 0) continue;
      const double distance = std::min({x_[j] - of_.lower_[j], of_.upper_[j] - x_[j], ToUpper(j)});
      if (distance <= farthest) continue;
      farthest = distance;
      away = &e;
    }
    if (away == nullptr) return std::nullopt;
    const Inequality* best = nullptr;
    double least = 1e-5, coefficient = 0;
    for (const std::int32_t i : of_.known_of_[At(away->variable)]) {
      const Inequality& row = of_.known_[At(i)];
      const auto [slack, own] = SlackAndCoefficient(row, away->variable);
      if (own * away->value >= 0 || slack >= least) continue;
      least = slack;
      coefficient = own;
      best = &row;
    }
    if (best == nullptr) return std::nullopt;
    return Sum(base, *best, away->variable, away->value, coefficient);
  }

 private:
  [[nodiscard]] double ToUpper(std::size_t j) const {
    const VariableUpper& upper = of_.variable_upper_[j];
    return upper.z >= 0 ? upper.factor * x_[At(upper.z)] - x_[j] : kInfinity;
  }

  /// Relative to the row's largest term.
  [[nodiscard]] std::pair<double, double> SlackAndCoefficient(const Inequality& row,
                                                              std::int32_t j) const {
    double slack = row.side, scale = 1, own = 0;
    for (const Entry& e : row.entries) {
      const double term = e.value * x_[At(e.variable)];
      slack -= term;
      scale = std::max(scale, std::abs(term));
      if (e.variable == j) own = e.value;
    }
    return {slack / scale, own};
  }

  // base + times row, where `times` leaves the variable, at least 0, a coefficient of at least 0:
  // it is dropped. What others, at least 0 as well, lose by rounding down does no harm.
  std::optional<Inequality> Sum(const Inequality& base, const Inequality& row, std::int32_t gone,
                                double a, double b) {
    const Interval exact = Over({std::abs(a), std::abs(a)}, {std::abs(b), std::abs(b)});
    const double times = a > 0 ? exact.lower : exact.upper;
    if (!(times > 1e-6 && times < 1e6)) return std::nullopt;
    const Interval by = {times, times};
    Inequality sum;
    sum.side = Plus({base.side, base.side}, Times(by, {row.side, row.side})).upper;
    for (const Entry& e : base.entries) sum_[At(e.variable)] = e.value;
    bool fit = true;
    for (const Entry& e : row.entries) {
      if (e.variable == gone) continue;
      double& to = sum_[At(e.variable)];
      fit = fit && of_.lower_[At(e.variable)] >= 0;
      const double value = Times(by, {e.value, e.value}).lower;
      to = to == 0 ? value : Below(to + value);
    }
    for (const auto* entries : {&base.entries, &row.entries}) {
      for (const Entry& e : *entries) {
        const double value = std::exchange(sum_[At(e.variable)], 0.0);
        if (value != 0 && e.variable != gone) sum.entries.push_back({e.variable, value});
      }
    }
    return fit ? std::optional(sum) : std::nullopt;
  }

  const MirCuts& of_;
  const std::vector<double>& x_;
  std::vector<double> sum_;
};

/// One inequality, rounded at one point.
class Rounder {
 public:
  Rounder(const MirCuts& of, const std::vector<double>& x)
      : of_(of), x_(x), place_(x.size(), -1), sum_(x.size(), 0.0) {}

  struct Found {
    Row row;
    double distance;  // from x
  };

  std::optional<Found> Round(const Inequality& base) {
    if (!Standardize(base)) return std::nullopt;
    double best = 0, delta = 0;
    for (const double d : Deltas()) {
      const double distance = DistanceBy(d);
      if (distance > best) best = distance, delta = d;
    }
    if (delta == 0) return std::nullopt;
    for (const double part : {2.0, 4.0, 8.0}) {
      const double distance = DistanceBy(delta / part);
      if (distance > best) best = distance, delta /= part;
    }
    best = Flip(delta, best);
    return Write(delta, best);
  }

 private:
  /// a y of an integer: y = x - lower or, flipped, upper - x.
  struct Whole {
    std::int32_t variable;
    double a, y, width;
    bool flipped;
  };
  /// c s of a continuous variable: s = x - at or, flipped, at - x, or factor z - x.
  struct Slack {
    std::int32_t variable;
    double c, s, at;
    bool flipped;
    std::int32_t z;
  };

  bool Standardize(const Inequality& base) {
    for (const Whole& w : wholes_) place_[At(w.variable)] = -1;
    wholes_.clear();
    slacks_.clear();
    side_ = base.side;
    for (const Entry& e : base.entries) {
      if (of_.integer_[At(e.variable)] != 0) AddWhole(e.variable, e.value);
    }
    for (const Entry& e : base.entries) {
      if (of_.integer_[At(e.variable)] == 0 && !AddSlack(e.variable, e.value)) return false;
    }
    for (Whole& w : wholes_) {
      const double l = of_.lower_[At(w.variable)], u = of_.upper_[At(w.variable)];
      if (!(std::max(-l, u) < kFar)) return false;
      w.y = std::clamp(x_[At(w.variable)] - l, 0.0, u - l);
      w.width = u - l;
      w.flipped = false;
      side_ = Moved(side_, w.a, l);
      if (2 * w.y > w.width) Flip(w);
    }
    return true;
  }

  void AddWhole(std::int32_t j, double a) {
    if (place_[At(j)] < 0) {
      place_[At(j)] = static_cast<std::int32_t>(wholes_.size());
      wholes_.push_back({j, a, 0, 0, false});
    } else {
      double& sum = wholes_[At(place_[At(j)])].a;
      sum = Below(sum + a);
    }
  }

  bool AddSlack(std::int32_t j, double a) {
    const double x = x_[At(j)], l = of_.lower_[At(j)], u = of_.upper_[At(j)];
    const VariableUpper& upper = of_.variable_upper_[At(j)];
    const double below = l > -kFar ? x - l : kInfinity, above = u < kFar ? u - x : kInfinity;
    const double variable = upper.z >= 0 ? upper.factor * x_[At(upper.z)] - x : kInfinity;
    if (variable < kInfinity && variable <= std::min(below, above) + 1e-6) {
      slacks_.push_back({j, -a, std::max(0.0, variable), upper.factor, true, upper.z});
      AddWhole(upper.z, Times({a, a}, {upper.factor, upper.factor}).lower);
      return true;
    }
    if (std::min(below, above) == kInfinity) return false;
    const bool flipped = above < below;
    const double at = flipped ? u : l;
    slacks_.push_back(
        {j, flipped ? -a : a, std::max(0.0, flipped ? above : below), at, flipped, -1});
    side_ = Moved(side_, a, at);
    return true;
  }

  void Flip(Whole& w) {
    side_ = Moved(side_, w.a, w.width);
    w.a = -w.a;
    w.y = w.width - w.y;
    w.flipped = !w.flipped;
  }

  [[nodiscard]] std::vector<double> Deltas() const {
    std::vector<std::pair<double, double>> order;  // by how fractional
    for (const Whole& w : wholes_) {
      const double away = std::min(w.y, w.width - w.y);
      if (w.a != 0 && away > 1e-6) order.emplace_back(-away, std::abs(w.a));
    }
    std::sort(order.begin(), order.end());
    std::vector<double> deltas;
    for (const auto& [away, a] : order) {
      const bool same = std::any_of(deltas.begin(), deltas.end(),
                                    [a = a](double d) { return std::abs(d - a) <= 1e-9 * a; });
      if (!same) deltas.push_back(a);
      if (deltas.size() == kDeltas) break;
    }
    return deltas;
  }

  /// By how much of its length x violates the rounded row, as far as floating point tells.
  [[nodiscard]] double DistanceBy(double delta) const {
    const double b = side_ / delta, f = b - std::floor(b);
    if (f < kLeastFraction || f > 1 - kLeastFraction || std::abs(b) > kFar) return 0;
    double sum = -std::floor(b), square = 0;
    for (const Whole& w : wholes_) {
      const double a = w.a / delta, below = std::floor(a);
      const double g = below + std::max(0.0, a - below - f) / (1 - f);
      sum += g * w.y;
      square += g * g;
    }
    for (const Slack& s : slacks_) {
      const double h = std::min(0.0, s.c) / (delta * (1 - f));
      sum += h * s.s;
      square += h * h;
    }
    return square > 0 ? sum / std::sqrt(square) : 0;
  }

  /// Integers measured from their other bounds, one by one, where that helps.
  double Flip(double delta, double best) {
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t k = 0; k < wholes_.size(); ++k) {
      const Whole& w = wholes_[k];
      if (w.y > 1e-6 && w.y < w.width - 1e-6) order.emplace_back(-w.y / w.width, k);
    }
    std::sort(order.begin(), order.end());
    int tries = 0;
    for (const auto& [key, k] : order) {
      if (++tries > kFlips) break;
      const double before = side_;
      const Whole old = wholes_[k];
      Flip(wholes_[k]);
      const double distance = DistanceBy(delta);
      if (distance > best) {
        best = distance;
      } else {
        wholes_[k] = old;
        side_ = before;
      }
    }
    return best;
  }

  /// The row in x, rounded to the safe side.
  std::optional<Found> Write(double delta, double distance) {
    const double b = QuotientUp(side_, delta), whole = std::floor(b);
    const Interval f = Plus({b, b}, {-whole, -whole}), rest = Plus({1, 1}, Minus(f));
    if (f.lower < 0.5 * kLeastFraction || rest.lower < 0.5 * kLeastFraction) return std::nullopt;
    double side = whole;
    for (const Whole& w : wholes_) {
      const double a = QuotientDown(w.a, delta), below = std::floor(a);
      const Interval over = Plus(Plus({a, a}, {-below, -below}), Minus(f));
      const Interval share = Over({std::max(0.0, over.lower), std::max(0.0, over.lower)}, rest);
      const double g = share.lower > 0 ? Below(below + share.lower) : below;
      const double from = w.flipped ? of_.upper_[At(w.variable)] : of_.lower_[At(w.variable)];
      Put(w.variable, w.flipped ? -g : g);
      side = Moved(side, w.flipped ? g : -g, from);
    }
    for (const Slack& s : slacks_) {
      if (s.c >= 0) continue;
      const double h = Over({s.c, s.c}, Times({delta, delta}, rest)).lower;
      Put(s.variable, s.flipped ? -h : h);
      if (s.z >= 0) {
        Put(s.z, Times({h, h}, {s.at, s.at}).lower);
      } else {
        side = Moved(side, s.flipped ? h : -h, s.at);
      }
    }
    return Take(side, distance);
  }

  // The second addend is a binary's: rounded down, it is on the safe side.
  void Put(std::int32_t j, double value) {
    double& sum = sum_[At(j)];
    sum = sum == 0 ? value : Below(sum + value);
    used_.push_back(j);
  }

  /// As sum >= lower, where it is fit for use.
  std::optional<Found> Take(double side, double distance) {
    Found found{{{}, -side}, distance};
    double least = kInfinity, most = 0, violation = -side;
    std::sort(used_.begin(), used_.end());
    used_.erase(std::unique(used_.begin(), used_.end()), used_.end());
    for (const std::int32_t j : used_) {
      const double value = std::exchange(sum_[At(j)], 0.0);
      if (value == 0) continue;
      found.row.entries.push_back({j, -value});
      violation += value * x_[At(j)];
      least = std::min(least, std::abs(value));
      most = std::max(most, std::abs(value));
    }
    used_.clear();
    if (!(violation > 0) || !(most <= kLargestRatio * least)) return std::nullopt;
    return found;
  }

  const MirCuts& of_;
  const std::vector<double>& x_;
  std::vector<Whole> wholes_;
  std::vector<Slack> slacks_;
  double side_ = 0;
  std::vector<std::int32_t> place_;  // of a variable among wholes_
  std::vector<double> sum_;          // of the row that is written
  std::vector<std::int32_t> used_;
};

MirCuts::MirCuts(const sy_problem& problem, const NodeBoxes& boxes)
    : lower_(boxes.lower()),
      upper_(boxes.upper()),
      variable_upper_(lower_.size()),
      known_of_(lower_.size()) {
  for (std::int32_t j = 0; j < problem.num_vars; ++j) integer_.push_back(boxes.IsInteger(j));
  if (problem.A == nullptr) return;
  const Csc by_rows = Transpose(*problem.A);
  FindVariableUppers(problem, by_rows);
  for (std::int32_t i = 0; i < problem.num_rows; ++i) {
    Inequality up, down;
    bool has_integer = false;
    for (std::int32_t k = by_rows.start[At(i)]; k < by_rows.start[At(i) + 1]; ++k) {
      const Entry e{by_rows.row[At(k)], by_rows.value[At(k)]};
      if (e.value == 0) continue;
      up.entries.push_back(e);
      down.entries.push_back({e.variable, -e.value});
      has_integer = has_integer || integer_[At(e.variable)] != 0;
    }
    const bool units = std::all_of(up.entries.begin(), up.entries.end(), [&](const Entry& e) {
      return integer_[At(e.variable)] != 0 && std::abs(e.value) == std::abs(up.entries[0].value);
    });
    up.side = problem.row_upper != nullptr ? problem.row_upper[i] : kInfinity;
    down.side = problem.row_lower != nullptr ? -problem.row_lower[i] : kInfinity;
    for (const Inequality* one : {&up, &down}) {
      if (one->side < kInfinity && up.entries.size() > 1) Know(*one);
    }
    if (!has_integer || units || up.entries.size() < 3) continue;
    if (up.side < kInfinity) bases_.push_back(std::move(up));
    if (down.side < kInfinity) bases_.push_back(std::move(down));
  }
}

void MirCuts::Know(Inequality row) {
  for (const Entry& e : row.entries) {
    if (integer_[At(e.variable)] == 0) {
      known_of_[At(e.variable)].push_back(static_cast<std::int32_t>(known_.size()));
    }
  }
  known_.push_back(std::move(row));
}

void MirCuts::Know(const Row& row) {
  Inequality other{row.entries, -row.lower};
  for (Entry& e : other.entries) e.value = -e.value;
  Know(std::move(other));
}

// a x + b z <= 0 with a > 0 > b, and the like.
void MirCuts::FindVariableUppers(const sy_problem& problem, const Csc& by_rows) {
  const auto is_binary = [&](std::int32_t j) {
    return integer_[At(j)] != 0 && lower_[At(j)] == 0 && upper_[At(j)] == 1;
  };
  for (std::int32_t i = 0; i < problem.num_rows; ++i) {
    const auto k = At(by_rows.start[At(i)]);
    if (At(by_rows.start[At(i) + 1]) != k + 2) continue;
    for (const std::size_t of : {k, k + 1}) {
      const std::size_t other = of == k ? k + 1 : k;
      const std::int32_t x = by_rows.row[of], z = by_rows.row[other];
      if (integer_[At(x)] != 0 || !is_binary(z)) continue;
      double a = by_rows.value[of], b = by_rows.value[other];
      const bool upper =
          problem.row_upper != nullptr && problem.row_upper[i] == 0 && a > 0 && b < 0;
      const bool lower =
          problem.row_lower != nullptr && problem.row_lower[i] == 0 && a < 0 && b > 0;
      if (!upper && !lower) continue;
      const double factor = QuotientUp(std::abs(b), std::abs(a));
      if (factor < variable_upper_[At(x)].factor) variable_upper_[At(x)] = {z, factor};
    }
  }
}

void MirCuts::Separate(const std::vector<double>& x, double tolerance,
                       std::vector<Row>& rows) const {
  constexpr double kParallel = 0.9;
  constexpr int kSums = 4;
  Rounder rounder(*this, x);
  Adder adder(*this, x);
  std::vector<Rounder::Found> all;
  for (const Inequality& base : bases_) {
    std::optional<Inequality> sum = base;
    for (int k = 0; k <= kSums && sum; ++k, sum = adder.Add(*sum)) {
      auto found = rounder.Round(*sum);
      if (!found || found->distance < tolerance) continue;
      all.push_back(std::move(*found));
      break;
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.distance > b.distance; });
  std::vector<double> dense(x.size(), 0.0);
  const std::size_t first = rows.size();
  for (Rounder::Found& found : all) {
    double own = 0;
    for (const Entry& e : found.row.entries) {
      dense[At(e.variable)] = e.value;
      own += e.value * e.value;
    }
    bool parallel = false;
    for (std::size_t k = first; k < rows.size() && !parallel; ++k) {
      double product = 0, other = 0;
      for (const Entry& e : rows[k].entries) {
        product += e.value * dense[At(e.variable)];
        other += e.value * e.value;
      }
      parallel = product > kParallel * std::sqrt(own * other);
    }
    for (const Entry& e : found.row.entries) dense[At(e.variable)] = 0;
    if (!parallel) rows.push_back(std::move(found.row));
  }
}

}  // namespace switchyard::mip
