// A hall to stand in: the camera of `scripts/demo` is inside the hollow, behind the near wall.
$fn = 48;

difference() {
  translate([-20, -20, 0]) cube([40, 40, 25]);
  translate([-18, -18, 2]) cube([36, 36, 21]);
  for (x = [-12, 0, 12]) translate([x, 18, 12]) rotate([-90, 0, 0]) cylinder(r = 3.5, h = 2);
  translate([0, 0, 23]) cylinder(r = 8, h = 2);
}
for (x = [-11, 11], y = [0, 12]) color("IndianRed") translate([x, y, 2]) cylinder(r = 1.5, h = 21);
