// An intersection of n unions of two: whoever normalises it to a union of products has 2^n of them.
n = 4;
intersection_for(i = [0 : n - 1]) rotate([180 / n * i, 0, 50 * i]) {
  translate([0, 0, 3]) cube([30, 30, 20], center = true);
  cylinder(d = 8, h = 60, center = true, $fn = 24);
}
