#include "core/io/mps_writer.hpp"
namespace switchyard::io {
std::vector<std::string> MpsCannotHold(const MathematicalProgram&) { return {}; }
std::string WriteMps(const MathematicalProgram&, Notes*) { return ""; }
}
