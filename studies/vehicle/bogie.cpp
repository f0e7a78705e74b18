#include "bogie.hpp"

#include <Simbody.h>

#include <stdexcept>

namespace railwave::vehicle {
namespace {

SimTK::Vec3 vec3(const Vector& v) { return {v[0], v[1], v[2]}; }

Vector vector(const SimTK::Vec3& v) { return {v[0], v[1], v[2]}; }

/// A body of that mass, kg, whose inertia about all axes is this, kg m2.
SimTK::Body body(double mass, double inertia = 1) {
  return SimTK::Body::Rigid(SimTK::MassProperties(mass, SimTK::Vec3(0), SimTK::Inertia(inertia)));
}

/// Moves a body that can only translate along a path that is renewed from window to window.
class AlongPath : public SimTK::Motion::Custom::Implementation {
 public:
  explicit AlongPath(const MotionPath& path) : path_(path) {}
  AlongPath* clone() const override { return new AlongPath(path_); }
  SimTK::Motion::Level getLevel(const SimTK::State&) const override { return SimTK::Motion::Position; }
  void calcPrescribedPosition(const SimTK::State& s, int, SimTK::Real* q) const override { put(s, 0, q); }
  void calcPrescribedPositionDot(const SimTK::State& s, int, SimTK::Real* q) const override { put(s, 1, q); }
  void calcPrescribedPositionDotDot(const SimTK::State& s, int, SimTK::Real* q) const override { put(s, 2, q); }

 private:
  void put(const SimTK::State& state, int order, SimTK::Real* q) const {
    const Vector value = path_.at(state.getTime(), order);
    for (int i = 0; i < 3; ++i) q[i] = value[i];
  }

  const MotionPath& path_;
};

}  // namespace

/// Axes of all bodies are those of the ground: x along the rail, z up. Origin: where the interface is at time 0.
struct Bogie::System {
  explicit System(const BogieData& the_data);

  /// Bodies and springs of what the data have; `second` is the body above.
  void spring(SimTK::MobilizedBody& first, const SimTK::Vec3& on_first, SimTK::MobilizedBody& second,
              const SimTK::Vec3& on_second, const Suspension& suspension, double load);
  void start(double speed);
  void place(SimTK::MobilizedBody& mobile, const SimTK::Vec3& displacement, const SimTK::Vec3& velocity);
  void renew_derived_values() { state.invalidateAll(SimTK::Stage::Time); }

  BogieData data;
  MotionPath path{{InterfaceMotion{}}};  ///< before the system, which refers to it
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  SimTK::GeneralForceSubsystem forces{system};
  SimTK::MobilizedBody wheelset, frame, trailing, car_body;
  std::vector<SimTK::Force::LinearBushing> springs;  ///< the first is the primary suspension of the interface
  SimTK::Vec3 frame_at_start{0};
  SimTK::State state;
};

/// @param load N that the spring carries in equilibrium, where both bodies' points would coincide
void Bogie::System::spring(SimTK::MobilizedBody& first, const SimTK::Vec3& on_first, SimTK::MobilizedBody& second,
                           const SimTK::Vec3& on_second, const Suspension& suspension, double load) {
  SimTK::Vec6 stiffness(0), damping(0);  // the first three are of rotations
  for (int i = 0; i < 3; ++i) {
    stiffness[3 + i] = suspension.stiffness[i];
    damping[3 + i] = suspension.damping[i];
  }
  const SimTK::Vec3 pressed(0, 0, load > 0 ? -load / suspension.stiffness[2] : 0);
  springs.emplace_back(forces, first, SimTK::Transform(on_first), second, SimTK::Transform(on_second + pressed),
                       stiffness, damping);
}

Bogie::System::System(const BogieData& the_data) : data(the_data) {
  const double carried = data.gravity * (data.frame_mass + data.car_body_mass);
  const double primary_load = data.has_trailing_wheelset ? carried / 2 : carried;
  const SimTK::Vec3 centre(0);
  wheelset = SimTK::MobilizedBody::Translation(matter.Ground(), SimTK::Body::Massless());
  SimTK::Motion::Custom(wheelset, new AlongPath(path));
  if (!data.has_trailing_wheelset) {
    frame = SimTK::MobilizedBody::Translation(matter.Ground(), body(data.frame_mass));
    spring(wheelset, centre, frame, centre, data.primary, primary_load);
  } else {
    // Simbody's planar joint moves in its own x and y and turns about its z, which is -y here.
    const SimTK::Transform upright(SimTK::Rotation(SimTK::Pi / 2, SimTK::XAxis));
    frame = SimTK::MobilizedBody::Planar(matter.Ground(), upright, body(data.frame_mass, data.pitch_inertia), upright);
    trailing = SimTK::MobilizedBody::Translation(matter.Ground(), body(data.trailing_mass));
    const SimTK::Vec3 half(data.wheelbase / 2, 0, 0);
    spring(wheelset, centre, frame, half, data.primary, primary_load);
    spring(trailing, centre, frame, -half, data.primary, primary_load);
    spring(matter.Ground(), centre, trailing, centre, {{0, 0, data.trailing_contact}, {}},
           primary_load + data.gravity * data.trailing_mass);
  }
  if (data.has_car_body) {
    car_body = SimTK::MobilizedBody::Translation(matter.Ground(), body(data.car_body_mass));
    spring(frame, centre, car_body, centre, data.secondary, data.gravity * data.car_body_mass);
  }
  if (data.gravity > 0) SimTK::Force::Gravity(forces, matter, -SimTK::ZAxis, data.gravity);
  system.realizeTopology();
  state = system.getDefaultState();
  start(0);
}

void Bogie::System::start(double along) {
  const SimTK::Vec3 speed(along, 0, 0);
  renew_derived_values();
  path = MotionPath({InterfaceMotion{0, {}, vector(speed)}});
  if (data.has_trailing_wheelset) {
    frame_at_start[0] = -data.wheelbase / 2;
    place(trailing, {-data.wheelbase, 0, 0}, speed);
  }
  place(frame, frame_at_start + vec3(data.start_displacement), speed + vec3(data.start_velocity));
  if (data.has_car_body) place(car_body, frame_at_start, speed);
  system.realize(state, SimTK::Stage::Time);
  system.prescribe(state);
}

void Bogie::System::place(SimTK::MobilizedBody& mobile, const SimTK::Vec3& displacement, const SimTK::Vec3& velocity) {
  const bool planar = SimTK::MobilizedBody::Planar::isInstanceOf(mobile);
  const int axis[3] = {planar ? 1 : 0, 1, 2};  // of a planar joint: angle, x, z
  for (int i = 0; i < 3; ++i) {
    if (planar && i == 1) continue;
    mobile.setOneQ(state, axis[i], displacement[i]);
    mobile.setOneU(state, axis[i], velocity[i]);
  }
}

struct BogieState::Kept {
  SimTK::State state;
  MotionPath path;
};

BogieState::BogieState() = default;
BogieState::~BogieState() = default;
BogieState::BogieState(BogieState&&) noexcept = default;
BogieState& BogieState::operator=(BogieState&&) noexcept = default;

Bogie::Bogie(const BogieData& data) : system_(std::make_unique<System>(data)) {}

Bogie::~Bogie() = default;

void Bogie::start(double speed) { system_->start(speed); }

std::vector<BogieSample> Bogie::follow(const MotionPath& path) {
  System& own = *system_;
  own.path = path;
  own.renew_derived_values();
  SimTK::RungeKuttaMersonIntegrator integrator(own.system);
  integrator.setAccuracy(1e-9);
  integrator.setAllowInterpolation(false);  // a step ends at each sample, where the path has its bends
  integrator.setReturnEveryInternalStep(false);
  integrator.setInitialStepSize(path.samples()[1].time - path.samples()[0].time);
  integrator.initialize(own.state);
  std::vector<BogieSample> samples;
  for (std::size_t k = 1; k < path.samples().size(); ++k) {
    while (integrator.getTime() < path.samples()[k].time) integrator.stepTo(path.samples()[k].time);
    own.state = integrator.getState();
    samples.push_back(sample());
  }
  return samples;
}

BogieSample Bogie::sample() const {
  const System& own = *system_;
  own.system.realize(own.state, SimTK::Stage::Dynamics);
  BogieSample now;
  now.force = vector(own.springs.front().getF_GF(own.state)[1]);
  now.frame = vector(own.frame.getBodyOriginLocation(own.state) - own.frame_at_start);
  if (own.data.has_trailing_wheelset) now.pitch = -own.frame.getOneQ(own.state, 0);
  now.energy = own.system.calcEnergy(own.state);
  for (const SimTK::Force::LinearBushing& one : own.springs) now.dissipated += one.getDissipatedEnergy(own.state);
  return now;
}

BogieState Bogie::save() const {
  BogieState state;
  state.kept_ = std::make_unique<BogieState::Kept>(BogieState::Kept{system_->state, system_->path});
  return state;
}

void Bogie::restore(const BogieState& state) {
  if (state.kept_ == nullptr) throw std::runtime_error("a state of a bogie that holds nothing cannot be restored");
  system_->path = state.kept_->path;
  system_->state = state.kept_->state;
  system_->renew_derived_values();
}

}  // namespace railwave::vehicle
