// Rows of an instance around its step: allocated and poisoned before, checked and taken over after.
#pragma once

#include <string>

#include "instance.hpp"

namespace muster {

// True if every number is finite. One sum decides the usual case, for a NaN or an infinity stays in it.
bool all_finite(const double* data, std::size_t count);

// Opens the tables that the instance writes and poisons the cells that it must fill.
void prepare_cells(Instance& instance, uint64_t tick);

// Fault of the cells that the instance wrote: an unfilled cell, a NaN, an infinity, an invalid row number; "" if there
// is none. Safe to call for several instances at once.
std::string check_cells(const Instance& instance, const Blackboard& board);

// Takes over the staged rows: appended rows, a rest of rows, bytes. In world-file order. Returns the fault, or "".
std::string commit_cells(Instance& instance, uint64_t tick);

}  // namespace muster
