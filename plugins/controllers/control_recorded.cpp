// Commands of a log, each held until the next: a robot is driven once more as it was.
#include <algorithm>
#include <muster/plugin.hpp>
#include <string>
#include <vector>

#include "plugins/table_times.hpp"

namespace {

using namespace muster;

struct Recorded {
  static constexpr const char* columns = "t[s] robot:robot v[m/s] w[rad/s]";
  double t, robot, v, w;
};

struct ControlRecorded {
  static constexpr auto id = "control.recorded/1";
  static constexpr auto summary = "drives a robot by the commands of a log";
  static constexpr auto manual =
      "The file's columns are t[s],robot,v[m/s],w[rad/s], as `muster run --record 'robot/*/command'` writes them; "
      "others "
      "are\n"
      "not read. A command holds until the next; before the first the robot is asked for rest, after the last that one "
      "holds.\n"
      "Nothing is fed back: the robot goes where noise and slip take it, which a fit of either needs.";
  static constexpr auto phase = MUSTER_CONTROL;
  static constexpr bool keeps_only_caches = true;
  static constexpr Param params[] = {reference("robot", "robot", "the robot it drives").required(),
                                     file("file", "recorded commands").required()};

  explicit ControlRecorded(Setup& s)
      : robot(static_cast<std::size_t>(s.param("robot"))),
        times(s, "file"),
        recorded(s.file<Recorded>("file")),
        command(s.write<Command>("robot/{robot}/command")) {}

  struct Sample {
    double t;
    Command command;
  };

  void read(const Step& k) {
    const auto rows = k[recorded];
    std::size_t first = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (static_cast<std::size_t>(rows[i].robot) != robot) continue;
      if (samples.empty()) first = i;
      if (!samples.empty() && !(rows[i].t > samples.back().t))
        throw BadInput(times.rows().at(i, "t") + "time does not rise: " + TableTimes::print(rows[i].t) + " s after " +
                       TableTimes::print(samples.back().t) + " s; expected the rows of a robot in the order of time");
      samples.push_back({rows[i].t, {rows[i].v, rows[i].w}});
    }
    const std::string name(k.name("robot", robot));
    if (samples.empty()) throw BadInput("has no command of robot '" + name + "' in its file; expected rows of it");
    const double second = samples.size() > 1 ? samples[1].t : samples[0].t;
    times.warn_of(k, {samples.front().t, second, samples.back().t, first}, "the commands of robot '" + name + "' are",
                  "it is driven by one command alone");
    is_read = true;
  }

  void step(const Step& k) {
    if (!is_read) read(k);
    // A little beyond, so that a time that was printed and read is that of its tick.
    const double now = k.time() + 1e-6 * k.dt();
    const auto next =
        std::upper_bound(samples.begin(), samples.end(), now, [](double t, const Sample& s) { return t < s.t; });
    *k[command] = next == samples.begin() ? Command{0, 0} : std::prev(next)->command;
  }

  std::size_t robot;
  TableTimes times;
  In<Recorded> recorded;
  Out<Command> command;
  std::vector<Sample> samples;  // from the file alone
  bool is_read = false;
};

}  // namespace

MUSTER_PLUGIN_IS(ControlRecorded)
