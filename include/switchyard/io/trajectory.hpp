// switchyard/io/trajectory.hpp - trajectories from files and to files: trajectory/1 and tables
// (CSV).
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "switchyard/export.hpp"
#include "switchyard/io/file_error.hpp"
#include "switchyard/io/read.hpp"
#include "switchyard/trajectory/piecewise_polynomial.hpp"
#include "switchyard/trajectory/trajectory.hpp"

namespace switchyard {

/// The trajectory in a file of trajectory/1 (docs/program-format.md), of the class that was
/// written, to the last bit; "-" is standard input; gzip is recognized by its first bytes. Throws
/// FileError where the file is not of its format, InvalidArgument where it cannot be read.
SWITCHYARD_EXPORT std::unique_ptr<Trajectory<double>> ReadTrajectory(
    const std::string& path, const ReadOptions& options = {});
/// The same of a text in memory; `name` is what errors call it.
SWITCHYARD_EXPORT std::unique_ptr<Trajectory<double>> ReadTrajectoryText(
    std::string_view text, const std::string& name, const ReadOptions& options = {});

/// What trajectory/1 cannot hold of it, a sentence each: classes of a user's, numbers that are not
/// finite, more than 20 trajectories within one another.
SWITCHYARD_EXPORT std::vector<std::string> CannotHold(const Trajectory<double>& trajectory);
/// Writes the trajectory; "-" is standard output; an ending ".gz" compresses. Throws
/// InvalidArgument with the sentences of CannotHold, before anything is written.
SWITCHYARD_EXPORT void WriteTrajectory(const Trajectory<double>& trajectory,
                                       const std::string& path);
/// The text that WriteTrajectory writes.
SWITCHYARD_EXPORT std::string TrajectoryText(const Trajectory<double>& trajectory);

/// Which rows and columns a table has.
struct TrajectoryTableOptions {
  double rate = 100;               // rows a second from the start on, and one at the end
  std::vector<double> times = {};  // where there are some: these instead, and the start and the end
  int derivatives = 0;             // columns for the derivatives up to this order
  void Check() const;
};

/// The table of a trajectory of one column: the header "t,q0,q1,..." (",qd0,qd1,..." of first
/// derivatives, ",qdd0,..." of second), then a row for each time, numbers as short as they can be
/// to read back to the same. Throws InvalidArgument where the values have another shape or are not
/// finite, the trajectory's times are not, times do not rise or are outside of the trajectory's, or
/// there are more than 2^22 rows.
SWITCHYARD_EXPORT std::string TrajectoryTable(const Trajectory<double>& trajectory,
                                              const TrajectoryTableOptions& options = {});
/// Writes that; "-" is standard output; an ending ".gz" compresses.
SWITCHYARD_EXPORT void WriteTrajectoryTable(const Trajectory<double>& trajectory,
                                            const std::string& path,
                                            const TrajectoryTableOptions& options = {});
/// From row to row of such a table, straight (FirstOrderHold). Columns of derivatives are left out,
/// which a note says. Throws FileError where it is no such table, or has fewer than 2 or more than
/// 2^22 rows.
SWITCHYARD_EXPORT PiecewisePolynomial<double> ReadTrajectoryTable(const std::string& path,
                                                                  const ReadOptions& options = {});
SWITCHYARD_EXPORT PiecewisePolynomial<double> ReadTrajectoryTableText(
    std::string_view text, const std::string& name, const ReadOptions& options = {});

}  // namespace switchyard
