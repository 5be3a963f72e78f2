#include "core/functions/sums_of_products.hpp"

#include <bit>
#include <cstddef>
#include <utility>

#include "switchyard/error.hpp"

namespace switchyard {
namespace {

constexpr std::size_t kRemembered = 4096;

std::size_t Hash(Product p) {
  const std::uint64_t pair =
      (std::uint64_t{static_cast<std::uint32_t>(p.a)} << 32) | static_cast<std::uint32_t>(p.b);
  return static_cast<std::size_t>((pair * 0x9e3779b97f4a7c15u) >> 52);  // < kRemembered
}

template <bool guarded>
double Times(double a, double b) {
  if constexpr (guarded) return a == 0 || b == 0 ? 0 : a * b;
  return a * b;
}

}  // namespace

Slot Constants::Of(double value) {
  const auto [found, is_new] = slot_of_.try_emplace(std::bit_cast<std::uint64_t>(value),
                                                    -1 - static_cast<Slot>(values_.size()));
  if (is_new) values_.push_back(value);
  return found->second;
}

Slot SumsOfProducts::Plan(std::span<const Product> products, Constants* constants) {
  double known = 0;
  kept_.clear();
  for (const Product p : products) {
    if (Constants::Is(p.a) && Constants::Is(p.b)) {
      known += constants->Value(p.a) * constants->Value(p.b);
    } else {
      kept_.push_back(p);
    }
  }
  if (kept_.empty()) return constants->Of(known);
  if (known != 0) kept_.push_back({constants->Of(known), Constants::kOne});
  if (kept_.size() > 1) return Emit(kept_);

  Product p = kept_.front();
  if (p.a == Constants::kOne || p.b == Constants::kOne) return p.a == Constants::kOne ? p.b : p.a;
  if (p.a > p.b) std::swap(p.a, p.b);
  remembered_.resize(kRemembered);
  Remembered& last = remembered_[Hash(p)];
  if (!last.known || last.product.a != p.a || last.product.b != p.b) last = {p, Emit(kept_), true};
  return last.slot;
}

Slot SumsOfProducts::Emit(std::span<const Product> products) {
  constexpr std::ptrdiff_t kMostSlots = std::ptrdiff_t{1} << 30;
  Require(first_ + std::ssize(start_) < kMostSlots, "function: its derivatives need more than ",
          kMostSlots, " numbers");
  product_.insert(product_.end(), products.begin(), products.end());
  start_.push_back(std::ssize(product_));
  return end() - 1;
}

void SumsOfProducts::Store(Slot base) {
  for (Product& p : product_) p = {Constants::Stored(p.a, base), Constants::Stored(p.b, base)};
  remembered_ = {};
  kept_ = {};
}

void SumsOfProducts::Run(double* slots, bool guarded) const {
  guarded ? RunAs<true>(slots) : RunAs<false>(slots);
}

template <bool guarded>
void SumsOfProducts::RunAs(double* slots) const {
  double* sum = slots + first_;
  const Product* p = product_.data();
  for (std::size_t t = 1; t < start_.size(); ++t) {
    const Product* const end = product_.data() + start_[t];
    double s = Times<guarded>(slots[p->a], slots[p->b]);
    for (++p; p < end; ++p) s += Times<guarded>(slots[p->a], slots[p->b]);
    *sum++ = s;
  }
}

}  // namespace switchyard
