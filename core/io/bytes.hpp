// core/io/bytes.hpp - whole files in and out, gzip among them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace switchyard::io {

/// The bytes of a file, of standard input for "-". Throws InvalidArgument where it cannot be read
/// or has more than `limit` bytes.
std::string ReadBytes(const std::string& path, std::size_t limit);

/// Does it start as a gzip file does?
bool IsGzip(std::string_view bytes);

/// What a gzip file holds, of one member or of several. Throws InvalidArgument, naming `path`,
/// where it is damaged, where it holds more than `limit` bytes, and where it is a bomb: more than
/// 64 MB and more than 250 times what is compressed (no file of numbers and names comes near).
std::string Unzipped(std::string_view bytes, const std::string& path, std::size_t limit);
std::string Zipped(std::string_view bytes);

/// Writes the file, or to standard output for "-". Throws InvalidArgument where that fails.
void WriteBytes(const std::string& path, std::string_view bytes);

}  // namespace switchyard::io
