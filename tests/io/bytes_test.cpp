#include "core/io/bytes.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "switchyard/io/read.hpp"
#include "switchyard/io/write.hpp"

namespace switchyard::io {
namespace {

constexpr std::size_t kLimit = std::size_t{1} << 30;

std::string Numbers(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += std::to_string(i * 2654435761U) + '\n';
  return text;
}

std::string Refusal(const std::string& zipped, std::size_t limit) {
  try {
    Unzipped(zipped, "f.gz", limit);
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "";
}

TEST(Gzip, GivesBackWhatItTook) {
  for (const int count : {0, 1, 1000, 300000}) {
    const std::string text = Numbers(count);
    const std::string zipped = Zipped(text);
    EXPECT_TRUE(IsGzip(zipped));
    EXPECT_EQ(Unzipped(zipped, "f.gz", kLimit), text);
  }
}

TEST(Gzip, ReadsMembersOneBehindTheOther) {
  const std::string text = Numbers(1000);
  EXPECT_EQ(Unzipped(Zipped("12\n") + Zipped(text) + std::string(10, '\0'), "f.gz", kLimit),
            Text("12\n", text));
}

TEST(Gzip, SaysWhatIsWrongWithAFile) {
  const std::string text = Numbers(1000);
  const std::string zipped = Zipped(text);
  EXPECT_EQ(Refusal(zipped.substr(0, 10), kLimit),
            "f.gz: the gzip data ends too early, after 0 bytes of text");
  std::string damaged = zipped;
  damaged[10] = '\x07';
  EXPECT_EQ(Refusal(damaged, kLimit), "f.gz: the gzip data is damaged after 0 bytes of text");
  damaged = zipped;
  damaged[damaged.size() - 8] ^= 1;  // of the checksum
  EXPECT_NE(Refusal(damaged, kLimit), "");
  EXPECT_EQ(Refusal(zipped, 100),
            "f.gz: the limit is 100 bytes of decompressed text, this has more");
}

TEST(Gzip, RefusesABombBeforeItHasGrown) {
  const std::string bomb = Zipped(std::string(std::size_t{70} << 20, ' '));
  EXPECT_EQ(
      Refusal(bomb, kLimit),
      "f.gz: a file that decompresses to more than 250 times its size is taken for an attack");
}

TEST(Files, AreWrittenAndReadUnderTheirEndings) {
  const auto folder = std::filesystem::path(::testing::TempDir());
  const auto program = ReadProgramText("ROWS\n N c\nCOLUMNS\n x c 1\nENDATA\n", "a.mps");
  for (const char* name : {"io_test.mps", "io_test.mps.gz", "io_test.QPS", "io_test.cbf.gz"}) {
    const std::string path = (folder / name).string();
    WriteProgram(*program, path);
    EXPECT_EQ(IsGzip(ReadBytes(path, kLimit)), path.ends_with(".gz"));
    EXPECT_EQ(ReadProgram(path)->num_vars(), 1);
    std::filesystem::remove(path);
  }
}

TEST(Files, ThatCannotBeReadOrWrittenAreNamed) {
  EXPECT_THROW(
      {
        try {
          ReadProgram("no_such_folder/a.mps");
        } catch (const InvalidArgument& error) {
          EXPECT_STREQ(error.what(), "cannot open no_such_folder/a.mps: No such file or directory");
          throw;
        }
      },
      InvalidArgument);
  EXPECT_THROW(ReadProgram(::testing::TempDir(), {.format = FileFormat::kMps}), InvalidArgument);
  const MathematicalProgram program;
  EXPECT_THROW(WriteProgram(program, "no_such_folder/a.mps"), InvalidArgument);
  EXPECT_THROW(WriteProgram(program, "a.txt"), InvalidArgument);
  EXPECT_THROW(ReadProgramText("", "a.mps", {.byte_limit = 0}), InvalidArgument);
}

}  // namespace
}  // namespace switchyard::io
