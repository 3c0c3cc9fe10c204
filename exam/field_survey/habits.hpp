// What those who measure have in common: sizes of tables, bands, receivers, and how they note it all down.
#pragma once

#include "exam/field_survey/campaign.hpp"

namespace muster::exam::survey {

// Readings: 80 to 1,000 in half of the campaigns, else up to 6,000.
double draw_size(Draws& draws);

// Frequency from 150 MHz to 6.5 GHz, level at 1 m near that of free space, and an exponent from 1.8 to `most_n`.
void draw_band(Campaign& campaign, Draws& draws, double power, double most_n);

// Codes of the receiver, clock, radios that the world lists, and what else the table and the world hold.
void draw_habits(Campaign& campaign, Draws& draws);

// Nominal powers, from the highest on down.
std::vector<double> nominal_powers(Draws& draws, double highest);

// A few straight walls through an area.
std::vector<Panel> cross_walls(Draws& draws, double wide, double deep);

}  // namespace muster::exam::survey
