#include "core/io/bytes.hpp"

#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "switchyard/error.hpp"

namespace switchyard::io {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 18;
constexpr std::size_t kBombSize = std::size_t{64} << 20;
constexpr std::size_t kBombRatio = 250;
constexpr int kGzipWindow = 15 + 16;  // zlib's way to ask for the gzip frame

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, FileCloser>;

// zlib counts in unsigned int.
unsigned Portion(std::size_t size) {
  return static_cast<unsigned>(std::min<std::size_t>(size, std::size_t{1} << 30));
}

Bytef* Input(std::string_view bytes) {
  return reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));  // zlib only reads it
}

class Inflater {
 public:
  explicit Inflater(std::string_view bytes) : bytes_(bytes) {
    Require(inflateInit2(&stream_, kGzipWindow) == Z_OK, "gzip: zlib cannot start: no memory");
    stream_.next_in = Input(bytes);
  }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  /// Fills out from `size` on; returns zlib's word on it.
  int Step(std::string* out, std::size_t* size) {
    const std::size_t room = std::min(out->size() - *size, std::size_t{1} << 30);
    stream_.avail_in = Portion(left());
    stream_.next_out = reinterpret_cast<Bytef*>(out->data() + *size);
    stream_.avail_out = static_cast<unsigned>(room);
    const int word = inflate(&stream_, Z_NO_FLUSH);
    *size += room - stream_.avail_out;
    return word;
  }
  bool NextMember() { return inflateReset(&stream_) == Z_OK; }
  [[nodiscard]] std::size_t left() const {
    return static_cast<std::size_t>(Input(bytes_) + bytes_.size() - stream_.next_in);
  }
  [[nodiscard]] std::string_view rest() const { return bytes_.substr(bytes_.size() - left()); }

 private:
  std::string_view bytes_;
  z_stream stream_{};
};

// The last four bytes of a gzip file tell the size of its last member, modulo 2^32: a hint for the
// first allocation, believed within what deflate usually does.
std::size_t SizeHint(std::string_view bytes, std::size_t limit) {
  std::size_t told = 0;
  if (bytes.size() >= 18) {
    for (std::size_t i = 0; i < 4; ++i) {
      told |= std::size_t{static_cast<unsigned char>(bytes[bytes.size() - 4 + i])} << (8 * i);
    }
  }
  return std::min({told, 40 * bytes.size(), limit}) + 1;
}

}  // namespace

std::string ReadBytes(const std::string& path, std::size_t limit) {
  const bool standard = path == "-";
  const File opened(standard ? nullptr : std::fopen(path.c_str(), "rb"));
  std::FILE* const file = standard ? stdin : opened.get();
  Require(file != nullptr, "cannot open ", path, ": ", std::strerror(errno));
  std::string bytes;
  for (std::size_t size = 0;;) {
    bytes.resize(std::max(size + kChunk, 2 * size));
    const std::size_t got = std::fread(bytes.data() + size, 1, bytes.size() - size, file);
    size += got;
    Require(size <= limit, path, ": a file of at most ", limit, " bytes is read, this has more");
    if (got > 0) continue;
    Require(std::ferror(file) == 0, "cannot read ", path, ": ", std::strerror(errno));
    bytes.resize(size);
    return bytes;
  }
}

bool IsGzip(std::string_view bytes) {
  return bytes.size() >= 3 && bytes[0] == '\x1F' && bytes[1] == '\x8B' && bytes[2] == '\x08';
}

std::string Unzipped(std::string_view bytes, const std::string& path, std::size_t limit) {
  Inflater inflater(bytes);
  std::string out(SizeHint(bytes, limit), '\0');
  std::size_t size = 0;
  for (;;) {
    const int word = inflater.Step(&out, &size);
    Require(size <= limit, path, ": the limit is ", limit,
            " bytes of decompressed text, this has more");
    Require(size <= kBombSize || size / kBombRatio <= bytes.size(), path,
            ": a file that decompresses to more than ", kBombRatio,
            " times its size is taken for an attack");
    if (word == Z_STREAM_END) {
      // Another member may follow, or padding, which is ignored as gzip does.
      if (!IsGzip(inflater.rest()) || !inflater.NextMember()) break;
      continue;
    }
    const bool starved = word == Z_BUF_ERROR || (word == Z_OK && size < out.size());
    Require(word == Z_OK || word == Z_BUF_ERROR, path, ": the gzip data is damaged after ", size,
            " bytes of text");
    Require(!starved || inflater.left() > 0 || size == out.size(), path,
            ": the gzip data ends too early, after ", size, " bytes of text");
    if (size == out.size()) out.resize(2 * size + kChunk);
  }
  out.resize(size);
  return out;
}

std::string Zipped(std::string_view bytes) {
  z_stream stream{};
  Require(deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kGzipWindow, 8,
                       Z_DEFAULT_STRATEGY) == Z_OK,
          "gzip: zlib cannot start: no memory");
  std::string out;
  std::size_t size = 0;
  stream.next_in = Input(bytes);
  for (int word = Z_OK; word != Z_STREAM_END;) {
    const auto left = static_cast<std::size_t>(Input(bytes) + bytes.size() - stream.next_in);
    out.resize(size + kChunk);
    stream.avail_in = Portion(left);
    stream.next_out = reinterpret_cast<Bytef*>(out.data() + size);
    stream.avail_out = static_cast<unsigned>(kChunk);
    word = deflate(&stream, stream.avail_in == left ? Z_FINISH : Z_NO_FLUSH);
    size += kChunk - stream.avail_out;
  }
  deflateEnd(&stream);
  out.resize(size);
  return out;
}

void WriteBytes(const std::string& path, std::string_view bytes) {
  const bool standard = path == "-";
  File opened(standard ? nullptr : std::fopen(path.c_str(), "wb"));
  std::FILE* const file = standard ? stdout : opened.get();
  Require(file != nullptr, "cannot write ", path, ": ", std::strerror(errno));
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  const bool flushed = standard ? std::fflush(file) == 0 : std::fclose(opened.release()) == 0;
  Require(written && flushed, "cannot write ", path, ": ", std::strerror(errno));
}

}  // namespace switchyard::io
