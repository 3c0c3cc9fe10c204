// Personal area networks in worlds: membership of radios, and its effects. tests/plugins/network_lrwpan/pan_test.cpp
// checks the medium. Row 24 of the requirements.
#include <gmock/gmock.h>

#include <set>

#include "world_of.hpp"

namespace muster {
namespace {

const std::string channel = "<radio.multiwall n=\"3\"/><radio.receiver sensitivity=\"-90\"/>";
const std::string network = "<network.lrwpan name=\"network\"/>\n";
const std::string four = station("a", "0 0 1") + station("b", "3 0 1") + station("c", "0 4 1") + station("d", "5 5 1");

std::string pan(const std::string& name, const std::string& id, const std::string& radios) {
  return "<radio.pan name=\"" + name + "\" id=\"" + id + "\" radios=\"" + radios + "\"/>\n";
}

// Broadcasts from each radio, and messages from a to d.
std::string everybody_sends() {
  std::string result = send("to_d", "a", "to=\"d\" size=\"300\"");
  for (const std::string radio : {"a", "b", "c", "d"}) result += send("of_" + radio, radio, "count=\"4\" size=\"60\"");
  return result;
}

// All results for senders and receivers, tick by tick.
std::vector<std::vector<double>> what_comes_of(Simulation& sim, int ticks) {
  std::vector<std::vector<double>> result;
  for (int tick = 0; tick < ticks; ++tick) {
    sim.step();
    for (const std::string table : {"inbox/*/message", "radio/*/traffic"}) {
      const TableView view = sim.table(table);
      result.emplace_back();
      for (std::size_t row = 0; row < view.rows(); ++row)
        for (std::size_t column = 0; column < 6; ++column) result.back().push_back(view.at(row, column));
    }
  }
  return result;
}

// Pairs of sender and receiver of received messages, such as "a>b".
std::set<std::string> heard(Simulation& sim, int ticks) {
  std::set<std::string> result;
  for (int tick = 0; tick < ticks; ++tick) {
    sim.step();
    const auto& names = sim.board().find_set("radio")->names;
    const TableView inbox = sim.table("inbox/*/message");
    for (std::size_t i = 0; i < inbox.rows(); ++i)
      result.insert(names[static_cast<std::size_t>(inbox.at(i, 1))] + '>' +
                    names[static_cast<std::size_t>(inbox.at(i, 0))]);
  }
  return result;
}

class PanWorld : public testing::Test {
 protected:
  Simulation world(const std::string& elements, int workers = 1) const {
    return world_of(folder, elements + channel + network, workers);
  }
  // Without the file's place, and with the text before the elements.
  std::string error_of(const std::string& elements) const {
    try {
      Simulation sim = world_of(folder, elements + four + channel + network + "<test.sender from=\"a\"/>");
    } catch (const Error& e) {
      EXPECT_EQ(e.exit(), Exit::invalid_input);
      const std::string what = e.what();
      return what.substr(what.find("world.xml"));
    }
    return "no error";
  }
  const Folder folder;
};

using testing::ElementsAre;

TEST_F(PanWorld, StationsAndRobotsAreInIt) {
  Simulation sim = world(station("base", "0 0 1") + station("a", "0 2 1") + station("b", "0 4 1") +
                         "<robot name=\"r\" at=\"1 0 0\"/><test.mover/>" + pan("ours", "2", "base r") +
                         send("1", "base") + send("2", "r") + send("3", "a") + send("4", "b", "to=\"r\""));
  EXPECT_THAT(heard(sim, 30), ElementsAre("a>b", "b>r", "base>r", "r>base"));
}

TEST_F(PanWorld, WithOneAllIsAsWithout) {
  Simulation none = world(four + everybody_sends()), one = world(four + everybody_sends() + pan("p", "3", "a b c d"));
  EXPECT_EQ(what_comes_of(none, 30), what_comes_of(one, 30));
}

TEST_F(PanWorld, NumbersDoNotMatter) {
  const auto with = [&](const std::string& pans) {
    Simulation sim = world(four + everybody_sends() + pans);
    return what_comes_of(sim, 30);
  };
  const auto expected = with(pan("p", "1", "a c") + pan("q", "2", "b d"));
  EXPECT_EQ(expected, with(pan("p", "65534", "a c") + pan("q", "17", "d b")));
  EXPECT_EQ(expected, with(pan("p", "1", "c a")));
  EXPECT_NE(expected, with(""));
}

TEST_F(PanWorld, EachCopyHasOneOutcome) {
  std::string quiet;
  for (const std::string name : {"to_d", "of_a", "of_b", "of_c", "of_d"})
    quiet += "<swap at=\"4\" instance=\"" + name + "\" plugin=\"test.sender\" from=\"a\" count=\"0\"/>\n";
  Simulation sim = world(four + everybody_sends() + pan("p", "1", "a c") + quiet);
  run(sim, 80);
  const TableView traffic = sim.table("radio/*/traffic");
  for (std::size_t row = 0; row < 4; ++row) {
    double ended = 0;
    for (std::size_t column = 1; column < traffic.cols(); ++column) ended += traffic.at(row, column);
    EXPECT_GT(traffic.at(row, 0), 450);
    EXPECT_EQ(traffic.at(row, 0), ended);
    EXPECT_GT(traffic.at(row, 3), 200) << "no link, into the other PAN";
  }
}

TEST_F(PanWorld, ARadioGoesFromOneToAnotherInMidRun) {
  Simulation sim = world(four + "<test.sender from=\"a\"/>" + pan("p", "1", "a b") + pan("q", "2", "c d") +
                         "<swap at=\"1\" instance=\"q\" plugin=\"radio.pan\" id=\"1\" radios=\"c\"/>");
  EXPECT_THAT(heard(sim, 10), ElementsAre("a>b"));
  EXPECT_THAT(heard(sim, 10), ElementsAre("a>b", "a>c"));
}

TEST_F(PanWorld, ACopyOfARadioIsInItsPan) {
  Simulation sim = world(four + "<test.sender from=\"a\"/>" + pan("p", "1", "a b") +
                         "<test.joiner radio=\"late\" like=\"b\" at=\"5\"/>");
  EXPECT_THAT(heard(sim, 20), ElementsAre("a>b", "a>late"));
}

TEST_F(PanWorld, ARunIsTheSameBitsHoweverItIsRun) {
  const std::string elements = four + everybody_sends() + pan("p", "1", "a c") + pan("q", "2", "b") +
                               "<swap at=\"2\" instance=\"q\" plugin=\"radio.pan\" id=\"1\" radios=\"b\"/>";
  expect_same_run([&](int workers) { return world(elements, workers); }, {"network", "p"}, 15);
}

TEST_F(PanWorld, WhereTheNetworkKnowsNoneItIsWarnedOf) {
  for (const std::string known : {"network.lrwpan", "network.ideal"}) {
    const Simulation sim =
        world_of(folder, four + pan("ours", "2", "a b") + everybody_sends() + channel + "<" + known + "/>\n");
    std::size_t told = 0;
    for (const auto& event : sim.events())
      told += event.message.find("ours (radio.pan): writes \"radio/") != std::string::npos;
    EXPECT_EQ(told, known == "network.ideal" ? 1u : 0u) << known;
  }
}

TEST_F(PanWorld, WhatIsDeclaredWronglyIsTold) {
  const std::string at = "world.xml:2:1: p (radio.pan): ", expected = "; expected an integer from 0 to 65534";
  EXPECT_EQ(error_of(pan("p", "65535", "a")),
            "world.xml:2:25: attribute \"id\": 65535 is out of bounds" + expected + " (macPANId)");
  EXPECT_EQ(
      error_of(pan("p", "0x1A", "a")),
      "world.xml:2:25: attribute \"id\": \"0x1A\" is not an integer; numbers are written in decimal: 26" + expected);
  EXPECT_EQ(error_of("<radio.pan radios=\"a\"/>"),
            "world.xml:2:1: <radio.pan> has no attribute \"id\", which it needs" + expected);
  EXPECT_EQ(
      error_of("<radio.pan id=\"1\" radio=\"a\"/>"),
      "world.xml:2:19: <radio.pan> has no attribute \"radio\"; expected one of name, every, library, revision, id, "
      "radios; did you mean \"radios\"?");
  EXPECT_EQ(error_of("<radio.pan id=\"1\"/>"),
            "world.xml:2:1: <radio.pan> has no attribute \"radios\", which it needs; expected a text");
  EXPECT_EQ(error_of(pan("p", "1", "a bb")),
            at + "claims a row of radio called \"bb\"; expected one of a, b, c, d; did you mean \"b\"?");
  EXPECT_EQ(error_of(pan("p", "1", " ")),
            "world.xml:2:36: attribute \"radios\": there is none; expected names of radios");
  EXPECT_EQ(error_of(pan("p", "1", "a b a")), "world.xml:2:36: attribute \"radios\": \"a\" stands there twice");
  EXPECT_EQ(
      error_of(pan("p", "1", "a,b")),
      "world.xml:2:36: attribute \"radios\": \"a,b\" has commas between its names; expected blanks: radios=\"a b\"");
  EXPECT_THAT(error_of(pan("p", "1", "a b") + pan("q", "2", "b c")),
              testing::MatchesRegex("world.xml:3:1: q .radio.pan.: writes \"radio/b/pan\"; so does .*world.xml:2:1: p "
                                    ".radio.pan.; expected one of the two"));
}

}  // namespace
}  // namespace muster
