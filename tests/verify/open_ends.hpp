#pragma once

#include "case/scene.hpp"

/// Ends through which waves leave.
namespace railwave::verify {

inline void add_dashpots(scene::Scene& scene, const std::string& target) {
  scene::NonReflecting end;
  end.name = target;
  end.target = target;
  scene.non_reflecting.push_back(end);
}

/// @param length m
inline void add_layer(scene::Scene& scene, const std::string& target, double length, double reflection) {
  scene::AbsorbingLayer layer;
  layer.name = target;
  layer.target = target;
  layer.length = length;
  layer.reflection = reflection;
  scene.absorbing_layers.push_back(layer);
}

}  // namespace railwave::verify
