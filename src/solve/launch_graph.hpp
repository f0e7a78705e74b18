#pragma once

#include <exception>
#include <functional>
#include <vector>

#include "kernels/support/spaces.hpp"

/// Kokkos records launches as a graph since 4.6; tried with CUDA only.
#if defined(KOKKOS_ENABLE_CUDA) && KOKKOS_VERSION >= 40600 && !defined(RAILWAVE_SERIAL)
#define RAILWAVE_LAUNCH_GRAPHS
#include <Kokkos_Graph.hpp>
#endif

namespace railwave {

#ifdef RAILWAVE_LAUNCH_GRAPHS

constexpr bool has_launch_graphs = true;

/// Launches recorded once, with who waits for whom, and repeated at the cost of one launch. What is recorded keeps its
/// arguments; nothing may be allocated, copied or waited for while it is.
class LaunchGraph {
 public:
  using Node = Kokkos::Experimental::GraphNodeRef<ExecutionSpace>;

  Node root() const { return graph_.root_node(); }

  /// Records what `launch` launches, one after the other, to begin when a node is done.
  static Node after(const Node& node, const std::function<void()>& launch) {
    // What is thrown meanwhile must not leave the space recording.
    std::exception_ptr failure;
    const Node done = node.cuda_capture(ExecutionSpace(), [launch, &failure](const ExecutionSpace&) {
      try {
        launch();
      } catch (...) {
        failure = std::current_exception();
      }
    });
    if (failure) std::rethrow_exception(failure);
    return done;
  }

  /// Done when all of these are.
  static Node joined(const std::vector<Node>& nodes, std::size_t from = 0) {
    switch (nodes.size() - from) {
      case 1:
        return nodes[from];
      case 2:
        return Kokkos::Experimental::when_all(nodes[from], nodes[from + 1]);
      case 3:
        return Kokkos::Experimental::when_all(nodes[from], nodes[from + 1], nodes[from + 2]);
      default:
        return Kokkos::Experimental::when_all(nodes[from], nodes[from + 1], joined(nodes, from + 2));
    }
  }

  /// All is recorded.
  void finish() { graph_.instantiate(); }

  /// @param space in whose order the launch comes; what it launches is not in the order of others
  void launch(const ExecutionSpace& space) const { graph_.submit(space); }

 private:
  Kokkos::Experimental::Graph<ExecutionSpace> graph_;
};

/// Spaces whose launches need not wait for each other's, nor for those of the default one.
inline std::vector<ExecutionSpace> separate_spaces(std::size_t count) {
  return Kokkos::Experimental::partition_space(ExecutionSpace(), std::vector<int>(count, 1));
}

#else

constexpr bool has_launch_graphs = false;

inline std::vector<ExecutionSpace> separate_spaces(std::size_t count) {
  return std::vector<ExecutionSpace>(count, ExecutionSpace());
}

#endif

}  // namespace railwave
