// kkt_slot.hpp - condensed systems in a run of Ipopt.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "condensed_kkt.hpp"

namespace switchyard::ipopt {

/// While one lives, a run of Ipopt on its thread whose option linear_solver is "ma27" solves its
/// linear systems by CondensedKkt.
///
/// Ipopt 3.11 asks MA27 of HSL, which is not linked, through four pointers to functions that
/// HSLLoader.h lets a program set. The functions set here stand for that solver's: analysis of a
/// pattern, factorization with the count of negative eigenvalues, solution. They are of the whole
/// process and so are set by one solve at a time (SY_ONE_AT_A_TIME); another thread that calls them
/// is told that they failed.
///
/// A system that cannot be condensed, whose condensed form has a pivot without a sign, or with a
/// solution that is not to be trusted, is factored whole, by the same pivoted factorization.
class KktSlot {
 public:
  /// Is there such a way in? Not where this Ipopt has no loader, or has the real MA27 already.
  static bool IsOpen();

  explicit KktSlot(const CondensedKkt::Counts& counts);
  ~KktSlot();
  KktSlot(const KktSlot&) = delete;
  KktSlot& operator=(const KktSlot&) = delete;

  /// Was a solution not to be trusted? Then Ipopt's next factorization fails, and the run with it.
  [[nodiscard]] bool failed() const { return failed_; }

  // What the functions do; Ipopt holds on to a system by its number.
  /// Of a pattern, places from 1. -1: none.
  int Analyze(int n, int entries, const int* row, const int* col);
  /// Nothing where it failed.
  std::optional<Inertia> Factor(int system, const double* values, double u);
  void Solve(int system, double* b);

 private:
  struct System {
    CondensedKkt::Entries entries;
    std::unique_ptr<CondensedKkt> condensed;
    std::unique_ptr<CondensedKkt> whole;  // with nothing condensed; once it is needed
    bool uses_whole = false;
    std::vector<double> values;
    double u = 0;
  };
  static std::optional<Inertia> FactorWhole(System& system);
  static bool Solve(System& system, double* b);

  const CondensedKkt::Counts counts_;
  std::vector<System> systems_;
  bool failed_ = false;
};

}  // namespace switchyard::ipopt
