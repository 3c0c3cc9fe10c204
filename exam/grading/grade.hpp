// Grades diagnoses against sealed answers: docs/reference/exam_format.md defines the inputs and each figure.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace muster::exam {

// Successes among trials, with the exact binomial interval (Clopper and Pearson 1934).
struct Share {
  int hits = 0, of = 0;
  void count(bool hit) {
    hits += hit;
    ++of;
  }
  double value() const { return of ? static_cast<double>(hits) / of : 0; }
  double lower95() const;
  double upper95() const;
};

// 0.1 % quantile of the number of hits in `of` trials, each with probability `share`.
int least_hits(int of, double share);

// A case's answer.
struct Truth {
  struct Effect {
    std::string id;
    std::vector<std::string> rows, covariates;
    std::vector<std::string> also;  // accepted names for the same effect on its rows
    std::map<std::string, double> parameters;
    double lambda = 0;
    bool in_vocabulary = true;
    std::vector<std::string> kin{};  // names that are right by class alone
  };
  std::string name, kind;
  std::vector<Effect> effects;
  double oracle_gain = 0;  // dB^2; 0: the generator has no oracle
};

// The diagnosis of a case.
struct Verdict {
  struct Estimate {
    double value = 0;
    std::optional<double> lower95, upper95;
  };
  struct Cause {
    std::string id, label;
    double evidence = 0;
    std::map<std::string, Estimate> parameters;  // by the last part of their names
    std::vector<std::string> rivals;             // causes indistinguishable from it
    std::vector<std::string> beside{};           // those that its headline names beside it
  };
  std::string verdict;
  std::vector<Cause> named;  // the strongest first; suspected ones are not counted
  std::vector<std::string> unexplained;
  std::optional<double> gain;  // dB^2
  std::optional<std::string> loop;
  std::optional<bool> second_silent;  // silence of the extended world on other data of the same truth
  // True if the advised measurement is predicted to decide all open questions of its cause.
  std::optional<bool> advised_decides;
  std::optional<std::vector<Cause>> named_when_followed;  // with that measurement
};

Truth read_truth(const std::string& text);
// Parses a diagnosis' output: the line that begins with {"verdict", or a whole JSON object. Throws std::runtime_error
// if there is none.
Verdict read_verdict(const std::string& text);

struct Places {
  std::vector<double> wall, obstacle;  // m, of those found
  std::vector<double> wall_loss;       // dB, absolute
};

struct Grades {
  std::map<std::string, Share> shares;  // by "kind / measure / bin"
  std::map<std::string, Share> by_effect;
  std::map<std::string, double> gain, oracle;  // dB^2, pooled, by bin of lambda
  Share covered;                               // share of 95 % intervals that hold the truth
  std::vector<double> relative_errors;         // of parameters
  Places places;
  std::vector<double> seconds;       // of CPU, a case
  std::vector<std::string> missing;  // cases without a readable report
};

void add(Grades& grades, const Truth& truth, const Verdict& verdict);
Grades grade(const std::filesystem::path& answers, const std::filesystem::path& reports);
std::string as_text(const Grades& grades);
std::string as_json(const Grades& grades);
// Grades against the goals, in Markdown.
std::string as_table(const Grades& grades);

// Mean distance between two segments, in both directions; ends x0 y0 x1 y1.
double segment_distance(const std::vector<double>& a, const std::vector<double>& b);
std::string lambda_bin(double lambda);
double quantile(std::vector<double> values, double share);

}  // namespace muster::exam
