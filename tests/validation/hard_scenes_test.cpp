// The catalogue's other hard cases, by its numbers, as far as they are a matter of the CSG picture: coincidence, order, the eye, geometry as people have
// it, trees. The oracle of exact crossings judges; where the answer is plain, it is also said in words.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "validation/exact_boolean.h"
#include "validation/hard_cases.h"
#include "validation/judge.h"
#include "validation/random_scene.h"

namespace copeel::validation {
namespace {

constexpr const char* kBall = "sphere($fn = 12, $fa = 12, $fs = 2, r = 12);\n";

Look sized(Look look, int width, int height) {
  look.width = width;
  look.height = height;
  return look;
}

// 0 wrong off-edge pixels in a view; returns how many are covered.
std::uint64_t expectRight(const csg::Model& model, const Look& look, const csg::RenderOptions& options = {}) {
  const Comparison c = judgeByRays(model, viewOf(look), options);
  EXPECT_EQ(c.wrongOffEdge, 0u) << c.summary();
  EXPECT_EQ(c.wrongLeafOffEdge, 0u) << c.summary();
  // On an edge the answer of a snapped vertex is as good; lone small images have few pixels to share the allowance.
  EXPECT_LE(c.wrongEdge, 3 + c.touched / 200) << c.summary();
  return c.covered;
}

std::uint64_t expectRight(const std::string& text, const std::vector<Look>& looks, int width = 128, int height = 96) {
  const csg::Model model = modelOf(text);
  std::uint64_t covered = 0;
  for (const Look& look : looks) covered += expectRight(model, sized(look, width, height));
  return covered;
}

std::string cylinder(int facets, double radius, double low, double high) {
  return moved("cylinder($fn = " + std::to_string(facets) + ", $fa = 12, $fs = 2, h = " + std::to_string(high - low) + ", r1 = " + std::to_string(radius) +
                   ", r2 = " + std::to_string(radius) + ", center = false);\n",
               translation({0, 0, low}));
}

// ---- 2, 3, 6, 7: coincidence

TEST(HardScenes, Case2_one_plane_in_two_tessellations) {
  // A box whose top is a fan of 256 slivers, cut flush by a box of two triangles, and covered by one.
  std::vector<glm::dvec2> outline;
  for (int i = 0; i < 256; ++i) {
    const double t = i / 256.0 * 4, s = (t - std::floor(t)) * 40 - 20;
    const int side = int(t);
    outline.push_back(side == 0 ? glm::dvec2(s, -20) : side == 1 ? glm::dvec2(20, s) : side == 2 ? glm::dvec2(-s, 20) : glm::dvec2(-20, -s));
  }
  const std::string fan = prism(outline, -10, 10);
  EXPECT_GT(expectRight(join("difference", {fan, box({-10, -10, -10}, {10, 10, 10})}), usualLooks()), 1000u);
  EXPECT_GT(expectRight(join("difference", {box({-30, -30, -10}, {30, 30, 10}), fan}), usualLooks()), 1000u);
  EXPECT_GT(expectRight(join("union", {fan, box({-10, -30, 0}, {10, 30, 10})}), usualLooks()), 1000u);
}

TEST(HardScenes, Case3_copies_in_one_place_are_one) {
  for (const int count : {2, 3, 64}) {
    std::vector<std::string> copies;
    for (int i = 0; i < count; ++i) {
      // Each copy's vertices run another way around: a different mesh in the same place.
      std::vector<glm::dvec2> outline{{-15, -15}, {15, -15}, {15, 15}, {-15, 15}};
      std::rotate(outline.begin(), outline.begin() + i % 4, outline.end());
      copies.push_back(prism(outline, -10, 10));
    }
    EXPECT_GT(expectRight(join("union", copies), usualLooks()), 1000u);
    EXPECT_GT(expectRight(join("intersection", copies), usualLooks()), 1000u);
    EXPECT_EQ(expectRight(join("difference", copies), usualLooks()), 0u);
  }
}

TEST(HardScenes, Case6_touching_solids) {
  const std::string block = box({-20, -20, -10}, {20, 20, 10});
  // A peg in its bore leaves a block; of another length it stands out or sinks in.
  const std::string bored = join("difference", {block, cylinder(16, 8, -10, 10)});
  for (const double top : {10.0, 13.0, 6.0}) EXPECT_GT(expectRight(join("union", {bored, cylinder(16, 8, -10, top)}), usualLooks()), 1000u);
  // Coaxial, of one radius and unequal facets.
  expectRight(join("difference", {cylinder(16, 15, -10, 10), cylinder(12, 15, -5, 10)}), usualLooks());
  expectRight(join("union", {cylinder(8, 15, -10, 10), cylinder(12, 15, -10, 10)}), usualLooks());
  // An edge on a face, a vertex on a face, an edge on an edge.
  expectRight(join("union", {block, moved(box({-5, -5, -5}, {5, 5, 5}), translation({0, 0, 10 + 5 * std::numbers::sqrt2}) * turn(45, 0, 0))}), usualLooks());
  expectRight(join("difference", {block, moved(box({0, 0, 0}, {9, 9, 9}), translation({0, 0, 1}) * turn(45, 35, 0))}), usualLooks());
  expectRight(join("union", {block, box({20, 20, -10}, {30, 30, 10})}), usualLooks());
}

TEST(HardScenes, Case7_a_small_city_of_voxels) {
  Random random(7);
  std::vector<std::string> houses;
  for (int x = -6; x < 6; ++x)
    for (int y = -6; y < 6; ++y)
      for (int z = 0, height = random.between(1, 4); z < height; ++z) houses.push_back(box(glm::dvec3(x, y, z) * 3.0, glm::dvec3(x + 1, y + 1, z + 1) * 3.0));
  EXPECT_GT(expectRight(join("union", houses), usualLooks()), 1000u);
}

TEST(HardScenes, Case7b_turned_leaves_in_six_digits_meet_again) {
  // As openscad writes rotate([0, 0, a]): six digits. A slot milled flush through a bar by a bar turned half a turn further.
  for (const int fold : {6, 7}) {
    for (int i = 1; i < fold; ++i) {
      const double angle = 360.0 / fold * i;
      const auto rounded = [](double degrees) {
        const double c = std::cos(degrees * std::numbers::pi / 180), s = std::sin(degrees * std::numbers::pi / 180);
        return fmt::format("multmatrix([[{:.6g}, {:.6g}, 0, 0], [{:.6g}, {:.6g}, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) ", c, -s, s, c);
      };
      const std::string bar = "cube(size = [40, 10, 10], center = true);\n", slot = "cube(size = [20, 10, 10], center = true);\n";
      const csg::Model model = modelOf(join("difference", {rounded(angle) + bar, rounded(angle + 180) + slot}));
      const auto truth = exactBoolean(modelOf(join("difference", {bar, slot})));
      ASSERT_TRUE(truth);
      for (const Look& look : usualLooks(30)) {
        const Comparison c = judgeByMesh(model, transformedExactly(*truth, turn(0, 0, angle)), viewOf(sized(look, 128, 96)));
        EXPECT_EQ(c.wrongOffEdge, 0u) << angle << " degrees: " << c.summary();
        EXPECT_GT(c.covered, 0u);
      }
    }
  }
}

// ---- 8 to 11: order

TEST(HardScenes, Case8_faces_seen_edge_on) {
  const std::string text = coplanarDifference().text;
  // The eye in the plane of the top face, and off it by angles down to 1e-9.
  for (const double angle : {0.0, 1e-3, -1e-3, 1e-5, -1e-5, 1e-7, -1e-7, 1e-9, -1e-9})
    for (const bool perspective : {true, false}) {
      const Look look{{150, 7, 10 + 150 * angle}, {0, 7, 10}, {0, 0, 1}, perspective};
      EXPECT_GT(expectRight(text, {look}), 100u) << angle;
    }
}

TEST(HardScenes, Case9_pencil_of_planes_and_saw_teeth) {
  std::vector<std::string> blades, teeth;
  for (int i = 0; i < 50; ++i) blades.push_back(moved(box({0, 0, -10}, {20, 20, 10}), turn(0, 0, 3.6 * i)));
  expectRight(join("union", blades), usualLooks());
  expectRight(join("intersection", {blades[0], blades[3], blades[7], blades[9]}), usualLooks());
  // 300 teeth over a width of about 60 pixels.
  for (int i = 0; i < 300; ++i) teeth.push_back(box({-15 + i * 0.1, -10, 0}, {-15 + i * 0.1 + 0.05, 10, 10}));
  const std::string comb = join("difference", {box({-20, -20, -10}, {20, 20, 10}), join("union", teeth)});
  expectRight(comb, usualLooks());
}

TEST(HardScenes, Case10_depth_from_a_thousandth_to_a_million) {
  // A speck just before the eye, a part, and a wall a million away. The declared tolerance of so large a scene is 3e-4: the speck is ten times that, or
  // smaller when the user declares a smaller one.
  for (const auto& [size, tolerance] : {std::pair{4e-3, 0.0}, {1e-4, 1e-8}}) {
    const std::string speck = box(glm::dvec3(1, 1, -10) * size, glm::dvec3(2, 2, -9) * size);
    const csg::Model model = modelOf(join("union", {speck, moved(coplanarDifference().text, translation({0, 0, -200})), box({-1e6, -1e6, -1e6 - 10}, {1e6, 0, -1e6})}));
    csg::RenderOptions options;
    options.coplanarTolerance = tolerance;
    for (const bool perspective : {true, false}) EXPECT_GT(expectRight(model, sized({{0, 0, 0}, {0, 0, -200}, {0, 1, 0}, perspective}, 128, 96), options), 1000u);
  }
}

TEST(HardScenes, Case10_images_of_one_pixel_and_of_extreme_shape) {
  const csg::Model model = modelOf(coplanarTurnedLeafByLeaf().text);
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 16384}, {16384, 16}, {17, 3}})
    for (const bool perspective : {true, false}) expectRight(model, sized({{60, -80, 100}, {0, 0, 0}, {0, 0, 1}, perspective}, width, height));
}

TEST(HardScenes, Case11_ten_thousand_layers_and_many_coplanar_fragments) {
  // 5,000 sheets with a hole each; then counts of coplanar faces about the sizes of small integers.
  std::vector<std::string> sheets;
  for (int i = 0; i < 5000; ++i) sheets.push_back(box({-10, -10, -i - 0.5}, {10, 10, -i}));
  const Look look{{3, 2, 50}, {0, 0, 0}, {0, 1, 0}, true};
  expectRight(join("difference", {box({-10, -10, -6000}, {10, 10, 1}), join("union", sheets)}), {look}, 8, 6);
  for (const int count : {255, 256, 257}) {
    const std::vector<std::string> copies(count, box({-10, -10, -10}, {10, 10, 10}));
    const csg::Model model = modelOf(join("union", copies));
    EXPECT_GT(expectRight(model, sized(look, 16, 12)), 20u);
  }
}

TEST(HardScenes, Case11_65537_coplanar_fragments_in_one_pixel) {
  const std::vector<std::string> copies(65537, "cube(size = [20, 20, 20], center = true);\n");
  csg::RenderOptions options;
  options.wantDepth = true;
  options.wantIds = true;
  const csg::Frame frame = csg::Renderer(modelOf(join("union", copies)), options).draw(viewOf({{3, 2, 50}, {0, 0, 0}, {0, 1, 0}, true, 4, 4}));
  EXPECT_TRUE(std::isfinite(frame.depth.at(1, 1)));
  EXPECT_EQ(frame.ids.at(1, 1), 65535);   // the last leaf, as far as 16 bits say it
}

// ---- 12: the eye

TEST(HardScenes, Case12_eye_anywhere) {
  const std::string text = join("difference", {box({-20, -20, -10}, {20, 20, 10}), box({-10, -10, -10}, {10, 10, 10}), box({14, -30, -3}, {17, 30, 3})});
  // In the part, in its hole, in its groove, on faces of the part and of the hole, on an edge, at a vertex, just outside.
  const glm::dvec3 eyes[] = {{-15, 3, 1}, {2, -3, 4}, {15, 2, 0}, {-20, 1, 2}, {10, 2, 3}, {3, 4, 10}, {20, 20, 4}, {20, 20, 10}, {10, 10, 10}, {-20.001, 0, 0}};
  for (const glm::dvec3& eye : eyes)
    for (const glm::dvec3& toward : {glm::dvec3(1, 0.3, 0.2), glm::dvec3(-1, -0.4, 0.1), glm::dvec3(0.2, 0.1, -1)})
      expectRight(text, {{eye, eye + toward, {0, 1, 0.5}, true}}, 64, 48);
}

TEST(HardScenes, Case12_sections_also_in_a_face) {
  const csg::Model model = modelOf(coplanarDifference().text);
  for (const csg::Section section : {csg::Section{0, 3}, {0, 10}, {0, 20}, {1, -10}, {2, 0}, {2, 10}, {2, -10}}) {
    csg::RenderOptions options;
    options.sections = {section};
    for (const Look& look : usualLooks()) expectRight(model, sized(look, 128, 96), options);
    // The eye beyond the section, in what is cut away.
    Look within{{15, 12, 8}, {-5, -3, -2}, {0, 0, 1}, true, 64, 48};
    expectRight(model, within, options);
  }
}

// ---- 13: geometry as people have it

TEST(HardScenes, Case13_nested_shells_duplicates_and_bow_ties) {
  const auto corners = [](double s) {
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 8; ++i) points.push_back({i & 1 ? s : -s, i & 2 ? s : -s, i & 4 ? s : -s});
    return points;
  };
  const std::vector<std::vector<int>> faces{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  const auto add = [](std::vector<std::vector<int>> base, const std::vector<std::vector<int>>& more, int offset, bool reversed) {
    for (std::vector<int> face : more) {
      for (int& i : face) i += offset;
      if (reversed) std::reverse(face.begin(), face.end());
      base.push_back(face);
    }
    return base;
  };
  std::vector<glm::dvec3> nested = corners(10), inner = corners(5);
  nested.insert(nested.end(), inner.begin(), inner.end());
  const std::string opening = box({0, -20, 0}, {20, 0, 20});

  // Two shells of one orientation: solid throughout by winding; hollow by the rule of odd crossings. Opposite ones: a cavity.
  for (const bool cavity : {false, true}) {
    const csg::Model model = modelOf(join("difference", {polyhedron(nested, add(faces, faces, 8, cavity)), opening}));
    for (const csg::InsideRule rule : {csg::InsideRule::NonZero, csg::InsideRule::Odd, csg::InsideRule::Positive}) {
      csg::RenderOptions options;
      options.inside = rule;
      for (const Look& look : usualLooks()) EXPECT_GT(expectRight(model, sized(look, 128, 96), options), 500u);
    }
  }
  // Every face twice; a needle and a face without area among them; two boxes that meet in one vertex, one edge.
  expectRight(join("difference", {polyhedron(corners(10), add(faces, faces, 0, false)), opening}), usualLooks());
  expectRight(join("difference", {polyhedron(corners(10), add(faces, {{0, 1, 0}, {0, 1, 3}, {0, 3, 1}}, 0, false)), opening}), usualLooks());
  std::vector<glm::dvec3> beside = corners(5), corner = corners(5);
  for (glm::dvec3& p : corner) p += glm::dvec3(10, 10, 10);
  beside.insert(beside.end(), corner.begin(), corner.end());
  expectRight(polyhedron(beside, add(faces, faces, 8, false)), usualLooks());
}

TEST(HardScenes, Case13_t_junctions_and_lone_triangles) {
  // The top is split where the sides are not.
  const std::vector<glm::dvec3> points{{-10, -10, -5}, {10, -10, -5}, {10, 10, -5}, {-10, 10, -5}, {-10, -10, 5}, {10, -10, 5}, {10, 10, 5}, {-10, 10, 5}, {1, -10, 5}, {1, 10, 5}};
  const std::vector<std::vector<int>> faces{{0, 3, 2, 1}, {4, 8, 9, 7}, {8, 5, 6, 9}, {0, 1, 5, 4}, {2, 3, 7, 6}, {1, 2, 6, 5}, {3, 0, 4, 7}};
  expectRight(join("difference", {polyhedron(points, faces), box({-3, -20, 0}, {3, 20, 5})}), usualLooks());
  expectRight(polyhedron({{-10, -10, 0}, {10, -10, 0}, {0, 10, 0}}, {{0, 1, 2}}), usualLooks());
}

// A zero-area facet has a plane class of its own, with any normal across it and a depth held to its own extent. It covers samples only by the
// snapping of its corners, within a sub-pixel step of its projection: edge pixels. Turned leaves have needles whose area is rounding.
TEST(HardScenes, Case13_needles_without_area) {
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 8; ++i) points.push_back({i & 1 ? 10 : -10, i & 2 ? 10 : -10, i & 4 ? 10 : -10});
  // One of the two faces at an edge has further corners on it; needles close the gap.
  std::vector<std::vector<int>> faces;
  for (const std::vector<int>& face : std::vector<std::vector<int>>{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    std::vector<int> ring;
    for (std::size_t i = 0; i < face.size(); ++i) {
      const int a = face[i], b = face[(i + 1) % face.size()];
      ring.push_back(a);
      if (a > b) continue;
      int last = a;
      for (int k = 1; k < 8; ++k) {
        points.push_back(points[a] + (points[b] - points[a]) * (k / 8.0));
        ring.push_back(static_cast<int>(points.size()) - 1);
        faces.push_back({a, ring.back(), last});
        last = ring.back();
      }
      faces.push_back({a, b, last});
    }
    faces.push_back(ring);
  }
  const std::string needles = polyhedron(points, faces), plain = box({-10, -10, -10}, {10, 10, 10});
  const std::string opening = box({-4, -20, -20}, {3, 20, 7});
  const std::uint64_t covered = expectRight(join("difference", {plain, opening}), usualLooks());
  EXPECT_EQ(expectRight(join("difference", {needles, opening}), usualLooks()), covered);
  expectRight(join("difference", {moved(needles, turn(10, 20, 30)), opening}), usualLooks());
  // Needles of both orientations across the solid, through it and far out of it.
  points.insert(points.end(), {{-30, -25, -20}, {30, 25, 20}, {0, 0, 0}, {12, 10, 8}});
  const int n = static_cast<int>(points.size());
  for (const std::vector<int>& needle : std::vector<std::vector<int>>{{n - 4, n - 3, n - 2}, {n - 4, n - 1, n - 3}, {0, n - 2, 7}, {n - 4, n - 4, n - 3}}) {
    faces.push_back(needle);
    faces.push_back({needle[2], needle[1], needle[0]});
  }
  const std::string spikes = polyhedron(points, faces);
  expectRight(join("difference", {spikes, opening}), usualLooks());
  expectRight(join("difference", {plain, moved(spikes, translation({6, 0, 5}))}), usualLooks());
  expectRight(join("difference", {moved(spikes, turn(10, 20, 30)), opening}), usualLooks());
}

// ---- 15: trees

TEST(HardScenes, Case15_identities_of_trees) {
  const std::string a = box({-10, -10, -10}, {10, 10, 10}), b = kBall;
  EXPECT_EQ(expectRight("union();\n", usualLooks()), 0u);
  EXPECT_EQ(expectRight(join("difference", {a, a}), usualLooks()), 0u);
  EXPECT_EQ(expectRight(join("difference", {join("union", {a, b}), a, b}), usualLooks()), 0u);
  const std::uint64_t alone = expectRight(a, usualLooks());
  EXPECT_EQ(expectRight(join("intersection", {a, a}), usualLooks()), alone);
  EXPECT_EQ(expectRight(join("difference", {a, join("difference", {a, a})}), usualLooks()), alone);
  EXPECT_EQ(expectRight(join("difference", {a}), usualLooks()), alone);
  EXPECT_EQ(expectRight(join("union", {join("difference", {a, b}), join("intersection", {a, b})}), usualLooks()), alone);
  EXPECT_GT(expectRight(join("difference", {b, join("difference", {b, a})}), usualLooks()), 1000u);
}

TEST(HardScenes, Case15_nesting_of_ten_thousand) {
  std::string open, close;
  for (int i = 0; i < 10000; ++i) open += i % 2 ? "union() {" : "difference() {", close += "}";
  EXPECT_GT(expectRight(open + box({-10, -10, -10}, {10, 10, 10}) + close, {usualLooks()[0]}, 32, 24), 20u);
}

TEST(HardScenes, Case15_mirrored_and_flat_leaves) {
  glm::dmat4 mirror(1.0), flat(1.0), nothing(0.0);
  mirror[0].x = -1;
  flat[2].z = 0;
  nothing[3].w = 1;
  const std::string block = box({-15, -15, -10}, {15, 15, 10}), odd = box({3, -8, -10}, {12, 4, 10});
  expectRight(join("difference", {block, moved(odd, mirror)}), usualLooks());
  for (const csg::InsideRule rule : {csg::InsideRule::Positive, csg::InsideRule::Odd}) {
    csg::RenderOptions options;
    options.inside = rule;
    EXPECT_GT(expectRight(modelOf(join("difference", {block, moved(odd, mirror)})), sized(usualLooks()[0], 128, 96), options), 1000u);
  }
  // A leaf without volume adds and takes nothing.
  const std::uint64_t alone = expectRight(block, usualLooks());
  for (const glm::dmat4& matrix : {flat, nothing}) EXPECT_EQ(expectRight(join("difference", {block, moved(kBall, matrix)}), usualLooks()), alone);
}

}  // namespace
}  // namespace copeel::validation
