// tests/fuzz/there_and_back.hpp - what a reader promises of any bytes.
#pragma once

#include <cstddef>
#include <cstdint>

#include "switchyard/io/format.hpp"

namespace switchyard::fuzz {

/// Reads the bytes. Whatever they are, this ends in a program or in a FileError whose place is in
/// them; a program, where the format can hold it, is written, read again and the same.
/// Aborts, with a sentence, where that does not hold.
void ReadThereAndBack(const std::uint8_t* data, std::size_t size, FileFormat format);

/// The same of gcs/1.
void ReadGraphThereAndBack(const std::uint8_t* data, std::size_t size);

/// The same of trajectory/1, and of tables of trajectories where the text does not start with "{".
void ReadTrajectoryThereAndBack(const std::uint8_t* data, std::size_t size);

}  // namespace switchyard::fuzz
