// A case of the generator `run`: the simulator's own readings over a plan and tours of the exam, with causes planted in
// its world, of which the examinee's world is the same without them.
#pragma once

#include "exam/simulated/cause_lambda.hpp"
#include "exam/simulated/simulator.hpp"

namespace muster::exam::simulated {

struct Request {
  std::uint64_t seed = 1;
  std::filesystem::path program;       // muster
  std::vector<std::string> kinds{};    // clean, one, two, three, each; equally likely. Empty: clean, one, two
  std::vector<std::string> effects{};  // to draw from; empty: all
  double least_rows = 1000, most_rows = 6000;
  double least_lambda = 12, most_lambda = 400;  // of causes whose shift is proportional to a size
};

// radio.fading of the world, and the receiver's codes.
struct Channel {
  enum class Fading { none = 1, multipath, per_reading } fading = Fading::none;
  double shadowing = 0, decorrelation = 1, rician_k = 6;  // dB, m, dB
  int decimals = 0;                                       // of the codes, in dB
  double step() const { return std::pow(10.0, -decimals); }
};

struct Made {
  std::string name, kind;
  std::uint64_t seed = 0;
  GroundTruth site;
  Channel channel;
  bool counts_walls = false;  // no plan in the world, numbers of walls in the data
  Data measured, second;
  std::vector<PlantedCause> causes;
};

// Case `number` depends on the request and on that number. Throws std::runtime_error if the simulator fails.
Made make(const Request& request, int number);

// Elements of the world without any cause.
std::string world_elements(const Made& made);
std::string world_xml(const Made& made);
std::string table(const Made& made, const Data& data);
std::string answer_json(const Made& made);
void write(const Made& made, const std::filesystem::path& folder);

}  // namespace muster::exam::simulated
