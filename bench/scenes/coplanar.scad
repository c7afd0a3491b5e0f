// The classic coplanar difference: the hole ends exactly in the top and bottom faces of the block.
difference() {
  cube([40, 40, 20], center = true);
  cube([20, 20, 20], center = true);
}
