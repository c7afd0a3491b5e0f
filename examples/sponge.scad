// A Menger sponge: every cutter ends in the outer faces, and its walls meet those of the others.
size = 27;
levels = 2;

module bar(width) cube([width, width, size], center = true);

module bars(level, width) {
  step = width * 3;
  count = pow(3, level - 1);
  for (i = [0 : count - 1], j = [0 : count - 1])
    translate([(i - (count - 1) / 2) * step, (j - (count - 1) / 2) * step, 0]) bar(width);
}

difference() {
  cube(size, center = true);
  for (level = [1 : levels], turn = [[0, 0, 0], [90, 0, 0], [0, 90, 0]])
    rotate(turn) bars(level, size / pow(3, level));
}
