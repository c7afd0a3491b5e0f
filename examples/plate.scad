// A plate with a field of holes that end in its faces: `copeel csg -D columns=50 -D rows=20 plate.scad` has a thousand.
columns = 16;
rows = 12;
pitch = 6;
thickness = 4;

difference() {
  translate([-columns * pitch / 2, -rows * pitch / 2, 0]) cube([columns * pitch, rows * pitch, thickness]);
  for (i = [0 : columns - 1], j = [0 : rows - 1])
    translate([(i - columns / 2 + 0.5) * pitch, (j - rows / 2 + 0.5) * pitch, 0]) cylinder(d = 4, h = thickness, $fn = 24);
}
