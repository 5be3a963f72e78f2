// The readers and writers of trajectories on any bytes; libFuzzer's entry, and run_corpus's.
#include "tests/fuzz/there_and_back.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  switchyard::fuzz::ReadTrajectoryThereAndBack(data, size);
  return 0;
}
