// core/model/scaled_identity.hpp - scale I.
#pragma once

#include "switchyard/model/evaluator.hpp"

namespace switchyard {

inline SparseMatrix ScaledIdentity(Eigen::Index size, double scale) {
  SparseMatrix I(size, size);
  I.setIdentity();
  return scale * I;
}

}  // namespace switchyard
