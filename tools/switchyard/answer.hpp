// tools/switchyard/answer.hpp - what commands that solve say of an answer, and end with.
#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "switchyard/solve/result.hpp"

namespace switchyard::cli {

using Clock = std::chrono::steady_clock;

/// Seconds.
double Since(Clock::time_point start);

/// Are there costs or constraints that are functions, or quadratic constraints?
bool HasFunctions(const MathematicalProgram& program);

int ExitCodeOf(const MathematicalProgramResult& result);

/// To standard error: which backends could serve, and by which bridges one does.
void Explain(const MathematicalProgramResult& result);

/// To standard error, where `code` says that there is no answer: why, and what to try.
void SayWhyNot(const std::string& file, const MathematicalProgramResult& result, int code);

/// A line on the terminal, renewed a few times a second; nothing where there is no terminal.
std::function<bool(const SolveProgress&)> TerminalProgress(bool quiet);
/// Takes that line away.
void EndProgress(const std::function<bool(const SolveProgress&)>& progress);

}  // namespace switchyard::cli
