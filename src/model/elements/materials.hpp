#pragma once

#include "kernels/materials/all.hpp"
#include "model/elements/element_model.hpp"

/// What materials of elements are to the host: which of a case's materials a kernel is for, the constants that it gets,
/// and the words for it. A new material has its kernel in kernels/materials/, its line in kernels/materials/all.hpp,
/// its trait here, and its keys in the case (src/case/scene.hpp, src/case/keys_bodies.cpp).
namespace railwave {

inline ElasticConstants elastic_constants(const scene::Material& material) {
  return {material.dilatational_modulus() - 2 * material.shear_modulus(), material.shear_modulus()};
}

inline BilinearConstants bilinear_constants(const scene::Material& material) {
  return {elastic_constants(material), *material.yield_stress,
          hardening_modulus(material.youngs_modulus, material.tangent_modulus)};
}

template <class Material>
struct MaterialTrait;

template <>
struct MaterialTrait<Elastic> {
  static constexpr const char* words = "";  ///< in the name of its task
  static constexpr const char* left_out_as =
      nullptr;  ///< for the summary, where something flows, but nothing by this material
  static bool is_of(const scene::Material& material) { return !material.yield_stress; }
  static ElasticConstants constants(const scene::Material& material) { return elastic_constants(material); }
};

template <>
struct MaterialTrait<Bilinear> {
  static constexpr const char* words = ", elastoplastic";
  static constexpr const char* left_out_as = nullptr;
  static bool is_of(const scene::Material& /*material*/) { return true; }
  static BilinearConstants constants(const scene::Material& material) { return bilinear_constants(material); }
};

template <>
struct MaterialTrait<KinematicBilinear> {
  static constexpr const char* words = ", elastoplastic with back stress";
  static constexpr const char* left_out_as = "back stress: hardening is isotropic everywhere";
  static bool is_of(const scene::Material& material) { return material.hardening_beta < 1; }
  static KinematicConstants constants(const scene::Material& material) {
    return {bilinear_constants(material), material.hardening_beta};
  }
};

template <>
struct MaterialTrait<Chaboche> {
  static constexpr const char* words = ", elastoplastic with hardening that saturates";
  static constexpr const char* left_out_as = nullptr;
  static bool is_of(const scene::Material& material) {
    return material.isotropic_saturation != 0 || material.back_stress_modulus > 0;
  }
  static ChabocheConstants constants(const scene::Material& material) {
    return {elastic_constants(material), *material.yield_stress,       material.isotropic_saturation,
            material.isotropic_rate,     material.back_stress_modulus, material.back_stress_recall};
  }
};

/// Which of `Materials` a case's material is: the first that is for it.
inline int material_number(const scene::Material& material) {
  return first_type(Materials{},
                    [&](auto type) { return MaterialTrait<typename decltype(type)::type>::is_of(material); });
}

/// Calls `work(TypeOf<...>)` with the type of a group's material.
template <class Work>
void with_material_type(const MaterialArrays& arrays, const Work& work) {
  with_type(Materials{}, arrays.number, work);
}

/// Calls `work(material)` with the material of a group's elements, in the type that their kernels are made for.
template <class Work>
void with_material(const ElementGroup& group, const Work& work) {
  with_material_type(group.material,
                     [&](auto type) { work(material_of<typename decltype(type)::type>(group.material)); });
}

/// The arrays, but for `history` and `volume`, of a group whose elements are of case materials that all have the number
/// `number`.
MaterialArrays material_arrays(int number, const std::vector<const scene::Material*>& materials);

/// For the summary: what of materials the scene leaves out.
std::vector<std::string> materials_left_out(const scene::Scene& scene);

}  // namespace railwave
