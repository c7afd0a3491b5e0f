// The classic: a hole that ends exactly in the faces of the block. Other previews flicker here, which is why everyone learns to make
// the cutter "a bit longer". With Copeel there is no need to.
difference() {
  cube([40, 40, 20], center = true);
  cube([20, 20, 20], center = true);
}
