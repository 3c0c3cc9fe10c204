// What happens to an instance's rows around its step: room made and poisoned before, checked and taken over after.
#pragma once

#include <string>

#include "instance.hpp"

namespace muster {

// Nearly always every number is finite: one sum tells, for a NaN or an infinity stays in it.
bool all_finite(const double* data, std::size_t count);

// Opens the tables that the instance writes and poisons the cells that it must fill.
void prepare_cells(Instance& instance, uint64_t tick);

// What is wrong with what the instance wrote: an unfilled cell, a NaN, an infinity, a row number that is none; "" if
// all is well. Safe to call for several instances at once.
std::string check_cells(const Instance& instance, const Blackboard& board);

// Takes over what was written aside: appended rows, a rest of rows, bytes. In world-file order. Returns what is wrong,
// or "".
std::string commit_cells(Instance& instance, uint64_t tick);

}  // namespace muster
