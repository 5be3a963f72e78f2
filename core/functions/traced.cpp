#include "switchyard/functions/traced.hpp"

#include <atomic>
#include <ostream>

#include "core/functions/op_table.hpp"
#include "switchyard/error.hpp"

namespace switchyard {
namespace {

thread_local Recording* innermost = nullptr;

// Of all threads: a number that strays to another thread is not taken for one of its recording.
std::uint32_t NextNumber() {
  static std::atomic<std::uint32_t> last = 0;
  return ++last;
}

}  // namespace

double Traced::value() const {
  if (place_ >= 0) {
    if (Recording* recording = Recording::Find(recording_)) recording->has_decisions_ = true;
  }
  return value_;
}

Traced Traced::Apply(Op op, const Traced& a) { return Recording::Record(op, {&a, &a, &a}, 1); }

Traced Traced::Apply(Op op, const Traced& a, const Traced& b) {
  return Recording::Record(op, {&a, &b, &b}, 2);
}

Traced Traced::Apply(Op op, const Traced& a, const Traced& b, const Traced& c) {
  return Recording::Record(op, {&a, &b, &c}, 3);
}

std::ostream& operator<<(std::ostream& out, const Traced& a) { return out << a.value_; }

Recording::Recording(const Eigen::Ref<const Eigen::VectorXd>& x)
    : tape_(static_cast<int>(x.size())),
      x_(x.data(), x.data() + x.size()),
      number_(NextNumber()),
      outer_(innermost) {
  innermost = this;
}

Recording::~Recording() { innermost = outer_; }

Traced Recording::input(int i) const { return {x_[i], i, number_}; }

void Recording::AddOutput(const Traced& y) {
  tape_.AddOutput(PlaceOf(y));
  outputs_.push_back(y.value_);
}

Recording* Recording::Find(std::uint32_t number) {
  Recording* r = innermost;
  while (r != nullptr && r->number_ != number) r = r->outer_;
  return r;
}

Traced Recording::Record(Op op, const Traced* const (&operand)[3], int num_operands) {
  const double value =
      FactsOf(op).value(operand[0]->value_, operand[1]->value_, operand[2]->value_);
  const Traced* of = nullptr;  // the recording is that of the first operand that has one
  for (int k = num_operands; k-- > 0;) {
    if (operand[k]->place_ >= 0) of = operand[k];
  }
  if (of == nullptr) return {value, -1, 0};
  Recording* const recording = Find(of->recording_);
  Require(recording != nullptr, "Traced: the recording of an operand of ", FactsOf(op).name,
          " has ended; keep numbers of one call out of the next");
  Tape& tape = recording->tape_;
  Tape::Place at[3] = {-1, -1, -1};
  for (int k = 0; k < num_operands; ++k) at[k] = recording->PlaceOf(*operand[k]);
  const Tape::Place place = num_operands == 1   ? tape.Apply(op, at[0])
                            : num_operands == 2 ? tape.Apply(op, at[0], at[1])
                                                : tape.Apply(op, at[0], at[1], at[2]);
  // What was folded is a constant from here on: to compare it decides nothing.
  const Tape::Step& step = tape.steps()[place];
  if (step.op == Op::kConstant) return {step.constant, -1, 0};
  return {value, place, recording->number_};
}

Tape::Place Recording::PlaceOf(const Traced& a) {
  if (a.place_ < 0) return tape_.Constant(a.value_);
  Require(a.recording_ == number_,
          "Traced: a number of one recording was used in another; a function that is made inside "
          "another one may take its .value()");
  return a.place_;
}

}  // namespace switchyard
