#include "kkt_slot.hpp"

#include <algorithm>
#include <exception>
#include <utility>

#ifdef IPOPT_HAS_HSL_LOADER
#include "HSLLoader.h"
#endif

namespace switchyard::ipopt {
namespace {

thread_local KktSlot* current = nullptr;

#ifdef IPOPT_HAS_HSL_LOADER

// Of INFO: 20 integers, of which these are read.
enum Info { kStatus = 0, kRank = 1, kRealsNeeded = 4, kIntegersNeeded = 5, kNegative = 14 };
constexpr int kInfoSize = 20;
constexpr ipfint kSingular = -5, kFailed = -99;

void Analyze(ipfint* n, ipfint* entries, const ipfint* row, const ipfint* col, ipfint*, ipfint*,
             ipfint* keep, ipfint*, ipfint* steps, ipfint*, ipfint*, double*, ipfint* info,
             double* operations) noexcept {
  std::fill_n(info, kInfoSize, 0);
  const int system = current != nullptr ? current->Analyze(*n, *entries, row, col) : -1;
  keep[0] = system;
  *steps = 1;
  *operations = 0;
  info[kRealsNeeded] = std::max<ipfint>(*entries, 1);
  info[kIntegersNeeded] = 1;
  if (system < 0) info[kStatus] = kFailed;
}

void Factor(ipfint* n, ipfint*, const ipfint*, const ipfint*, double* values, ipfint*,
            ipfint* integers, ipfint*, ipfint* keep, ipfint*, ipfint* front, ipfint*, ipfint*,
            double* tolerances, ipfint* info) noexcept {
  std::fill_n(info, kInfoSize, 0);
  integers[0] = keep[0];
  *front = 1;
  const auto inertia = current != nullptr ? current->Factor(keep[0], values, tolerances[0])
                                          : std::optional<Inertia>();
  if (!inertia) {
    info[kStatus] = kFailed;
  } else if (inertia->zero > 0) {
    info[kStatus] = kSingular;
    info[kRank] = *n - inertia->zero;
  } else {
    info[kNegative] = inertia->negative;
  }
}

void Solve(ipfint*, double*, ipfint*, ipfint* integers, ipfint*, double*, ipfint*, double* b,
           ipfint*, ipfint*, ipfint*, double*) noexcept {
  if (current != nullptr) current->Solve(integers[0], b);
}

void Defaults(ipfint*, double*) noexcept {}

#endif

}  // namespace

bool KktSlot::IsOpen() {
#ifdef IPOPT_HAS_HSL_LOADER
  return LSL_isMA27available() == 0;
#else
  return false;
#endif
}

KktSlot::KktSlot(const CondensedKkt::Counts& counts) : counts_(counts) {
  current = this;
#ifdef IPOPT_HAS_HSL_LOADER
  LSL_setMA27(switchyard::ipopt::Analyze, switchyard::ipopt::Factor, switchyard::ipopt::Solve,
              Defaults);
#endif
}

KktSlot::~KktSlot() {
  current = nullptr;
#ifdef IPOPT_HAS_HSL_LOADER
  LSL_setMA27(nullptr, nullptr, nullptr, nullptr);
#endif
}

int KktSlot::Analyze(int n, int entries, const int* row, const int* col) try {
  System system;
  system.entries.n = n;
  for (int k = 0; k < entries; ++k) {
    system.entries.row.push_back(row[k] - 1);
    system.entries.col.push_back(col[k] - 1);
  }
  system.condensed = CondensedKkt::Make(system.entries, counts_);
  systems_.push_back(std::move(system));
  return static_cast<int>(systems_.size()) - 1;
} catch (const std::exception&) {
  failed_ = true;
  return -1;
}

std::optional<Inertia> KktSlot::FactorWhole(System& system) {
  if (system.whole == nullptr) system.whole = CondensedKkt::Make(system.entries, {});
  system.uses_whole = true;
  if (system.whole == nullptr) return std::nullopt;
  return system.whole->Factor(system.values.data(), system.u);
}

std::optional<Inertia> KktSlot::Factor(int number, const double* values, double u) try {
  if (failed_) return std::nullopt;
  System& system = systems_[static_cast<std::size_t>(number)];
  system.values.assign(values, values + system.entries.row.size());
  system.u = u;
  system.uses_whole = false;
  std::optional<Inertia> inertia;
  if (system.condensed != nullptr) inertia = system.condensed->Factor(values, u);
  if (!inertia || inertia->zero > 0) inertia = FactorWhole(system);
  failed_ = !inertia;
  return inertia;
} catch (const std::exception&) {
  failed_ = true;
  return std::nullopt;
}

bool KktSlot::Solve(System& system, double* b) {
  const std::vector<double> given(b, b + system.entries.n);
  if (!system.uses_whole) {
    if (system.condensed->Solve(b)) return true;
    const auto inertia = FactorWhole(system);
    if (!inertia || inertia->zero > 0) return false;
    std::copy(given.begin(), given.end(), b);
  }
  return system.whole->Solve(b);
}

void KktSlot::Solve(int number, double* b) try {
  if (!Solve(systems_[static_cast<std::size_t>(number)], b)) failed_ = true;
} catch (const std::exception&) {
  failed_ = true;
}

}  // namespace switchyard::ipopt
