// Two hexagonal rings of turned leaves. Each was turned on its own, so neighbours share their faces only to within rounding, and the numbers
// of a turn reach us with six digits; the faces are still one face.
module leaf(r) rotate([0, 0, 30]) cylinder(r = r / sqrt(3), h = 6, $fn = 6);

names = ["Tomato", "Orange", "Gold", "YellowGreen", "MediumAquamarine", "CornflowerBlue"];
difference() {
  union() {
    color("WhiteSmoke") leaf(20);
    for (i = [0 : 5]) color(names[i]) rotate([0, 0, 60 * i]) translate([20, 0, 0]) leaf(20);
    for (i = [0 : 5]) color(names[5 - i]) rotate([0, 0, 60 * i + 30]) translate([20 * sqrt(3), 0, 0]) leaf(20);
  }
  for (i = [0 : 6]) rotate([0, 0, 360 / 7 * i]) translate([20, 0, 0]) cylinder(r = 4, h = 6, $fn = 32);
}
