// Claims of plugins: parsed from text and checked against the sets and the standard quantities.
#pragma once

#include "instance.hpp"

namespace muster {

// Parses "robot/{robot}/pose@stage"; braces are replaced by the row that a parameter of the instance names. Throws
// Error.
TableName parse_table_name(const std::string& text, const Instance& instance, const Surroundings& around);

// The set of a claim, created if it is private to an instance or a standard one on demand; and the number of the
// claimed row, or -1. Throws Error.
Set& resolve_set(const TableName& name, const Instance& instance, const Standard& standard, Blackboard& board);
int resolve_row(const TableName& name, const Set& set, const Instance& instance);

// Checks that columns of row numbers refer to existing sets. Throws Error.
void check_references(const Claim& claim, const Instance& instance, const Blackboard& board);

// The standard quantity of that name, or null.
const Quantity* standard_quantity(const Standard& standard, const TableName& name);
// The table that a condition of the world file looks at.
TableName table_of(const Condition& condition);

const SetDeclaration* standard_set(const Standard& standard, const std::string& set);

// Restricts a robot's controller to its own sensed rows, inbox and outbox. Throws Error for anything else.
void check_blindness(const Claim& claim, const Instance& instance, const Surroundings& around);

}  // namespace muster
