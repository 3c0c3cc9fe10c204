// Results of a diagnosis, as plain data: causes, unexplained effects, held-out gains, advice and the closed loop.
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
  bool cyclic = false;              // an angle: its interval may extend beyond these
  bool by_ratio = false;            // sought by its logarithm: 1 and 2 are as far apart as 10 and 20
};

// A place that one standing radio alone sees: how wide it is shows, and not how far off.
struct OneStation {
  std::string radio;
  double nearest = 0, farthest = 0;         // m from the radio to the middle of the place, 95 %
  std::optional<Eigen::Vector2d> second{};  // where a second station would tell; none if no visited place would
};

struct CauseEstimate {
  std::string id, label, title, tell_apart;
  // The search's id for it: a wall with zero loss may be reported as an absent one. Empty: not from the search, but a
  // law of readings or an earlier edit.
  std::string sought_as;
  inference::Status status = inference::Status::named;
  std::vector<std::string> covariates;  // its arguments, its own one first: "map", "time", "bearing"
  std::string row_parameter, row;       // empty for a cause without a row
  std::vector<CauseValue> values;
  std::map<std::string, double> held;        // parameters set and not estimated
  std::map<std::string, std::string> words;  // further attributes, such as the other radio
  std::map<std::string, std::string> files;  // tables that it refers to: attribute and text
  double evidence = 0, log_p = 0;
  double inflation = 1;    // of gains of its kind in these data; its own was divided by it for log_p
  double lambda = 0;       // its gain: fall of the deviance beside all others
  Eigen::VectorXd effect;  // dB added to each row of the summary
  std::optional<inference::HeldOutGain> held_out;
  Eigen::VectorXd unseen_without;  // squared errors at held-out places without it, in the order of Diagnosis::used
  std::vector<inference::Elsewhere> elsewhere;  // its gains on held-out radios and runs, if it concerns several
  std::vector<inference::Alternative> alternatives;
  std::optional<OneStation> one_station{};
  std::string doubt{};           // reason why it is uncertain, whatever its gain; empty: none
  bool corrected_first = false;  // all others were found in the world put right for it

  bool changes_in_time() const;
};

// How a doubt begins where a parameter of the world ends at its bound.
inline constexpr const char* at_its_bound = "at its bound: ";

struct Unexplained {
  std::string covariate;
  double evidence = 0;
  double lambda = 0;
  std::optional<inference::HeldOutGain> held_out;
  std::vector<inference::Elsewhere> elsewhere{};
  std::vector<inference::Alternative> alternatives{};  // causes that explain it nearly as well
  double reach = 0;  // dB, between the lowest and the highest of its effects, but for 1 % at each end

  bool changes_in_time() const;
};

struct MappedWall {
  std::string name, material;
  double x0, y0, x1, y1, thickness;  // m
};

// Rows of the search: means of neighbouring readings of one link, one entry a row.
struct RowSummary {
  std::vector<std::string> radios;  // names, by the indices in tx and rx
  std::vector<int> tx, rx;
  Eigen::Matrix3Xd tx_at, rx_at;              // m
  Eigen::VectorXd count, t;                   // readings; s: empty if the data have none, like all that follow
  Eigen::VectorXd tx_yaw, rx_yaw;             // rad
  Eigen::VectorXd heading, bearing;           // rad, of and from the end that moves: empty without a known heading
  Eigen::VectorXd before, after;              // dB, residual of the fitted world, and of the extended one
  Eigen::VectorXd white_before, white_after;  // the same whitened, in standard deviations
  std::vector<inference::Covariate> columns;  // further columns of the data, means
  std::vector<inference::Factor> factors;
  std::vector<MappedWall> walls;
  double noise_variance = 0;  // dB2, of a reading from noise alone, in data to which the extended world was fitted
  bool places_known = true;   // false: the data have distances instead, used in place of places
};

// Advice on measurements that separate a cause from an alternative.
struct Advice {
  std::string say, cause, alternative;
  double separability = 0;            // D with the present data
  std::optional<double> predicted{};  // D with the advised readings; none if no plan could be made
};

// A possible measurement, reading by reading.
struct PlannedReadings {
  std::string say;
  LinkReadings readings;
};

// A parameter of the world, refitted beside the causes.
struct WorldValue {
  std::string path, unit;
  double value = 0, stderror = 0;
  bool at_bound = false;
  bool identifiable = true;  // false: other parameters of the world can compensate it
};

// A named cause or, as "~COVARIATE", an unexplained effect.
struct NamedCause {
  std::string id, label;
};

// Errors of the extended world on readings that it was not fitted to.
struct SecondLook {
  std::filesystem::path data;
  std::size_t readings = 0;
  double rmse_given = 0;     // dB a reading: of the world as given, fitted to these readings
  double rmse_extended = 0;  // of the extended world as written
  std::vector<NamedCause> rediagnosis;
};

// Closed loop: the extended world, simulated and diagnosed again.
struct Loop {
  std::filesystem::path world;             // its folder
  double mean_difference = 0;              // dB, largest over all readings
  double rmse_extended = 0;                // dB a reading: measured less the extended world as written
  std::vector<NamedCause> rediagnosis{};   // findings of the second diagnosis
  std::optional<double> unseen_error{};    // dB: of the extended world at places left out, by the second diagnosis
  std::vector<WorldValue> fitted_again{};  // parameters of the extended world, by the second diagnosis
  std::optional<SecondLook> second{};
};

// A radio that the data name and the world does not list, at the first place of its readings.
struct AddedRadio {
  std::string name;
  double x, y, z;  // m
  bool stands = false;
};

// Stays, each of many readings in turn at one place, that differ by more than their readings, in a way that depends on
// time and has no name.
struct Stays {
  int count = 0;
  double sd = 0, reading_sd = 0;  // dB: of their means, and of single readings
};

// A field that neighbouring readings share and the world does not state.
struct UnstatedField {
  double shadowing = 0, decorrelation = 0;  // dB; m
  double reading_sd = 0;                    // dB, of single readings about it
};

// Readings that scatter more or less than those that the world draws.
struct OtherScatter {
  double measured = 0;         // dB, about the fitted world
  double least = 0, most = 0;  // dB, of the world's own draws
  bool of_single = false;      // beside what neighbouring readings share
};

struct Diagnosis {
  // What lowers the error at left-out places most comes first, laws of readings after that, what is in doubt and
  // suspected causes last.
  std::vector<CauseEstimate> causes;
  std::vector<Unexplained> unexplained;
  std::vector<Unexplained> of_people;             // effects of time that those who walk about account for
  std::vector<std::string> searched, not_tested;  // causes; those not tested with the reason
  std::vector<std::string> notes;
  std::vector<AddedRadio> added_radios;
  ReceiverChecks receiver;  // properties of the receiver, and soundness of the record
  double residual_sd = 0;   // dB, of the fitted world
  noise::Covariance noise;
  double time_unit = 0;  // s: of one unit of its decorrelation distance, where errors are correlated over time
  std::optional<UnstatedField> unstated_field;
  std::optional<Stays> stays;
  std::optional<OtherScatter> other_scatter;  // sought where nothing else was found
  std::optional<inference::HeldOutGain> held_out;
  std::optional<inference::Unseen> unseen;      // held-out errors behind held_out, in the order of `used`
  std::vector<inference::Elsewhere> elsewhere;  // the same on held-out radios and runs, if there are several
  std::vector<Eigen::Index> used;               // rows of the table used in the search
  std::optional<double> end;                    // dBm; a floor below which readings are missing from the table
  bool end_of_default = false;                  // that floor is a default of the world's receiver
  Eigen::VectorXd fitted;                       // mean of the world as given, fitted, at every row of the table, dBm
  Eigen::VectorXd levels;                       // of the readings used, dBm; censored and truncated ones as imputed
  std::map<std::string, double> parameters;     // of the world, refitted beside the causes
  std::vector<WorldValue> world_values;         // the same with their uncertainty
  std::vector<inference::Stair> stairs;         // held-out error of the world, then with each accepted finding in turn
  std::vector<inference::Check> checks;         // every candidate scored beside the final model, the likeliest first
  std::vector<Advice> advice;
  std::optional<PlannedReadings> advised;  // the plan with the largest growth of D for the strongest open cause
  RowSummary seen;
  Eigen::VectorXd mean;  // of the extended model at every row of the table, dBm
  std::size_t readings = 0;
  Eigen::Index rows = 0;
  LinkRowLimits row_limits;
  std::optional<Loop> loop;
  bool interrupted = false;  // the search was ended before all was looked at

  bool named() const;
  // "unexplained", "extended", "adequate", or "interrupted" where nothing was found until then. Unexplained is also a
  // field that the world does not state, without a name.
  const char* verdict() const;
};

std::vector<NamedCause> named_causes(const Diagnosis& diagnosis);
// On one line; "silent" if empty.
std::string names_in_words(const std::vector<NamedCause>& told);

}  // namespace muster::diagnosis
