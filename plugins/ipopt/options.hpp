// options.hpp - Ipopt's own options: those listed, and any other that Ipopt itself knows.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "IpIpoptApplication.hpp"
#include "switchyard/abi.h"

namespace switchyard::ipopt {

/// The options that users set most, letter for letter.
const sy_option* const* OptionTable();

/// How a run goes about it.
enum class Way {
  kFullSteps,   // predictor and corrector, no line search: for convex programs
  kLineSearch,  // from anywhere, for any program
  kWarm         // likewise, from a point with its multipliers, which stays where it is
};

/// What there is of a program's derivatives, and what of it may be asked for once.
struct Derivatives {
  bool constant_jacobian = true;
  bool constant_hessian = true;
  bool has_hessian = true;
};

/// In which form linear systems are solved: see kkt_choice.hpp.
enum class KktForm { kAuto, kCondensed, kAugmented };
struct KktPlan {
  bool condensed = false;
  bool has_dense_column = false;
};

class Options {
 public:
  /// Throws Failure: an unknown name, another type, a value out of range.
  void Set(std::string_view name, const sy_value& value);

  /// What one solve runs with: the user's choice, else the host's, else the default of the table.
  void Give(const sy_control& control, Way way, const Derivatives& derivatives, const KktPlan& kkt,
            Ipopt::OptionsList& to) const;

  /// What the user wants of the option kkt. One who names a linear solver means Ipopt's.
  [[nodiscard]] KktForm Form() const;

  /// Are second derivatives asked for? Else Ipopt approximates them. Throws Failure where the user
  /// wants them and there are none.
  [[nodiscard]] bool UsesHessian(const Derivatives& derivatives) const;

  /// Has the user said how the barrier goes down, how long, or along which curvature?
  [[nodiscard]] bool ChoosesItsWay() const;

  [[nodiscard]] double Real(std::string_view name) const;

 private:
  struct Held {
    sy_type type = SY_REAL;
    double number = 0;
    std::string text;
  };

  static void GiveWay(Way way, Ipopt::OptionsList& to);
  static void GiveKkt(const KktPlan& kkt, Ipopt::OptionsList& to);
  void GiveDerivatives(const Derivatives& derivatives, Ipopt::OptionsList& to) const;
  static void Put(const std::string& name, const Held& held, Ipopt::OptionsList& to);

  std::map<std::string, Held, std::less<>> chosen_;
};

}  // namespace switchyard::ipopt
