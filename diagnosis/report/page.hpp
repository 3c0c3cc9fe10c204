// Formats a diagnosis as one self-contained HTML page: text, tables and figures, no scripts.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/report/figures.hpp"
#include "diagnosis/report/text.hpp"

namespace muster::report {

std::string page_of(const Diagnosis& diagnosis, const Setting& setting, const std::vector<Picture>& pictures);

}  // namespace muster::report
