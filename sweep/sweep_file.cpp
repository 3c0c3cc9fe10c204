#include "sweep_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <set>

#include "text/names.hpp"
#include "text/number.hpp"
#include "text/xml.hpp"

namespace muster::sweep {
namespace {

using Names = std::vector<std::string>;

constexpr std::size_t most_runs = 1'000'000;  // beyond it, a sweep is a typing error

void check_attributes(const XmlElement& element, const Names& known) {
  for (const XmlAttribute& given : element.attributes) {
    if (std::find(known.begin(), known.end(), given.name) == known.end())
      throw invalid(given.place,
                    "<" + element.name + "> has no attribute " + quote(given.name) + "; " + suggest(given.name, known));
  }
}

const XmlAttribute& required(const XmlElement& element, const std::string& name) {
  const XmlAttribute* found = element.attribute(name);
  if (!found) throw invalid(element.place, "<" + element.name + "> needs " + name + "=\"...\"");
  return *found;
}

// Words between white space, each with its place.
std::vector<Word> words_of(const XmlAttribute& attribute) {
  std::vector<Word> result;
  Place at = attribute.value_place;
  bool inside = false;
  for (const char c : attribute.value) {
    const bool blank = c == ' ' || c == '\t' || c == '\n' || c == '\r';
    if (!blank && !inside) result.push_back({"", at});
    if (!blank) result.back().text += c;
    inside = !blank;
    // A byte that continues a character takes no column.
    if (c == '\n')
      ++at.line, at.column = 1;
    else if ((static_cast<unsigned char>(c) & 0xc0) != 0x80)
      ++at.column;
  }
  if (result.empty()) throw invalid(attribute.value_place, attribute.name + "=\"\" is empty; expected words");
  std::set<std::string> seen;
  for (const Word& word : result) {
    if (!seen.insert(word.text).second)
      throw invalid(word.place, quote(word.text) + " stands twice in " + attribute.name + "; expected each value once");
  }
  return result;
}

std::int64_t seed_of(const std::string& text, const Word& word) {
  const auto value = parse_integer(text);
  if (!value || *value < 0)
    throw invalid(word.place, quote(word.text) + " is no seed; expected an integer from 0, or a range such as 1..20");
  return *value;
}

std::vector<std::int64_t> seeds_of(const XmlAttribute& attribute) {
  std::vector<std::int64_t> result;
  std::set<std::int64_t> seen;
  for (const Word& word : words_of(attribute)) {
    const auto dots = word.text.find("..");
    const std::int64_t first = seed_of(word.text.substr(0, dots), word);
    const std::int64_t last = dots == std::string::npos ? first : seed_of(word.text.substr(dots + 2), word);
    if (last < first)
      throw invalid(word.place, "the range " + quote(word.text) + " is empty; expected its least seed first");
    if (static_cast<std::size_t>(last - first) >= most_runs - result.size())
      throw invalid(word.place, fmt::format("more than {} seeds", most_runs));
    for (std::int64_t seed = first;; ++seed) {
      if (!seen.insert(seed).second)
        throw invalid(word.place, fmt::format("the seed {} is there already; expected each seed once", seed));
      result.push_back(seed);
      if (seed == last) break;
    }
  }
  return result;
}

// "1.5 2 2.5 3" of "1.5:0.5:3", begin:step:end as in MATLAB, and of "1:3"; "" where it is no such range, or a long one.
std::string listed(const std::string& range) {
  const auto first = range.find(':'), last = range.rfind(':');
  if (first == range.npos) return "";
  const auto begin = parse_real(range.substr(0, first)), end = parse_real(range.substr(last + 1));
  const auto step = first == last ? std::optional(1.0) : parse_real(range.substr(first + 1, last - first - 1));
  constexpr double most = 20;
  if (!begin || !end || !step || !(*step != 0) || !((*end - *begin) / *step >= 0 && (*end - *begin) / *step <= most))
    return "";
  std::string result;
  const int steps = static_cast<int>((*end - *begin) / *step + 1e-9);
  for (int i = 0; i <= steps; ++i) result += (i ? " " : "") + print_real(*begin + i * *step);
  return result;
}

Variation variation_of(const XmlElement& element) {
  check_attributes(element, {"set", "values", "instance", "plugins", "worlds"});
  const XmlAttribute *set = element.attribute("set"), *instance = element.attribute("instance"),
                     *worlds = element.attribute("worlds");
  if ((set != nullptr) + (instance != nullptr) + (worlds != nullptr) != 1)
    throw invalid(element.place,
                  "<vary> varies one thing; expected set=\"PATH\" values=\"...\", instance=\"NAME\" plugins=\"...\" or "
                  "worlds=\"...\"");
  for (const auto& [list, beside] : {std::pair("values", set), std::pair("plugins", instance)}) {
    if (const auto* given = element.attribute(list); given && !beside)
      throw invalid(given->place,
                    fmt::format("{}= needs {}= beside it", list, std::string(list) == "values" ? "set" : "instance"));
  }
  if (worlds) return {Variation::Kind::world, "", words_of(*worlds), worlds->place};
  if (!set)
    return {Variation::Kind::plugin, instance->value, words_of(required(element, "plugins")), instance->value_place};
  Variation result{Variation::Kind::parameter, set->value, words_of(required(element, "values")), set->value_place};
  for (const Word& word : result.values) {
    if (const std::string list = listed(word.text); !list.empty())
      throw invalid(word.place, "values: " + quote(word.text) +
                                    " is a range, and values are a list with blanks between them; expected values=\"" +
                                    list + '"');
    if (const auto mark = word.text.find_first_of(";|"); mark != word.text.npos && mark > 0) {
      std::string apart = word.text;
      std::replace(apart.begin(), apart.end(), word.text[mark], ' ');
      throw invalid(word.place, "values: " + quote(word.text) + " has " +
                                    (word.text[mark] == ';' ? "semicolons" : "bars") +
                                    " between values; expected blanks: values=\"" + apart + '"');
    }
    if (word.text.find(',') != word.text.npos && word.text.find_first_not_of("0123456789.,+-eE") == word.text.npos)
      throw invalid(word.place, "values: " + quote(word.text) +
                                    " is not a number; expected numbers with blanks between "
                                    "them, and a point in each: \"1.5 2 2.5\"");
  }
  return result;
}

MetricDeclaration metric_of(const XmlElement& element) {
  check_attributes(element, {"of", "take"});
  const XmlAttribute& of = required(element, "of");
  MetricDeclaration result{{of.value, of.value_place}, Over::end};
  const XmlAttribute* take = element.attribute("take");
  if (!take) return result;
  const Names known{"end", "mean", "least", "most"};  // in the order of Over
  const auto found = std::find(known.begin(), known.end(), take->value);
  if (found == known.end())
    throw invalid(take->value_place, "there is no take=" + quote(take->value) + "; " + suggest(take->value, known));
  result.over = static_cast<Over>(found - known.begin());
  return result;
}

void add_variation(SweepFile& sweep, Variation made) {
  for (const Variation& other : sweep.varied) {
    if (other.title() == made.title())
      throw invalid(made.place, quote(made.title()) + " is varied already at " + other.place.text() +
                                    "; expected one <vary> with all its values");
  }
  sweep.varied.push_back(std::move(made));
}

void add_metric(SweepFile& sweep, MetricDeclaration made) {
  for (const MetricDeclaration& other : sweep.metrics) {
    if (other.of.text == made.of.text && other.over == made.over)
      throw invalid(made.of.place, "the metric " + quote(made.of.text) + " stands at " + other.of.place.text() +
                                       " already; expected it once");
  }
  sweep.metrics.push_back(std::move(made));
}

void check_root(const std::string& name, const Place& place) {
  if (name != "sweep")
    throw invalid(place, "<" + name + "> is no sweep; expected <sweep world=\"...\" seeds=\"1..20\">");
}

}  // namespace

std::size_t SweepFile::combinations() const {
  std::size_t result = 1;
  for (const Variation& each : varied) result *= each.values.size();
  return result;
}

std::vector<Word> SweepFile::combination(std::size_t number) const {
  std::vector<Word> result(varied.size());
  for (std::size_t i = varied.size(); i-- > 0; number /= varied[i].values.size())
    result[i] = varied[i].values[number % varied[i].values.size()];
  return result;
}

SweepFile read_sweep(const std::filesystem::path& path) {
  const XmlElement root = read_xml(path, check_root);
  check_attributes(root, {"world", "seeds", "until"});
  SweepFile result;
  result.file = path;
  const XmlAttribute& seeds = required(root, "seeds");
  result.seeds = seeds_of(seeds);
  result.seeds_place = seeds.value_place;
  if (const auto* until = root.attribute("until")) result.until = Word{until->value, until->value_place};
  std::size_t runs = result.seeds.size();
  for (const XmlElement& child : root.children) {
    if (child.name == "vary") {
      add_variation(result, variation_of(child));
      runs *= result.varied.back().values.size();
      if (runs > most_runs) throw invalid(child.place, fmt::format("more than {} runs", most_runs));
    } else if (child.name == "metric") {
      add_metric(result, metric_of(child));
    } else {
      throw invalid(child.place,
                    "there is no element <" + child.name + "> in a sweep; " + suggest(child.name, {"vary", "metric"}));
    }
    if (!child.children.empty()) throw invalid(child.children[0].place, "<" + child.name + "> holds no other element");
  }
  const auto has_worlds = [](const Variation& each) { return each.kind == Variation::Kind::world; };
  const bool varies_world = std::any_of(result.varied.begin(), result.varied.end(), has_worlds);
  const auto* world = root.attribute("world");
  if (world && varies_world)
    throw invalid(world->place, "the world is given here and varied; expected world= or <vary worlds=\"...\"/>");
  if (!world && !varies_world) required(root, "world");
  if (world) result.world = {world->value, world->value_place};
  return result;
}

}  // namespace muster::sweep
