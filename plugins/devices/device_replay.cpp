// What a robot has sensed, from a log, in the place of the robot: a controller runs on it open loop.
#include <charconv>
#include <cmath>
#include <cstring>
#include <iterator>
#include <muster/names.hpp>
#include <muster/plugin.hpp>

#include "device_ports.hpp"
#include "recording.hpp"

namespace {

using namespace muster;
using devices::nanoseconds;
using devices::Track;
using ports::GivenRows;
using ports::Port;

constexpr Param params[] = {
    reference("robot", "robot", "the robot whose sensors it stands for").required(),
    file("file", "an MCAP file, or the wide CSV table of a run"),
    text("writes", "robot/{robot}/odometry robot/{robot}/stall", "tables that it fills, with blanks between"),
    text("reads", "robot/{robot}/command", "commands that it holds against those of the log; \"\" for none"),
    text("logged_as", "", "the robot's name in the log; by default its own"),
    text("topics", "", "topics of ROS 2 in the place of tables: robot/{robot}/odometry=/odom"),
    real("begin", 0, 0, 1e9, "s", "when the world begins, after the log's start"),
    real("gap", 1, 0, 1e9, "s", "a sample that is older is told")};

constexpr auto manual =
    "Each tick a table of `writes` has the log's latest sample at or before it; of a queue, such as "
    "scan/{robot}/message,\n"
    "the messages since the tick before. Nothing is interpolated: a sensor's reading is what it was. self/age has the "
    "age\n"
    "of each table's sample; before the first sample the table has its initial values. Gaps are events.\n"
    "A controller's commands are held against those that the log has, bit for bit: self/logged_command has the log's,\n"
    "self/compared_command how many ticks had both, how many differ, since when, and by how much at most.\n"
    "`file` is what `muster run --mcap` or `--wide` writes, or what ros2 bag has recorded as MCAP: of the topics that\n"
    "`topics` names, nav_msgs/msg/Odometry and sensor_msgs/msg/LaserScan are read. A log of muster starts at 0, any "
    "other\n"
    "with its first message.";

struct Filled {
  Port port;
  Track track;
};

struct Compared {
  Port port;
  Track track;
  int logged = -1, result = -1;  // claims
};

// Columns of self/compared_...
struct Comparison {
  static constexpr const char* columns = "ticks differing since[s]? most";
  double ticks, differing, since, most;
};

struct Replay {
  const muster_host* host = nullptr;
  std::vector<Filled> filled;
  std::vector<Compared> compared;
  int age = -1;
  double gap = 0;
};

std::string text_of(const muster_host* host, const char* path) {
  const char* found = host->text(host, path);
  return found ? found : "";
}

devices::Topics topics_of(const muster_host* host) {
  devices::Topics result;
  for (const std::string& word : names_in(host, "topics")) {
    const auto equals = word.find('=');
    if (equals == word.npos || equals + 1 >= word.size() || word[equals + 1] != '/')
      throw BadInput("attribute \"topics\": \"" + word + "\" is no pair; expected TABLE=/TOPIC, such as " +
                     "robot/{robot}/odometry=/odom");
    result.emplace_back(word.substr(0, equals), word.substr(equals + 1));
  }
  return result;
}

// The world's folder is the last one in which files are looked for.
std::filesystem::path file_of(const muster_host* host) {
  const std::string given = text_of(host, "file");
  if (given.empty()) throw BadInput("has no attribute \"file\", which it needs; expected an MCAP file or a CSV file");
  std::string folder;
  for (uint32_t i = 0; const char* next = host->search_path(host, i); ++i) folder = next;
  const std::filesystem::path path(given);
  return path.is_absolute() ? path : std::filesystem::path(folder) / path;
}

std::string nullable_columns(const Port& port) {
  std::string result;
  for (const auto& column : port.columns) result += (result.empty() ? "" : " ") + column.title() + '?';
  return result;
}

void* create(const muster_host* host) {
  Replay* made = nullptr;
  detail::guarded(host, [&] {
    const int robot = static_cast<int>(host->param(host, "robot"));
    const auto fills = devices::filled_ports(host, robot), reads = devices::command_ports(host, robot);
    if (fills.empty()) throw BadInput("fills no table; expected an attribute writes=\"robot/{robot}/odometry\"");
    const std::string name = text_of(host, "logged_as");
    const devices::Source source{file_of(host),
                                 name.empty() ? host->row_name(host, "robot", static_cast<uint32_t>(robot)) : name,
                                 host->param(host, "begin"), topics_of(host)};
    auto both = fills;
    both.insert(both.end(), reads.begin(), reads.end());
    auto tracks = devices::recording(host, both, source);
    auto* replay = new Replay{host, {}, {}, -1, host->param(host, "gap")};
    std::string ages;
    for (std::size_t i = 0; i < fills.size(); ++i) {
      ages += (ages.empty() ? "" : " ") + devices::short_name(fills[i]) + "[s]?";
      if (tracks[i].strangers)
        detail::warn(host, "self",
                     std::to_string(tracks[i].strangers) + " messages of " + fills[i].table +
                         " in the log are of rows that this world does not have, and are left out");
      replay->filled.push_back({fills[i], std::move(tracks[i])});
    }
    made = replay;
    replay->age = devices::own_table(host, "age", ages);
    for (std::size_t i = 0; i < reads.size(); ++i) {
      const std::string quantity = devices::short_name(reads[i]);
      replay->compared.push_back({reads[i], std::move(tracks[fills.size() + i]),
                                  devices::own_table(host, "logged_" + quantity, nullable_columns(reads[i])),
                                  devices::own_table(host, "compared_" + quantity, Comparison::columns)});
    }
  });
  return made;
}

void destroy(void* self) { delete static_cast<Replay*>(self); }

struct Now {
  std::int64_t time, before;  // [ns] of this tick and of the last
  bool is_first;
};

std::string seconds(std::int64_t time) { return devices::seconds_text(static_cast<double>(time) / 1e9); }

// Told once: in the first tick at which the sample is too old. `samples`: that there are until now.
void tell_gap(const Replay& replay, const Filled& filled, const Now& now, std::size_t samples) {
  if (filled.port.is_queue) return;
  const Track& track = filled.track;
  if (samples == 0 && now.is_first)
    detail::warn(replay.host, "self",
                 filled.port.table +
                     (track.times.empty() ? " has no sample in the log"
                                          : " has no sample in the log before " + seconds(track.times.front())) +
                     ": it has its initial values");
  if (samples == 0 || samples == track.times.size()) return;
  const std::int64_t limit = track.times[samples - 1] + nanoseconds(replay.gap);
  if (now.time > limit && (now.before <= limit || now.is_first))
    replay.host->event(replay.host, (filled.port.table + " has a gap in the log: no sample from " +
                                     seconds(track.times[samples - 1]) + " to " + seconds(track.times[samples]))
                                        .c_str());
}

double fill(const Replay& replay, const Filled& filled, const Now& now, const muster_in* in, const muster_out* out) {
  const auto& [port, track] = filled;
  const std::size_t samples = track.until(now.time), width = port.columns.size();
  const std::size_t first = port.is_queue ? track.until(now.before) : samples - (samples > 0);
  const std::size_t texts = track.times.empty() ? 0 : track.bytes.size() / track.times.size();
  tell_gap(replay, filled, now, samples);
  if (samples == 0 && !port.is_queue) {
    set_last(port, in[port.claim], out[port.claim]);
  } else {
    const auto slice = [&](const auto& all, std::size_t each) {
      return std::vector(all.begin() + static_cast<std::ptrdiff_t>(first * each),
                         all.begin() + static_cast<std::ptrdiff_t>(samples * each));
    };
    if (samples > first)
      GivenRows(port, slice(track.cells, width), slice(track.bytes, texts)).set(replay.host, out[port.claim]);
  }
  return samples == 0 ? null() : static_cast<double>(now.time - track.times[samples - 1]) / 1e9;
}

bool are_same(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0 || (is_null(a) && is_null(b)); }

// What is told of the first command that is another.
std::string difference(const Port& port, const double* given, const double* logged) {
  std::string result = port.table + " is not what the log has:";
  for (std::size_t c = 0; c < port.columns.size(); ++c) {
    if (are_same(given[c], logged[c])) continue;
    char digits[2][32];
    *std::to_chars(digits[0], digits[0] + 31, given[c]).ptr = 0;
    *std::to_chars(digits[1], digits[1] + 31, logged[c]).ptr = 0;
    result += ' ' + port.columns[c].title() + ' ' + digits[0] + " here, " + digits[1] + " there";
  }
  return result;
}

void compare(const Replay& replay, const Compared& compared, const Now& now, const muster_in* in,
             const muster_out* out) {
  const auto& [port, track, logged, result] = compared;
  const std::size_t samples = track.until(now.time), width = port.columns.size();
  Comparison so_far = *reinterpret_cast<const Comparison*>(in[result].data);
  if (now.is_first) so_far = {0, 0, null(), 0};
  const bool is_fresh = samples > 0 && !now.is_first && track.times[samples - 1] > now.before;
  const double* here = in[port.claim].data;
  const double* there = samples ? &track.cells[(samples - 1) * width] : nullptr;
  for (std::size_t c = 0; c < width; ++c) out[logged].data[c] = there ? there[c] : null();
  if (is_fresh) {
    ++so_far.ticks;
    bool differs = false;
    for (std::size_t c = 0; c < width; ++c) {
      if (are_same(here[c], there[c])) continue;
      differs = true;
      if (const double by = std::abs(here[c] - there[c]); by > so_far.most) so_far.most = by;
    }
    so_far.differing += differs;
    if (differs && is_null(so_far.since)) {
      so_far.since = static_cast<double>(now.time) / 1e9;
      replay.host->event(replay.host, difference(port, here, there).c_str());
    }
    if (samples == track.times.size()) {
      const auto same = static_cast<uint64_t>(so_far.ticks - so_far.differing);
      replay.host->event(replay.host, ("the log of " + port.table + " ends: " + std::to_string(same) + " of " +
                                       std::to_string(static_cast<uint64_t>(so_far.ticks)) +
                                       " commands are those of the log, to the last bit")
                                          .c_str());
    }
  }
  *reinterpret_cast<Comparison*>(out[result].data) = so_far;
}

int step(void* self, const muster_tick* tick, const muster_in* in, const muster_out* out) {
  const Replay& replay = *static_cast<Replay*>(self);
  const bool fine = detail::guarded(replay.host, [&] {
    const Now now{nanoseconds(tick->time), nanoseconds(tick->time - tick->dt), tick->index == 0};
    double* age = out[replay.age].data;
    for (const Filled& filled : replay.filled) *age++ = fill(replay, filled, now, in, out);
    for (const Compared& compared : replay.compared) compare(replay, compared, now, in, out);
  });
  return fine ? MUSTER_OK : MUSTER_FAILED;
}

}  // namespace

MUSTER_DECLARE_ABI
extern "C" int muster_register(uint32_t abi, void* registry, muster_add add) {
  static const muster_plugin plugin{sizeof(muster_plugin),
                                    MUSTER_SENSE,
                                    "device.replay/2",
                                    "what a robot has sensed, from a log, in the place of the robot",
                                    manual,
                                    params,
                                    std::size(params),
                                    nullptr,
                                    create,
                                    destroy,
                                    step,
                                    nullptr,
                                    nullptr,
                                    nullptr,
                                    nullptr,
                                    nullptr};
  return abi == MUSTER_ABI ? add(registry, &plugin) : MUSTER_FAILED;
}
