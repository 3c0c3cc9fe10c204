// Formats a diagnosis as text for a terminal of 100 columns.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/report/words.hpp"

namespace muster::report {

// Inputs and written files of a diagnosis.
struct Setting {
  std::string world, data;           // as given by the user
  std::vector<std::string> files{};  // written, the report first
};

std::string text_of(const Diagnosis& diagnosis, const Setting& setting);

// Wraps text to 100 columns; lines after the first are indented.
std::string wrapped(const std::string& text, std::size_t first_indent = 0, std::size_t indent = 0);

// Causes that were not tested, by reason: "not searched yet (...): a, b".
std::vector<std::string> reasons_not_tested(const Diagnosis& diagnosis);

}  // namespace muster::report
