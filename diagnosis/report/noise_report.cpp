#include "noise_report.hpp"

#include <fmt/core.h>

namespace muster::report {

using namespace diagnosis;

Json json_of(const NoiseFit& fit) {
  Json json = {{"parameters", Json::array()},
               {"held", fit.held},
               {"pieces", Json::array()},
               {"left_out", fit.left_out},
               {"doubts", fit.doubts},
               {"noiseless_pieces", fit.noiseless},
               {"runs", fit.runs}};
  for (const NoiseParameter& p : fit.parameters)
    json["parameters"].push_back({{"name", p.path},
                                  {"value", p.value},
                                  {"lower95", p.lower95},
                                  {"upper95", p.upper95},
                                  {"unit", p.unit},
                                  {"freedom", p.freedom},
                                  {"at_bound", p.at_bound}});
  for (const NoiseCheck& c : fit.checks)
    json["pieces"].push_back({{"name", c.name},
                              {"unit", c.unit},
                              {"count", c.pieces},
                              {"measured_sd", c.measured_sd},
                              {"fitted_sd", c.fitted_sd},
                              {"variance_p", c.variance_p},
                              {"quiet_ratio", c.quiet_ratio},
                              {"quiet_p", c.quiet_p},
                              {"scale", c.scale},
                              {"scale_stderr", c.scale_stderr},
                              {"scale_p", c.scale_p},
                              {"mean", c.mean},
                              {"mean_p", c.mean_p},
                              {"correlation", c.correlation},
                              {"correlation_p", c.correlation_p}});
  return json;
}

void print(const NoiseFit& fit, const std::string& table, const std::string& data) {
  fmt::print("Noise of {}, fitted to {} by {} runs of the world.\n", table, data, fit.runs);
  fmt::print("\n  {:<28} {:>10}   {:<24} {}\n", "standard deviation", "value", "95 % interval", "unit");
  for (const NoiseParameter& p : fit.parameters)
    fmt::print("  {:<28} {:>10.4g}   {:<24} {}{}\n", p.path, p.value,
               fmt::format("{:.4g} to {:.4g}", p.lower95, p.upper95), p.unit, p.at_bound ? "  (at its bound)" : "");
  fmt::print("\n  {:<12} {:>8} {:>13} {:>13} {:>13} {:>13}  {}\n", "pieces", "count", "measured sd", "fitted sd",
             "mean error", "neighbours", "unit");
  for (const NoiseCheck& c : fit.checks)
    fmt::print("  {:<12} {:>8} {:>13.4g} {:>13.4g} {:>13.2g} {:>13.2f}  {}\n", c.name, c.pieces, c.measured_sd,
               c.fitted_sd, c.mean, c.correlation, c.unit);
  if (fit.noiseless > 0) fmt::print("\n{} pieces have no noise in the world, and are not used.\n", fit.noiseless);
  if (fit.doubts.empty())
    fmt::print("\nThe fitted noise explains the data: size, mean and neighbours are those of its own runs.\n");
  for (const std::string& doubt : fit.doubts) fmt::print("\ndoubt: {}.\n", doubt);
  if (fit.held.empty()) return;
  std::string held;
  for (const auto& path : fit.held) held += (held.empty() ? "" : ", ") + path;
  fmt::print("\nHeld, for they are no noise of this table: {}.\n", held);
}

}  // namespace muster::report
