// An angle bracket with a rib and screw holes; every cutter ends exactly in the faces it goes through.
$fn = 48;
thickness = 5;
width = 40;
height = 50;

module screw_hole(depth) {
  cylinder(d = 5, h = depth);
  translate([0, 0, depth - 2]) cylinder(d1 = 5, d2 = 9, h = 2);
}

difference() {
  union() {
    cube([60, width, thickness]);
    cube([thickness, width, height]);
    translate([thickness, width / 2 + 2, thickness]) rotate([90, 0, 0])
      linear_extrude(4) polygon([[0, 0], [35, 0], [0, 30]]);
  }
  for (y = [10, width - 10]) {
    translate([45, y, 0]) screw_hole(thickness);
    translate([0, y, height - 10]) rotate([0, 90, 0]) screw_hole(thickness);
  }
}
