// A world and its measured readings made ready for a search: the world fitted, its own columns, and every cause that
// the data can speak of as a candidate.
#pragma once

#include "diagnosis/calibration/fit.hpp"
#include "diagnosis/causes/cause_candidates.hpp"
#include "diagnosis/inference/state/problem.hpp"
#include "diagnosis/prediction/sensitivities.hpp"
#include "diagnosis/radio/causes/simulated_readings.hpp"
#include "diagnosis/radio/links/link_smooths.hpp"
#include "diagnosis/radio/links/receiver_checks.hpp"

namespace muster::diagnosis {

struct DiagnosisSetup {
  // Throws Error.
  DiagnosisSetup(const std::filesystem::path& world, const std::filesystem::path& file,
                 const Library::SearchPath& plugins);
  DiagnosisSetup(const DiagnosisSetup&) = delete;
  DiagnosisSetup& operator=(const DiagnosisSetup&) = delete;

  std::filesystem::path file;  // of the readings
  Dataset data;
  ReceiverChecks instrument;  // what the readings show of the receiver
  LinkModel model;
  std::vector<Cause> causes;  // of the plugin path
  Fit fitted;
  Sensitivities base;
  std::vector<Eigen::Index> used;            // rows of the table behind the readings of the search
  std::shared_ptr<CauseModel> run;           // what the candidates evaluate
  std::shared_ptr<const LinkLayout> layout;  // of the readings of the search
  LinkColumns link_columns;                  // beyond those of a link
  inference::Problem problem;
  inference::Options options;
  CauseSearch sought;                           // behind the problem's candidates
  std::vector<std::string> untested;            // columns, with the reason
  std::unique_ptr<SimulatedReadings> sketched;  // one reading a row of the search; none if each is a row

 private:
  void leave_out_crossed_links();
  LinkReadings readings_of_search();
  void take_swaps_by_the_map(const noise::Rows& rows, const std::filesystem::path& world,
                             const Library::SearchPath& plugins);
  void let_sketch(const noise::Rows& rows, const std::filesystem::path& world, const Library::SearchPath& plugins);
  void let_ask_near(const std::filesystem::path& world, const Library::SearchPath& plugins);
  noise::Known known_of(double rssi) const;
  // The run of each reading; empty where the data name none.
  std::vector<int> add_columns();
};

}  // namespace muster::diagnosis
