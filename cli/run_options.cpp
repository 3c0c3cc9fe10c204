#include "run_options.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <set>

#include "text/comma_list.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/unit_words.hpp"
#include "world_file/params.hpp"

namespace muster::cli {

// What may be given several times takes one word each time: the words of a verb may follow it.
void declare(CommandLine& line, RunOptions& words) {
  line.option("--workers", words.workers, "threads; the results do not depend on it").within(1, 256);
  line.option("--until", words.until, "end of the run in seconds, instead of the world's");
  line.option("--seed", words.seed, "seed of all random numbers, instead of the world's");
  line.option("--set", words.set, "PATH=VALUE: a parameter of the world or of a plugin").one_word_each();
  line.option("--out", words.out, "folder for tables and pictures");
  line.option("--record", words.record, "a table to write to --out as CSV, such as 'robot/*/pose'").one_word_each();
  line.option("--plugins", words.plugins, "a folder of plugins, looked in first").one_word_each();
  line.flag("--json", words.json, "print the outcome as JSON");
}

double real_of(const std::string& text, const char* option, const char* unit) {
  const auto value = parse_real(text);
  if (!value) {
    const std::string name = std::string_view(unit) == "s"   ? "seconds"
                             : std::string_view(unit) == "m" ? "metres"
                                                             : unit;
    const auto meant = in_unit(unit, text);
    throw Error(Exit::invalid_input,
                std::string(option) + ": " + why_not_real(text) + (name.empty() ? "" : "; expected " + name) +
                    (meant ? ": " + std::string(option) + (std::string_view(option).ends_with('=') ? "" : " ") +
                                 print_real(*meant)
                           : ""));
  }
  return *value;
}

uint64_t tick_in_run(const World& world, double seconds, const char* option) {
  const uint64_t tick = ticks_of(seconds, world.dt, {option});
  const std::string end = print_real(static_cast<double>(world.ticks) * world.dt);
  if (tick > world.ticks)
    throw Error(Exit::invalid_input, std::string(option) + ": " + print_real(seconds) +
                                         " s is after the end of the run at " + end + " s; expected at most " + end +
                                         " s");
  return tick;
}

namespace {

// "1..20", "1-20", "1:20", "1,2,3": several seeds, as a sweep has them.
bool is_several(const std::string& text) {
  const auto sign = text.find_first_not_of("0123456789");
  const auto next = text.find_first_of("0123456789", sign);
  const bool is_decimal = text.find('.') != text.npos && text.find("..") == text.npos;
  return sign != 0 && sign != text.npos && next != text.npos && !is_decimal &&
         text.find_first_not_of("0123456789.-:, ") == text.npos;
}

std::string as_seeds(const std::string& text) {
  const auto sign = text.find_first_not_of("0123456789"), next = text.find_first_of("0123456789", sign);
  const bool is_list = text.find_first_of(", ") != text.npos;
  if (!is_list)
    return text.substr(0, sign) + ".." + text.substr(next, text.find_first_not_of("0123456789", next) - next);
  std::string result = text;
  std::replace(result.begin(), result.end(), ',', ' ');
  return result;
}

}  // namespace

World world_of(const std::string& path, const RunOptions& words) {
  World world = read_world(path, standard());
  if (words.until) world.ticks = ticks_of(real_of(*words.until, "--until", "s"), world.dt, {"--until"});
  if (words.seed) {
    const auto seed = parse_integer(*words.seed);
    if (!seed || *seed < 0)
      throw Error(Exit::invalid_input, "--seed: " + quote(*words.seed) + " is no seed; expected an integer from 0" +
                                           (is_several(*words.seed) ? ", and one: of several seeds, muster sweep, with "
                                                                      "seeds=\"" +
                                                                          as_seeds(*words.seed) + "\" in its file"
                                                                    : ""));
    world.seed = static_cast<uint64_t>(*seed);
  }
  for (const auto& table : words.record)
    if (const std::string each = once_each("--record", table); !each.empty())
      throw Error(Exit::invalid_input, "--record takes one table each time; expected " + each);
  for (const auto& table : words.record) world.records.push_back({table, 1, {"--record"}});
  if (!words.record.empty() && words.out.empty() && !words.has_log)
    throw Error(Exit::invalid_input, "--record needs --out, the folder to write to" +
                                         std::string(words.may_log ? ", or --mcap, a log" : ""));
  return world;
}

// Attributes of the world's file that no run changes, and those that have an option of their own.
void refuse_fixed(const World& world, const XmlAttribute& given) {
  const std::string& path = given.name;
  const auto refuse = [&](const std::string& expected) {
    throw invalid(given.place, quote(path) + " is no parameter" + expected);
  };
  const auto slash = path.rfind('/');
  const std::string name = slash == path.npos ? path : path.substr(slash + 1);
  const std::string owner = slash == path.npos ? "world" : path.substr(0, slash);
  const bool in_file = given.place.line > 0;  // of a sweep
  if (owner == "world" && name == "until") refuse(in_file ? "; expected until= of <sweep>" : "; expected --until");
  if (owner == "world" && name == "seed") refuse(in_file ? "; expected seeds= of <sweep>" : "; expected --seed");
  if (owner == "world" && name == "dt") refuse("; expected it in " + world.file.string() + ", <world dt=\"...\">");
  static const std::set<std::string> at_start = {"at", "heading", "model", "fittings", "packages", "antenna"};
  for (const RowDeclaration& row : world.rows) {
    if (row.set != "robot" || !at_start.count(name) || (owner != row.name && owner != "robot/" + row.name)) continue;
    refuse(": what a robot is and where it starts stand in the world's file; expected it there, at " +
           row.place.text());
  }
}

ParameterInfo parameter_at(const Simulation& run, const XmlAttribute& given) {
  try {
    return run.parameter(given.name);
  } catch (const Error& e) {
    if (given.place.line == 0) throw;
    throw Error(e.exit(), given.place, e.message());
  }
}

void set_parameter(Simulation& run, const XmlAttribute& given) {
  refuse_fixed(run.world(), given);
  const FindRow no_rows = [](const std::string&, const std::string&, const Place& place) -> double {
    throw invalid(place,
                  place.line > 0 ? "a reference cannot be varied" : "a reference cannot be set on the command line");
  };
  const Warn warn = [](const Place& place, const std::string& message) {
    fmt::print(stderr, "muster: warning: {}: {}\n", place.text(), message);
  };
  const auto info = parameter_at(run, given);
  run.set_parameter(given.name, attribute_values(*info.declared, 1, given, no_rows, warn).at(0));
}

void set_parameters(Simulation& run, const std::vector<std::string>& given) {
  std::set<std::string> seen;
  for (const auto& one : given) {
    const auto equals = one.find('=');
    if (equals == std::string::npos)
      throw Error(Exit::invalid_input, "--set " + quote(one) + ": expected PATH=VALUE, without blanks");
    if (const auto comma = one.find(',', equals);
        comma != std::string::npos && one.find('=', comma) != std::string::npos)
      throw Error(Exit::invalid_input, "--set takes one parameter each time; expected " + once_each("--set", one));
    const std::string path = one.substr(0, equals);
    if (const auto end = path.find_last_not_of(' '); end + 1 < path.size() && end != path.npos) {
      const auto begin = one.find_first_not_of(' ', equals + 1);
      throw Error(Exit::invalid_input, "--set " + quote(one) + " has blanks around '='; expected --set " +
                                           path.substr(0, end + 1) + '=' +
                                           (begin == one.npos ? "VALUE" : one.substr(begin)));
    }
    if (path.ends_with(':'))  // as ROS remaps
      throw Error(Exit::invalid_input, "--set " + quote(one) + " has := as ROS has it; expected PATH=VALUE: --set " +
                                           path.substr(0, path.size() - 1) + one.substr(equals));
    if (!seen.insert(path).second)
      throw Error(Exit::invalid_input, "--set: " + path + " is given more than once; expected one value");
    set_parameter(run, {path, one.substr(equals + 1), {"--set"}, {"--set"}});
  }
}

InstanceDeclaration instance_of(const std::string& name, const std::string& plugin,
                                const std::vector<std::string>& attributes, const std::string& who) {
  const Place place{who};
  XmlElement element{plugin, place, {}, {}};
  for (std::size_t i = 0; i < attributes.size(); ++i) {
    const std::string& one = attributes[i];
    const auto equals = one.find('=');
    if (equals == std::string::npos) {
      const bool has_value = i + 1 < attributes.size() && attributes[i + 1].find('=') == std::string::npos;
      throw invalid(place, quote(one) + " is no attribute; expected NAME=VALUE" +
                               (has_value ? "; did you mean " + one + '=' + attributes[i + 1] + "?" : ""));
    }
    if (equals == 4 && one.starts_with("name"))
      throw invalid(place, "the attribute \"name\" cannot be given; the new plugin keeps the name " + quote(name));
    element.attributes.push_back({one.substr(0, equals), one.substr(equals + 1), place, place});
  }
  InstanceDeclaration result = read_instance(element, plugin);
  result.name = name;
  return result;
}

std::string hexadecimal(uint64_t digest) { return fmt::format("{:016x}", digest); }

}  // namespace muster::cli
