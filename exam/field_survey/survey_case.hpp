// A case of the field generator: a campaign, what is wrong in it, and its readings.
#pragma once

#include <filesystem>

#include "exam/field_survey/effects.hpp"

namespace muster::exam::survey {

struct Request {
  std::uint64_t seed = 1;
  std::string style{};                 // flat, mesh, walk, drive; empty: any
  std::vector<std::string> kinds{};    // clean, one, two, three, four; equally likely. Empty: mostly two to four
  std::vector<std::string> effects{};  // to draw from; empty: all
  bool noiseless = false;              // levels without scatter and steps, for tests of the law
};

struct Made {
  std::string name;
  Request request;
  Campaign campaign;
  Scene map, truth;
  std::vector<Planted> planted;
  std::vector<double> rssi;   // dBm; NaN: not received
  bool drops_missed = false;  // rows without a reading are left out of the table
};

const std::vector<std::string>& styles();

// Case `number` depends on the request and on that number alone.
Made make(const Request& request, int number);

std::string world_xml(const Made& made);
std::string measured_csv(const Made& made);
std::string answer_json(const Made& made);
void write(const Made& made, const std::filesystem::path& folder);

}  // namespace muster::exam::survey
