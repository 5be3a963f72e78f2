// core/solve/recovery.hpp - a backend's answer to the lowered problem, in the program's terms.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/lower/lowering.hpp"
#include "core/problem/vectors.hpp"
#include "core/solve/check.hpp"
#include "switchyard/abi.h"
#include "switchyard/solve/result.hpp"

namespace switchyard {

/// The buffers that a backend fills, sized for a problem.
class AnswerBuffers {
 public:
  explicit AnswerBuffers(const ProblemData& problem);
  AnswerBuffers(const AnswerBuffers&) = delete;
  AnswerBuffers& operator=(const AnswerBuffers&) = delete;

  sy_result raw{};
  Vectors vectors;
  std::vector<char> text;
};

/// Writes into a result what the answer says of the program, and nothing that the answer only
/// claims: see MathematicalProgramResult.
class Recovery {
 public:
  Recovery(const MathematicalProgram& program, const Lowering& lowering, const sy_solver& backend,
           MathematicalProgramResult& result)
      : program_(program), lowering_(lowering), backend_(backend), result_(result) {}

  void Write(const AnswerBuffers& answer);
  /// A point of the backend's pool; one that is not feasible is left out, with a note.
  void AddSuboptimal(const std::vector<double>& x);
  /// Did the backend claim what the check does not support?
  [[nodiscard]] bool doubted() const { return doubted_; }

 private:
  void IndexVariables();
  void WritePoint(const AnswerBuffers& answer);
  void WriteBound(const AnswerBuffers& answer);
  void WriteDuals(const AnswerBuffers& answer);
  void JudgeDuals(const DualCheck& check, bool convex);
  void WriteNonlinearDuals(const Vectors& v, double sign);
  void WriteBoxDuals(const std::vector<double>& x_dual);
  void JudgeOptimum(const AnswerBuffers& answer);
  void JudgeCertificates(const AnswerBuffers& answer);
  void Doubt(const std::string& why);
  [[nodiscard]] double InUserSense(double value) const {
    return lowering_.maximize() ? -value : value;
  }

  const MathematicalProgram& program_;
  const Lowering& lowering_;
  const sy_solver& backend_;
  MathematicalProgramResult& result_;
  bool doubted_ = false;
};

/// The absolute violations of x in the program.
Violation ViolationOf(const MathematicalProgram& program, const Eigen::VectorXd& x);

}  // namespace switchyard
