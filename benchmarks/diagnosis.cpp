// Measures the cost of a diagnosis. Limits: 2 s of search and 10 s in all at 20,000 readings, a minute and 4 GB at
// 100,000. The counter of_limit is the share used.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>

#include "diagnosis/inference/assess/search.hpp"
#include "diagnosis/pipeline/diagnose.hpp"
#include "diagnosis/pipeline/setup.hpp"
#include "text/number.hpp"
#include "text/temporary_folder.hpp"

namespace {

using namespace muster;

const Library::SearchPath plugins = {MUSTER_PLUGINS_DIR};
const std::filesystem::path hall = std::filesystem::path(MUSTER_SOURCE_DIR) / "worlds" / "hall";

// The hall's tour, driven that often, with what a wall of 9 dB leaves of it and Rayleigh fading.
class Tours {
 public:
  explicit Tours(int count) {
    const diagnosis::Dataset data = diagnosis::read_dataset(hall / "measured.csv");
    diagnosis::LinkModel model(hall, hall / "measured.csv", plugins);
    const double duration = data.t.back() + 10;  // s
    std::ofstream out(file(), std::ios::binary);
    out << "t[s],tx,rx,tx_x[m],tx_y[m],tx_z[m],rx_x[m],rx_y[m],rx_z[m],rx_yaw[rad],rssi[dBm]\n";
    for (int tour = 0; tour < count; ++tour) {
      for (std::size_t row = 0; row < data.rows(); ++row) {
        const auto& [tx, rx] = model.ends()[row];
        out << print_real(data.t[row] + tour * duration) << ",base,rover";
        for (const double v : {tx.x, tx.y, tx.z, rx.x, rx.y, rx.z, rx.yaw}) out << ',' << print_real(v);
        // A tour in the other order takes its readings' errors from other places.
        const std::size_t other = (row + static_cast<std::size_t>(tour) * 4001) % data.rows();
        const auto at = [&](std::size_t k) { return model.expected()[static_cast<Eigen::Index>(k)] - wall(k, model); };
        out << ',' << print_real(at(row) + data.rssi[other] - at(other)) << '\n';
      }
    }
    if (!out.flush()) throw std::runtime_error("cannot be written: " + file().string());
  }

  std::filesystem::path file() const { return folder_.path() / "tours.csv"; }

 private:
  // What the hall hides (worlds/hall/generate/hidden.hpp), without its soft ends.
  static double wall(std::size_t row, const diagnosis::LinkModel& model) {
    const auto& [tx, rx] = model.ends()[row];
    constexpr double y = 1.55;
    if ((tx.y - y) * (rx.y - y) >= 0) return 0;
    const double x = tx.x + (rx.x - tx.x) * (y - tx.y) / (rx.y - tx.y);
    return x > 2.6 && x < 5.4 ? 9 : 0;
  }

  TemporaryFolder folder_;
};

void require_the_wall(const std::string& id) {
  if (id != "effect.unmapped_wall" && id != "effect.obstacle") throw std::logic_error("found " + id);
}

void finish(benchmark::State& state, double limit) {
  state.counters["of_limit"] = benchmark::Counter(static_cast<double>(state.iterations()) * limit,
                                                  benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void search_of_all_causes(benchmark::State& state) {
  const Tours tours(static_cast<int>(state.range(0)));
  const diagnosis::Prepared at(hall, tours.file(), plugins);
  for (auto _ : state) {
    inference::Search search(at.problem, at.options);
    require_the_wall(search.run().findings.at(0).id);
  }
  finish(state, state.range(0) == 1 ? 2 : 60);
}
BENCHMARK(search_of_all_causes)->Arg(1)->Arg(5)->Unit(benchmark::kSecond)->Iterations(1)->MeasureProcessCPUTime();

void whole_diagnosis(benchmark::State& state) {
  const Tours tours(static_cast<int>(state.range(0)));
  for (auto _ : state) require_the_wall(diagnosis::diagnose(hall, tours.file(), plugins).causes.at(0).id);
  finish(state, state.range(0) == 1 ? 10 : 60);
}
BENCHMARK(whole_diagnosis)->Arg(1)->Arg(5)->Unit(benchmark::kSecond)->Iterations(1)->MeasureProcessCPUTime();

}  // namespace

BENCHMARK_MAIN();
