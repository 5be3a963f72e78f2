#include "solvers/rounding/exact_duals.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "switchyard/cones.hpp"
#include "switchyard/problem.hpp"

namespace switchyard::rounding {
namespace {

constexpr double kJustInside = 1 - 0x1p-48;  // of a norm, over the rounding of its evaluation

struct Entry {
  double value;  // of the matrix
  double sign;   // of a dual that may stand there; 0: none may
  double* dual;
};

class Exactness {
 public:
  Exactness(const sy_problem& problem, Duals& duals) : p_(problem), duals_(duals) {
    std::int32_t row = 0;
    for (std::int32_t c = 0; c < p_.num_cones; ++c) {
      begin_.push_back(row);
      cone_.insert(cone_.end(), static_cast<std::size_t>(p_.cones[c].dim), c);
      row += p_.cones[c].dim;
    }
  }

  void Column(std::int32_t j) {
    const double q = p_.q != nullptr ? p_.q[j] : 0;
    const std::int32_t in_rows = Count(p_.A, j), in_cones = Count(p_.F, j);
    if (Count(p_.P, j) > 0) return;
    if (in_rows == 0 && in_cones == 1 && Head(p_.F->row[p_.F->start[j]], q, FirstOf(p_.F, j))) {
      return;
    }
    Share(j, q);
  }

 private:
  static std::int32_t Count(const sy_csc* m, std::int32_t j) {
    return m != nullptr ? m->start[j + 1] - m->start[j] : 0;
  }
  static double FirstOf(const sy_csc* m, std::int32_t j) { return m->value[m->start[j]]; }

  /// Was `row` a head of its cone, and the column dealt with?
  bool Head(std::int32_t row, double q, double f) {
    const std::int32_t c = cone_[static_cast<std::size_t>(row)];
    const sy_cone& cone = p_.cones[c];
    const std::int32_t place = row - begin_[static_cast<std::size_t>(c)];
    const bool second_order = cone.kind == SY_CONE_SECOND_ORDER && place == 0;
    const bool rotated = cone.kind == SY_CONE_ROTATED && place <= 1;
    if (!second_order && !rotated) return false;
    const double head = q / f;
    if (!(head >= 0) || !std::isfinite(head) || std::fma(head, f, -q) != 0) return true;
    double* y = duals_.cone.data() + (row - place);
    const std::span<double> tail(y + (second_order ? 1 : 2), y + cone.dim);
    y[place] = head;
    if (second_order) {
      Shorten(tail, head);
    } else {
      RaiseOther(y[1 - place], head, tail);
    }
    return true;
  }

  /// |tail| <= head.
  static void Shorten(std::span<double> tail, double head) {
    const double norm = Norm(tail);
    if (norm <= head * kJustInside) return;
    const double factor = head * kJustInside / norm;
    for (double& v : tail) v *= factor;
    if (!(factor > 0) || !(Norm(tail) <= head)) std::fill(tail.begin(), tail.end(), 0.0);
  }

  /// 2 head other >= |tail|^2.
  static void RaiseOther(double& other, double head, std::span<double> tail) {
    const double norm = Norm(tail);
    const double needed = norm == 0 ? 0 : norm * norm / (2 * head) / kJustInside;
    if (std::isfinite(needed)) {
      other = std::max({other, needed, 0.0});
    } else {
      std::fill(tail.begin(), tail.end(), 0.0);
      other = std::max(other, 0.0);
    }
  }

  static double Norm(std::span<const double> v) {
    long double square = 0;
    for (const double e : v) square += static_cast<long double>(e) * e;
    return static_cast<double>(std::sqrt(square));
  }

  void Share(std::int32_t j, double q) {
    Collect(j);
    if (!Bears(q)) return;
    // Multiples of q's last place below q are doubles, and so is each sum of them up to q.
    int exponent;
    std::frexp(q, &exponent);
    const double unit = std::ldexp(1.0, exponent - 53);
    const auto part = [&](const Entry& e) {
      return q == 0 ? 0.0 : std::max(0.0, e.value * *e.dual / q);
    };
    double sum = 0;
    for (const Entry& e : entries_) sum += part(e);
    const double whole = std::abs(q);
    double left = whole;
    Entry* largest = nullptr;
    double most = -1;
    for (Entry& e : entries_) {
      const double share = sum > 0 && std::isfinite(sum) ? part(e) / sum : 0;
      const double taken = q == 0 ? 0 : std::min(left, std::floor(share * (whole / unit)) * unit);
      left -= taken;
      *e.dual = std::copysign(taken, q) / e.value;
      if (taken > most) {
        most = taken;
        largest = &e;
      }
    }
    *largest->dual = std::copysign(most + left, q) / largest->value;
  }

  /// Can the entries' terms, of one sign all, add up to q and nothing else?
  [[nodiscard]] bool Bears(double q) const {
    if (entries_.empty()) return false;
    const double sign = q != 0 ? q : entries_.front().sign * entries_.front().value;
    return std::all_of(entries_.begin(), entries_.end(), [&](const Entry& e) {
      int exponent;
      return std::abs(std::frexp(e.value, &exponent)) == 0.5 && e.sign * e.value * sign > 0;
    });
  }

  void Collect(std::int32_t j) {
    entries_.clear();
    for (std::int32_t k = 0; k < Count(p_.A, j); ++k) {
      const std::int32_t at = p_.A->start[j] + k, i = p_.A->row[at];
      const bool below = p_.row_lower != nullptr && p_.row_lower[i] > -kInfinity;
      const bool above = p_.row_upper != nullptr && p_.row_upper[i] < kInfinity;
      const double sign = below == above ? 0 : (below ? 1 : -1);
      entries_.push_back({p_.A->value[at], sign, &duals_.row[static_cast<std::size_t>(i)]});
    }
    for (std::int32_t k = 0; k < Count(p_.F, j); ++k) {
      const std::int32_t at = p_.F->start[j] + k, i = p_.F->row[at];
      const sy_cone& cone = p_.cones[cone_[static_cast<std::size_t>(i)]];
      const double sign = cone.kind == SY_CONE_NONNEGATIVE ? 1 : 0;
      entries_.push_back({p_.F->value[at], sign, &duals_.cone[static_cast<std::size_t>(i)]});
    }
  }

  const sy_problem& p_;
  Duals& duals_;
  std::vector<std::int32_t> cone_, begin_;  // of each row of F, and where each cone's begin
  std::vector<Entry> entries_;
};

}  // namespace

void MakeExact(const sy_problem& problem, const double* lower, const double* upper, Duals& duals) {
  for (std::vector<double>* part : {&duals.row, &duals.cone}) {
    std::replace_if(
        part->begin(), part->end(), [](double v) { return !std::isfinite(v); }, 0.0);
  }
  Exactness exactness(problem, duals);
  for (std::int32_t j = 0; j < problem.num_vars; ++j) {
    const bool boxed =
        lower != nullptr && upper != nullptr && std::isfinite(lower[j]) && std::isfinite(upper[j]);
    if (!boxed) exactness.Column(j);
  }
}

}  // namespace switchyard::rounding
