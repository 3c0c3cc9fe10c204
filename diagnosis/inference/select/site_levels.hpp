// A network that stands has one level at each site, however often it is measured: what is alike in all rows of a site
// is seen as often as there are sites.
#pragma once

#include "diagnosis/inference/score/candidate_scores.hpp"

namespace muster::inference {

// True if nearly all rows recur at a few sites.
bool is_standing(const ModelState& state);

// True if that is so and the model with the lead, alike in all rows of a site, would fit the sites one by one: it needs
// as many levels left as it has numbers.
bool fits_each_site(const ModelState& state, const ScoredCandidate& lead);

// True if that is so, sites are few, and the columns, alike in all rows of a site, explain no more of the sites' means
// beside the design than chance would (F test). The fitted noise says less: with one cause more, few levels differ less
// by chance.
bool is_chance_of_sites(const ModelState& state, const Candidate& candidate, const Eigen::MatrixXd& columns,
                        const Eigen::MatrixXd& design);

}  // namespace muster::inference
