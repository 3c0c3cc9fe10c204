#include "diagnosis/replicates/replicates.hpp"

#include <cmath>
#include <utility>

#include "text/names.hpp"
#include "text/number.hpp"

namespace muster::diagnosis {
namespace {

// A table whose rows have names and stay: others have no courses.
const Table& named_table(const Simulation& run, const std::string& name) {
  if (name.starts_with("link/"))
    throw Error(Exit::invalid_input, "--table: " + quote(name) +
                                         " is of links: radio readings are fitted without --table, "
                                         "as muster fit WORLD --data FILE");
  const TableView view = run.table(name);  // throws with the nearest name
  if (view.row >= 0 || !view.table->set().is_named())
    throw Error(Exit::invalid_input, "--table: " + quote(name) + " is " +
                                         (view.row >= 0 ? "one row" : "a table without named rows") +
                                         "; expected a table of named rows, such as \"robot/*/odometry\"");
  return *view.table;
}

Eigen::VectorXd joined(const std::vector<Eigen::VectorXd>& parts) {
  Eigen::Index size = 0;
  for (const auto& part : parts) size += part.size();
  Eigen::VectorXd result(size);
  size = 0;
  for (const auto& part : parts) result.segment(size, part.size()) = part, size += part.size();
  return result;
}

}  // namespace

Replicates::Replicates(World world, Options options, std::string table, const std::filesystem::path& data)
    : world_(std::move(world)),
      options_(std::move(options)),
      table_(std::move(table)),
      at_start_(std::make_unique<Simulation>(world_, standard(), options_)),
      recorded_(read_recorded(data, named_table(*at_start_, table_))),
      pieces_(recorded_.columns) {
  if (!options_.tables) options_.tables = std::make_shared<TableCache>();
  for (const auto& instance : at_start_->instances()) options_.libraries.push_back(instance->library());
  if (const double last = recorded_.last(); last > world_.until() + 1e-9 * world_.dt)
    throw invalid(
        {recorded_.file},
        "goes on until t = " + print_real(last) + " s, and the run ends at " + print_real(world_.until()) +
            " s; expected times from the start of the run, or " + "until=\"" + print_real(std::ceil(last)) +
            "\" in the world" +
            (last / 1000 <= 2 * world_.until() && last > 100 * world_.until() ? "; are these milliseconds?" : ""));
  world_.ticks = static_cast<uint64_t>(std::ceil(recorded_.last() / world_.dt - 1e-9));
  std::vector<Eigen::VectorXd> parts;
  for (const RecordedCourse& course : recorded_.courses) {
    parts.push_back(pieces_(course.values));
    course_of_.insert(course_of_.end(), static_cast<std::size_t>(parts.back().size()),
                      static_cast<Eigen::Index>(parts.size()));
  }
  measured_ = joined(parts);
}

bool Replicates::follows(Eigen::Index before, Eigen::Index piece) const {
  return piece - before == static_cast<Eigen::Index>(pieces_.kinds().size()) &&
         course_of_[static_cast<std::size_t>(before)] == course_of_[static_cast<std::size_t>(piece)];
}

Eigen::VectorXd Replicates::run(uint64_t seed, const std::map<std::string, double>& parameters) {
  ++runs_;
  World world = world_;
  world.seed = seed;
  Simulation run(std::move(world), standard(), options_);
  for (const auto& [path, value] : parameters) run.set_parameter(path, value);

  const std::size_t courses = recorded_.courses.size();
  std::vector<Eigen::MatrixXd> samples(courses);
  std::vector<Eigen::RowVectorXd> before(courses), now(courses);
  std::vector<std::size_t> next(courses, 0);
  for (std::size_t i = 0; i < courses; ++i) samples[i].resizeLike(recorded_.courses[i].values);
  const auto look = [&] {
    const Table& table = *run.table(table_).table;
    for (std::size_t i = 0; i < courses; ++i) {
      const RecordedCourse& course = recorded_.courses[i];
      const auto row = static_cast<std::size_t>(table.set().find(course.row));
      std::swap(before[i], now[i]);
      now[i].resize(static_cast<Eigen::Index>(recorded_.cells.size()));
      for (std::size_t c = 0; c < recorded_.cells.size(); ++c)
        now[i][static_cast<Eigen::Index>(c)] = table.now().data[row * table.width() + recorded_.cells[c]];
      for (; next[i] < course.t.size(); ++next[i]) {
        const double ahead = (run.time() - course.t[next[i]]) / world_.dt;  // ticks
        if (ahead < -1e-9) break;
        samples[i].row(static_cast<Eigen::Index>(next[i])) =
            ahead <= 1e-9 || before[i].size() == 0 ? now[i] : pieces_.between(now[i], before[i], ahead);
      }
    }
  };
  for (look(); !run.done(); look()) run.step();
  std::vector<Eigen::VectorXd> parts;
  for (const auto& each : samples) parts.push_back(pieces_(each));
  return joined(parts);
}

}  // namespace muster::diagnosis
