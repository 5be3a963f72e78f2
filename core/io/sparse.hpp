// core/io/sparse.hpp - the matrix that readers have put together in compressed columns.
#pragma once

#include <vector>

#include "switchyard/model/evaluator.hpp"

namespace switchyard::io {

/// start has cols + 1 entries; rows ascend within a column, no duplicates.
inline SparseMatrix CompressedColumns(int rows, int cols, const std::vector<int>& start,
                                      const std::vector<int>& row,
                                      const std::vector<double>& value) {
  return Eigen::Map<const SparseMatrix>(rows, cols, static_cast<Eigen::Index>(row.size()),
                                        start.data(), row.data(), value.data());
}

}  // namespace switchyard::io
