// An L-shaped bracket with ribs, rounded ears and two rows of holes; every drill overshoots its plate, as openscad's manual advises.
holes = 10;     // per row
$fn = 32;

module rib(thickness, leg) {
  polyhedron(points = [[0, 0, 0], [leg, 0, 0], [0, leg, 0], [0, 0, thickness], [leg, 0, thickness], [0, leg, thickness]],
             faces = [[0, 1, 2], [3, 5, 4], [0, 3, 4, 1], [1, 4, 5, 2], [2, 5, 3, 0]]);
}

difference() {
  union() {
    translate([-40, -25, 0]) cube([80, 50, 6]);
    translate([-40, -25, 0]) cube([80, 6, 50]);
    for (x = [-40, -3, 34]) translate([x, -20, 5]) rotate([90, 0, 90]) rib(6, 20);
    for (x = [-40, 40]) translate([x, 25, 0]) cylinder(r = 5, h = 6);
  }
  for (i = [0 : holes - 1]) translate([-36 + 80 / holes * i, 12, -1]) cylinder(d = 5, h = 8);
  for (i = [0 : holes - 1]) translate([-36 + 80 / holes * i, -18, 35]) rotate([90, 0, 0]) cylinder(d = 5, h = 8);
}
