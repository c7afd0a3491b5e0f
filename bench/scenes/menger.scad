// A Menger sponge: a cube minus square bars along three axes, level by level. Bars overshoot, and cross each other everywhere.
levels = 3;
size = 27;

module bars(level) {
  width = size / pow(3, level);
  last = pow(3, level - 1) - 1;
  for (i = [0 : last]) for (j = [0 : last]) {
    u = width * (3 * i + 1);
    v = width * (3 * j + 1);
    translate([u, v, -1]) cube([width, width, size + 2]);
    translate([u, -1, v]) cube([width, size + 2, width]);
    translate([-1, u, v]) cube([size + 2, width, width]);
  }
}

difference() {
  cube(size);
  for (level = [1 : levels]) bars(level);
}
