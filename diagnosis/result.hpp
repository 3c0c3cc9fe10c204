// Results of a diagnosis, as plain data: causes, what stays unexplained, held-out gains, advice and the closed loop.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/inference/assess/finding.hpp"
#include "diagnosis/inference/state/smooths.hpp"
#include "diagnosis/radio/links/link_rows.hpp"
#include "diagnosis/radio/links/receiver_checks.hpp"

namespace muster::diagnosis {

struct CauseValue {
  std::string name, unit;  // of the plugin's parameter
  double value = 0, stderror = 0, lower95 = 0, upper95 = 0;
  double minimum = 0, maximum = 0;  // as declared
  bool cyclic = false;              // an angle: its interval may go on beyond these
};

struct CauseEstimate {
  std::string id, label, title, tell_apart;
  // By which id the search had it: a wall that costs nothing may be told as one that is absent. Empty: none of the
  // search's, but a law of readings or an edit that came before it.
  std::string sought_as;
  bool put_right_first = false;  // and all else was judged in a world that has it
  inference::Status status = inference::Status::named;
  std::vector<std::string> covariates;  // what it is a function of, its own one first: "map", "time", "bearing"
  std::string row_parameter, row;       // empty where it is about no row
  std::vector<CauseValue> values;
  std::map<std::string, double> held;        // parameters that were set and not sought
  std::map<std::string, std::string> words;  // further attributes, such as the other radio
  std::map<std::string, std::string> files;  // tables that it reads: attribute and text
  double evidence = 0, log_p = 0;
  double lambda = 0;       // fall of the deviance by it, beside all others
  Eigen::VectorXd effect;  // dB it adds to each of the rows seen
  std::optional<inference::HeldOutGain> held_out;
  Eigen::VectorXd unseen_without;  // squared errors at places not seen without it, in the order of Diagnosis::used
  std::vector<inference::Elsewhere>
      elsewhere;  // what it gains with radios and runs not seen, where it concerns several
  std::vector<inference::Alternative> alternatives;
  std::string doubt{};  // why it is not sure, whatever it gains; empty: nothing speaks so

  bool changes_in_time() const;
};

struct Unexplained {
  std::string covariate;
  double evidence = 0;
  double lambda = 0;
  std::optional<inference::HeldOutGain> held_out;
  std::vector<inference::Elsewhere> elsewhere{};
  std::vector<inference::Alternative> alternatives{};  // causes that explain it nearly as well

  bool changes_in_time() const;
};

struct MappedWall {
  std::string name, material;
  double x0, y0, x1, y1, thickness;  // m
};

// What the search looked at, one entry a row: means of neighbouring readings of one link.
struct RowSummary {
  std::vector<std::string> radios;  // names, by the numbers in tx and rx
  std::vector<int> tx, rx;
  Eigen::Matrix3Xd tx_at, rx_at;              // m
  Eigen::VectorXd count, t;                   // readings; s: empty where the data have none, as all that follow
  Eigen::VectorXd tx_yaw, rx_yaw;             // rad
  Eigen::VectorXd heading, bearing;           // rad, of and from the end that moves: empty where no heading is known
  Eigen::VectorXd before, after;              // dB, measured less the world fitted alone, less the extended one
  Eigen::VectorXd white_before, white_after;  // the same, in its sd, without what its neighbours share with it
  std::vector<inference::Covariate> columns;  // further columns of the data, means
  std::vector<inference::Factor> factors;
  std::vector<MappedWall> walls;
  bool places_known = true;  // false: only distances are, and places stand for them
};

// What to measure to tell a cause from a rival.
struct Advice {
  std::string say, cause, alternative;
  double separability = 0;            // D of the data
  std::optional<double> predicted{};  // D with the advised readings; none where no plan could be made
};

// A measurement that could be made, reading by reading.
struct PlannedReadings {
  std::string say;
  LinkReadings readings;
};

// A parameter of the world, refitted beside the causes.
struct WorldValue {
  std::string path, unit;
  double value = 0, stderror = 0;
  bool at_bound = false;
  bool identifiable = true;  // without it the readings give one that others of the world may trade against it
};

// What was named, or, as "~COVARIATE", is unexplained.
struct Told {
  std::string id, label;
};

// The extended world held against readings that it was not made from.
struct SecondLook {
  std::filesystem::path data;
  std::size_t readings = 0;
  double rmse_given = 0;     // dB a reading: of the world as given, fitted to these very readings
  double rmse_extended = 0;  // of the extended world as it is written
  std::vector<Told> rediagnosis;
};

// The extended world simulated, and diagnosed again.
struct Loop {
  std::filesystem::path world;    // its folder
  double mean_difference = 0;     // dB, largest of all readings
  double rmse_extended = 0;       // dB a reading: measured less the extended world as it is written
  std::vector<Told> rediagnosis;  // what was found again
  std::optional<SecondLook> second{};
};

struct Diagnosis {
  std::vector<CauseEstimate> causes;  // the strongest first, suspected ones last
  std::vector<Unexplained> unexplained;
  std::vector<std::string> searched, not_tested;  // causes; the latter with the reason
  std::vector<std::string> notes;
  ReceiverChecks instrument;  // what the readings show of the receiver, and that the record is sound
  double residual_sd = 0;     // dB, of the fitted world
  noise::Covariance noise;
  std::optional<inference::HeldOutGain> held_out;
  std::optional<inference::Unseen> unseen;      // what held_out is of, in the order of `used`
  std::vector<inference::Elsewhere> elsewhere;  // the same with radios and runs not seen, where there are several
  std::vector<Eigen::Index> used;               // rows of the table that were searched
  Eigen::VectorXd fitted;                       // mean of the world as given, fitted, at every row of the table, dBm
  std::map<std::string, double> parameters;     // of the world, beside the causes
  std::vector<WorldValue> world_values;         // the same with their spread
  std::vector<inference::Stair> stairs;         // held-out error of the world, then with each accepted finding in turn
  std::vector<inference::Check> checks;         // all that was looked at beside what was found, the likeliest first
  std::vector<Advice> advice;
  std::optional<PlannedReadings> advised;  // of the plans, the one that decides most about the strongest open cause
  RowSummary seen;
  Eigen::VectorXd mean;  // of the extended model at every row of the table, dBm
  std::size_t readings = 0;
  Eigen::Index rows = 0;
  LinkRowLimits row_limits;
  std::optional<Loop> loop;

  bool named() const;
  // "unexplained", "extended" or "adequate"
  const char* verdict() const;
};

std::vector<Told> told_by(const Diagnosis& diagnosis);
// In one line; "silent" if there is nothing.
std::string in_short(const std::vector<Told>& told);

}  // namespace muster::diagnosis
