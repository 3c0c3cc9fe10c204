// Names of radios that slipped by some lines in the list of places.
#include <algorithm>
#include <cctype>
#include <muster/plugin.hpp>
#include <string_view>
#include <vector>

#include "link_term.hpp"
#include "standing.hpp"

namespace {

using namespace muster;

// True if one name comes before another in a list that people make: numbers by their size, node2 before node10.
bool comes_before(std::string_view a, std::string_view b) {
  const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  const auto number = [&](std::string_view& text) {
    std::size_t count = 0;
    while (count < text.size() && digit(text[count])) ++count;
    std::string_view found = text.substr(0, count);
    text.remove_prefix(count);
    while (found.size() > 1 && found.front() == '0') found.remove_prefix(1);
    return found;
  };
  while (!a.empty() && !b.empty()) {
    if (digit(a.front()) && digit(b.front())) {
      const std::string_view of_a = number(a), of_b = number(b);
      if (of_a.size() != of_b.size()) return of_a.size() < of_b.size();
      if (of_a != of_b) return of_a < of_b;
      continue;
    }
    if (a.front() != b.front()) return a.front() < b.front();
    a.remove_prefix(1);
    b.remove_prefix(1);
  }
  return a.size() < b.size();
}

struct LabelsShifted {
  static constexpr auto id = "effect.labels_shifted/3";
  static constexpr auto summary = "all radios that stand bear the name of another, some lines further on";
  static constexpr auto manual =
      "Of all radios that stand, in the world's order or that of their names, puts the first where `first` is, "
      "heading\n"
      "included, the second where the one after `first` is, and so on; after the last comes the first again. Names "
      "are\n"
      "in order as people list them, node2 before node10: a world that lists only some of the radios does not tell "
      "the\n"
      "order of all. A radio that is in the list and never heard has its line, too. Nothing changes where `first` "
      "moves.\n"
      "Radios that only the data name are in it, too: behind those of the world, in the order of the data.\n"
      "A radio stands if no robot carries it and all readings have it within 5 cm of its first place, in plan.\n"
      "A station that moves in the data is not in the list.\n"
      "Of a, b, c and d `first` b puts a where b is listed, b where c is, c where d is, and d where a is.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      reference("first", "radio", "which radio's place the first one has").required(),
      choice("order", "world|names", "of the list").with(MUSTER_EACH),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_INSTRUMENT,
      "the names of all radios that stand are shifted in the list of places: the first one is where {first} is listed, "
      "and the others follow in the order of the {order}",
      "first",
      places_in_plan,
      "effect.label_swap effect.plan_turned effect.column_shifted",
      "switch one of them off and see which falls silent",
      nullptr,
      MUSTER_FIRST | MUSTER_OWN_WORLD,
  };

  explicit LabelsShifted(Setup& s)
      : first(s.value("first")),
        order(s.value("order")),
        mount(s.read<Mount>("radio/*/mount")),
        endpoint(s.modify<Endpoint>("endpoint/*/radio")),
        pose(s.modify<Pose>("endpoint/*/pose")) {}

  void step(const Step& k) const {
    const auto before = k.before(pose);
    const auto ends = unchanged(k, endpoint);
    const auto out = k[pose];
    const Standing standing(ends, before, k[mount]);
    std::vector<std::size_t> radios = standing.radios();
    if (k[order] != 0) {
      std::stable_sort(radios.begin(), radios.end(), [&](std::size_t a, std::size_t b) {
        return comes_before(k.name("radio", a), k.name("radio", b));
      });
    }
    const auto place_of = [&](double radio) {
      return static_cast<std::size_t>(std::find(radios.begin(), radios.end(), static_cast<std::size_t>(radio)) -
                                      radios.begin());
    };
    const std::size_t by = place_of(k[first]);
    for (std::size_t i = 0; i < out.size(); ++i) {
      const bool shifts = by < radios.size() && standing(ends[i].radio);
      out[i] = shifts ? standing.place_of(radios[(place_of(ends[i].radio) + by) % radios.size()]) : before[i];
    }
  }

  Value first, order;
  In<Mount> mount;
  Stage<Endpoint> endpoint;  // unchanged: in line with other edits of either
  Stage<Pose> pose;
};

}  // namespace

MUSTER_PLUGIN_IS(LabelsShifted)
