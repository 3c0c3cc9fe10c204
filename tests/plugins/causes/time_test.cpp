// Causes that are functions of time.
#include "survey.hpp"

namespace muster {
namespace {

TEST(Drift, IsSteadyByDefault) {
  expect_term("drift", "radio=\"a\" rate=\"90\" settling=\"1e6\"", [](const Reading& r) {
    return r.tx == "a" || r.rx == "a" ? -90.0 / 3600 * 1e6 * std::expm1(-r.t / 1e6) : 0;
  });
}

TEST(Drift, OfSomethingThatWarmsUpSettles) {
  expect_term("drift", "rate=\"-720\" settling=\"20\" start=\"30\"",
              [](const Reading& r) { return r.t < 30 ? 0 : -0.2 * 20 * (1 - std::exp(-(r.t - 30) / 20)); });
}

TEST(Step, HoldsFromItsTimeOn) {
  expect_term("step", "at=\"60.125\" size=\"4\"", [](const Reading& r) { return r.t >= 60.125 ? 4 : 0; });
  expect_term("step", "radio=\"s\" at=\"60.125\" size=\"4\"",
              [](const Reading& r) { return r.t >= 60.125 && (r.tx == "s" || r.rx == "s") ? 4 : 0; });
}

// What a radio sends, and nothing that it hears.
TEST(TimeOfASender, IsOnItsOwnWayAlone) {
  expect_term("tx_drift", "radio=\"a\" rate=\"90\" settling=\"1e6\"",
              [](const Reading& r) { return r.tx == "a" ? -90.0 / 3600 * 1e6 * std::expm1(-r.t / 1e6) : 0; });
  expect_term("tx_step", "radio=\"a\" at=\"60.125\" size=\"4\"",
              [](const Reading& r) { return r.tx == "a" && r.t >= 60.125 ? 4 : 0; });
  expect_term("tx_periodic", "radio=\"a\" period=\"25\" amplitude=\"3\"",
              [](const Reading& r) { return r.tx == "a" ? 3 * std::cos(2 * 3.141592653589793 / 25 * r.t) : 0; });
}

TEST(Periodic, IsHighestAtItsPhase) {
  expect_term("periodic", "radio=\"b\" period=\"25\" amplitude=\"3\" phase=\"1.25\"", [](const Reading& r) {
    return r.tx == "b" || r.rx == "b" ? 3 * std::cos(2 * 3.141592653589793 / 25 * (r.t - 25 * 1.25 / 6.283185307179586))
                                      : 0;
  });
}

}  // namespace
}  // namespace muster
