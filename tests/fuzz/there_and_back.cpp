#include "tests/fuzz/there_and_back.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "switchyard/io/graph.hpp"
#include "switchyard/io/read.hpp"
#include "switchyard/io/trajectory.hpp"
#include "switchyard/io/write.hpp"
#include "tests/io/same_program.hpp"

namespace switchyard::fuzz {
namespace {

[[noreturn]] void Fail(const std::string& why, std::string_view text) {
  std::fprintf(stderr, "%s\n%.*s\n", why.c_str(), static_cast<int>(text.size()), text.data());
  std::abort();
}

bool IsPlaceOf(const FileError& error, std::string_view text) {
  if (error.line() == 0) return error.pointer().empty() || error.pointer()[0] == '/';
  const auto lines = 1 + std::count(text.begin(), text.end(), '\n');
  return error.line() >= 1 && error.line() <= lines && error.column() >= 1 &&
         static_cast<std::size_t>(error.column()) <= text.size() + 1;
}

// A row without sides is left out by readers, and a range is a difference that may be rounded: the
// writer says so, and then the program read is another.
bool SaysItIsAnother(const std::vector<std::string>& notes) {
  return std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
    return note.starts_with("a row without sides") || note.starts_with("one side of a row moves") ||
           note.starts_with("a row with two sides") || note.starts_with("a bound of a variable");
  });
}

}  // namespace

void ReadGraphThereAndBack(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  GraphProblem problem;
  try {
    problem = ReadGraphText(text, "file");
  } catch (const FileError& error) {
    if (!IsPlaceOf(error, text)) Fail(std::string("no place of the file: ") + error.what(), text);
    return;
  }
  const std::string written = GraphText(problem);
  if (GraphText(ReadGraphText(written, "written")) != written) {
    Fail("read, written, read: another graph\n" + written, text);
  }
}

void ReadTrajectoryThereAndBack(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const bool json = text.starts_with('{');
  std::unique_ptr<Trajectory<double>> trajectory;
  try {
    trajectory =
        json ? ReadTrajectoryText(text, "file") : ReadTrajectoryTableText(text, "file").Clone();
  } catch (const FileError& error) {
    if (!IsPlaceOf(error, text)) Fail(std::string("no place of the file: ") + error.what(), text);
    return;
  }
  const std::string written = TrajectoryText(*trajectory);
  if (TrajectoryText(*ReadTrajectoryText(written, "written")) != written) {
    Fail("read, written, read: another trajectory\n" + written, text);
  }
  if (json) return;
  const auto& hold = dynamic_cast<const PiecewisePolynomial<double>&>(*trajectory);
  for (int i = 0; i < hold.get_number_of_segments(); ++i) {
    const Eigen::VectorXd sample = hold.value(hold.start_time(i));
    if (sample != hold.coefficients(i).col(0)) Fail("a row is not what is held there", text);
  }
}

void ReadThereAndBack(const std::uint8_t* data, std::size_t size, FileFormat format) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  std::vector<std::string> notes;
  std::unique_ptr<MathematicalProgram> program;
  try {
    program = ReadProgramText(text, "file", {.format = format, .notes = &notes});
  } catch (const FileError& error) {
    if (!IsPlaceOf(error, text)) Fail(std::string("no place of the file: ") + error.what(), text);
    return;
  }
  notes.clear();
  if (!CannotHold(*program, format).empty()) return;
  const std::string written = ProgramText(*program, format, &notes);
  if (SaysItIsAnother(notes)) return;
  const auto again = ReadProgramText(written, "written", {.format = format});
  if (format == FileFormat::kJson && ProgramText(*again, format) != written) {
    Fail("read, written, read: another text\n" + written, text);
  }
  const std::string difference = testing::Difference(*program, *again);
  if (!difference.empty()) Fail("read, written, read: " + difference + "\n" + written, text);
}

}  // namespace switchyard::fuzz
