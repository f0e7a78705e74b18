#include "solve/step_recording.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <tuple>
#include <utility>

#include "kernels/support/milestone.hpp"
#include "model/boundaries/prescribed_nodes.hpp"
#include "model/elements/relative_coordinates.hpp"
#include "solve/launch_graph.hpp"
#include "solve/ranks/row_exchange.hpp"
#include "solve/step_values.hpp"

namespace railwave {

#ifdef RAILWAVE_LAUNCH_GRAPHS

namespace {

/// A graph of so many steps makes what is launched before each, and the gap there, a hundredth of its time.
constexpr int default_steps = 16;

/// The same of the first graph after a device has waited for its host: it takes the less to launch the smaller it is,
/// and the next one is launched meanwhile.
constexpr long steps_of_first = 4;

/// Steps of the largest graph: RAILWAVE_STEP_GRAPHS; 0, with which all steps are plain, also where a tool listens, as
/// it would not see launches within graphs, and where rows of other ranks go through the host.
int most_steps(const RowExchange* exchange) {
  if (Kokkos::Profiling::profileLibraryLoaded() || (exchange != nullptr && !exchange->between_devices())) return 0;
  const char* chosen = std::getenv("RAILWAVE_STEP_GRAPHS");
  return chosen != nullptr ? std::clamp(std::atoi(chosen), 0, 64) : default_steps;
}

}  // namespace

struct StepRecording::Recordings {
  /// What launches depend on besides the time.
  using State = std::vector<double>;
  /// Phase of the cycle of subcycling, step of the frames' block, steps, whether a rare task is due at the first.
  using Key = std::tuple<long, long, long, bool>;

  Recordings(Model& the_model, const Plan& plan, LaunchOrder& of_launches, RowExchange* of_ranks)
      : model(the_model),
        exchange(of_ranks),
        elements_alone(of_ranks != nullptr && of_ranks->transport().rank() > 0),
        contacts(elements_alone ? no_contacts : model.contacts),
        order(of_launches),
        most(most_steps(of_ranks)),
        load_values(elements_alone ? 0 : static_cast<int>(model.loads.size()), std::max(1, most)),
        places(elements_alone ? 0 : static_cast<int>(model.prescribed.size()), std::max(1, most)) {
    for (const std::vector<Task>* tasks : {&plan.forces, &plan.motion})
      for (const Task& task : *tasks) {
        (task.recordable ? recordable : plain).push_back(task);
        if (task.recordable && task.every > model.subcycling.cycle()) rare.push_back(task);
        crowded = crowded || (task.recordable && task.bulk);
        in_parts = in_parts || task.part > 0;
      }
  }

  /// @param step s, which another rank than 0 has by its order alone
  State state(double step) const {
    State now{step};
    for (const ContactPair& pair : contacts) now.push_back(pair.window.bound());
    return now;
  }

  /// Whether tasks that are not recorded may launch something at this step.
  bool plain_due() const {
    for (const ContactPair& pair : contacts)
      if (model.step >= pair.next_check || model.step >= pair.next_near_check) return true;
    return model.relative.active();
  }

  void run_plain(const Instant& instant) const {
    Instant here = instant;
    here.own_space = order.own_space();
    const auto launch = [&] { run_tasks(plain, here, model.step); };
    if (exchange != nullptr)
      exchange->in_order(launch);
    else
      launch();
  }

  /// For the device. For one that waits for another rank's rows that has no end.
  void wait() const {
    if (exchange != nullptr) exchange->wait_for_rows();
    order.space().fence();
  }

  /// Whether a task is due at a step that comes less often than subcycling's cycle.
  bool rare_due(long step) const {
    return std::any_of(rare.begin(), rare.end(), [step](const Task& task) { return task.due(step); });
  }

  /// Before launches in the default space.
  void finish(bool then_idle) {
    order.leave();
    idle = then_idle;
  }

  long frame_step() const { return model.relative.active() ? model.step - model.relative.block_step : 0; }

  /// Steps for one graph: a power of two that begins at a multiple of itself within a block of frames and a cycle of
  /// subcycling, with rare tasks at its first step only, so that few graphs do for all.
  long steps_of_graph(long quiet) const {
    for (const ContactPair& pair : contacts)
      quiet = std::min({quiet, pair.next_check - model.step, pair.next_near_check - model.step});
    for (const Task& task : rare) {
      const long since = (model.step + task.every - task.at) % task.every;
      quiet = std::min(quiet, task.every - since);
    }
    const long frame = frame_step(), cycle = model.subcycling.cycle();
    if (model.relative.active()) quiet = std::min(quiet, steps_of_block - frame);
    long steps = 1;
    while (2 * steps <= std::min<long>(quiet, most) && frame % (2 * steps) == 0 &&
           model.step % std::min(2 * steps, cycle) == 0)
      steps *= 2;
    // Of the 64 steps between two checks for near nodes the first may come by itself. The last are one graph, not four.
    return quiet == most - 1 && cycle == 1 && !model.relative.active() ? quiet : steps;
  }

  /// Where elements fill the device, in parts or not: the later part last.
  int urgency(const Task& task) const {
    if (!crowded) return 0;
    if (!task.bulk) return 2;
    return in_parts && task.stage == Stage::own_forces && task.part == 0 ? 1 : 0;
  }

  /// Whether elements of a later part would find room beside the first, which others wait for, and slow it.
  static bool leaves_room(const Task& task) { return task.part > 0 && !task.bulk; }

  /// What the next step begins after.
  struct Ends {
    LaunchGraph::Node tasks;       ///< for all but elements
    LaunchGraph::Node all;         ///< for elements
    LaunchGraph::Node own_forces;  ///< for nothing but what changes the values of loads
  };

  void run_recordable(const Instant& instant) const {
    for (const Task& task : recordable)
      if (task.due(model.step)) task.run(instant);
  }

  /// A stage's lanes begin when all lanes of the stage before are done. Where elements come in parts, what concerns the
  /// first part's nodes goes on beside the second, and loads and contact of the next step beside the second part and
  /// its nodes, of which they read none. A second part that finds room beside the first waits for it. In a space of its
  /// own one task comes after the other: what the others of that device launch fills it, and a graph with lanes takes
  /// the host 20 times as long to launch.
  Ends record_step(LaunchGraph& graph, Ends ready, const Instant& instant) const {
    if (order.own()) {
      ready.tasks = graph.after(ready.tasks, 0, [this, &instant] { run_recordable(instant); });
      return {ready.tasks, ready.tasks, ready.tasks};
    }
    LaunchGraph::Node own_forces = ready.all, elements = ready.all, beside_loads = ready.all;
    std::vector<const Task*> apart;
    for (std::size_t first = 0, end = 0; first < recordable.size(); first = end) {
      const Stage stage = recordable[first].stage;
      std::map<int, std::vector<const Task*>> lanes;
      for (; end < recordable.size() && recordable[end].stage == stage; ++end) {
        const Task& task = recordable[end];
        if (!task.due(model.step)) continue;
        if (task.apart())
          apart.push_back(&task);
        else
          lanes[task.lane].push_back(&task);
      }
      if (lanes.empty()) continue;
      const bool of_forces = stage == Stage::own_forces;
      std::map<int, LaunchGraph::Node> done;
      std::vector<LaunchGraph::Node> ends, all_ends, element_ends, unloaded_ends;
      bool all_in_order = true;
      for (const auto& [lane, tasks] : lanes) {
        const bool of_elements = of_forces && lane >= OwnForceLanes::elements;
        const bool after_first = of_elements && leaves_room(*tasks.front()) && !element_ends.empty();
        const LaunchGraph::Node begin = after_first                                ? LaunchGraph::joined(element_ends)
                                        : of_elements || stage < Stage::own_forces ? ready.all
                                                                                   : ready.tasks;
        const LaunchGraph::Node last = record_lane(graph, {begin, beside_loads}, tasks, done, instant);
        done.emplace(lane, last);
        all_ends.push_back(last);
        if (tasks.front()->part == 0) ends.push_back(last);
        if (of_elements) element_ends.push_back(last);
        if (of_forces && lane >= OwnForceLanes::contact && tasks.front()->part == 0) unloaded_ends.push_back(last);
        all_in_order = all_in_order && tasks.back()->begins == Begins::in_order;
      }
      if (!all_in_order) ends.push_back(ready.tasks);
      ready.tasks = LaunchGraph::joined(ends);
      if (!unloaded_ends.empty()) beside_loads = LaunchGraph::joined(unloaded_ends);
      if (stage <= Stage::own_forces) ready.all = own_forces = LaunchGraph::joined(all_ends);
      if (!element_ends.empty()) elements = LaunchGraph::joined(element_ends);
    }
    // Those that others wait for come before them.
    std::vector<LaunchGraph::Node> last{ready.tasks};
    for (const Task* task : apart) {
      const LaunchGraph::Node& begin = task->begins == Begins::after_elements ? elements : own_forces;
      last.push_back(record_lane(graph, {begin, begin}, {task}, {}, instant));
    }
    const LaunchGraph::Node all = LaunchGraph::joined(last);
    return {in_parts ? ready.tasks : all, all, own_forces};
  }

  /// What a lane begins after.
  struct LaneBegin {
    LaunchGraph::Node in_order, beside_loads;
  };

  /// @param done lanes of the same stage
  LaunchGraph::Node record_lane(LaunchGraph& graph, const LaneBegin& begin, const std::vector<const Task*>& tasks,
                                const std::map<int, LaunchGraph::Node>& done, const Instant& instant) const {
    bool in_order = tasks.front()->begins != Begins::beside_loads;
    LaunchGraph::Node ready = in_order ? begin.in_order : begin.beside_loads;
    for (std::size_t first = 0, end = 0; first < tasks.size(); first = end) {
      const Task& task = *tasks[first];
      if (const auto other = done.find(task.joins); other != done.end())
        ready = first == 0 ? other->second : LaunchGraph::joined({ready, other->second});
      if (!in_order && task.begins != Begins::beside_loads) {
        ready = LaunchGraph::joined({ready, begin.in_order});
        in_order = true;
      }
      const auto goes_on = [&task](const Task& next) {
        return next.joins < 0 && next.bulk == task.bulk && next.begins == task.begins;
      };
      for (end = first + 1; end < tasks.size() && goes_on(*tasks[end]);) ++end;
      ready = graph.after(ready, urgency(task), [&tasks, first, end, &instant] {
        for (std::size_t t = first; t < end; ++t) tasks[t]->run(instant);
      });
    }
    return ready;
  }

  template <class Record>
  void for_each_step(const Instant& instant, long steps, const Record& record_one) const {
    const long begin = model.step;
    for (long s = 0; s < steps; ++s, ++model.step) {
      Instant now = instant;
      now.load_values = load_values.of(static_cast<int>(s));
      now.places = places.of(static_cast<int>(s));
      record_one(now);
    }
    model.step = begin;
  }

  /// @return what launches the steps
  std::function<void()> record(const Instant& instant, long steps) const {
    if (exchange != nullptr) {
      const std::shared_ptr<const DeviceMessages::Recorded> recorded =
          exchange->record([&] { for_each_step(instant, steps, [this](const Instant& now) { run_recordable(now); }); });
      return [this, recorded] { exchange->repeat(*recorded); };
    }
    const auto graph = std::make_shared<LaunchGraph>();
    Ends ready{graph->root(), graph->root(), graph->root()};
    for_each_step(instant, steps, [&](const Instant& now) { ready = record_step(*graph, ready, now); });
    if (load_values.any()) graph->after(ready.own_forces, 0, [&] { load_values.take_next(steps); });
    if (places.any()) graph->after(ready.all, 0, [&] { places.take_next(steps); });
    graph->finish();
    return [this, graph] { graph->launch(order.space()); };
  }

  Model& model;
  RowExchange* const exchange;  ///< null: one rank
  const bool elements_alone;    ///< another rank than 0: contact, loads and prescribed motions are 0's
  const std::vector<ContactPair> no_contacts;
  const std::vector<ContactPair>& contacts;  ///< that are looked after here
  LaunchOrder& order;
  bool idle = true;  ///< the device has waited since the last graph
  const int most;
  std::vector<Task> plain, recordable, rare;
  bool crowded = false;   ///< one of them is bulk
  bool in_parts = false;  ///< they compute the elements in parts
  StepValues<double> load_values;
  StepValues<RigidPlace> places;
  std::map<Key, std::function<void()>> graphs;
  Milestone graph_ends;
  State recorded_in;  ///< of all of them
};

StepRecording::StepRecording(Model& model, const Plan& plan, LaunchOrder& order, RowExchange* exchange)
    : recordings_(std::make_unique<Recordings>(model, plan, order, exchange)) {}

StepRecording::~StepRecording() { finish(); }

void StepRecording::finish(bool idle) { recordings_->finish(idle); }

void StepRecording::forget() {
  Recordings& all = *recordings_;
  all.finish(true);
  ExecutionSpace().fence();
  all.graphs.clear();
  all.load_values.forget();
  all.places.forget();
}

int StepRecording::most() const { return recordings_->most; }

long StepRecording::advance(const Instant& instant, long quiet, const std::function<double(long)>& time) {
  Recordings& all = *recordings_;
  Model& model = all.model;
  // The first steps know another time before them.
  const bool regular = instant.elapsed == instant.step && model.velocity_lag == 0.5 * instant.step;
  if (all.most == 0 || quiet < 1 || !regular) return 0;
  all.order.enter();
  if (all.plain_due()) all.run_plain(instant);
  const long steps = all.steps_of_graph(all.idle && !all.order.own() ? std::min(quiet, steps_of_first) : quiet);
  all.idle = false;
  if (auto now = all.state(instant.step); now != all.recorded_in) {
    all.wait();
    all.graphs.clear();
    all.recorded_in = std::move(now);
  }
  const auto value = [&](long step, int number) { return load_value(model.loads[number], time(step)); };
  const auto place = [&](long step, int number) {
    return place_at(model.prescribed[number], time(step) + instant.step);
  };
  const Recordings::Key key{model.step % model.subcycling.cycle(), all.frame_step(), steps, all.rare_due(model.step)};
  // Before they are recorded, as a kernel's first launch brings its code to the device.
  all.load_values.take(all.order.space(), model.step, steps, instant.step, value);
  all.places.take(all.order.space(), model.step, steps, instant.step, place);
  auto found = all.graphs.find(key);
  if (found == all.graphs.end()) found = all.graphs.emplace(key, all.record(instant, steps)).first;
  found->second();
  if (all.exchange == nullptr) {
    all.load_values.has_taken_next(steps);
    all.places.has_taken_next(steps);
  }
  if (all.order.own()) all.graph_ends.put(all.order.space());
  return steps;
}

long StepRecording::graphs_ahead() const { return recordings_->order.own() ? recordings_->graph_ends.ahead() : 0; }

bool StepRecording::would_wait() const {
  const Recordings& all = *recordings_;
  const auto checks = [&all](const ContactPair& pair) {
    const AskedMotion& asked = pair.asked_motion;
    return all.model.step >= pair.next_check &&
           (asked.arrives.ahead() > 0 || !asked.is_of(all.model.step, ContactPair::steps_between_near_checks));
  };
  return std::any_of(all.contacts.begin(), all.contacts.end(), checks);
}

#else

struct StepRecording::Recordings {
  LaunchOrder& order;
};
StepRecording::StepRecording(Model&, const Plan&, LaunchOrder& order, RowExchange*)
    : recordings_(std::make_unique<Recordings>(Recordings{order})) {}
StepRecording::~StepRecording() = default;
void StepRecording::finish(bool) { recordings_->order.leave(); }
void StepRecording::forget() { recordings_->order.leave(); }
int StepRecording::most() const { return 0; }
long StepRecording::graphs_ahead() const { return 0; }
bool StepRecording::would_wait() const { return false; }
long StepRecording::advance(const Instant&, long, const std::function<double(long)>&) { return 0; }

#endif

}  // namespace railwave
