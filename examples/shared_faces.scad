// Coloured parts that share faces, and one cut that goes through all of them. Where two colours lie in one face the later one shows.
module tile(x, name) color(name) translate([x, 0, 0]) cube([10, 30, 12]);

difference() {
  union() {
    tile(0, "Tomato");
    tile(10, "SteelBlue");
    tile(20, "Gold");
    color("SeaGreen") translate([5, 8, 6]) cube([20, 14, 6]);   // its top lies in the others' tops
  }
  translate([15, 0, 12]) rotate([-90, 0, 0]) cylinder(r = 5, h = 30, $fn = 64);
}
