// Tests if measured data suffice for a cause, and lists the rows of the world that it may concern.
#pragma once

#include "diagnosis/causes/cause_model.hpp"
#include "diagnosis/radio/links/link_model.hpp"
#include "diagnosis/radio/links/measurement_geometry.hpp"

namespace muster::diagnosis {

// True if the cause declares this column as required.
bool needs(const Cause& cause, const std::string& column);
// Required column beyond times, places and headings, or "".
std::string own_column(const Cause& cause);
// Reason why the data cannot test a cause; empty if they can.
std::string why_not(const Cause& cause, const MeasurementGeometry& survey, const Dataset& data);
// Rows that a cause may concern, radios that the data alone name among them: all pairs for two references, a single row
// without names for none.
std::vector<CauseRow> rows_for(const Cause& cause, const LinkModel& model, const MeasurementGeometry& survey);

// Reason why rows_for() is empty.
std::string why_no_rows(const Cause& cause);

}  // namespace muster::diagnosis
