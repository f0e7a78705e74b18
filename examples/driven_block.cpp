// Couples a steel block, computed by Railwave, with a spring of this program's own, which holds it to the ground.
// Each window is computed twice: a first time with the force of its begin, a second time, from the state that was
// kept, with the force that the first made likely at its end.
#include <cstdio>
#include <exception>
#include <railwave/simulation.hpp>
#include <string>

namespace {

constexpr double window = 1e-5;         // s
constexpr double stiffness = 1e8;       // N/m
constexpr double first_stretch = 1e-5;  // m, what the spring is stretched by in the beginning

/// N, on the block, whose face has moved by so much (m).
double spring_force(double displacement) { return -stiffness * (first_stretch + displacement); }

/// m, of the face's mean along z.
double displacement(const railwave::Simulation& block) { return block.values("set.block.z_max.displacement")[2]; }

void run(const std::string& case_file) {
  railwave::Simulation block(case_file, window);
  std::printf("time_s,displacement_m,velocity_m_per_s,force_N\n");
  for (bool goes_on = true; goes_on;) {
    const railwave::SimulationState begin = block.save();
    block.drive("pull", spring_force(displacement(block)));
    block.advance();
    const double force = spring_force(displacement(block));
    block.restore(begin);
    block.drive("pull", force);
    goes_on = block.advance();
    std::printf("%.9g,%.9g,%.9g,%.9g\n", block.time(), displacement(block), block.values("set.block.z_max.velocity")[2],
                block.values("load.pull.force")[2]);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(argc > 1 ? argv[1] : "driven_block.toml");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "driven_block: %s\n", error.what());
    return 1;
  }
  return 0;
}
