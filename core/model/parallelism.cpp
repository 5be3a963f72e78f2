#include "switchyard/model/parallelism.hpp"

#include <thread>

namespace switchyard {

Parallelism Parallelism::Max() {
  return Parallelism(static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace switchyard
