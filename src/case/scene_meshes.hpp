#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

/// Parameters of the meshes that a case can name, in SI units; the meshes are made of them by src/mesh.
///
/// A new mesh has a struct and a line of RAILWAVE_MESHES here, its keys and the names of its sets in keys_meshes.cpp,
/// and its generator in src/mesh, see mesh/build_mesh.hpp.
namespace railwave::scene {

using Vec3 = std::array<double, 3>;

/// Where an entry stands, for errors found after reading.
struct Place {
  std::string name;  ///< the entry's own name, e.g. "wheel" of [parts.wheel]
  int line = 0;
};

/// Where the contact band of a wheel or rail lies across it.
enum class ZoneBand {
  given,   ///< zone_centre, zone_width
  contact  ///< where the profiles of a contact's wheel and rail meet, see mesh/contact_zone.hpp
};

struct BoxMesh {
  Vec3 origin{0, 0, 0};  ///< lowest corner, m
  Vec3 size{1, 1, 1};    ///< m
  std::array<int, 3> divisions{1, 1, 1};
};

/// S1002 tread profile revolved; axle along y through (0, 0, 0) at the tape circle's plane y = 0; flange towards -y;
/// the solution zone is centred on the lowest point, rolled towards +x.
struct WheelMesh {
  std::string profile = "S1002";  ///< or "cone": a straight tread of slope `conicity` without flange
  double radius = 0.46;           ///< nominal rolling radius at the tape circle
  double bore_radius = 0.0925;
  double hub_radius = 0.125;  ///< where the hub's full width ends
  double hub_width = 0.18;
  double web_inner_radius = 0.160;  ///< where the hub's taper has become the web
  double web_inner_thickness = 0.0256;
  double web_outer_thickness = 0.0197;
  double web_outer_radius = 0.3505;
  double rim_inner_radius = 0.3855;  ///< where the rim has its full width
  double rim_width = 0.135;
  double zone_size = 0.002;   ///< element size in the solution zone
  double zone_length = 0.16;  ///< rolled arc length that is fine
  double zone_start = -0.02;  ///< arc position of the zone's beginning; 0 is the lowest point, positive is rolled later
  ZoneBand zone = ZoneBand::given;
  double zone_centre = 0.0;     ///< lateral position of the contact band's middle (profile coordinate s)
  double zone_width = 0.03;     ///< width of the contact band
  double growth = 1.25;         ///< largest ratio of neighbouring element sizes
  double coarse_size = 0.030;   ///< largest element size along the tread
  double core_size = 0.090;     ///< largest element size below the tread, as an arc at the tread
  double section_size = 0.008;  ///< largest element size across the tread
  int zone_layers = 3;          ///< layers of zone_size below the running surface
  int web_columns = 3;          ///< elements through the web's thickness
  double web_centre = -0.0025;  ///< lateral middle of web and hub: the rim's middle
  double conicity = 0.025;      ///< slope of the tread of profile "cone"
  std::optional<double>
      path_start;            ///< arc at which the wheel begins to roll towards or through its zone; absent: no path
  double path_length = 1.4;  ///< rolled arc length that is the path
  double path_size = 0.003;  ///< largest element size along the tread on it
};

/// 54E1 section extruded along x, foot centre at y = 0 and underside at z = 0, inclined towards -y (the track's
/// centre).
struct RailMesh {
  std::string section = "54E1";  ///< or "60E1"
  double inclination = 0.025;    ///< 1:40
  double start = -0.3;           ///< x of the rail's beginning, m
  double end = 0.5;              ///< x of its end
  double zone_size = 0.002;
  double zone_start = -0.02;  ///< x range of the solution zone
  double zone_end = 0.14;
  ZoneBand zone = ZoneBand::given;
  double zone_centre = -0.003;  ///< lateral (y) middle of the contact band
  double zone_width = 0.03;
  double growth = 1.25;
  double coarse_size = 0.030;       ///< largest element size along the head's surface
  double core_size = 0.030;         ///< largest element size along the rail below it
  double section_size = 0.006;      ///< largest element size across the head's surface
  int zone_layers = 3;              ///< layers of zone_size below the running surface
  int web_columns = 3;              ///< elements through the web's thickness
  std::string height_map;           ///< CSV of x, y, dz on the running surface, see mesh/height_map.hpp; empty: nominal
  double height_map_depth = 0.015;  ///< m below the surface at which nodes stay where they are
  std::optional<double> path_start,
      path_end;              ///< x range that a wheel rolls over, beyond the zone; absent: that of the zone
  double path_size = 0.003;  ///< largest element size along the head on it
};

struct FileMesh {
  std::string path;    ///< absolute, or relative to the case file's folder (already joined)
  double scale = 1.0;  ///< multiplies coordinates: 0.001 for a mesh in mm
};

/// A block with a curved top, its crest above (0, 0); see mesh/generators/crowned_block.cpp.
struct CrownedBlockMesh {
  Vec3 origin{-0.04, -0.04, -0.06};  ///< lowest corner, m
  Vec3 size{0.08, 0.08, 0.06};       ///< m, height at the crest
  double radius_along = 0;           ///< m, of the top's curve along x at the crest; 0: straight
  double radius_across = 0;          ///< m, of the top's curve along y; 0: straight
  double zone_size = 0.001;
  double zone_start = -0.01;  ///< x range of the solution zone, m
  double zone_end = 0.01;
  double zone_centre = 0;              ///< y of its middle, m
  double zone_width = 0.02;            ///< m
  int zone_layers = 6;                 ///< layers of layer_height below the top
  std::optional<double> layer_height;  ///< m; absent: zone_size
  double growth = 1.25;                ///< largest ratio of neighbouring cells
  double coarse_size = 0.01;           ///< m, largest cell
};

/// A ring or a sector of it, axle along y through the origin; see mesh/generators/roller.cpp.
struct RollerMesh {
  double radius = 0.46;  ///< m, of the tread, at y = 0
  double bore_radius = 0.40;
  double crown_radius = 0;    ///< m, of the tread's curve along y; 0: straight
  double side_start = -0.04;  ///< y range, m
  double side_end = 0.04;
  bool ring = false;         ///< the whole way round
  double arc_start = -0.06;  ///< a sector's range, m at the tread from the lowest point, towards +x
  double arc_end = 0.06;
  double zone_size = 0.001;
  double zone_start = -0.01;  ///< arc range of the solution zone, m
  double zone_end = 0.01;
  double zone_centre = 0;              ///< y of its middle, m
  double zone_width = 0.02;            ///< m
  int zone_layers = 6;                 ///< layers of layer_height below the tread
  std::optional<double> layer_height;  ///< m; absent: zone_size
  double growth = 1.25;                ///< largest ratio of neighbouring cells
  double coarse_size = 0.01;           ///< m, largest cell
};

/// A solid round bar along z, its lower end in z = 0; see mesh/generators/cylinder.cpp.
struct CylinderMesh {
  double radius = 0.01;       ///< m
  double length = 0.05;       ///< m
  int core_divisions = 6;     ///< elements along each side of the square-like core
  int ring_divisions = 3;     ///< elements from the core to the skin
  int length_divisions = 20;  ///< elements along the axis
  double end_ratio = 1;       ///< height of the uppermost elements over that of the lowest
  double core_share = 0.5;    ///< half diagonal of the core over the radius
};

enum class RailSide { left, right };  ///< left: towards -y, where a rail of positive inclination leans

/// A bar in the fishing chamber at one side of a rail; see mesh/generators/fishplate.cpp.
struct FishplateMesh {
  std::string rail;    ///< the mesh that it fits
  RailMesh rail_mesh;  ///< that mesh's parameters, filled in when the case has been read
  RailSide side = RailSide::left;
  double start = -0.3;  ///< x range, m
  double end = 0.3;
  double thickness = 0.02;  ///< m, from the web's thinnest place outwards
  double clearance = 0;     ///< m, between web and plate
  std::optional<double>
      size;  ///< m, elements along x; absent: 3 zone_size of the rail, 1 where it reaches the layers of that size
  std::optional<double> gap_start, gap_end;  ///< x range of a gap between two rails that it bridges
};

/// A pad under a rail's foot, as wide as that and leaning with it, of even thickness; see mesh/generators/rail_pad.cpp.
struct RailPadMesh {
  std::string rail;      ///< the mesh that it lies under
  RailMesh rail_mesh;    ///< that mesh's parameters, filled in when the case has been read
  double start = -0.08;  ///< x range, m
  double end = 0.08;
  double thickness = 0.007;    ///< m
  int layers = 2;              ///< elements through the thickness
  std::optional<double> size;  ///< m, largest element along and across the rail; absent: as the foot's are
};

/// Wheel and half axle in one, or both halves; see mesh/generators/wheelset.cpp. Its origin is the axle's middle.
struct WheelsetMesh : WheelMesh {
  WheelsetMesh() : axle{{0, 0.08}, {0.61, 0.08}, {0.89, 0.0675}, {1.1, 0.0675}} {}

  bool half = false;                        ///< only that at y > 0
  double flange_back_distance = 1.360;      ///< m, between the wheels' inner sides
  std::vector<std::array<double, 2>> axle;  ///< y and radius, m, from the middle outwards
  double axle_size = 0.05;                  ///< m, largest element size along the axle beside the hub
};

/// A hollow cylinder of equal cells, its axis along y through the origin, its middle in y = 0; see
/// mesh/generators/ring.cpp.
struct RingMesh {
  double inner_radius = 0.40;  ///< m
  double outer_radius = 0.46;  ///< m
  double width = 0.08;         ///< m, along y
  int round_divisions = 90;    ///< elements round it
  int wall_divisions = 2;      ///< elements from the inner to the outer side
  int width_divisions = 3;     ///< elements along y
};

/// Every mesh that a case can name: its `type`, and the struct of its parameters. MeshType and MeshSource below, the
/// case file's choices of `type` and the generators that src/mesh expects (mesh/build_mesh.hpp) are made of this list.
/// New ones come last.
#define RAILWAVE_MESHES(RAILWAVE_MESH)           \
  RAILWAVE_MESH(box, BoxMesh)                    \
  RAILWAVE_MESH(wheel, WheelMesh)                \
  RAILWAVE_MESH(rail, RailMesh)                  \
  RAILWAVE_MESH(file, FileMesh)                  \
  RAILWAVE_MESH(crowned_block, CrownedBlockMesh) \
  RAILWAVE_MESH(roller, RollerMesh)              \
  RAILWAVE_MESH(cylinder, CylinderMesh)          \
  RAILWAVE_MESH(fishplate, FishplateMesh)        \
  RAILWAVE_MESH(rail_pad, RailPadMesh)           \
  RAILWAVE_MESH(wheelset, WheelsetMesh)          \
  RAILWAVE_MESH(ring, RingMesh)

#define RAILWAVE_TYPE(type, Parameters) type,
#define RAILWAVE_NAME(type, Parameters) #type,
#define RAILWAVE_FIELD(type, Parameters) Parameters type;

enum class MeshType { RAILWAVE_MESHES(RAILWAVE_TYPE) };

/// What the types are called in a case, in the order of MeshType.
inline constexpr const char* mesh_type_names[] = {RAILWAVE_MESHES(RAILWAVE_NAME)};

/// A mesh of a case; only the parameters of its own type count.
struct MeshSource : Place {
  MeshType type = MeshType::box;
  RAILWAVE_MESHES(RAILWAVE_FIELD)
};

#undef RAILWAVE_TYPE
#undef RAILWAVE_NAME
#undef RAILWAVE_FIELD

}  // namespace railwave::scene
