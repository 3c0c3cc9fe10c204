// Velocity step of robots in contact: stiff normal contacts, Coulomb's isotropic cone, motors with a torque limit. The
// first try is a warm start (warm_start.cpp), or all contacts stick. If it fails, friction's bound is held fixed, and
// the step minimises a convex energy; the bound is refreshed a few times until it agrees with the normal impulse.
// Developed and measured in the project's trials; the ideas: Castro, Permenter, Han 2022 (primal regularised Newton),
// Castro, Han, Masterjohn 2023 (lagged bound), Chan, Golub, Mulet 1999 (primal-dual sums of norms).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "block_cholesky.hpp"
#include "friction.hpp"
#include "mixing.hpp"

namespace muster::simbody {

// Rows that map a body's velocity to its share of a contact's: normal speed, and slip along two tangents. They are
// contiguous.
template <int N>
struct alignas(cache_line) ContactRowsOf {
  using Velocity = VelocityOf<N>;

  Velocity normal = Velocity::Zero();
  std::array<Velocity, 2> tangent{Velocity::Zero(), Velocity::Zero()};
};
static_assert(offsetof(ContactRowsOf<unknowns>, tangent) == sizeof(VelocityOf<unknowns>));
static_assert(offsetof(ContactRowsOf<unknowns_with_legs>, tangent) == sizeof(VelocityOf<unknowns_with_legs>));

template <int N>
struct ContactOf : ContactRowsOf<N> {
  ContactOf() {}  // not = default, with which emplace_back() clears it all twice

  ContactRowsOf<N> of_other;  // its sign included
  int body = 0, other = -1;   // indices of the problem's bodies; -1: a static surface
  double friction = 0;
  double softness = 0;          // [m/s per N s]
  double grip_softness = 1e-6;  // of friction: creep of a sticking contact [m/s per N s]
  double target = 0;            // normal speed below which it pushes [m/s]

  // Results, and the start of the search for a slipping step.
  double push = 0;                                 // normal impulse [N s]
  Eigen::Vector2d grip = Eigen::Vector2d::Zero();  // tangential impulse [N s]
};

constexpr double turn_arm = 0.1, rim = 0.05;  // [m]: rates as speeds, where a solver compares them

struct Motor {
  double asked = 0;        // rate of the joint [rad/s]
  double limit = 0;        // impulse: torque times step [N m s]
  double softness = 1e-4;  // of its hold on the rate; it creeps by this without external load [rad/s per N m s]

  double impulse(double rate) const { return std::clamp((asked - rate) / softness, -limit, limit); }
};

template <int N>
struct alignas(cache_line) InertiaOf {
  MassMatrixOf<N> mass, inverse;
};

template <int N>
struct alignas(cache_line) BodyOf {
  static constexpr int joints = N - 6;

  const InertiaOf<N>* inertia = nullptr;  // held by pointer: it is many times as large as all the rest
  VelocityOf<N> free;                     // without contacts and motors
  VelocityOf<N> previous;                 // start of the search for a slipping step
  std::array<Motor, joints> motors;

  VelocityOf<N> velocity;  // the result
};

// Method and tolerances of the search.
struct Search {
  double tolerance = 1e-7;        // of the residual as a velocity [m/s]
  double bound_tolerance = 1e-3;  // of friction's bound, relative to the largest
  int passes = 12;                // that refresh the bounds
  // The first try.
  enum class First {
    all_sticks = 1,
    as_before,  // warm start: each contact keeps its mode from the last step
  } first = First::all_sticks;
  bool together = false;  // for many robots: motors at their limit are searched for like friction. Set where a search
                          // without it fails.
};

template <int N>
struct ProblemOf {
  std::vector<BodyOf<N>> bodies;
  std::vector<ContactOf<N>> contacts;
  Search search;
};

struct Outcome {
  bool direct = false;    // the first try succeeded
  bool converged = true;  // the bounds of friction agreed with the normal impulses
  bool minimised = true;  // the energy of the last bounds is at its minimum
};

template <int N>
class ContactSolverOf {
 public:
  using Contact = ContactOf<N>;
  using Problem = ProblemOf<N>;

  // Solves the step and leaves velocities in the problem's bodies, impulses in its contacts.
  Outcome solve(Problem& problem);

 private:
  using Velocity = VelocityOf<N>;
  using Velocities = Blocks<Velocity>;
  static constexpr int joints = N - 6;

  // Mode of a contact in a first try.
  enum class ContactMode { open = 1, smooth, sticks, slides };
  enum class MotorHabit { holds = 1, pulls, brakes };  // at its limit, forwards or backwards

  // A contact at some velocity, its friction limited by `bound`; Newton's method has its own form, in lanes.
  struct Local {
    std::array<double, 3> speeds;                    // normal, tangential
    double bound = 0;                                // [N s]
    Eigen::Vector2d dual = Eigen::Vector2d::Zero();  // estimate of the friction impulse
    bool closes = false;                             // in a guess
    ContactMode habit = ContactMode::open;
    Eigen::Vector2d way = Eigen::Vector2d::Zero();  // unit direction of a sliding contact's friction
    double stiffness = 0;                           // against changes of that direction [N s per m/s]
    double start_push = 0;                          // as handed in
    Eigen::Vector2d start_grip = Eigen::Vector2d::Zero();

    double speed() const { return speeds[0]; }
    Eigen::Vector2d slip() const { return {speeds[1], speeds[2]}; }
  };

  void begin();
  void obey_impulses();
  void locate(const Velocities& u);
  void obey_law();
  void begin_gradient();
  void end_gradient();
  double residual() const;
  bool stick_all();
  void stick();
  bool go_on();
  void begin_as_before();
  bool see_habits();
  int number_that_slide() const;
  bool see_motor_habits();
  void factor_habits();
  void step_by_habits();
  Eigen::Vector2d grip_by_habit(std::size_t contact) const;
  static Eigen::Vector2d sliding_grip(const Local& at);
  void note_grips();
  Eigen::Vector2d pull(std::size_t contact) const;
  double weight(std::size_t contact) const;
  void slip(Outcome& outcome);
  void fill_lanes();
  int lane_count() const { return static_cast<int>(lanes_.size()); }
  ContactTable table() const;
  void set_dual(std::size_t contact, const Eigen::Vector2d& dual);
  void refresh_bounds(int pass);
  bool minimise(int limit);
  void respond();
  void set_hessian();
  void look_ahead();
  void move_duals();
  double slope(double a) const;
  double line_search() const;
  double motor_stiffness(std::size_t body, int m) const;
  void begin_hessian();
  void add(const Contact& c, double normal, const GripStiffness& grip);
  void add_run(const Contact& c, int count, const double* const* own, const double* const* others,
               const double* stiffness);
  void speeds_of(const Contact& c, const Velocities& u, std::array<double, 3>& speeds) const;
  void take_impulse(const Contact& c, Velocities& momenta) const;

  Problem* p_ = nullptr;
  std::vector<Local> local_;
  std::vector<ContactLanes> lanes_;
  std::vector<int> bodies_;                              // two of each contact
  std::vector<std::array<double, joints>> motor_duals_;  // estimates of the motors' impulses [N m s]
  std::vector<std::pair<int, int>> pairs_;
  std::vector<std::array<MotorHabit, joints>> motor_habits_;
  BlockCholeskyOf<N> hessian_;
  MixingOf<N> mixing_;
  const BlockArithmetic<N>& blocks_ = block_arithmetic<N>();
  const LaneArithmetic& in_lanes_ = lane_arithmetic();
  double slope_of_motion_ = 0, curve_of_motion_ = 0;
  Velocities u_, gradient_, d_;  // d_: the direction of a search
};

using ContactRows = ContactRowsOf<unknowns>;
using Contact = ContactOf<unknowns>;
using Inertia = InertiaOf<unknowns>;
using Body = BodyOf<unknowns>;
using Problem = ProblemOf<unknowns>;
using ContactSolver = ContactSolverOf<unknowns>;

}  // namespace muster::simbody
