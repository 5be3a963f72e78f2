// The filling of kkt_values.hpp with numbers of twice the digits.
#include <cmath>

#include "solvers/conic/kkt_filling.hpp"

namespace switchyard::conic {
namespace {

using Number = linalg::Twofold<double>;

struct Twofold {
  linalg::NumbersOf<double> value;
  static Number Product(double a, double b) { return Number::Product(a, b); }
  void Add(Index entry, const Number& v) {
    const Number sum = Number{value.high[entry], value.low[entry]} + v;
    const bool infinite = std::isinf(v.high);  // has no rest
    value.high[entry] = infinite ? v.high : sum.high;
    value.low[entry] = infinite ? 0 : sum.low;
  }
};

}  // namespace

void FillTwofoldValues(const Form& form, const KktPlan& plan, const KktWeights& weights,
                       const linalg::NumbersOf<double>& value) {
  KktFilling<Number, Twofold>(form, plan, weights, {value}).Fill();
}

}  // namespace switchyard::conic
