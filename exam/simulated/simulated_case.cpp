#include "exam/simulated/simulated_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <set>

#include "exam/case.hpp"
#include "exam/write.hpp"

namespace muster::exam::simulated {
namespace {

std::string kind_of(const Request& request, Random& random) {
  static const std::vector<std::string> usual{"clean", "one", "two"};
  return random.pick(request.kinds.empty() ? usual : request.kinds);
}

// Kinds in the order in which they are tried.
std::vector<CauseKind> candidates(const Request& request, const std::string& kind, int number) {
  std::vector<CauseKind> some;
  for (const CauseKind& k : cause_kinds())
    if (request.effects.empty() || std::count(request.effects.begin(), request.effects.end(), k.id)) some.push_back(k);
  if (kind == "each")
    std::rotate(some.begin(), some.begin() + (number - 1) % static_cast<int>(some.size()), some.end());
  else {
    // A stream of its own: a new cause changes no case without causes.
    Random random(request.seed, fmt::format("causes of simulated {}", number));
    for (std::size_t i = some.size(); i > 1; --i)
      std::swap(some[i - 1], some[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
  }
  return some;
}

// Causes that cannot be in one world, or that undo one another.
bool exclude(const PlantedCause& a, const PlantedCause& b) {
  const auto places = [](const PlantedCause& c) {
    return c.id == "label_swap" || c.id == "tx_misplaced" || c.id == "labels_shifted" || c.id == "plan_turned" ||
           c.id == "plan_shifted" || c.id == "column_shifted";
  };
  const auto scatters = [](const PlantedCause& c) {
    return c.acts == Acts::reading_law || c.acts == Acts::field_law || c.acts == Acts::blockage;
  };
  return a.id == b.id || a.id == "counted_walls" || b.id == "counted_walls" || (places(a) && places(b)) ||
         (scatters(a) && scatters(b));
}

Channel draw_channel(Random& random, bool needs_fading, bool needs_shadowing) {
  Channel c;
  const int law = needs_fading ? 2 : random.below(3);
  c.fading = law == 0 ? Channel::Fading::none : law == 1 ? Channel::Fading::multipath : Channel::Fading::per_reading;
  const bool still = !needs_shadowing && random.chance(0.15);
  c.shadowing = still ? 0 : std::round(100 * random.uniform(1, 6)) / 100;
  c.decorrelation = std::round(100 * random.uniform(1, 4)) / 100;
  c.rician_k = random.chance(0.25) ? -40 : std::round(10 * random.uniform(0, 10)) / 10;
  c.decimals = random.chance(0.5) ? 0 : 1;
  return c;
}

// The base as the world file has it, to the last digit.
void round_base(GroundTruth& site) {
  site.base.stated_l0 = std::round(10 * (site.base.tx_power - site.base.level_at_1m)) / 10;
  site.base.stated_n = std::round(100 * site.base.n) / 100;
  for (Material& m : site.plan.materials) m.loss = std::round(10 * m.loss) / 10;
}

std::string elements(const std::vector<PlantedCause>& causes, const PlantedCause* left_out = nullptr) {
  std::string out;
  for (const PlantedCause& c : causes)
    if (&c != left_out) out += c.element();
  return out;
}

Eigen::VectorXd heard_as(const Eigen::VectorXd& drawn, double step) {
  return drawn.unaryExpr([=](double v) { return std::isnan(v) ? v : std::round(v / step) * step; });
}

LinkLaw law_of(const Made& made) {
  const Channel& c = made.channel;
  return {c.shadowing, c.decorrelation,
          c.fading == Channel::Fading::none ? 0 : std::sqrt(rician_moments(c.rician_k).variance), c.step()};
}

Eigen::MatrixXd base_columns(const Made& made) {
  return made.counts_walls ? made.measured.design.leftCols(2) : made.measured.design;
}

// Mean over draws of what a cause of the receiver changes; where it leaves no reading, zero.
Eigen::VectorXd receiver_shift(const Simulator& simulator, const std::string& with, const std::string& without) {
  constexpr int draws = 16;
  Eigen::VectorXd sum, count;
  for (int i = 0; i < draws; ++i) {
    const auto seed = std::uint64_t{1000} + static_cast<std::uint64_t>(i);
    const Eigen::VectorXd difference = simulator.drawn(with, seed) - simulator.drawn(without, seed);
    if (i == 0) sum = count = Eigen::VectorXd::Zero(difference.size());
    for (Eigen::Index k = 0; k < difference.size(); ++k)
      if (!std::isnan(difference[k])) {
        sum[k] += difference[k];
        ++count[k];
      }
  }
  return (sum.array() / count.array().max(1)).matrix();
}

class Maker {
 public:
  Maker(const Request& request, Made& made)
      : request_(request),
        made_(made),
        simulator_(request.program, table(made, made.measured), walls_csv(made.site.plan)) {}

  // Draws causes, each at its size, up to `count`.
  void plant(const std::vector<CauseKind>& kinds, std::size_t count, Random& random) {
    const std::string base = world_elements(made_);
    const Setting setting = setting_now();
    for (const CauseKind& kind : kinds) {
      if (made_.causes.size() == count) return;
      auto cause = drawn_at_size(kind, setting, base, random);
      if (!cause || std::any_of(made_.causes.begin(), made_.causes.end(),
                                [&](const PlantedCause& c) { return exclude(c, *cause); }))
        continue;
      made_.causes.push_back(*cause);
    }
  }

  void hear(std::uint64_t seed) {
    const std::string truth = world_elements(made_) + elements(made_.causes);
    made_.measured.rssi = heard_as(simulator_.drawn(truth, seed), made_.channel.step());
    seed_ = seed;
  }

  void weigh() {
    const std::string base = world_elements(made_), truth = base + elements(made_.causes);
    const std::vector<char> use = unclipped();
    const LinkCovariance covariance(made_.site, made_.measured, law_of(made_), use);
    const Eigen::MatrixXd columns = base_columns(made_);
    Eigen::MatrixXd all(columns.rows(), columns.cols() + static_cast<Eigen::Index>(made_.causes.size()));
    all.leftCols(columns.cols()) = columns;
    const Eigen::VectorXd expected = simulator_.expected(truth);
    for (std::size_t k = 0; k < made_.causes.size(); ++k) {
      const std::string without = base + elements(made_.causes, &made_.causes[k]);
      all.col(columns.cols() + static_cast<Eigen::Index>(k)) =
          made_.causes[k].acts == Acts::receiver   ? receiver_shift(simulator_, truth, without)
          : made_.causes[k].acts == Acts::blockage ? blocked(truth, without)
                                                   : Eigen::VectorXd(expected - simulator_.expected(without));
    }
    const Eigen::MatrixXd white = covariance.whitened(all);
    for (std::size_t k = 0; k < made_.causes.size(); ++k) {
      const Eigen::Index own = columns.cols() + static_cast<Eigen::Index>(k);
      Eigen::MatrixXd others(white.rows(), white.cols() - 1);
      others << white.leftCols(own), white.rightCols(white.cols() - own - 1);
      made_.causes[k].lambda = lambda_of(made_.causes[k], covariance, white.col(own), all.col(own), others);
      if (made_.site.two_way) allow_the_other_way(made_.causes[k], covariance, others);
    }
  }

 private:
  Setting setting_now() const {
    const Channel& c = made_.channel;
    return {made_.site,        made_.measured, simulator_.expected(world_elements(made_)), c.shadowing,
            c.decorrelation,   c.rician_k,     c.fading == Channel::Fading::per_reading,   made_.site.two_way,
            made_.counts_walls};
  }

  // What one radio sends too much differs from what it reads too little by a loss of both its directions. Where
  // readings do not show as much of that, only the difference of the directions tells of either: no reading tells which
  // it is.
  void allow_the_other_way(PlantedCause& cause, const LinkCovariance& covariance, const Eigen::MatrixXd& others) const {
    constexpr double indistinguishable = 12;
    const bool sends = cause.id == "tx_offset";
    if (!sends && cause.id != "rx_offset") return;
    PlantedCause both{"feeder_loss"};
    both.texts = cause.texts;
    both.numbers = {{"loss", std::abs(cause.number("offset")), "dB"}};
    const std::string base = world_elements(made_);
    const Eigen::VectorXd apart = simulator_.expected(base + both.element()) - simulator_.expected(base);
    if (unexplained(covariance.whitened(apart).col(0), others) < indistinguishable)
      cause.also.emplace_back(sends ? "rx_offset" : "tx_offset");
  }

  // A place where links do not show the cause gives way to another.
  std::optional<PlantedCause> drawn_at_size(const CauseKind& kind, const Setting& setting, const std::string& base,
                                            Random& random) {
    constexpr int attempts = 10;
    const double wanted = std::exp(random.uniform(std::log(request_.least_lambda), std::log(request_.most_lambda)));
    std::optional<PlantedCause> best;
    double least_miss = std::numeric_limits<double>::infinity();
    for (int i = 0; i < attempts; ++i) {
      auto cause = kind.draw(setting, random);
      if (!cause) return {};
      cause->wanted = wanted;
      if (cause->size.empty()) return cause;
      const double lambda = size(*cause, base);
      const double miss = std::abs(std::log(std::max(lambda, 1e-9) / wanted));
      if (miss < least_miss) {
        least_miss = miss;
        best = cause;
      }
      if (miss < 0.05) break;
    }
    return best;
  }

  // Scales a cause to its wanted lambda, within its bounds; returns the lambda that it then has by itself.
  double size(PlantedCause& cause, const std::string& base) {
    if (!sizing_)
      sizing_ = std::make_unique<LinkCovariance>(made_.site, made_.measured, law_of(made_),
                                                 std::vector<char>(made_.measured.size(), 1));
    const Eigen::MatrixXd columns = base_columns(made_);
    Eigen::MatrixXd all(columns.rows(), columns.cols() + 1);
    all << columns, simulator_.expected(base + cause.element()) - simulator_.expected(base);
    const Eigen::MatrixXd white = sizing_->whitened(all);
    const double lambda = unexplained(white.rightCols(1), white.leftCols(columns.cols()));
    if (lambda <= 0) return 0;
    const double now = std::abs(cause.number(cause.size));
    const double factor = std::clamp(now * std::sqrt(cause.wanted / lambda), cause.least, cause.most) / now;
    cause.scale(factor);
    return lambda * factor * factor;
  }

  // Readings received, and not at a level at which a receiver cuts.
  std::vector<char> unclipped() const {
    std::vector<char> use = heard(made_.measured);
    for (const PlantedCause& c : made_.causes) {
      if (c.acts != Acts::receiver || c.id == "rssi_compression" || made_.causes.size() < 2)
        continue;  // compression cuts nothing off; of a bound by itself the readings at it count
      const double level = c.number("level"), step = made_.channel.step();
      for (std::size_t i = 0; i < use.size(); ++i)
        if (std::abs(made_.measured.rssi[static_cast<Eigen::Index>(i)] - level) <= step) use[i] = 0;
    }
    return use;
  }

  Eigen::VectorXd blocked(const std::string& truth, const std::string& without) const {
    Eigen::VectorXd loss = simulator_.drawn(without, seed_) - simulator_.drawn(truth, seed_);
    for (double& v : loss)
      if (std::isnan(v)) v = 0;
    return loss;
  }

  double lambda_of(const PlantedCause& cause, const LinkCovariance& covariance, const Eigen::VectorXd& white,
                   const Eigen::VectorXd& shift, const Eigen::MatrixXd& others) const {
    const LinkLaw law = law_of(made_);
    switch (cause.acts) {
      case Acts::mean:
        return unexplained(white, others);
      case Acts::receiver: {
        const bool silent = !cause.texts.empty() && cause.texts[0].second == "true";
        return unexplained(white, others) +
               (silent ? silence_lambda(setting_now(), cause.number("level"), std::hypot(law.shadowing, law.fading))
                       : 0);
      }
      case Acts::reading_law:
        return covariance.spots() * reading_divergence(cause, made_.channel.rician_k,
                                                       made_.channel.fading != Channel::Fading::none, law.step);
      case Acts::field_law: {
        LinkLaw truth = law;
        truth.shadowing = cause.number("shadowing");
        truth.decorrelation = cause.number("decorrelation");
        return covariance.field_divergence(truth);
      }
      case Acts::blockage:
        return blockage_lambda(shift, setting_now(), covariance, others, cause.number("duration"));
    }
    return 0;
  }

  const Request& request_;
  Made& made_;
  Simulator simulator_;
  std::unique_ptr<LinkCovariance> sizing_;
  std::uint64_t seed_ = 1;
};

void empty_rssi(Data& data) {
  data.rssi =
      Eigen::VectorXd::Constant(static_cast<Eigen::Index>(data.size()), std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

Made make(const Request& request, int number) {
  Random random(request.seed, fmt::format("simulated {}", number));
  Made made;
  made.name = fmt::format("case_{:04}", number);
  made.seed = random.bits();
  made.kind = kind_of(request, random);
  std::vector<CauseKind> kinds = candidates(request, made.kind, number);
  const std::size_t count = made.kind == "clean" ? 0 : made.kind == "two" ? 2 : made.kind == "three" ? 3 : 1;
  // In its world, which has no plan, nothing else can be.
  if (count > 1) std::erase_if(kinds, [](const CauseKind& kind) { return kind.id == std::string("counted_walls"); });
  SiteNeeds needs;
  for (std::size_t i = 0; i < std::min(count, kinds.size()); ++i) {
    const SiteNeeds& n = kinds[i].needs;
    needs.plan.corridor_station |= n.plan.corridor_station;
    needs.plan.high_stations |= n.plan.high_stations;
    needs.two_way |= n.two_way;
    needs.power |= n.power;
    needs.noise |= n.noise;
  }
  needs.two_way |= random.chance(0.5);
  const double rows = std::exp(random.uniform(std::log(request.least_rows), std::log(request.most_rows)));
  made.site = draw_site(made.seed, needs, static_cast<int>(rows));
  round_base(made.site);
  const bool first = count > 0 && !kinds.empty();
  made.channel = draw_channel(random, first && kinds[0].id == std::string("fading_law"),
                              first && kinds[0].id == std::string("shadowing_correlation"));
  made.counts_walls = first && kinds[0].id == std::string("counted_walls");
  for (Data* data : {&made.measured, &made.second}) {
    *data = draw_data(made.site, made.seed, data == &made.measured ? "measured" : "second");
    empty_rssi(*data);
  }
  const std::uint64_t draws = random.bits() >> 16;
  Maker maker(request, made);
  maker.plant(kinds, count, random);
  maker.hear(draws);
  // The field is that of the seed. But what is drawn by link and time, such as outliers, would be the same at the same
  // times. What changes in time stays where it is.
  const auto is_drawn = [](const PlantedCause& c) { return c.acts == Acts::reading_law || c.acts == Acts::blockage; };
  const auto is_in_time = [](const PlantedCause& c) {
    return c.id.ends_with("drift") || c.id.ends_with("step") || c.id.ends_with("periodic");
  };
  if (std::any_of(made.causes.begin(), made.causes.end(), is_drawn) &&
      std::none_of(made.causes.begin(), made.causes.end(), is_in_time))
    for (Reading& r : made.second.readings) r.t += made.site.duration();
  const Simulator second(request.program, table(made, made.second), walls_csv(made.site.plan));
  made.second.rssi = heard_as(second.drawn(world_elements(made) + elements(made.causes), draws), made.channel.step());
  maker.weigh();
  constexpr const char* words[] = {"clean", "one", "two", "three"};
  made.kind = words[made.causes.size()];
  return made;
}

}  // namespace muster::exam::simulated
