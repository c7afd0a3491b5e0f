// A translucent housing with its parts inside. Glass walls are blended in their depth order; where the lid meets the box there is no
// double wall, because the two are one solid.
$fn = 64;

color([0.5, 0.7, 0.9, 0.35]) {
  difference() {
    cube([60, 40, 20]);
    translate([3, 3, 3]) cube([54, 34, 17]);
  }
  translate([0, 0, 20]) cube([60, 40, 3]);
}
color("DarkOliveGreen") translate([6, 6, 3]) cube([48, 28, 2]);
color("Black") for (i = [0 : 2]) translate([12 + 13 * i, 14, 5]) cube([9, 12, 3]);
color("Silver") for (x = [9, 51]) translate([x, 10, 5]) cylinder(d = 4, h = 8);
