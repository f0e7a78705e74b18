// The plate of cases/own_mesh/drop.toml, in mm: 200 x 48 x 12, of 40 x 10 x 3 hexahedra.
// plate.msh was made with Gmsh 4.8.4 by
//   gmsh -3 plate.geo -format msh41 -o plate.msh
length = 200;
width = 48;
thickness = 12;

Point(1) = {-length / 2, -width / 2, 0};
Point(2) = { length / 2, -width / 2, 0};
Point(3) = { length / 2,  width / 2, 0};
Point(4) = {-length / 2,  width / 2, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};

// Quadrilaterals: transfinite curves and surface, recombined.
Transfinite Curve {1, 3} = 41;
Transfinite Curve {2, 4} = 11;
Transfinite Surface {1};
Recombine Surface {1};

// Hexahedra: layers of an extrusion, recombined. made[0] is the upper side, made[1] the volume, made[2] to made[5] the
// sides over curves 1 to 4.
made[] = Extrude {0, 0, thickness} { Surface{1}; Layers{3}; Recombine; };

// Physical groups become the sets of the case file: plate.top, plate.ends, ...
Physical Surface("top") = {made[0]};
Physical Surface("bottom") = {1};
Physical Surface("ends") = {made[3], made[5]};
Physical Volume("steel") = {made[1]};
