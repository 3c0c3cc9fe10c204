// Tells readings that were lost for another reason from those that lie below a receiver's floor.
#pragma once

#include <vector>

#include "diagnosis/calibration/censored_likelihood.hpp"
#include "diagnosis/calibration/reading_clusters.hpp"

namespace muster::diagnosis {

// Rows, in order, that were lost far above the floor of `readings`: those that stand amid heard ones of their link, as
// where packets collide, and stretches in which all links are silent at once, as before a radio sent or while the log
// was down. Taken for bounds these would be gross errors. `links`: of each row; `t`: its time [s]; none: silences are
// not told; `mean` [dBm], `sigma` [dB]: of a fit to what was heard.
std::vector<Eigen::Index> lost_amid_heard(const Readings& readings, const std::vector<LinkPlace>& links,
                                          const std::vector<double>& t, const Eigen::VectorXd& mean, double sigma);

}  // namespace muster::diagnosis
