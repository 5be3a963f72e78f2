// start.hpp - where a search may begin.
#pragma once

#include <vector>

#include "functions.hpp"

namespace switchyard::nlopt {

/// Moves the functions to x (0 where NaN or not there), within the bounds. Where they are not
/// defined at that, further and further inside of the bounds, and up and down from x. False where
/// they are not defined at any of these, or where one of them ended the solve: then to x.
bool MoveToStart(std::vector<double> x, Functions& functions);

}  // namespace switchyard::nlopt
