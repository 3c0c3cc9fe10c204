// Worlds that have a fault of the map or the log each, with the world's parameters and the noise fitted anew in them.
#pragma once

#include <array>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "diagnosis/inference/noise/fit.hpp"
#include "diagnosis/pipeline/own_world_hypotheses.hpp"
#include "diagnosis/radio/links/fewer_readings.hpp"
#include "diagnosis/radio/links/link_rows.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {

// Rows of the readings where they were in a world, and the field that they share there.
struct RowsOfWorld {
  noise::Rows rows;
  noise::Field field;
};

// A world with a hypothesis, linearised at its own fit.
struct OwnWorld {
  Hypothesis hypothesis;
  double squares = 0;    // left by least squares
  double levelled = 0;   // the same with a level of each radio
  Eigen::VectorXd rest;  // measured less the mean at zero parameters
  Eigen::MatrixXd design;
  std::vector<std::array<End, 2>> ends{};
  Eigen::VectorXd values{};  // of the parameters, by least squares
  // Made when first asked for; the same for copies with other columns, whose ends are the same.
  std::shared_ptr<std::optional<RowsOfWorld>> rows{};
};

// Levels at the world's declared parameters, dBm.
struct DeclaredLevels {
  Eigen::VectorXd plain;              // of the world as it is
  std::vector<Eigen::VectorXd> with;  // each hypothesis; empty if it cannot run in this world
};

struct Likelihood {
  double nats = -std::numeric_limits<double>::infinity();
  noise::Covariance noise{};
};

class OwnWorldFits {
 public:
  // The models are at the setup's fitted parameters as long as this lives, but while a world is fitted.
  // `time_unit`: of a diagnosis whose errors are correlated over time (Diagnosis::time_unit), s; else 0. `levels`: of
  // the readings used, dBm; what was heard alone would be the stronger ones. `readings`: by about so many of them
  // worlds are judged, fewer than twice as many.
  OwnWorldFits(DiagnosisSetup& setup, double time_unit, const Eigen::VectorXd& levels,
               std::size_t readings = thresholds::own_world_readings);

  const std::vector<Eigen::Index>& rows() const { return kept_; }   // of the table, of the readings
  const Eigen::VectorXd& measured() const { return y_; }            // dBm, there
  const std::vector<std::size_t>& radio() const { return radio_; }  // of each: which sends, or hears where one sends
  double numbers_of_levels() const { return static_cast<double>(radios_.size()) - 1; }
  bool may_level() const;  // True if radios are few enough for a level of each
  // Finds out, too, with which hypotheses a smaller model predicts the readings used as that of all does: before it,
  // and with the others, all are evaluated.
  DeclaredLevels declared_levels(const std::vector<Hypothesis>& all);
  // The world with the hypothesis: its place and the parameters are fitted in turn.
  OwnWorld world_with(const Hypothesis& hypothesis);
  // With a level of each radio but one.
  OwnWorld with_levels(OwnWorld world) const;
  // Profile likelihood of the readings, with the noise fitted in this world.
  Likelihood likelihood_of(const OwnWorld& world) const;
  // The same with the family of that noise alone where this leaves it at less than so many nats.
  Likelihood likelihood_of(const OwnWorld& world, const noise::Covariance& like, double least) const;
  // Moves the place by generalised least squares; its standard errors.
  InPlan settle(OwnWorld& world, const noise::Covariance& covariance);

 private:
  // A model, and which of its rows are the readings used.
  struct Predictor {
    Predictor(LinkModel& of, std::vector<Eigen::Index> at) : model(of), rows(std::move(at)), moved(of) {}
    Eigen::VectorXd levels() { return model.expected()(rows); }
    Eigen::VectorXd levels_with(const Hypothesis& hypothesis);  // empty if it cannot run

    LinkModel& model;
    std::vector<Eigen::Index> rows;
    ParameterGuard moved;
  };
  struct Few {
    explicit Few(FewerReadings made) : of(std::move(made)), by(*of.model, of.rows) {}

    FewerReadings of;
    Predictor by;
  };
  using Kind = std::pair<const Cause*, std::map<std::string, std::string>>;  // a cause and its choices

  static Kind kind_of(const Hypothesis& h) { return {h.cause, h.words}; }
  Predictor& predictor_for(const Hypothesis& h) { return few_ && !by_all_.contains(kind_of(h)) ? few_->by : all_; }
  void look_at_few();
  void set(const Eigen::VectorXd& values);
  // Worlds as a whole are compared, so that a long field takes nothing from one of them.
  const noise::Prior& prior() const {
    return s_.options.longer && time_unit_ == 0 ? *s_.options.longer : s_.options.prior;
  }
  OwnWorld linearised(const Hypothesis& hypothesis);
  InPlan moved_to_best(Supposed& supposed, Predictor& predictor, const InPlan& start);
  void stepped(OwnWorld& world, const noise::Rows& rows, const noise::Whitener& whitener);
  LinkReadings readings_of(const OwnWorld& world) const;
  std::vector<Eigen::Index> twins_in(const OwnWorld& world) const;
  const RowsOfWorld& rows_of(const OwnWorld& world) const;

  DiagnosisSetup& s_;
  std::vector<Eigen::Index> of_used_, kept_;  // among the rows of the search; of the table
  Predictor all_;
  std::optional<Few> few_;
  std::set<Kind> by_all_;  // with which a reading depends on others
  std::vector<std::size_t> radio_;
  std::set<std::size_t> radios_;
  Eigen::VectorXd y_;
  double scale_;  // of the area, by which a plan may be off as much farther
  double time_unit_;
};

// Each less the mean of its group.
Eigen::VectorXd centred(const Eigen::VectorXd& values, const std::vector<std::size_t>& group);

}  // namespace muster::diagnosis
