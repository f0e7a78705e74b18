#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <functional>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "kernels/support/spaces.hpp"

/// Kokkos records launches as a graph since 4.6; tried with CUDA only.
#if defined(KOKKOS_ENABLE_CUDA) && KOKKOS_VERSION >= 40600 && !defined(RAILWAVE_SERIAL)
#define RAILWAVE_LAUNCH_GRAPHS
#include <Kokkos_Graph.hpp>
#endif

namespace railwave {

/// Who waits for whom among nodes 0, 1, ...: the second for the first.
using GraphEdges = std::vector<std::pair<int, int>>;

/// The same order among the nodes that do something, with as few edges as it takes: nodes that are there only so that
/// one waits for several have none, and nobody waits for what another of those that he waits for has waited for.
/// @param edges of a graph without circles
/// @param empty of each node, whether it does nothing
/// @return ascending
GraphEdges fewest_edges(const GraphEdges& edges, const std::vector<bool>& empty);

#ifdef KOKKOS_ENABLE_CUDA

inline void check_graph(cudaError_t result, const char* what) {
  if (result == cudaSuccess) return;
  throw std::runtime_error(fmt::format("CUDA could not {}, which RAILWAVE_STEP_GRAPHS=0 does without: {}", what,
                                       cudaGetErrorString(result)));
}

/// Launches that were recorded, and are repeated as one. Each keeps its priority.
class RepeatedLaunches {
 public:
  explicit RepeatedLaunches(cudaGraph_t graph) {
    check_graph(cudaGraphInstantiate(&launches_, graph, cudaGraphInstantiateFlagUseNodePriority),
                "make a graph of steps");
  }
  ~RepeatedLaunches() { cudaGraphExecDestroy(launches_); }
  RepeatedLaunches(const RepeatedLaunches&) = delete;
  RepeatedLaunches& operator=(const RepeatedLaunches&) = delete;

  void launch(const ExecutionSpace& space) const {
    check_graph(cudaGraphLaunch(launches_, space.cuda_stream()), "launch a graph of steps");
  }

 private:
  cudaGraphExec_t launches_ = nullptr;
};

#endif

#ifdef RAILWAVE_LAUNCH_GRAPHS

constexpr bool has_launch_graphs = true;

/// Launches recorded once, with who waits for whom, and repeated at the cost of one launch. What is recorded keeps its
/// arguments; nothing may be allocated, copied or waited for while it is.
class LaunchGraph {
 public:
  using Node = Kokkos::Experimental::GraphNodeRef<ExecutionSpace>;

  Node root() const { return graph_.root_node(); }

  /// Records what `launch` launches, one after the other, to begin when a node is done.
  /// @param urgency they get room on the device before those of less; 0: after all others
  Node after(const Node& node, int urgency, const std::function<void()>& launch) {
    // What is thrown meanwhile must not leave the space recording.
    std::exception_ptr failure;
    const NativeNodes before = urgency > 0 ? nodes_of(graph_.native_graph()) : NativeNodes{};
    const Node done = node.cuda_capture(ExecutionSpace(), [launch, &failure](const ExecutionSpace&) {
      try {
        launch();
      } catch (...) {
        failure = std::current_exception();
      }
    });
    if (failure) std::rethrow_exception(failure);
    if (urgency > 0)
      for (cudaGraphNode_t one : nodes_of(graph_.native_graph()))
        if (!std::binary_search(before.begin(), before.end(), one)) put_first(one, urgency);
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
  void finish() {
    connect_directly(graph_.native_graph());
    launches_ = std::make_unique<RepeatedLaunches>(graph_.native_graph());
  }

  /// @param space in whose order the launch comes; what it launches is not in the order of others
  void launch(const ExecutionSpace& space) const { launches_->launch(space); }

 private:
  using NativeNodes = std::vector<cudaGraphNode_t>;

  /// Ascending.
  static NativeNodes nodes_of(cudaGraph_t graph) {
    std::size_t count = 0;
    check_graph(cudaGraphGetNodes(graph, nullptr, &count), "count the launches of a graph");
    NativeNodes nodes(count);
    check_graph(cudaGraphGetNodes(graph, nodes.data(), &count), "list the launches of a graph");
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  }

  static cudaGraphNodeType type_of(cudaGraphNode_t node) {
    cudaGraphNodeType type;
    check_graph(cudaGraphNodeGetType(node, &type), "look at a graph");
    return type;
  }

  /// Takes out the empty nodes by which Kokkos joins others, and what is waited for twice: a device waits 2 to 6 us
  /// longer for several nodes through an empty one than for these themselves.
  static void connect_directly(cudaGraph_t graph) {
    const NativeNodes nodes = nodes_of(graph);
    std::vector<bool> empty;
    for (cudaGraphNode_t node : nodes) empty.push_back(type_of(node) == cudaGraphNodeTypeEmpty);
    std::size_t count = 0;
    check_graph(edges_of(graph, nullptr, nullptr, &count), "count the edges of a graph");
    std::vector<cudaGraphNode_t> from(count), to(count);
    check_graph(edges_of(graph, from.data(), to.data(), &count), "list the edges of a graph");
    const auto number = [&nodes](cudaGraphNode_t node) {
      return static_cast<int>(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin());
    };
    GraphEdges edges;
    for (std::size_t k = 0; k < count; ++k) edges.emplace_back(number(from[k]), number(to[k]));
    check_graph(remove_edges(graph, from.data(), to.data(), count), "change the edges of a graph");
    from.clear();
    to.clear();
    for (const auto& [one, other] : fewest_edges(edges, empty)) {
      from.push_back(nodes[one]);
      to.push_back(nodes[other]);
    }
    check_graph(add_edges(graph, from.data(), to.data(), from.size()), "change the edges of a graph");
    for (std::size_t k = 0; k < nodes.size(); ++k)
      if (empty[k]) check_graph(cudaGraphDestroyNode(nodes[k]), "take a node out of a graph");
  }

  // CUDA 13 gave these a parameter more.
#if CUDART_VERSION >= 13000
  static cudaError_t edges_of(cudaGraph_t graph, cudaGraphNode_t* from, cudaGraphNode_t* to, std::size_t* count) {
    return cudaGraphGetEdges(graph, from, to, nullptr, count);
  }
  static cudaError_t add_edges(cudaGraph_t graph, const cudaGraphNode_t* from, const cudaGraphNode_t* to,
                               std::size_t count) {
    return cudaGraphAddDependencies(graph, from, to, static_cast<const cudaGraphEdgeData*>(nullptr), count);
  }
  static cudaError_t remove_edges(cudaGraph_t graph, const cudaGraphNode_t* from, const cudaGraphNode_t* to,
                                  std::size_t count) {
    return cudaGraphRemoveDependencies(graph, from, to, nullptr, count);
  }
#else
  static constexpr auto edges_of = cudaGraphGetEdges;
  static constexpr auto add_edges = cudaGraphAddDependencies;
  static constexpr auto remove_edges = cudaGraphRemoveDependencies;
#endif

  /// What was recorded together is a graph within the graph.
  static void put_first(cudaGraphNode_t node, int urgency) {
    const cudaGraphNodeType type = type_of(node);
    if (type == cudaGraphNodeTypeGraph) {
      cudaGraph_t within = nullptr;
      check_graph(cudaGraphChildGraphNodeGetGraph(node, &within), "look at a graph");
      for (cudaGraphNode_t one : nodes_of(within)) put_first(one, urgency);
    } else if (type == cudaGraphNodeTypeKernel) {
      int least = 0, greatest = 0;  // the greatest has the smallest number
      check_graph(cudaDeviceGetStreamPriorityRange(&least, &greatest), "say its priorities");
      cudaLaunchAttributeValue value{};
      value.priority = std::max(greatest, least - urgency);
      check_graph(cudaGraphKernelNodeSetAttribute(node, cudaLaunchAttributePriority, &value), "set a priority");
    }
  }

  Kokkos::Experimental::Graph<ExecutionSpace> graph_;
  std::unique_ptr<RepeatedLaunches> launches_;
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
