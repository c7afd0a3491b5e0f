// A shaft in its bush in its housing, each fitting exactly, with a nut below and a collar above. Look inside with `--section -y=0`.
$fn = 72;

module ring(outer, inner, height) difference() {
  cylinder(r = outer, h = height);
  cylinder(r = inner, h = height);
}

color("LightSteelBlue") difference() {
  translate([-25, -25, 0]) cube([50, 50, 20]);
  cylinder(r = 12, h = 20);
  for (x = [-19, 19], y = [-19, 19]) translate([x, y, 0]) cylinder(r = 3, h = 20);
}
color("Goldenrod") ring(12, 8, 20);
color("Silver") translate([0, 0, -2.5]) ring(16, 8, 2.5, $fn = 6);
color("DimGray") {
  translate([0, 0, -10]) cylinder(r = 8, h = 40);
  translate([0, 0, 20]) ring(14, 8, 4);
}
