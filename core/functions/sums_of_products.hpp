// core/functions/sums_of_products.hpp - a computation planned as sums of products on fixed slots.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace switchyard {

/// The place of a number in the workspace of a function. While a function is planned, slot -1 - k
/// is the k-th constant: how many there are, and so where they stand, is known at the end.
using Slot = std::int32_t;

class Constants {
 public:
  static constexpr Slot kOne = -1;

  Constants() { Of(1); }

  Slot Of(double value);
  [[nodiscard]] static bool Is(Slot slot) { return slot < 0; }
  [[nodiscard]] double Value(Slot slot) const { return values_[-1 - slot]; }
  [[nodiscard]] const std::vector<double>& values() const { return values_; }
  /// Where `slot` stands if the constants are stored from `base` on.
  [[nodiscard]] static Slot Stored(Slot slot, Slot base) {
    return slot < 0 ? base - 1 - slot : slot;
  }

 private:
  std::vector<double> values_;
  std::unordered_map<std::uint64_t, Slot> slot_of_;  // by their bits
};

/// What is at `a` times what is at `b`.
struct Product {
  Slot a;
  Slot b;
};

/// Sums s_t = sum_k a_k b_k, written to consecutive slots in their order; a product may name
/// earlier sums.
///
/// A sum that needs no operation gets no slot of its own: of constants it is a constant, and 1 b
/// is b.
class SumsOfProducts {
 public:
  /// The sums are written from slot `first` on.
  explicit SumsOfProducts(Slot first) : first_(first) {}

  /// Plans a sum of at least one product; gives the slot where it will be.
  Slot Plan(std::span<const Product> products, Constants* constants);
  /// Closes the plan: constants are read from `base` on.
  void Store(Slot base);

  [[nodiscard]] Slot end() const { return first_ + static_cast<Slot>(start_.size()) - 1; }
  [[nodiscard]] std::int64_t num_products() const { return std::ssize(product_); }

  /// Carries out the plan. Where `guarded`, a product of 0 and anything is 0, infinite or NaN too:
  /// a branch that is not taken adds nothing, whatever its derivative.
  void Run(double* slots, bool guarded) const;

 private:
  template <bool guarded>
  void RunAs(double* slots) const;
  Slot Emit(std::span<const Product> products);

  struct Remembered {
    Product product = {0, 0};
    Slot slot = 0;
    bool known = false;
  };

  Slot first_;
  std::vector<std::int64_t> start_ = {0};
  std::vector<Product> product_;
  std::vector<Product> kept_;           // scratch of Plan
  std::vector<Remembered> remembered_;  // single products planned lately, by their hash
};

}  // namespace switchyard
