#include "core/symbolic/terms.hpp"

#include <algorithm>
#include <numeric>

namespace switchyard {
namespace {

using Terms = std::vector<Expression::LinearTerm>;

// Up to here comparing all pairs is faster than sorting.
constexpr std::size_t kFew = 24;

void MergeFew(Terms* terms) {
  std::size_t kept = 0;
  for (const auto& t : *terms) {
    const auto end = terms->begin() + static_cast<std::ptrdiff_t>(kept);
    const auto same = std::find_if(terms->begin(), end, [&t](const auto& earlier) {
      return earlier.variable.equal_to(t.variable);
    });
    if (same == end) {
      (*terms)[kept++] = t;
    } else {
      same->coefficient += t.coefficient;
    }
  }
  terms->resize(kept);
}

// Puts each sum where the variable first stands, and 0 at its other places.
void MergeMany(Terms* terms) {
  std::vector<std::size_t> by_variable(terms->size());
  std::iota(by_variable.begin(), by_variable.end(), std::size_t{0});
  std::sort(by_variable.begin(), by_variable.end(), [terms](std::size_t i, std::size_t j) {
    const Variable::Id a = (*terms)[i].variable.get_id();
    const Variable::Id b = (*terms)[j].variable.get_id();
    return a != b ? a < b : i < j;
  });
  std::size_t first = 0;
  for (std::size_t k = 1; k < by_variable.size(); ++k) {
    auto& sum = (*terms)[by_variable[first]];
    auto& term = (*terms)[by_variable[k]];
    if (!sum.variable.equal_to(term.variable)) {
      first = k;
      continue;
    }
    sum.coefficient += term.coefficient;
    term.coefficient = 0;
  }
}

}  // namespace

Terms Merged(Terms terms) {
  if (terms.size() > kFew) {
    MergeMany(&terms);
  } else {
    MergeFew(&terms);
  }
  std::erase_if(terms, [](const auto& t) { return t.coefficient == 0; });
  return terms;
}

}  // namespace switchyard
