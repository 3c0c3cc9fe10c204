// A mission as a list of steps with jumps, read from its XML file.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "text/xml.hpp"

namespace muster::missions {

constexpr std::size_t most_loops = 4, most_links = 4;  // nested repeats; radios whose links are kept or asked

enum class Act { go_to, wait, hear, say, follow, keep, release, repeat, again, test_message, test_link, jump, end };

struct Instruction {
  Act act = Act::end;
  double x = 0, y = 0, z = 0, heading = 0;  // heading is null where none is asked for
  double number = 0;                        // within [m], seconds, distance [m], level [dBm], times (0: for ever)
  double patience = 0;                      // [s]; 0: for ever
  double margin = 0, lost = 0;              // of a link that is kept [dB], [s]
  double peer = -1;                         // row of a radio; -1: any, or all
  std::string text;                         // of a message
  bool below = false;                       // test_link: or above
  std::size_t slot = 0;                     // of a loop's counter or of a link
  std::size_t to = 0;                       // where it jumps: after a loop, past an <if> that does not hold
  int line = 0;
};

struct Handler {
  std::string text;
  double peer = -1;
  std::size_t to = 0;
};

struct Program {
  std::vector<Instruction> code;
  std::vector<Handler> handlers;
  std::vector<double> links;         // rows of the radios whose messages are measured
  std::vector<std::string> awaited;  // texts of messages that mean something to it
  std::vector<std::string> doubts;   // warnings with their places, such as of a heading that looks like degrees
  double mark = 0;                   // differs from that of any other mission
};

// Finds a radio's row by its name, or throws with the place.
using FindRadio = std::function<double(const std::string& name, const Place& place)>;

// `own` is the row of the robot's own radio; `flies`: places have a height. Throws BadInput with the place in the file.
Program compile(const XmlElement& root, const FindRadio& find, double own, bool flies);

}  // namespace muster::missions
