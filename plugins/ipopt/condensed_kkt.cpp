#include "condensed_kkt.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "pattern_builder.hpp"

namespace switchyard::ipopt {
namespace {

using linalg::Index;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

double Largest(const std::vector<double>& v) {
  double largest = 0;
  for (const double one : v) largest = std::max(largest, std::abs(one));
  return largest;
}

}  // namespace

std::unique_ptr<CondensedKkt> CondensedKkt::Make(Entries entries, const Counts& counts) {
  std::unique_ptr<CondensedKkt> made(new CondensedKkt(std::move(entries), counts));
  if (!made->FindPairs()) return nullptr;
  made->FindRows();
  return made->FindPattern() ? std::move(made) : nullptr;
}

CondensedKkt::CondensedKkt(Entries entries, const Counts& counts)
    : a_(std::move(entries)),
      counts_(counts),
      number_(static_cast<std::size_t>(a_.n), 0),
      part_(a_.row.size()),
      to_(a_.row.size()),
      x_(number_.size()),
      residual_(number_.size()),
      size_(number_.size()),
      row_size_(number_.size()) {}

// A slack has but its own multiplier beside it. Slacks stand in the order of their multipliers.
bool CondensedKkt::FindPairs() {
  if (counts_.inequalities == 0) {
    std::iota(number_.begin(), number_.end(), 0);
    kept_ = a_.n;
    return true;
  }
  constexpr Index kNone = -1, kMany = -2;
  std::vector<Index> beside(number_.size(), kNone);
  const auto meet = [&beside](Index i, Index j) {
    beside[i] = beside[i] == kNone || beside[i] == j ? j : kMany;
  };
  for (std::size_t k = 0; k < a_.row.size(); ++k) {
    if (a_.row[k] == a_.col[k]) continue;
    meet(a_.row[k], a_.col[k]);
    meet(a_.col[k], a_.row[k]);
  }
  const Index first = a_.n - counts_.inequalities;
  Index slack = first - 1;
  while (slack >= 0 && beside[slack] != a_.n - 1) --slack;
  slack -= counts_.inequalities - 1;
  if (first < 0 || slack < 0) return false;
  for (Index i = 0; i < counts_.inequalities; ++i) {
    Pair pair;
    pair.slack = slack + i;
    pair.multiplier = first + i;
    if (pair.slack >= first || beside[pair.slack] != pair.multiplier) return false;
    number_[pair.slack] = number_[pair.multiplier] = -1 - i;
    pairs_.push_back(pair);
  }
  for (Index& number : number_) {
    if (number >= 0) number = kept_++;
  }
  return true;
}

// Of each pair, the columns of its row of J_d, each once.
void CondensedKkt::FindRows() {
  std::vector<std::vector<std::size_t>> of_row(pairs_.size());
  for (std::size_t k = 0; k < a_.row.size(); ++k) {
    Index i = a_.row[k], j = a_.col[k];
    if (number_[i] >= 0 && number_[j] >= 0) {
      part_[k] = Part::kKept;
      continue;
    }
    if (number_[i] >= 0) std::swap(i, j);
    const auto pair = static_cast<std::size_t>(-1 - number_[i]);
    to_[k] = pair;
    if (number_[j] >= 0) {
      part_[k] = Part::kRow;
      of_row[pair].push_back(k);
    } else {
      part_[k] = i != j ? Part::kLink : i == pairs_[pair].slack ? Part::kSigma : Part::kD;
    }
  }
  std::vector<Index> seen(static_cast<std::size_t>(kept_), -1);
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    pairs_[i].begin = row_col_.size();
    for (const std::size_t k : of_row[i]) {
      const Index column = std::max(number_[a_.row[k]], number_[a_.col[k]]);
      Index& at = seen[column];
      if (at < static_cast<Index>(pairs_[i].begin)) {
        at = static_cast<Index>(row_col_.size());
        row_col_.push_back(column);
      }
      to_[k] = static_cast<std::size_t>(at);
    }
    pairs_[i].end = row_col_.size();
  }
  row_value_.resize(row_col_.size());
}

bool CondensedKkt::FindPattern() {
  std::size_t count = a_.row.size() + number_.size();
  for (const Pair& pair : pairs_) count += (pair.end - pair.begin) * (pair.end - pair.begin);
  if (count > std::numeric_limits<Index>::max() / 2) return false;
  PatternBuilder builder(kept_);
  for (Index j = 0; j < kept_; ++j) builder.Add(j, j);
  for (std::size_t k = 0; k < a_.row.size(); ++k) {
    if (part_[k] == Part::kKept) to_[k] = builder.Add(number_[a_.row[k]], number_[a_.col[k]]);
  }
  const std::size_t products = builder.size();
  for (Pair& pair : pairs_) {
    pair.product = builder.size() - products;
    for (std::size_t p = pair.begin; p < pair.end; ++p) {
      for (std::size_t q = pair.begin; q <= p; ++q) builder.Add(row_col_[p], row_col_[q]);
    }
  }
  const std::vector<Index> entry = builder.Finish();
  for (std::size_t k = 0; k < to_.size(); ++k) {
    if (part_[k] == Part::kKept) to_[k] = static_cast<std::size_t>(entry[to_[k]]);
  }
  product_.assign(entry.begin() + static_cast<std::ptrdiff_t>(products), entry.end());
  k_.resize(builder.pattern().row.size());
  small_.resize(static_cast<std::size_t>(kept_));
  std::vector<Index> last(small_.size(), 0);
  std::fill(last.end() - std::min(counts_.equations, kept_), last.end(), 1);
  ldl_ = std::make_unique<PivotedLdl>(std::move(builder.pattern()), std::move(last));
  return true;
}

bool CondensedKkt::Condense(const double* values) {
  std::fill(k_.begin(), k_.end(), 0.0);
  std::fill(row_value_.begin(), row_value_.end(), 0.0);
  for (Pair& pair : pairs_) pair.sigma = pair.link = pair.d = 0;
  for (std::size_t k = 0; k < a_.row.size(); ++k) {
    const std::size_t to = to_[k];
    switch (part_[k]) {
      case Part::kKept:
        k_[to] += values[k];
        break;
      case Part::kRow:
        row_value_[to] += values[k];
        break;
      case Part::kSigma:
        pairs_[to].sigma += values[k];
        break;
      case Part::kLink:
        pairs_[to].link += values[k];
        break;
      case Part::kD:
        pairs_[to].d += values[k];
        break;
    }
  }
  for (Pair& pair : pairs_) {
    const double pivot = pair.link * pair.link / pair.sigma - pair.d;
    pair.s = 1 / pivot;
    if (!(pair.sigma > 0 && pivot > 0 && std::isfinite(pair.s))) return false;
    const Index* to = product_.data() + pair.product;
    for (std::size_t p = pair.begin; p < pair.end; ++p) {
      const double weighted = pair.s * row_value_[p];
      for (std::size_t q = pair.begin; q <= p; ++q) k_[*to++] += weighted * row_value_[q];
    }
  }
  return std::all_of(k_.begin(), k_.end(), [](double v) { return std::isfinite(v); });
}

std::optional<Inertia> CondensedKkt::Factor(const double* values, double u) {
  values_.assign(values, values + a_.row.size());
  if (!Condense(values)) return std::nullopt;
  std::fill(row_size_.begin(), row_size_.end(), 0.0);
  for (std::size_t k = 0; k < a_.row.size(); ++k) {
    row_size_[a_.row[k]] += std::abs(values[k]);
    if (a_.row[k] != a_.col[k]) row_size_[a_.col[k]] += std::abs(values[k]);
  }
  Inertia inertia = ldl_->Factor(k_.data(), u);
  inertia.negative += counts_.inequalities;
  return inertia;
}

// With g = b_y - (link / sigma) b_s:  K x = b_x + J' S g,  y = S (J x - g),
// s = (b_s - link y) / sigma.
void CondensedKkt::SolveOnce(double* b) {
  for (std::size_t j = 0; j < number_.size(); ++j) {
    if (number_[j] >= 0) small_[number_[j]] = b[j];
  }
  for (const Pair& pair : pairs_) {
    double& g = b[pair.multiplier];
    g -= pair.link / pair.sigma * b[pair.slack];
    const double weighted = pair.s * g;
    for (std::size_t p = pair.begin; p < pair.end; ++p) {
      small_[row_col_[p]] += row_value_[p] * weighted;
    }
  }
  ldl_->Solve(small_.data());
  for (std::size_t j = 0; j < number_.size(); ++j) {
    if (number_[j] >= 0) b[j] = small_[number_[j]];
  }
  for (const Pair& pair : pairs_) {
    double product = 0;
    for (std::size_t p = pair.begin; p < pair.end; ++p) {
      product += row_value_[p] * small_[row_col_[p]];
    }
    double& y = b[pair.multiplier];
    y = pair.s * (product - y);
    b[pair.slack] = (b[pair.slack] - pair.link * y) / pair.sigma;
  }
}

/// residual_ = b - A x; the largest of its rows relative to the sizes of the row's terms. Where
/// these are rounding errors themselves they are no measure, and what they could have been is added
/// (Arioli, Demmel and Duff, SIAM J. Matrix Anal. Appl. 10, 1989).
double CondensedKkt::Residual(const std::vector<double>& b, const std::vector<double>& x) {
  residual_ = b;
  for (std::size_t i = 0; i < b.size(); ++i) size_[i] = std::abs(b[i]);
  for (std::size_t k = 0; k < a_.row.size(); ++k) {
    const Index i = a_.row[k], j = a_.col[k];
    const double term = values_[k] * x[j];
    residual_[i] -= term;
    size_[i] += std::abs(term);
    if (i == j) continue;
    const double mirrored = values_[k] * x[i];
    residual_[j] -= mirrored;
    size_[j] += std::abs(mirrored);
  }
  constexpr double kRounding = 1000 * kEpsilon;
  const double longest = Largest(x);
  double worst = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    const double could_be = row_size_[i] * longest;
    const double size = size_[i] + (size_[i] > kRounding * could_be ? 0 : could_be);
    const double relative = std::abs(residual_[i]) / size;
    if (size > 0 && !(relative <= worst)) worst = relative;
  }
  return worst;
}

bool CondensedKkt::Solve(double* b) {
  constexpr int kRounds = 6;
  constexpr double kGood = 64 * kEpsilon, kEnough = 1e-9, kProgress = 0.5, kFar = 1e6;
  const std::vector<double> given(b, b + number_.size());
  SolveOnce(b);
  x_.assign(b, b + number_.size());
  double worst = Residual(given, x_);
  for (int round = 0; round < kRounds && worst > kGood; ++round) {
    SolveOnce(residual_.data());
    std::vector<double> next = x_;
    for (std::size_t i = 0; i < next.size(); ++i) next[i] += residual_[i];
    const double then = Residual(given, next);
    if (!(then < worst)) break;
    const bool slow = then > kProgress * worst;
    x_ = std::move(next);
    worst = then;
    if (slow) break;
  }
  std::copy(x_.begin(), x_.end(), b);
  if (worst <= kEnough) return true;
  Residual(given, x_);
  return Largest(residual_) <=
         kEnough * (Largest(given) + std::min(Largest(x_), kFar * Largest(given)));
}

}  // namespace switchyard::ipopt
