// Tables of measured data made of files in ../shared/data.
#pragma once

#include <filesystem>
#include <string>

namespace muster::real_data {

// ../shared/data/radio; does not exist where the data are not there.
std::filesystem::path radio_data();

// Every beacon at every fingerprint of the UJI office at one power setting, empty where it was not heard; with
// `heard_only` the heard ones alone, and how many shelves and pillars each link crosses.
std::string uji_table(int power_dbm, bool heard_only);

// Every tenth reading of the two people, of all six ways to carry the phones.
std::string body_table();

// Both campaigns of a building as two senders; both tables are as import writes them.
std::string joined(const std::string& first, const std::string& second);

}  // namespace muster::real_data
