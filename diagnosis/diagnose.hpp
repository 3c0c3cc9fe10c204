// What a world gets wrong about measured readings: found, named where it can be, written into an extended world, and
// checked by simulating that world and looking again.
#pragma once

#include <optional>

#include "diagnosis/cause_columns.hpp"
#include "diagnosis/fit.hpp"
#include "diagnosis/search/search.hpp"

namespace muster::diagnosis {

struct CauseValue {
  std::string name, unit;  // of the plugin's parameter
  double value = 0, stderror = 0, lower95 = 0, upper95 = 0;
  double minimum = 0, maximum = 0;  // as declared
};

struct FoundCause {
  std::string id, label, title, tell_apart;
  search::Status status = search::Status::named;
  std::string row_parameter, row;  // empty where it is about no row
  std::vector<CauseValue> values;
  std::map<std::string, double> held;  // parameters that were set and not sought
  double evidence = 0, log_p = 0;
  std::optional<search::HeldOut> held_out;
  std::vector<search::Rival> rivals;
};

struct Unexplained {
  std::string covariate;
  double evidence = 0;
};

// The extended world simulated, and diagnosed again.
struct Loop {
  std::filesystem::path world;  // its folder
  double mean_difference = 0;   // dB, largest of all readings
  std::string rediagnosis;      // "silent", or what was found
};

struct Diagnosis {
  std::vector<FoundCause> causes;  // the strongest first, suspected ones last
  std::vector<Unexplained> unexplained;
  std::vector<std::string> searched, not_tested;  // causes; the latter with the reason
  std::vector<std::string> notes;
  double residual_sd = 0;  // dB, of the fitted world
  noise::Covariance noise;
  std::optional<search::HeldOut> held_out;
  std::map<std::string, double> parameters;  // of the world, beside the causes
  Eigen::VectorXd mean;                      // of the extended model at every row of the table, dBm
  std::size_t readings = 0;
  Eigen::Index rows = 0;
  std::optional<Loop> loop;

  bool named() const;
  // "unexplained", "extended" or "adequate"
  const char* verdict() const;
};

// One look. Throws Error.
Diagnosis diagnose(const std::filesystem::path& world, const std::filesystem::path& data,
                   const Library::SearchPath& plugins);

// Writes the extended world to `out`, simulates it at the readings and diagnoses it. Throws Error.
Loop closed_loop(const Diagnosis& found, const std::filesystem::path& world, const std::filesystem::path& data,
                 const std::filesystem::path& out, const Library::SearchPath& plugins);

}  // namespace muster::diagnosis
