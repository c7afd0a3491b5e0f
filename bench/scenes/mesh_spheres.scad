// A scanned mesh minus a grid of spheres.
mesh = "";
difference() {
  import(mesh, convexity = 12);
  for (x = [-16, 0, 16]) for (y = [-16, 0, 16]) for (z = [-16, 0, 16]) translate([x, y, z]) sphere(r = 6, $fn = 32);
}
