#include "solvers/rounding/exact_duals.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "solvers/rounding/kept_entry.hpp"
#include "switchyard/problem.hpp"

namespace switchyard::rounding {
namespace {

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

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
      cone_.insert(cone_.end(), At(p_.cones[c].dim), c);
      row += p_.cones[c].dim;
    }
  }

  /// In [lower, upper], of which an end is infinite.
  void Column(std::int32_t j, double lower, double upper) {
    const double q = p_.q != nullptr ? p_.q[j] : 0;
    if (Count(p_.P, j) > 0) return;
    if (Count(p_.A, j) == 0 && Count(p_.F, j) == 1) {
      Alone(p_.F->row[p_.F->start[j]], q, p_.F->value[p_.F->start[j]], lower, upper);
    } else {
      Share(j, q);
    }
  }

 private:
  static std::int32_t Count(const sy_csc* m, std::int32_t j) {
    return m != nullptr ? m->start[j + 1] - m->start[j] : 0;
  }

  /// The column's one entry f is in `row`. What is no head is let be where an end bears it.
  void Alone(std::int32_t row, double q, double f, double lower, double upper) {
    const std::int32_t c = cone_[At(row)], begin = begin_[At(c)];
    const sy_cone& cone = p_.cones[c];
    const auto is_borne = [&](double rho) {
      return rho == 0 || (rho > 0 ? lower > -kInfinity : upper < kInfinity);
    };
    const auto rho_of = [&](double dual) { return std::fma(-dual, f, q); };
    if (!IsHead(cone, row - begin) && is_borne(rho_of(duals_.cone[At(row)]))) return;
    double kept = q / f;
    if (!is_borne(rho_of(kept))) {
      kept = std::nextafter(kept, (rho_of(kept) > 0) == (f > 0) ? kInfinity : -kInfinity);
    }
    if (!std::isfinite(kept) || !is_borne(rho_of(kept))) return;
    KeepEntry(cone, row - begin, kept, duals_.cone.data() + begin);
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
      entries_.push_back({p_.A->value[at], sign, &duals_.row[At(i)]});
    }
    for (std::int32_t k = 0; k < Count(p_.F, j); ++k) {
      const std::int32_t at = p_.F->start[j] + k, i = p_.F->row[at];
      const sy_cone& cone = p_.cones[cone_[At(i)]];
      const double sign = cone.kind == SY_CONE_NONNEGATIVE ? 1 : 0;
      entries_.push_back({p_.F->value[at], sign, &duals_.cone[At(i)]});
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
    const double l = lower != nullptr ? lower[j] : -kInfinity;
    const double u = upper != nullptr ? upper[j] : kInfinity;
    if (!std::isfinite(l) || !std::isfinite(u)) exactness.Column(j, l, u);
  }
}

}  // namespace switchyard::rounding
