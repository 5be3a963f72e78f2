// Functions of Traced numbers.
#include <algorithm>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "core/functions/pattern_index.hpp"
#include "core/functions/placed_function.hpp"
#include "core/functions/probe.hpp"
#include "core/functions/tape_function.hpp"
#include "switchyard/error.hpp"
#include "switchyard/functions/make_function.hpp"

namespace switchyard {
namespace {

using TracedVector = Eigen::VectorX<Traced>;
using Call = std::function<std::vector<Traced>(const TracedVector&)>;

// What one call did.
struct Trace {
  Tape tape;
  std::vector<double> values;
  bool has_decisions;
};

Trace TraceOf(const Call& f, const Eigen::Ref<const Eigen::VectorXd>& x) {
  Recording recording(x);
  TracedVector inputs(x.size());
  for (int i = 0; i < x.size(); ++i) inputs[i] = recording.input(i);
  for (const Traced& y : f(inputs)) recording.AddOutput(y);
  return {recording.TakeTape(), recording.outputs(), recording.has_decisions()};
}

// Its operations are the same everywhere, its patterns those that were declared.
class DeclaredFunction final : public Function, public OfTape {
 public:
  DeclaredFunction(std::shared_ptr<const Function> f, const FunctionOptions& options)
      : Function(f->num_vars(), f->num_outputs()), compiled_(f) {
    SetJacobian(options.jacobian.value_or(f->jacobian()));
    if (f->has_hessian()) SetHessian(options.hessian.value_or(f->hessian()));
    placed_ = std::make_unique<PlacedFunction>(std::move(f), PatternIndex(jacobian()),
                                               PatternIndex(hessian()));
  }
  void Evaluate(const Evaluation& wanted) const override { placed_->Evaluate(*this, wanted); }
  [[nodiscard]] const Tape& tape() const override { return *TapeOf(*compiled_); }

 private:
  std::shared_ptr<const Function> compiled_;
  std::unique_ptr<const PlacedFunction> placed_;
};

// Its operations depend on the point: they are recorded at each. Those of the last few different
// recordings stay compiled, the last used first.
class RetracedFunction final : public Function {
 public:
  RetracedFunction(int num_vars, int num_outputs, Call f, const FunctionOptions& options)
      : Function(num_vars, num_outputs), f_(std::move(f)) {
    SetJacobian(options.jacobian ? *options.jacobian
                                 : SparsityPattern::Dense(num_outputs, num_vars));
    SetHessian(options.hessian ? *options.hessian : SparsityPattern::DenseUpperTriangle(num_vars));
    set_is_thread_safe(options.is_thread_safe);
    jacobian_index_ = std::make_unique<PatternIndex>(jacobian());
    hessian_index_ = std::make_unique<PatternIndex>(hessian());
  }

  void Evaluate(const Evaluation& wanted) const override {
    const Trace trace = TraceOf(f_, Eigen::Map<const Eigen::VectorXd>(wanted.x, num_vars()));
    Require(std::ssize(trace.values) == num_outputs(), "function: needs to return ", num_outputs(),
            " numbers as at first, got ", trace.values.size());
    if (wanted.jacobian == nullptr && wanted.hessian == nullptr) {
      if (wanted.values != nullptr) std::ranges::copy(trace.values, wanted.values);
      return;
    }
    Compiled(trace.tape)->Evaluate(*this, wanted);
  }

 private:
  static constexpr std::size_t kKept = 8;
  struct Branch {
    Tape tape;
    std::shared_ptr<const PlacedFunction> function;
  };

  std::shared_ptr<const PlacedFunction> Compiled(const Tape& tape) const {
    {
      const std::lock_guard lock(mutex_);
      const auto found = std::ranges::find(branches_, tape, &Branch::tape);
      if (found != branches_.end()) {
        std::rotate(branches_.begin(), found, found + 1);
        return branches_.front().function;
      }
    }
    auto function = std::make_shared<const PlacedFunction>(CompileTape(tape), *jacobian_index_,
                                                           *hessian_index_);
    const std::lock_guard lock(mutex_);
    branches_.insert(branches_.begin(), {tape, function});
    if (branches_.size() > kKept) branches_.pop_back();
    return function;
  }

  Call f_;
  std::unique_ptr<const PatternIndex> jacobian_index_;
  std::unique_ptr<const PatternIndex> hessian_index_;
  mutable std::mutex mutex_;
  mutable std::vector<Branch> branches_;
};

}  // namespace

std::shared_ptr<const Function> FunctionByTracing(int num_vars, Call f,
                                                  const FunctionOptions& options) {
  const Trace trace =
      AtProbe(num_vars, options, [&](const Eigen::VectorXd& x) { return TraceOf(f, x); });
  const int num_outputs = static_cast<int>(trace.values.size());
  options.Check(num_vars, num_outputs);
  if (trace.has_decisions) {
    return std::make_shared<RetracedFunction>(num_vars, num_outputs, std::move(f), options);
  }
  auto compiled = CompileTape(trace.tape);
  if (!options.jacobian && !options.hessian) return compiled;
  return std::make_shared<DeclaredFunction>(std::move(compiled), options);
}

}  // namespace switchyard
