// Whether measured data can speak of a cause, and which rows of the world it may be about.
#pragma once

#include "diagnosis/causes/cause_model.hpp"
#include "diagnosis/radio/links/link_model.hpp"
#include "diagnosis/radio/links/measurement_geometry.hpp"

namespace muster::diagnosis {

// Whether the cause declares that data must have this column.
bool needs(const Cause& cause, const std::string& column);
// A column of the data beyond times and places that it needs, or "".
std::string own_column(const Cause& cause);
// Why the data cannot speak of a cause; empty if they can.
std::string why_not(const Cause& cause, const MeasurementGeometry& survey, const Dataset& data);
// Rows of the world that a cause may be about; of two references all pairs; one without names where it is about none.
std::vector<CauseRow> rows_for(const Cause& cause, const LinkModel& model, const MeasurementGeometry& survey);

// Why there are none of these.
std::string why_no_rows(const Cause& cause, const LinkModel& model, const MeasurementGeometry& survey);

}  // namespace muster::diagnosis
