// Writes the files of a diagnosis to its --out folder, beside the extended world.
#pragma once

#include <filesystem>

#include "diagnosis/report/text.hpp"

namespace muster::report {

// Files: report.html, diagnosis.json and the figures. Returns them, the page first. Throws Error.
std::vector<std::string> write_report(const Diagnosis& diagnosis, const Setting& setting,
                                      const std::filesystem::path& folder);

}  // namespace muster::report
