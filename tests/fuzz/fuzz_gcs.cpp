// The reader and writer of gcs/1 on any bytes; libFuzzer's entry, and run_corpus's.
#include "tests/fuzz/there_and_back.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  switchyard::fuzz::ReadGraphThereAndBack(data, size);
  return 0;
}
