// A tree as deep as it has leaves: union and difference take turns, each with the result so far as first operand.
depth = 50;

module leaf(i) {
  turn = 37 * i;
  translate([20 * cos(turn), 20 * sin(turn), 0.8 * i - 20]) rotate([turn, 2 * turn, 0]) {
    if (i % 3 == 0) cube(9, center = true);
    if (i % 3 == 1) sphere(r = 6, $fn = 24);
    if (i % 3 == 2) cylinder(r = 4, h = 14, center = true, $fn = 24);
  }
}

module chain(n) {
  if (n == 0) cylinder(r = 22, h = 44, center = true, $fn = 48);
  else if (n % 2 == 0) union() { chain(n - 1); leaf(n); }
  else difference() { chain(n - 1); leaf(n); }
}

chain(depth);
