// Tells readings that were lost for another reason from those that lie below a receiver's floor.
#pragma once

#include <vector>

#include "diagnosis/calibration/censored_likelihood.hpp"
#include "diagnosis/calibration/reading_clusters.hpp"

namespace muster::diagnosis {

// Rows, in order, that were lost though those nearest on the same link are heard, far above the floor of `readings`: a
// packet that collided, or a log that began before the radio sent. Taken for bounds these would be gross errors.
// `links`: of each row; `mean` [dBm], `sigma` [dB]: of a fit to what was heard.
std::vector<Eigen::Index> lost_amid_heard(const Readings& readings, const std::vector<LinkPlace>& links,
                                          const Eigen::VectorXd& mean, double sigma);

}  // namespace muster::diagnosis
