// Which readings the tests of laws look at, and what is left of each.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "diagnosis/radio/laws/law_sources.hpp"

namespace muster::diagnosis {

// In all of these a reading that is not tested is NaN, dB.

// Measured less expected, for each reading of the search; NaN for a censored reading or near a clip.
Eigen::VectorXd residual_of(const LawSources& sources, const Diagnosis& found);
// Readings of which each is drawn anew: of those of a link that lie closer than its law needs, the first.
Eigen::VectorXd drawn_anew(const LawSources& sources, const LawPart& law, Eigen::VectorXd residual);
// Readings whose link, moved by 5 mm, crosses other walls are left out, with a note: the link may pass on the other
// side, an error of a whole wall. Three of those among 20,000 readings resemble outliers.
Eigen::VectorXd without_grazing(const LawSources& sources, const Eigen::VectorXd& residual,
                                std::vector<std::string>& notes);
// Of twins, which share what scatters, one: their mean would scatter by another law than a reading.
Eigen::VectorXd without_second_twins(const LinkReadings& readings, const noise::Rows& rows, Eigen::VectorXd residual);
// Instead of twins their mean.
Eigen::VectorXd means_of_twins(const LinkReadings& readings, const noise::Rows& rows, Eigen::VectorXd residual);
// Without the link between these two radios.
Eigen::VectorXd without_link(const LawSources& sources, const std::set<std::string>& ends, Eigen::VectorXd residual);

// True where nearly all readings of a link are of one place, as those of a standing network: what is drawn by place is
// the same in all of them.
bool repeat_places(const LinkReadings& readings);
// How many readings are of the place of the one before of their link.
Eigen::Index repeated(const LinkReadings& readings);
std::vector<Eigen::Index> in_order_of_time(const LinkReadings& readings);
// Reason why single readings are not testable; empty if they are.
std::string why_not(const LawSources& sources, const Eigen::VectorXd& residual);
Eigen::Index tested(const Eigen::VectorXd& residual);

}  // namespace muster::diagnosis
