// Two results of brume bench: what became quicker, slower, closer or further off.
#pragma once
#include <string>

#include "row.hpp"

namespace brume::bench {

// A table of the rows that changed by more than their noise, or in their error, and a line that counts the others.
// InputError where the two cannot be compared: another size, or no row in common.
std::string results_compare(const Results& before, const Results& after);

}  // namespace brume::bench
