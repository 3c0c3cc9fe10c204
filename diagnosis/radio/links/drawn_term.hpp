// Shadowing as the world draws it: the correlation that a term's plugin declares (muster_draw).
#pragma once

#include <memory>

#include "diagnosis/inference/noise/family.hpp"
#include "diagnosis/inference/noise/stated_correlation.hpp"
#include "diagnosis/radio/links/link_model.hpp"

namespace muster::diagnosis {

// Of the world's last instance that declares its draws and has some: it stands for those before it. Null where there is
// none. It keeps the plugin's library.
std::shared_ptr<const noise::StatedCorrelation> drawn_correlation(const LinkModel& model);
// Standard deviation and decorrelation distance of those draws; zeros where there are none.
noise::StatedField drawn_field(const LinkModel& model);
// Sets the size and the distance of those draws, within the bounds of the parameters. False where there are none.
bool set_drawn_field(LinkModel& model, const noise::StatedField& field);
// True if an instance declares its draws, of any size.
bool declares_draws(const LinkModel& model);

}  // namespace muster::diagnosis
