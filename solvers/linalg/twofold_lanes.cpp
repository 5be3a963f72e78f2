// The loops of lane_kernels.hpp with numbers of twice the digits.
#include "solvers/linalg/lane_elimination.hpp"

namespace switchyard::linalg {

using lanes::As;
using One = Twofold<double>;
using Eight = Twofold<Lanes>;

SWITCHYARD_EACH_ISA int FactorTwofoldLanes(const LaneShape& shape, const PivotRule& rule, double* l,
                                           double* inverse_pivot, double* triangle) {
  alignas(64) double size[kMostColumns * kLanes];
  if (shape.lanes == 1) {
    return lanes::Factor(shape.block, rule, As<One>(l), As<One>(inverse_pivot), As<One>(triangle),
                         size);
  }
  return lanes::Factor(shape.block, rule, As<Eight>(l), As<Eight>(inverse_pivot),
                       As<Eight>(triangle), As<Lanes>(size));
}

SWITCHYARD_EACH_ISA void ForwardTwofoldLanes(const LaneShape& shape, const double* l, double* x) {
  shape.lanes == 1 ? lanes::Forward(shape.block, As<One>(l), As<One>(x))
                   : lanes::Forward(shape.block, As<Eight>(l), As<Eight>(x));
}

SWITCHYARD_EACH_ISA void BackwardTwofoldLanes(const LaneShape& shape, const double* l,
                                              const double* inverse_pivot, double* x) {
  shape.lanes == 1
      ? lanes::Backward(shape.block, As<One>(l), As<One>(inverse_pivot), As<One>(x))
      : lanes::Backward(shape.block, As<Eight>(l), As<Eight>(inverse_pivot), As<Eight>(x));
}

void AddTwofoldScattered(const LaneShape& shape, const double* from,
                         const std::vector<Index>& place, const NumbersOf<double>& to) {
  const auto lanes = static_cast<std::size_t>(shape.lanes);
  for (std::size_t k = 0; k < place.size(); k += lanes) {
    const double* at = from + 2 * k;
    for (std::size_t l = 0; l < lanes; ++l) {
      double& high = to.high[place[k + l]];
      double& low = to.low[place[k + l]];
      const One sum = One{high, low} + One{at[l], at[lanes + l]};
      high = sum.high;
      low = sum.low;
    }
  }
}

}  // namespace switchyard::linalg
