// A lens of two spheres with a bite by a third: few leaves, many triangles.
sides = 256;
difference() {
  intersection() {
    sphere(r = 20, $fn = sides);
    translate([8, 0, 0]) sphere(r = 20, $fn = sides);
  }
  translate([6, -14, 8]) sphere(r = 12, $fn = sides);
}
