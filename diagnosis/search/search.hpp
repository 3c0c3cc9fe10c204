// Finds what a model gets wrong, names it where it can be named, and says how sure that is.
#pragma once

#include <optional>

#include "diagnosis/search/forward.hpp"
#include "diagnosis/search/held_out.hpp"
#include "diagnosis/search/planned.hpp"
#include "diagnosis/search/spread.hpp"

namespace muster::search {

enum class Status { named = 1, suspected, unexplained };

struct Finding {
  std::string id, label;
  Status status = Status::named;
  std::vector<std::string> covariates;
  Eigen::VectorXd theta;                // where, when or of what shape
  Eigen::VectorXd coefficients;         // one a column
  Eigen::MatrixXd uncertainty;          // covariance of the coefficients
  std::vector<Eigen::VectorXd> thetas;  // where else it may be, as likely as one another; none for a suspected one
  double gain = 0;                      // deviance beside all other findings
  double evidence = 0;                  // nats
  double log_p = 0;                     // integrated over the covariance
  std::optional<HeldOut> held_out;      // without and with it; none for what is only suspected
  Eigen::VectorXd unseen_without;       // squared errors of readings at places not seen without it, dB^2; none likewise
  std::vector<Elsewhere> elsewhere;     // the same of radios and runs, where it concerns several
  std::vector<Rival> rivals;
};

struct Advice {
  std::string say, finding, rival;
  double separability = 0, predicted = 0;  // D now, and with the plan's readings
};

// A candidate at its best beside the model as it stands at the end.
struct Check {
  std::string id, label;
  Kind kind = Kind::named;
  double gain = 0, log_p = 0;  // of chance doing as well anywhere on its grid
};

struct Result {
  std::vector<Finding> findings;  // the strongest first, suspected ones last
  std::vector<Trial> trials;
  noise::Fit noise;
  std::vector<noise::Fit> families;  // of the base model
  Eigen::VectorXd base_coefficients;
  Eigen::VectorXd mean;              // of the extended model, one a row
  std::optional<Unseen> unseen;      // the base model and the extended one
  std::optional<HeldOut> held_out;   // the same in short
  std::vector<Elsewhere> elsewhere;  // of radios and runs, where there are several
  std::vector<Stair> stairs;         // the base model, then with each accepted finding in turn; empty: too few blocks
  std::vector<Check> checks;
};

constexpr Eigen::Index fewest_readings = 50;

class Search {
 public:
  // Keeps a reference to the problem. Throws std::invalid_argument where its columns do not fit its readings.
  explicit Search(const Problem& problem, const Options& options = {});

  Result run();
  // After run(): what each plan would do for every named finding and rival that the data do not decide (D < 25).
  std::vector<Advice> advise(const std::vector<Plan>& plans);

  const Bench& bench() const { return bench_; }

 private:
  Finding finding_of(const Term& term, Status status) const;
  // How well each term is known; a place goes to the middle of those that are as likely.
  std::vector<Spread> settle_in_the_middle();
  void check_what_is_left(Result& result, const Stand& stand);

  Bench bench_;
  Result result_;
};

}  // namespace muster::search
