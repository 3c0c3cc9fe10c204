// Figures of a fit: samples, cell means measured and simulated, their errors, and maps of the residual.
#pragma once

#include <filesystem>

#include "diagnosis/calibration/cell_means.hpp"
#include "diagnosis/calibration/residual_scan.hpp"

namespace muster::diagnosis {

// Writes fig3a.svg (samples from above and from the side), fig3b.svg and fig3c.svg (cell means measured and
// simulated), fig3d.svg (histogram of their errors), residual_map.svg and residual.svg (along each covariate).
// Returns the files.
std::vector<std::filesystem::path> write_fit_pictures(const std::filesystem::path& folder, const LinkModel& model,
                                                      const Fit& fit, const ResidualScan& misfit,
                                                      const std::vector<CellMap>& maps, const CellErrors& errors,
                                                      const CellOptions& options);

}  // namespace muster::diagnosis
