#include "text/synonyms.hpp"

#include <algorithm>

namespace muster {
namespace {

// The same thing in a row: a foreign word, and the names that it may have here, the likeliest first.
struct Same {
  std::string_view foreign;
  std::vector<std::string_view> here;
};

const std::vector<Same>& dictionary() {
  static const std::vector<Same> words = {
      // attributes
      {"yaw", {"heading", "azimuth"}},
      {"heading", {"yaw", "azimuth", "direction"}},
      {"theta", {"heading", "yaw"}},
      {"orientation", {"heading", "yaw"}},
      {"rotation", {"heading", "yaw"}},
      {"rpy", {"heading", "yaw"}},
      {"pose", {"at"}},
      {"position", {"at"}},
      {"location", {"at"}},
      {"place", {"at"}},
      {"xyz", {"at"}},
      {"origin", {"at"}},
      {"x", {"at"}},
      {"z", {"base", "height", "at"}},
      {"start", {"from", "begin"}},
      {"end", {"to", "until"}},
      {"duration", {"until", "seconds"}},
      {"length", {"until"}},
      {"stop", {"until"}},
      {"stop_time", {"until"}},
      {"end_time", {"until"}},
      {"time", {"t", "at", "until", "seconds"}},
      {"when", {"t", "at"}},
      {"timestep", {"dt"}},
      {"time_step", {"dt"}},
      {"step", {"dt"}},
      {"step_size", {"dt"}},
      {"max_step_size", {"dt"}},
      {"rate", {"period", "every"}},
      {"update_rate", {"period", "every"}},
      {"hz", {"period", "every"}},
      {"interval", {"period", "every"}},
      {"frequency", {"period", "every"}},
      {"topic", {"table"}},
      {"urdf", {"model"}},
      {"file", {"model", "path", "mission"}},
      {"type", {"model", "plugin"}},
      {"waypoints", {"path"}},
      {"filename", {"file", "library"}},
      {"uri", {"file", "model"}},
      {"velocity", {"speed", "v"}},
      {"vel", {"speed", "v"}},
      {"max_speed", {"speed"}},
      {"angular", {"w"}},
      {"linear", {"v"}},
      {"power", {"tx_power"}},
      {"exponent", {"n"}},
      {"path_loss_exponent", {"n"}},
      {"attenuation", {"loss"}},
      {"stddev", {"noise", "shadowing"}},
      {"sigma", {"shadowing", "noise"}},
      {"sensor", {"robot"}},
      {"robot_name", {"robot"}},
      {"agent", {"robot"}},
      {"vehicle", {"robot"}},
      {"node", {"robot", "station", "radio"}},
      {"goal", {"at"}},
      {"target", {"at", "to", "instance"}},
      {"dest", {"to"}},
      {"destination", {"to"}},
      {"source", {"from"}},
      {"old", {"instance"}},
      {"new", {"plugin"}},
      // elements
      {"box", {"wall", "mesh"}},
      {"obstacle", {"wall", "mesh"}},
      {"model", {"robot", "mesh"}},
      {"actor", {"robot"}},
      {"anchor", {"station"}},
      {"beacon", {"station"}},
      {"access_point", {"station"}},
      {"ap", {"station"}},
      {"base", {"station"}},
      {"log", {"record"}},
      {"event", {"at"}},
      // verbs
      {"launch", {"run"}},
      {"start", {"run"}},
      {"simulate", {"run"}},
      {"play", {"run"}},
      {"validate", {"check"}},
      {"lint", {"check"}},
      {"list", {"plugins"}},
      {"info", {"describe"}},
      {"show", {"describe"}},
      {"calibrate", {"fit"}},
      {"convert", {"import"}},
      {"bag", {"log"}},
      {"coverage", {"map"}},
      {"heatmap", {"map"}},
      {"create", {"new"}},
      {"init", {"new"}},
      // options
      {"--output", {"--out"}},
      {"-o", {"--out"}},
      {"--duration", {"--until"}},
      {"--time", {"--until", "--at"}},
      {"--param", {"--set"}},
      {"--bag", {"--mcap"}},
      {"--gui", {"--view"}},
      {"--threads", {"--workers"}},
      {"--jobs", {"--workers"}},
  };
  return words;
}

}  // namespace

std::string synonym(std::string_view foreign, const std::vector<std::string>& valid) {
  for (const Same& word : dictionary()) {
    if (word.foreign != foreign) continue;
    for (const std::string_view name : word.here) {
      if (std::find(valid.begin(), valid.end(), name) != valid.end()) return std::string(name);
    }
  }
  return "";
}

}  // namespace muster
