#include "solvers/linalg/ldl.hpp"

#include <utility>

namespace switchyard::linalg {
namespace {

// Multiplications for each entry of L, above which fronts pay for themselves.
constexpr double kWorkPerEntry = 15;

}  // namespace

Ldl::Ldl(const SymmetricPattern& pattern, const std::vector<std::int8_t>& sign,
         const EliminationWish& wish)
    : Ldl(LeastWork(pattern, wish), sign) {}

Ldl::Ldl(Planned planned, const std::vector<std::int8_t>& sign)
    : elimination_(std::make_shared<const Elimination>(std::move(planned.elimination))),
      sign_(sign),
      high_(sign.size()),
      respects_groups_(planned.respects_groups),
      work_(elimination_->Work()),
      factor_size_(elimination_->FactorSize()) {
  MakeRoom();
}

Ldl::Ldl(const Ldl& other)
    : elimination_(other.elimination_),
      sign_(other.sign_),
      high_(sign_.size()),
      respects_groups_(other.respects_groups_),
      work_(other.work_),
      factor_size_(other.factor_size_) {
  MakeRoom();
}

void Ldl::MakeRoom() {
  if (work_ <= kWorkPerEntry * factor_size_) {
    simplicial_.emplace(*elimination_, sign_);
  } else {
    fronts_.emplace(*elimination_, sign_, Digits::kPlain);
    high_.resize(static_cast<std::size_t>(fronts_->room()));
  }
}

int Ldl::Factor(const Numbers& values, const PivotRule& rule, Workers* workers) {
  digits_ = values.digits();
  if (digits_ == Digits::kTwofold) {
    fronts_.reset();  // not both
    simplicial_.reset();
    if (!twofold_) twofold_.emplace(*elimination_, sign_, digits_);
    high_.resize(static_cast<std::size_t>(twofold_->room()));
    low_.resize(high_.size());
    return twofold_->Factor(values, rule, workers);
  }
  twofold_.reset();
  if (!fronts_ && !simplicial_) MakeRoom();
  return fronts_ ? fronts_->Factor(values, rule, workers) : simplicial_->Factor(values.high, rule);
}

void Ldl::Solve(double* high, double* low, Workers* workers) const {
  const std::vector<Index>& order = elimination_->order;
  const bool twofold = digits_ == Digits::kTwofold;
  for (std::size_t k = 0; k < order.size(); ++k) high_[k] = high[order[k]];
  for (std::size_t k = 0; twofold && k < order.size(); ++k) {
    low_[k] = low != nullptr ? low[order[k]] : 0;
  }
  if (twofold) {
    twofold_->Solve({high_.data(), low_.data()}, workers);
  } else if (fronts_) {
    fronts_->Solve({high_.data(), nullptr}, workers);
  } else {
    simplicial_->Solve(high_.data());
  }
  for (std::size_t k = 0; k < order.size(); ++k) high[order[k]] = high_[k];
  for (std::size_t k = 0; twofold && low != nullptr && k < order.size(); ++k) {
    low[order[k]] = low_[k];
  }
}

}  // namespace switchyard::linalg
