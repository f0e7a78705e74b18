#include <Kokkos_Core.hpp>
#include <catch2/catch_test_macros.hpp>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "model/visit_arrays.hpp"
#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;

namespace {

/// What Kokkos has allocated and not freed since the recording began. Its callbacks are functions without a place for
/// data of ours.
struct Allocation {
  std::string label;
  std::size_t bytes;
};
std::map<const void*, Allocation> allocated;

void allocate(Kokkos_Profiling_SpaceHandle, const char* label, const void* data, std::uint64_t bytes) {
  allocated[data] = {label, bytes};
}
void deallocate(Kokkos_Profiling_SpaceHandle, const char* /*label*/, const void* data, std::uint64_t /*bytes*/) {
  allocated.erase(data);
}

class Recording {
 public:
  Recording() : before_(Kokkos::Tools::Experimental::get_callbacks()) {
    allocated.clear();
    Kokkos::Tools::Experimental::set_allocate_data_callback(allocate);
    Kokkos::Tools::Experimental::set_deallocate_data_callback(deallocate);
  }
  ~Recording() { Kokkos::Tools::Experimental::set_callbacks(before_); }
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

 private:
  Kokkos::Tools::Experimental::EventSet before_;
};

struct Visited {
  std::set<const void*> data;
  std::map<std::string, int> names;
  template <class View>
  void operator()(ArrayUse /*use*/, const std::string& name, View& view, ArrayShape /*shape*/) {
    ++names[name];
    if (view.size() > 0) data.insert(view.data());
  }
};

/// What a run changes, byte by byte.
struct Bytes {
  std::map<std::string, std::vector<unsigned char>> of;
  template <class View>
  void operator()(ArrayUse use, const std::string& name, View& view, ArrayShape /*shape*/) {
    if (use == ArrayUse::constant || use == ArrayUse::scratch || view.size() == 0) return;
    const auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), view);
    const auto* first = reinterpret_cast<const unsigned char*>(host.data());
    of[name].assign(first, first + host.span() * sizeof(typename View::value_type));
  }
};

/// Every kind of array that there is.
scene::Scene scene_of_everything() {
  scene::Scene scene = busy_blocks();
  add_pressure(scene, "upper.z_max", 1e6);
  scene::NonReflecting end;
  end.name = "end";
  end.target = "lower.x_max";
  scene.non_reflecting.push_back(end);
  scene::PrescribedMotion motion;
  motion.name = "pulled";
  motion.target = "upper.x_min";
  motion.velocity = {1, 0, 0};
  scene.prescribed_motions.push_back(motion);
  scene.materials[0].yield_stress = 500e6;
  scene.materials[0].tangent_modulus = 1e9;
  return scene;
}

/// What this version of Kokkos tells of an allocation besides the view: a header before it, and bytes.
struct Header {
  std::size_t offset = 0;
  std::size_t bytes = 0;    ///< beside the view's
  std::size_t nothing = 0;  ///< bytes of a view of nothing

  Header() {
    const Array<double*> probe("probe", 1), empty("empty probe", 0);
    for (const auto& [data, allocation] : allocated) {
      if (allocation.label == "probe") {
        offset = reinterpret_cast<const unsigned char*>(probe.data()) - static_cast<const unsigned char*>(data);
        bytes = allocation.bytes - sizeof(double);
      }
      if (allocation.label == "empty probe") nothing = allocation.bytes;
    }
  }
};

/// Views begin and end at whole doubles.
constexpr std::size_t rounding = sizeof(double) - 1;

void check_all_are_visited(const scene::Scene& scene) {
  const Recording recording;
  const Header header;
  Model model;
  build_model(scene, model);
  Visited visited;
  visit_model_arrays(visited, model);
  for (const auto& [name, times] : visited.names) {
    INFO(name);
    CHECK(times == 1);
  }
  std::size_t bytes = 0;
  for (const auto& [data, allocation] : allocated) {
    const auto* first = static_cast<const unsigned char*>(data);
    const auto at = visited.data.lower_bound(first);
    if (at != visited.data.end() && static_cast<const unsigned char*>(*at) <= first + header.offset) {
      bytes += allocation.bytes - header.bytes;
      continue;
    }
    if (allocation.bytes <= header.nothing) continue;
    // Host memory that a device copies to is no array of the device's, nor is Kokkos' own memory; what is lent is no
    // model's.
    INFO(allocation.label << ", " << allocation.bytes << " bytes, is held and not visited");
    CHECK((allocation.label.find("fetched") != std::string::npos || allocation.label.rfind("Kokkos::", 0) == 0 ||
           allocation.label == "lent memory" || allocation.label == "[unlabeled]"));
  }
  CHECK(bytes >= device_bytes(model));
  CHECK(bytes <= device_bytes(model) + rounding * visited.data.size());
}

}  // namespace

TEST_CASE("every array that a model holds is visited once, and counted in its bytes") {
  scene::Scene scene = scene_of_everything();
  SECTION("double") {}
  SECTION("estimate of the whole scene") { scene.solver.step_estimate = scene::StepEstimate::global; }
  SECTION("mixed") { scene.solver.precision = scene::Precision::mixed; }
  SECTION("multipliers, smooth normals") {
    scene.non_reflecting.clear();  // multipliers know nothing of dashpots
    scene.contacts[0].algorithm = scene::ContactAlgorithm::multiplier;
    scene.contacts[0].normals = scene::ContactNormals::smooth;
  }
  SECTION("falling friction and damping of contact") {
    scene.contacts[0].dynamic_friction = 0.2;
    scene.contacts[0].friction_decay = 1;
    scene.contacts[0].damping = 0.1;
  }
  check_all_are_visited(scene);
}

TEST_CASE("every array of nodes in single precision is visited") {
  scene::Scene scene = TwoBlocks{}.scene(1e-5);
  hold(scene, "lower.z_min", {true, true, true});
  scene.solver.precision = scene::Precision::single_precision;
  check_all_are_visited(scene);
}

TEST_CASE("a reset puts all that a run changes back to where a new model has it") {
  scene::Scene scene = scene_of_everything();
  scene.parts[0].position[2] = -1e-6;
  Model fresh, used;
  build_model(scene, fresh);
  build_model(scene, used);
  march(used, 50, [] {});
  reset_to_start(used);
  Bytes expected, found;
  visit_model_arrays(expected, fresh);
  visit_model_arrays(found, used);
  REQUIRE(expected.of.size() > 20);
  for (const auto& [name, bytes] : expected.of) {
    if (name.find("window") != std::string::npos || name.find("layout") != std::string::npos)
      continue;  // laid out anew
    INFO(name);
    const bool same = found.of[name] == bytes;
    CHECK(same);
  }
}
