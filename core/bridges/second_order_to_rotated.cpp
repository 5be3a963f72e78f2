// s_0 >= |s_1..| becomes a rotated cone in rotated coordinates: see rotate_cones.hpp.
#include "core/bridges/bridges.hpp"
#include "core/bridges/rotate_cones.hpp"

namespace switchyard {

BridgeKind SecondOrderToRotated() {
  return {"second-order to rotated cones", ConeFeature(SY_CONE_SECOND_ORDER),
          ConeFeature(SY_CONE_ROTATED) | ConeFeature(SY_CONE_NONNEGATIVE), [](ProblemData d) {
            return RotateCones(std::move(d), SY_CONE_SECOND_ORDER, SY_CONE_ROTATED);
          }};
}

}  // namespace switchyard
