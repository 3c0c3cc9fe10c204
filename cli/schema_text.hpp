// The text of an XML schema (XSD 1.0) of world files.
#pragma once

#include <memory>
#include <muster/sets.hpp>
#include <set>
#include <string>
#include <vector>

#include "loader/library.hpp"

namespace muster::cli {

// It takes every world whose elements and attributes muster check takes. What one attribute alone does not show is left
// to muster check: rows that references name, files, and what fits together.
std::string schema_text(const Standard& standard, const std::vector<std::shared_ptr<Library>>& plugins);

}  // namespace muster::cli
