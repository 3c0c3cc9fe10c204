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

// Behind the refusal of a rule whose column has another unit than ours: `: rx_yaw[rad] =
// 0.017453292519943295*heading_deg` where the map says degrees; else that there is a scale.
std::string in_our_unit(const ColumnRule& rule, const std::string& unit);

}  // namespace muster::diagnosis
