// A plate with columns × rows through holes. The drills overshoot the faces of the plate by 1, or end exactly in them.
columns = 10;
rows = 10;
overshoot = 1;   // 0: coplanar ends

difference() {
  translate([-2, -2, 0]) cube([5 * columns + 4, 5 * rows + 4, 4]);
  for (i = [0 : columns - 1]) for (j = [0 : rows - 1])
    translate([5 * i + 2.5, 5 * j + 2.5, -overshoot]) cylinder(d = 4, h = 4 + 2 * overshoot, $fn = 64);
}
