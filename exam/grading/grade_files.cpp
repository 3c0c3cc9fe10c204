// Reads answers and reports, and writes grades.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "exam/files.hpp"
#include "exam/grading/grade.hpp"

namespace muster::exam {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;
namespace fs = std::filesystem;

json report_in(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.rfind("{\"verdict\"", 0) == 0) return json::parse(line);
  return json::parse(text);
}

std::optional<double> number(const json& from, const char* key) {
  const auto at = from.find(key);
  return at != from.end() && at->is_number() ? std::optional<double>(at->get<double>()) : std::nullopt;
}

std::string last_part(const std::string& path) { return path.substr(path.find_last_of("/.") + 1); }

Verdict::Cause cause_of(const json& from) {
  Verdict::Cause cause{last_part(from.at("id").get<std::string>()),
                       from.value("label", ""),
                       number(from, "evidence").value_or(0),
                       {},
                       {}};
  for (const json& p : from.value("parameters", json::array()))
    if (const auto value = number(p, "value"))
      cause.parameters[last_part(p.at("name").get<std::string>())] = {*value, number(p, "lower95"),
                                                                      number(p, "upper95")};
  for (const json& r : from.value("rivals", json::array())) {
    const std::string id = r.at("id");
    if (id[0] != '~') cause.rivals.push_back(last_part(id));
    if (r.value("in_headline", false)) cause.beside.push_back(last_part(id));
  }
  return cause;
}

std::optional<bool> advised_decides(const json& report) {
  constexpr double decided = 25;  // D
  std::optional<bool> result;
  for (const json& a : report.value("advice", json::array()))
    if (a.value("advised", false))
      result = result.value_or(true) && number(a, "predicted_separability").value_or(0) >= decided;
  return result;
}

// The first existing report of this case.
std::optional<fs::path> report_of(const fs::path& reports, const std::string& name) {
  for (const char* file : {"{}.json", "{}.txt", "{}/diagnosis.json", "{}/report.json", "{}/diagnose.out"}) {
    const fs::path at = reports / fmt::format(fmt::runtime(file), name);
    if (fs::is_regular_file(at)) return at;
  }
  return {};
}

// A second report that the command wrote beside the first one.
std::optional<Verdict> beside(const fs::path& reports, const std::string& name) {
  const fs::path at = reports / name;
  if (!fs::is_regular_file(at)) return {};
  return read_verdict(read_file(at));
}

// CPU seconds of each case, from the output of `run`; of repeated runs the last one.
std::vector<double> costs_in(const fs::path& reports) {
  std::map<std::string, double> seconds;
  std::ifstream in(reports / "costs.csv");
  std::string line;
  for (std::getline(in, line); std::getline(in, line);) {
    const auto comma = line.find(',');
    double value = 0;
    if (comma == line.npos) continue;
    const auto [end, error] = std::from_chars(line.data() + comma + 1, line.data() + line.size(), value);
    if (error == std::errc{} && *end == ',') seconds[line.substr(0, comma)] = value;
  }
  std::vector<double> result;
  result.reserve(seconds.size());
  for (const auto& [name, value] : seconds) result.push_back(value);
  return result;
}

json share_json(const Share& s) {
  return {{"hits", s.hits}, {"of", s.of}, {"share", s.value()}, {"lower95", s.lower95()}, {"upper95", s.upper95()}};
}

std::string share_line(const std::string& name, const Share& s) {
  return fmt::format("  {:<58} {:>5}/{:<5} {:6.1f} %  [{:.1f}, {:.1f}]\n", name, s.hits, s.of, 100 * s.value(),
                     100 * s.lower95(), 100 * s.upper95());
}

ordered_json spread_json(const std::vector<double>& values) {
  if (values.empty()) return nullptr;
  return {{"count", values.size()}, {"median", quantile(values, 0.5)}, {"p90", quantile(values, 0.9)}};
}

}  // namespace

Truth read_truth(const std::string& text) {
  const json from = json::parse(text);
  if (from.value("format", "") != "muster_exam/1") throw std::runtime_error("not an answer of muster_exam/1");
  Truth truth{from.at("case"), from.at("kind"), {}, from.value("oracle", json::object()).value("gain_db2", 0.0)};
  for (const json& e : from.at("effects")) {
    Truth::Effect effect{e.at("id"), e.at("rows"), e.at("covariates"), {}, {}, e.at("lambda")};
    effect.also = e.value("also", effect.also);
    effect.kin = e.value("class", effect.kin);
    effect.in_vocabulary = e.value("in_vocabulary", truth.kind != "outside");
    for (const json& p : e.at("parameters")) effect.parameters[p.at("name")] = p.at("value");
    truth.effects.push_back(effect);
  }
  return truth;
}

Verdict read_verdict(const std::string& text) {
  try {
    const json from = report_in(text);
    Verdict verdict;
    verdict.verdict = from.at("verdict").get<std::string>();
    for (const json& c : from.value("causes", json::array()))
      if (c.value("status", "named") == "named") verdict.named.push_back(cause_of(c));
    std::stable_sort(verdict.named.begin(), verdict.named.end(),
                     [](const auto& a, const auto& b) { return a.evidence > b.evidence; });
    for (const json& u : from.value("unexplained", json::array())) verdict.unexplained.push_back(u.at("covariate"));
    const auto before = number(from.value("base", json::object()), "heldout_rmse_db"),
               after = number(from, "heldout_rmse_db");
    if (before && after) verdict.gain = *before * *before - *after * *after;
    verdict.advised_decides = advised_decides(from);
    if (from.contains("loop") && from["loop"].is_object() && from["loop"].contains("rediagnosis") &&
        from["loop"]["rediagnosis"].is_string())
      verdict.loop = from["loop"]["rediagnosis"].get<std::string>();
    return verdict;
  } catch (const json::exception& e) {
    throw std::runtime_error(std::string("not a report of a diagnosis: ") + e.what());
  }
}

namespace {

// Throws std::invalid_argument with the file.
Truth truth_in(const fs::path& file) try { return read_truth(read_file(file)); } catch (const json::parse_error& e) {
  throw std::invalid_argument(fmt::format(
      "{}: is no JSON from byte {} on; expected an answer that muster exam make wrote", file.string(), e.byte));
} catch (const json::exception&) {
  throw std::invalid_argument(file.string() + ": lacks what an answer has; expected one that muster exam make wrote");
}

}  // namespace

Grades grade(const fs::path& answers, const fs::path& reports) {
  std::vector<fs::path> files;
  const fs::path folder = fs::is_directory(answers / "answers") ? answers / "answers" : answers;
  if (!fs::is_directory(folder))
    throw std::invalid_argument("--answers: " + folder.string() + ": there is no such folder");
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  if (files.empty())
    throw std::invalid_argument("--answers: " + folder.string() +
                                ": has no case_....json; expected a folder that muster exam make wrote");
  std::sort(files.begin(), files.end());
  Grades grades;
  for (const fs::path& file : files) {
    const Truth truth = truth_in(file);
    Verdict verdict;  // for a case without a report: silence, which is wrong; a clean one without it is not counted
    try {
      const auto report = report_of(reports, truth.name);
      if (!report) throw std::runtime_error("none");
      verdict = read_verdict(read_file(*report));
      if (const auto second = beside(reports, truth.name + ".second.json"))
        verdict.second_silent = second->named.empty() && second->unexplained.empty();
      if (const auto followed = beside(reports, truth.name + ".advised.json"))
        verdict.named_when_followed = followed->named;
    } catch (const std::runtime_error&) {
      grades.missing.push_back(truth.name);
      if (truth.effects.empty()) continue;
    }
    add(grades, truth, verdict);
  }
  if (grades.missing.size() == files.size())
    throw std::invalid_argument(
        fmt::format("{}: has no readable report of any of the {} cases; expected what muster diagnose --json prints, "
                    "as muster exam "
                    "run FOLDER keeps it{}",
                    reports.string(), files.size(),
                    answers.filename() == "answers" ? "; --answers is the folder above answers/" : ""));
  grades.seconds = costs_in(reports);
  return grades;
}

std::string as_text(const Grades& g) {
  std::string out = "95 % binomial intervals in brackets; cases with several effects stand in the bin of the weakest\n";
  for (const auto& [name, share] : g.shares) out += share_line(name, share);
  out += "found, by effect (outside the vocabulary: right covariate)\n";
  for (const auto& [name, share] : g.by_effect) out += share_line(name, share);
  out += "share of the oracle's held-out gain, pooled\n";
  for (const auto& [bin, oracle] : g.oracle) out += fmt::format("  {:<58} {:.3f}\n", bin, g.gain.at(bin) / oracle);
  out += "parameters of found effects\n" + share_line("95 % intervals that hold the truth", g.covered);
  const auto spread = [&](const char* name, const std::vector<double>& values, const char* unit) {
    if (!values.empty())
      out += fmt::format("  {:<58} {:.3f} / {:.3f}{} ({})\n", name, quantile(values, 0.5), quantile(values, 0.9), unit,
                         values.size());
  };
  spread("relative error, median / 90 %", g.relative_errors, "");
  spread("wall's location, median / 90 %", g.places.wall, " m");
  spread("wall's loss, median / 90 %", g.places.wall_loss, " dB");
  spread("obstacle's centre, median / 90 %", g.places.obstacle, " m");
  for (const std::string& name : g.missing)
    out += "no readable report: " + name + "; expected what muster diagnose --json prints\n";
  return out;
}

std::string as_json(const Grades& g) {
  ordered_json shares, effects, gains;
  for (const auto& [name, share] : g.shares) shares[name] = share_json(share);
  for (const auto& [name, share] : g.by_effect) effects[name] = share_json(share);
  for (const auto& [bin, oracle] : g.oracle) gains[bin] = g.gain.at(bin) / oracle;
  return ordered_json{{"shares", shares},
                      {"by_effect", effects},
                      {"gain_share", gains},
                      {"interval_coverage", share_json(g.covered)},
                      {"relative_error", spread_json(g.relative_errors)},
                      {"wall_location_m", spread_json(g.places.wall)},
                      {"wall_loss_db", spread_json(g.places.wall_loss)},
                      {"obstacle_location_m", spread_json(g.places.obstacle)},
                      {"missing", g.missing}}
             .dump() +
         "\n";
}

}  // namespace muster::exam
