// Gmsh script of the .msh files beside it, made with Gmsh 4.8.4:
//   gmsh -3 block.geo -format msh41 -o block_ascii.msh
//   gmsh -3 block.geo -format msh41 -bin -o block_binary.msh
//   gmsh -3 block.geo -setnumber divisions 1 -setnumber layers 2 -format msh41 -parametric -o small_ascii.msh
//   gmsh -3 block.geo -setnumber divisions 1 -setnumber layers 2 -format msh41 -parametric -bin -o small_binary.msh
// The bar is 0.1 x 0.02 x 0.02 m, along x, in layers x divisions x divisions hexahedra.
DefineConstant[ divisions = 4, layers = 40 ];
length = 0.1;
width = 0.02;

Point(1) = {0, 0, 0};
Point(2) = {0, width, 0};
Point(3) = {0, width, width};
Point(4) = {0, 0, width};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve {1:4} = divisions + 1;
Transfinite Surface {1};
Recombine Surface {1};

// bar[0] is the far end, bar[1] the volume, bar[2] to bar[5] the sides over curves 1 to 4.
bar[] = Extrude {length, 0, 0} { Surface{1}; Layers{layers}; Recombine; };

Physical Surface("start") = {1};
Physical Surface("end") = {bar[0]};
Physical Surface("foot") = {bar[2]};
Physical Surface("head") = {bar[4]};
Physical Surface("sides", 12) = {bar[3], bar[5]};
Physical Curve("lower edge") = {1};
Physical Point("origin") = {1};
Physical Volume("bar") = {bar[1]};
