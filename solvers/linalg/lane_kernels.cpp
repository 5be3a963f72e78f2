#include "solvers/linalg/lane_kernels.hpp"

#include "solvers/linalg/lane_elimination.hpp"

namespace switchyard::linalg {

using lanes::As;

namespace {

SWITCHYARD_EACH_ISA int FactorPlain(const LaneShape& shape, const PivotRule& rule, double* l,
                                    double* inverse_pivot, double* triangle) {
  alignas(64) double size[kMostColumns * kLanes];
  if (shape.lanes == 1) return lanes::Factor(shape.block, rule, l, inverse_pivot, triangle, size);
  return lanes::Factor(shape.block, rule, As<Lanes>(l), As<Lanes>(inverse_pivot),
                       As<Lanes>(triangle), As<Lanes>(size));
}

SWITCHYARD_EACH_ISA void ForwardPlain(const LaneShape& shape, const double* l, double* x) {
  shape.lanes == 1 ? lanes::Forward(shape.block, l, x)
                   : lanes::Forward(shape.block, As<Lanes>(l), As<Lanes>(x));
}

SWITCHYARD_EACH_ISA void BackwardPlain(const LaneShape& shape, const double* l,
                                       const double* inverse_pivot, double* x) {
  shape.lanes == 1
      ? lanes::Backward(shape.block, l, inverse_pivot, x)
      : lanes::Backward(shape.block, As<Lanes>(l), As<Lanes>(inverse_pivot), As<Lanes>(x));
}

}  // namespace

int FactorLanes(const LaneShape& shape, const PivotRule& rule, double* l, double* inverse_pivot,
                double* triangle) {
  return shape.digits == Digits::kPlain
             ? FactorPlain(shape, rule, l, inverse_pivot, triangle)
             : FactorTwofoldLanes(shape, rule, l, inverse_pivot, triangle);
}
void ForwardLanes(const LaneShape& shape, const double* l, double* x) {
  shape.digits == Digits::kPlain ? ForwardPlain(shape, l, x) : ForwardTwofoldLanes(shape, l, x);
}
void BackwardLanes(const LaneShape& shape, const double* l, const double* inverse_pivot,
                   double* x) {
  shape.digits == Digits::kPlain ? BackwardPlain(shape, l, inverse_pivot, x)
                                 : BackwardTwofoldLanes(shape, l, inverse_pivot, x);
}

void AddScattered(const LaneShape& shape, const double* from, const std::vector<Index>& place,
                  const NumbersOf<double>& to) {
  if (shape.digits == Digits::kTwofold) return AddTwofoldScattered(shape, from, place, to);
  for (std::size_t k = 0; k < place.size(); ++k) to.high[place[k]] += from[k];
}

}  // namespace switchyard::linalg
