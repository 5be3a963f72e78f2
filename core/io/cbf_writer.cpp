#include "core/io/cbf.hpp"
namespace switchyard::io {
std::vector<std::string> CbfCannotHold(const MathematicalProgram&) { return {}; }
std::string WriteCbf(const MathematicalProgram&, Notes*) { return ""; }
}
