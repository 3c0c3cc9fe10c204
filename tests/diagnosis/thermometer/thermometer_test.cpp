// The engine on a kind of measurement that is no radio: planted causes are found, clean data stay silent, and an effect
// without a cause is unexplained along its own column.
#include <gtest/gtest.h>

#include <fstream>
#include <functional>

#include "muster/random.hpp"
#include "tests/diagnosis/thermometer/thermometers.hpp"
#include "text/temporary_folder.hpp"

namespace muster::thermometers {
namespace {

constexpr int days = 4, sensors = 3;
constexpr double every = 600;  // s between samples of a thermometer

struct Truth {
  double t, humidity;
  int thermometer;
};
using Effect = std::function<double(const Truth&)>;

// Samples of three thermometers: mean, trend, day curve, an error alike over 40 minutes, and one of each reading.
std::filesystem::path made(const std::filesystem::path& folder, uint64_t seed, const Effect& effect) {
  const Stream stream(combined(key_of("thermometers"), seed));
  std::ofstream out(folder / "samples.csv");
  out << "t[s],thermometer,temperature[K],humidity\n";
  out.precision(9);
  const double kept = std::exp(-every / 2400);
  double weather = 0;  // of the humidity
  std::vector<double> error(sensors);
  for (uint64_t k = 0; k < days * 86400 / 600; ++k) {
    const double t = every * static_cast<double>(k);
    weather = 0.98 * weather + stream.normal(k, 0);
    for (int s = 0; s < sensors; ++s) {
      const auto of = static_cast<uint64_t>(s);
      double& e = error[static_cast<std::size_t>(s)];
      e = kept * e + 0.3 * std::sqrt(1 - kept * kept) * stream.normal(k, 10 + of);
      const Truth truth{t, 50 + 2 * weather, s};
      const double temperature =
          291 + 4e-6 * t + 3.5 * std::sin(2 * M_PI * t / 86400) + e + 0.1 * stream.normal(k, 20 + of) + effect(truth);
      out << t << ",t" << s << ',' << temperature << ',' << truth.humidity << '\n';
    }
  }
  std::ofstream(folder / "world.xml") << "<world name=\"room\" dt=\"1\" until=\"1\">\n  <thermometer name=\"t0\"/>\n"
                                         "  <thermometer name=\"t1\"/>\n  <thermometer name=\"t2\"/>\n"
                                         "  <room.temperature/>\n</world>\n";
  return folder / "samples.csv";
}

// The whole way: world, sensitivities, plugins as candidates, search.
inference::Result diagnosed(uint64_t seed, const Effect& effect) {
  const TemporaryFolder folder;
  const std::filesystem::path table = made(folder.path(), seed, effect), file = folder.path() / "world.xml";
  const Library::SearchPath plugins{MUSTER_THERMOMETERS};
  const Place place{file.string()};
  const InstanceDeclaration stand_in{"data.samples", "data", 1, {}, {}, {{"file", table.string(), place, place}},
                                     place};
  Options options;
  options.search_path = plugins;
  diagnosis::MeasuredWorld world(read_world(file, sets()), options,
                                 {MUSTER_SENSE, "sample/*/temperature", "sample/*/temperature", stand_in, &sets()});
  const Samples samples(TextTable::read(table));
  const auto base = diagnosis::sensitivities(world, diagnosis::free_parameters(world, {}));
  inference::Problem problem;
  problem.layout = std::make_shared<SampleLayout>(samples);
  problem.measured = samples.temperature - base.offset();
  problem.base = base.slopes;
  problem.smooths = smooths_of(samples);
  std::vector<Index> all(static_cast<std::size_t>(samples.t.size()));
  std::iota(all.begin(), all.end(), 0);
  const diagnosis::CauseSources sources{std::make_shared<diagnosis::CauseModel>(world, file, table, plugins), all};
  const auto causes = diagnosis::cause_candidates(diagnosis::causes_on(plugins), ThermometerDomain(samples), sources,
                                                  problem.base, problem.layout->rows());
  EXPECT_TRUE(causes.not_tested.empty()) << causes.not_tested[0];
  for (const diagnosis::CauseCandidate& c : causes.found) problem.candidates.push_back(c.candidate);
  inference::Options search;
  search.prior.log_decorrelation = std::log(0.7);  // h, within a factor of two
  return inference::Search(problem, search).run();
}

// Names and unexplained covariates, with their rows.
std::vector<std::string> found(const inference::Result& result) {
  std::vector<std::string> out;
  for (const inference::Finding& f : result.findings) {
    if (f.status != inference::Status::suspected) out.push_back(f.id + (f.id[0] == '~' ? "" : " " + f.label));
  }
  return out;
}

TEST(Thermometers, CleanDataAreSilent) {
  int silent = 0;
  for (uint64_t seed = 1; seed <= 12; ++seed)
    silent += found(diagnosed(seed, [](const Truth&) { return 0.0; })).empty();
  EXPECT_EQ(silent, 12);
}

TEST(Thermometers, APlantedOffsetIsNamedWithItsSize) {
  const auto result = diagnosed(21, [](const Truth& at) { return at.thermometer == 1 ? 0.6 : 0.0; });
  ASSERT_EQ(found(result), std::vector<std::string>{"cause.offset thermometer/t1"});
  EXPECT_NEAR(result.findings[0].coefficients[0], 0.6, 0.15);
}

TEST(Thermometers, APlantedStepIsNamedWithItsTime) {
  const double at = 1.7 * 86400;
  const auto result = diagnosed(22, [=](const Truth& x) { return x.t >= at ? 0.8 : 0.0; });
  ASSERT_EQ(found(result), std::vector<std::string>{"cause.step all"});
  EXPECT_NEAR(result.findings[0].theta[1], at, 3 * every);
}

TEST(Thermometers, APlantedLagIsNamedWithItsDelay) {
  const double w = 2 * M_PI / 86400, late = std::atan(w * 5400);
  const auto result = diagnosed(23, [=](const Truth& x) {
    return x.thermometer == 2 ? 3.5 * (std::cos(late) * std::sin(w * x.t - late) - std::sin(w * x.t)) : 0.0;
  });
  ASSERT_EQ(found(result), std::vector<std::string>{"cause.lag thermometer/t2"});
  EXPECT_NEAR(result.findings[0].theta[1], std::log(5400), 0.4);
}

TEST(Thermometers, AnUnknownEffectIsUnexplainedAlongItsColumn) {
  const auto result = diagnosed(24, [](const Truth& at) { return 0.25 * std::max(0.0, at.humidity - 52); });
  EXPECT_EQ(found(result), std::vector<std::string>{"~humidity"});
}

}  // namespace
}  // namespace muster::thermometers
