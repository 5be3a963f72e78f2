// 2 s_0 s_1 >= |s_2|^2 becomes a second-order cone in rotated coordinates: see rotate_cones.hpp.
#include "core/bridges/bridges.hpp"
#include "core/bridges/rotate_cones.hpp"

namespace switchyard {

BridgeKind RotatedToSecondOrder() {
  return {"rotated to second-order cones", ConeFeature(SY_CONE_ROTATED),
          ConeFeature(SY_CONE_SECOND_ORDER), [](ProblemData d) {
            return RotateCones(std::move(d), SY_CONE_ROTATED, SY_CONE_SECOND_ORDER);
          }};
}

}  // namespace switchyard
