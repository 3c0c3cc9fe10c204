// Files of causes that read a table: written from the measured columns that they need.
#pragma once

#include "diagnosis/causes/cause_shape.hpp"
#include "diagnosis/data/dataset.hpp"
#include "diagnosis/result.hpp"

namespace muster::diagnosis {

// Sets found.files; nothing where the cause reads no table.
void give_files(const CauseShape& shape, const Dataset& data, CauseEstimate& found);

}  // namespace muster::diagnosis
