// A descriptor with a fault in one place is refused with that place's name.
#include "loader/registration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "loader/elf.hpp"

namespace muster {
namespace {

// Descriptors that the library under test registers; muster_register is a plain function and takes no captures.
std::vector<const muster_plugin*> given;
int answer = MUSTER_OK;

int register_given(uint32_t, void* registry, muster_add add) {
  int result = answer;
  for (const muster_plugin* plugin : given) result |= add(registry, plugin);
  return result;
}

struct Sample {
  muster_param param{"n", MUSTER_REAL, MUSTER_FREE, 2, 1, 6, "", "decay exponent", nullptr};
  muster_plugin plugin{sizeof(muster_plugin),
                       MUSTER_RADIO,
                       "radio.sample/3",
                       "a sample",
                       nullptr,
                       &param,
                       1,
                       nullptr,
                       [](const muster_host*) -> void* { return nullptr; },
                       [](void*) {},
                       [](void*, const muster_tick*, const muster_in*, const muster_out*) { return 0; },
                       nullptr,
                       nullptr,
                       nullptr,
                       nullptr,
                       nullptr};
};

std::string refusal() {
  try {
    registered_plugins(register_given);
  } catch (const Refusal& refusal) {
    return refusal.what();
  }
  return "";
}

std::string refusal_of(const std::function<void(muster_plugin&)>& spoil) {
  Sample sample;
  spoil(sample.plugin);
  given = {&sample.plugin};
  answer = MUSTER_OK;
  return refusal();
}

std::string refusal_of_param(const std::function<void(muster_param&)>& spoil) {
  Sample sample;
  spoil(sample.param);
  given = {&sample.plugin};
  answer = MUSTER_OK;
  const std::string words = refusal();
  const std::string before = "registers \"radio.sample/3\" whose parameter \"n\" ";
  return words.starts_with(before) ? words.substr(before.size()) : words;
}

TEST(Registration, TakesAGoodDescriptorApart) {
  EXPECT_EQ(refusal_of([](muster_plugin&) {}), "");
  EXPECT_EQ(parse_plugin_id("radio.sample/12").id, "radio.sample");
  EXPECT_EQ(parse_plugin_id("radio.sample/12").revision, 12u);
  for (const char* bad : {"", "radio", "radio/", "radio/0", "radio/01", "radio/-1", "radio/1x", "Radio/1", "radio./1",
                          ".x/1", "radio sample/1", "radio.1x/1", "radio/4294967296"})
    EXPECT_EQ(parse_plugin_id(bad).revision, 0u) << bad;
}

TEST(Registration, RefusesBadDescriptors) {
  EXPECT_EQ(refusal_of([](auto& p) { p.size = 8; }), "registers a descriptor of 8 bytes; expected at least " +
                                                         std::to_string(offsetof(muster_plugin, cause)) +
                                                         "; rebuild it against plugin_api");
  EXPECT_EQ(refusal_of([](auto& p) { p.id = nullptr; }),
            "registers the id \"\"; expected one like \"radio.multiwall/1\"");
  EXPECT_EQ(refusal_of([](auto& p) { p.id = "radio"; }),
            "registers the id \"radio\", without a revision; expected \"radio/1\"");
  EXPECT_EQ(refusal_of([](auto& p) { p.id = "Radio/x"; }),
            "registers the id \"Radio/x\"; expected one like \"radio.multiwall/1\"");
  EXPECT_EQ(refusal_of([](auto& p) { p.id = "radio.sample"; }),
            "registers the id \"radio.sample\", without a revision; expected \"radio.sample/1\"");
  EXPECT_EQ(refusal_of([](auto& p) { p.phase = 0; }), "registers \"radio.sample/3\" in phase 0; expected 1 to 7");
  EXPECT_EQ(refusal_of([](auto& p) { p.phase = 8; }), "registers \"radio.sample/3\" in phase 8; expected 1 to 7");
  EXPECT_EQ(refusal_of([](auto& p) { p.summary = nullptr; }), "registers \"radio.sample/3\" without a summary");
  EXPECT_EQ(refusal_of([](auto& p) { p.create = nullptr; }), "registers \"radio.sample/3\" without create");
  EXPECT_EQ(refusal_of([](auto& p) { p.destroy = nullptr; }), "registers \"radio.sample/3\" without destroy");
  EXPECT_EQ(refusal_of([](auto& p) { p.step = nullptr; }), "registers \"radio.sample/3\" without step");
  EXPECT_EQ(refusal_of([](auto& p) { p.params = nullptr; }), "registers \"radio.sample/3\" without its parameters");
}

TEST(Registration, RefusesBadSetsOfDescriptors) {
  Sample a, b;
  given = {};
  EXPECT_EQ(refusal(), "registers no plugin");
  answer = 7;
  EXPECT_EQ(refusal(), "refuses to register: muster_register returned 7");
  answer = MUSTER_OK;
  given = {nullptr};
  EXPECT_EQ(refusal(), "registers nothing");
  given = {&a.plugin, &b.plugin};
  EXPECT_EQ(refusal(), "registers \"radio.sample/3\" twice");
  b.plugin.id = "radio.other/1";
  EXPECT_EQ(refusal(), "registers \"radio.sample/3\" and \"radio.other/1\"; expected one id a library");
}

TEST(Registration, ReadsALongerDescriptorOfALaterHeader) {
  struct Later {
    muster_plugin plugin;
    double more = 1;
  } later{Sample().plugin};
  later.plugin.size = sizeof later;
  later.plugin.param_count = 0;
  given = {&later.plugin};
  answer = MUSTER_OK;
  EXPECT_EQ(registered_plugins(register_given)[0].size, sizeof(muster_plugin));
}

TEST(Registration, RefusesBadNumbers) {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
  const std::string order = "; expected the order real(name, default, least, most, unit, help)";
  EXPECT_EQ(refusal_of_param([](auto& p) { p.value = 7; }), "has the default 7, which is not in 1 to 6" + order);
  EXPECT_EQ(refusal_of_param([&](auto& p) { p.value = nan; }), "has the default nan, which is not in 1 to 6" + order);
  EXPECT_EQ(refusal_of_param([](auto& p) { p.min = 9; }),
            "has the default 2 and bounds from 9 to 6; expected the least first, in the order real(name, default, "
            "least, most, unit, help)");
  EXPECT_EQ(refusal_of_param([](auto& p) { p.kind = MUSTER_INTEGER, p.max = 0; }),
            "has the default 2 and bounds from 1 to 0; expected the least first, in the order integer(name, default, "
            "least, most, help)");
  EXPECT_EQ(refusal_of_param([&](auto& p) { p.max = nan; }),
            "has the default 2 and bounds from 1 to nan; expected the least first, in the order real(name, default, "
            "least, most, unit, help)");
  EXPECT_EQ(refusal_of_param([&](auto& p) { p.max = inf; }),
            "is free for a fit, which needs finite bounds; it has 1 to inf");
  EXPECT_EQ(refusal_of_param([&](auto& p) { p.max = inf, p.flags = 0; }), "");
  EXPECT_EQ(refusal_of_param([](auto& p) { p.value = 7, p.flags = MUSTER_REQUIRED; }), "");
  EXPECT_EQ(refusal_of_param([](auto& p) { p.kind = MUSTER_INTEGER, p.value = 2.5; }),
            "is an integer with default 2.5");
  EXPECT_EQ(refusal_of_param([](auto& p) { p.kind = MUSTER_FLAG; }), "is a flag with default 2");
}

TEST(Registration, RefusesACauseWhoseSentenceOrRowIsOfNoParameter) {
  const auto refused = [](const char* title, const char* ranges_over = "") {
    static muster_cause cause;
    cause = {sizeof(muster_cause), MUSTER_TERM, title, ranges_over, "", "", "", nullptr, 0};
    return refusal_of([](muster_plugin& plugin) { plugin.cause = &cause; });
  };
  const std::string begin = "registers \"radio.sample/3\" whose cause ";
  EXPECT_EQ(refused("the exponent is {n}, and {n|too high|too low}"), "");
  EXPECT_EQ(refused("the exponent is {m}"), begin +
                                                "has the title \"the exponent is {m}\", in which {m} is no parameter; "
                                                "expected n");
  EXPECT_EQ(refused("the exponent is {n"), begin + "has the title \"the exponent is {n\", with a { that no } ends");
  EXPECT_EQ(refused("{n|high}"), begin +
                                     "has the title \"{n|high}\", in which {n|high} has 1 words for the sign; expected "
                                     "{n|if positive|if negative}");
  EXPECT_EQ(refused("of {n}", "a b"),
            begin + "names \"a\" as its ranges_over, which is not a reference of the plugin; it has none");
  EXPECT_EQ(refused("of {n}", "radio"),
            begin + "names \"radio\" as its ranges_over, which is not a reference of the plugin; it has none");
}

TEST(Registration, RefusesBadDeclarations) {
  EXPECT_EQ(refusal_of_param([](auto& p) { p.kind = 0; }), "has the unknown kind 0");
  EXPECT_EQ(refusal_of_param([](auto& p) { p.kind = 8; }), "has the unknown kind 8");
  EXPECT_EQ(refusal_of_param([](auto& p) { p.flags = 256; }), "has unknown flags 0x100");
  EXPECT_EQ(refusal_of_param([](auto& p) { p.flags = MUSTER_EACH; }),
            "is to be tried at each of its values; expected a choice or an integer");
  EXPECT_EQ(refusal_of_param([](auto& p) { p.unit = nullptr; }), "has no unit; expected \"\" where there is none");
  EXPECT_EQ(refusal_of_param([](auto& p) { p.help = ""; }), "has no help");
  EXPECT_EQ(refusal_of_param([](auto& p) { p.name = "N"; }),
            "registers \"radio.sample/3\" with a parameter \"N\"; expected a name of a-z, 0-9 and _");
  EXPECT_EQ(refusal_of_param([](auto& p) { p.name = "every"; }),
            "registers \"radio.sample/3\" whose parameter \"every\" bears a reserved name; reserved are name, every, "
            "library, "
            "revision");
  EXPECT_EQ(refusal_of_param([](auto& p) { p.kind = MUSTER_REFERENCE; }), "refers to a row of no set");
  const auto choice = [](const char* text) {
    return refusal_of_param([text](auto& p) { p.kind = MUSTER_CHOICE, p.text = text; });
  };
  EXPECT_EQ(choice("a|b|c"), "");
  EXPECT_EQ(choice(nullptr), "has no choices");
  EXPECT_EQ(choice("a||c"), "has an empty choice in \"a||c\"");
  EXPECT_EQ(choice("a|b|a"), "has a choice twice in \"a|b|a\"");
  EXPECT_EQ(choice("slow,fast"), "has one choice, \"slow,fast\"; expected them with | between, such as \"slow|fast\"");
  EXPECT_EQ(choice("a|b"), "has the default 2, which is no place in \"a|b\"");
}

TEST(Registration, RefusesAParameterTwice) {
  Sample sample;
  const muster_param twice[] = {sample.param, sample.param};
  sample.plugin.params = twice;
  sample.plugin.param_count = 2;
  given = {&sample.plugin};
  answer = MUSTER_OK;
  EXPECT_EQ(refusal(),
            "registers \"radio.sample/3\" with the parameter \"n\" twice; expected another name for the one of \"" +
                std::string(sample.param.help ? sample.param.help : "") + '"');
}

muster_law sample_law() {
  static const double grid[] = {1, 2};
  const auto density = [](const double*, uint32_t, const double*, uint32_t, double*) {};
  return {sizeof(muster_law), 0, "n", grid, nullptr, nullptr, 2, 0, 1, density, nullptr, nullptr, nullptr};
}

std::string refusal_of_law(const std::function<void(muster_law&)>& spoil) {
  muster_law law = sample_law();
  spoil(law);
  const std::string words = refusal_of([&](muster_plugin& p) { p.law = &law; });
  const std::string start = "registers \"radio.sample/3\" whose law ";
  return words.rfind(start, 0) == 0 ? words.substr(start.size()) : words;
}

TEST(Registration, RefusesLawsThatNoDiagnosisCanFit) {
  EXPECT_EQ(refusal_of_law([](auto&) {}), "");
  EXPECT_EQ(refusal_of_law([](auto& l) { l.strength = "m"; }),
            "names \"m\" as its strength, which is not a real parameter of the plugin; expected n");
  EXPECT_EQ(refusal_of_law([](auto& l) { l.strength = nullptr; }), "names no parameter as its strength");
  EXPECT_EQ(refusal_of_law([](auto& l) { l.log_density = nullptr; }), "has no density");
  EXPECT_EQ(refusal_of_law([](auto& l) { l.grid = nullptr; }), "has no values of its strength");
  EXPECT_EQ(refusal_of_law([](auto& l) { l.grid = nullptr, l.flags = MUSTER_REPLACES; }), "");
  EXPECT_EQ(refusal_of_law([](auto& l) { l.flags = 2; }), "has unknown flags 0x2");
  EXPECT_EQ(refusal_of_law([](auto& l) { l.most_draws = 0; }),
            "has a density of no draws; expected most_draws of at least 1");
  static const double falling[] = {2, 1};
  EXPECT_EQ(refusal_of_law([](auto& l) { l.grid = falling; }),
            "has 1 as value 2 of its strength; expected positive values that grow");
  EXPECT_EQ(refusal_of_law([](auto& l) { l.form = "n"; }), "has no values of its form");
  EXPECT_EQ(
      refusal_of_law([](auto& l) { l.size = 40; }),
      "has 40 bytes; expected at least " + std::to_string(sizeof(muster_law)) + "; rebuild it against plugin_api");
}

TEST(Registration, RefusesClipsAndBurstsOfUndeclaredParameters) {
  muster_clip clip{sizeof(muster_clip), MUSTER_ABOVE, "n", 0, nullptr};
  const auto clipped = [&] { return refusal_of([&](muster_plugin& p) { p.clip = &clip; }); };
  EXPECT_EQ(clipped(), "");
  clip.choice = "n";
  EXPECT_EQ(clipped(),
            "registers \"radio.sample/3\" whose clip names \"n\" as its choice, which is not a flag of the plugin; it "
            "has none");
  clip.level = "levle";
  EXPECT_EQ(clipped(),
            "registers \"radio.sample/3\" whose clip names \"levle\" as its level, which is not a real parameter of "
            "the plugin; expected n");
  clip.side = 3;
  EXPECT_EQ(clipped(), "registers \"radio.sample/3\" whose clip has the side 3; expected MUSTER_ABOVE or MUSTER_BELOW");
  const muster_burst burst{sizeof(muster_burst), "n", "n", "n", "n", "n"};
  EXPECT_EQ(refusal_of([&](muster_plugin& p) { p.burst = &burst; }),
            "registers \"radio.sample/3\" whose burst names \"n\" as its radio, which is not a reference of the "
            "plugin; it has none");
}

// As of a library that was built before the field was there.
TEST(Registration, AShorterDescriptorDeclaresNoLaw) {
  const muster_law law = sample_law();
  Sample sample;
  sample.plugin.law = &law;
  given = {&sample.plugin};
  answer = MUSTER_OK;
  EXPECT_EQ(registered_plugins(register_given).front().law, &law);
  sample.plugin.size = offsetof(muster_plugin, law);
  EXPECT_EQ(registered_plugins(register_given).front().law, nullptr);
}

}  // namespace
}  // namespace muster
