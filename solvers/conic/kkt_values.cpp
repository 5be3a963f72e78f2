#include "solvers/conic/kkt_values.hpp"

#include "solvers/conic/kkt_filling.hpp"

namespace switchyard::conic {
namespace {

struct Plain {
  double* value;
  static double Product(double a, double b) { return a * b; }
  void Add(Index entry, double v) { value[entry] += v; }
};

}  // namespace

void FillValues(const Form& form, const KktPlan& plan, const KktWeights& weights,
                const linalg::NumbersOf<double>& value) {
  if (value.low != nullptr) return FillTwofoldValues(form, plan, weights, value);
  KktFilling<double, Plain>(form, plan, weights, {value.high}).Fill();
}

}  // namespace switchyard::conic
