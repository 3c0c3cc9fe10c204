// What else makes readings scatter as by a law, so that it is not named.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/radio/laws/law_sources.hpp"

namespace muster::diagnosis {

// Of each reading that is tested, if walls or places that are as far off as they may be change which walls it crosses.
std::vector<bool> unsure(const LawSources& sources, const Eigen::VectorXd& residual);

// A sentence: what is not explained and far plainer, links that stand and may wander, a receiver whose scatter depends
// on the level, walls or places that are off, readings that are off one after the other. Empty if none of them.
// `residual`: dB, NaN for a reading that is not tested.
std::string doubt_of(const LawSources& sources, const Eigen::VectorXd& residual, const KrigedReadings& field,
                     const Diagnosis& found, const LawTest& law);

// A sentence: why a field that differs from the stated one is not named, as long as the ground on which it was seen: it
// is no stationary one. Empty where it is shorter.
std::string doubt_of_extent(const LinkReadings& readings, const noise::StatedField& fitted,
                            const noise::StatedField& stated);
// A sentence: a law of single readings that is not named beside what is not explained and far plainer. Empty where
// there is no such thing.
std::string doubt_beside_unexplained(const Diagnosis& found, const LawTest& law);

// Why a law of fading that is named may be none: readings scatter otherwise at other levels, though not beyond chance.
// Empty where they scatter alike.
std::string doubt_by_level(const LawSources& sources, const Eigen::VectorXd& residual, const KrigedReadings& field,
                           const Diagnosis& found);

// Why a law of single readings that is named may be none: a few of the links have nearly all that it is named for.
// Empty where all have their share.
std::string doubt_by_link(const LawSources& sources, const Eigen::VectorXd& residual, const LawTest& law);

// Why a law of single readings that is named may be none: what shifts levels and is not found scatters them as well.
// Empty where nothing comes near.
std::string doubt_of_scatter(const Diagnosis& found);

// Why a field that differs from the world's may be none: what shifts levels at places and is not found makes a field
// wide, too. Empty where it is plain.
std::string doubt_of_field(const Diagnosis& found, const CauseEstimate& field);

}  // namespace muster::diagnosis
