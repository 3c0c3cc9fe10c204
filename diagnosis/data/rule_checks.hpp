// Rules of an import map that say something else than was meant.
#pragma once

#include <vector>

#include "diagnosis/data/foreign_table.hpp"
#include "diagnosis/data/import_map.hpp"

namespace muster::diagnosis {

// A name for all rows that is also a column of names: quotes are meant for one name, and not for the column.
void refuse_quoted_column(const ColumnRule& rule, const std::vector<ForeignTable>& files);

// `rssi = rssi[dBm]`: a column of the result on the right, and one of the data on the left.
void refuse_exchanged(const ColumnRule& rule, const std::vector<ForeignTable>& files);

}  // namespace muster::diagnosis
