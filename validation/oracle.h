// The exact answer: what each pixel of a CSG model, or of the mesh of its result, must show. It judges the renderer and shares no code with it.
//
// CsgOracle walks the crossings of one ray with all leaves in exact order, keeps a winding number per leaf, applies all crossings of one depth
// together, and asks the tree before and after: the first change from outside to inside is what is seen. It answers where no exact
// Boolean kernel can (self-intersecting leaves, winding numbers of two, leaves turned one by one).
// MeshOracle asks the same of a single closed mesh, such as the result of an exact Boolean.
//
// Rules, as DESIGN.md states them: inside is winding ≠ 0 (or > 0, or odd). Where several faces of one depth could show, the later operand wins, at
// every node of the tree. Perspective rays start at the eye, where a closed leaf's winding number is what its crossings in front leave over
// and an open leaf's is 0 outside its box and the rounded generalised winding number within (Jacobson et al., Robust Inside-Outside
// Segmentation using Generalized Winding Numbers, ACM ToG 2013). A face that the eye lies on, to within 1e-10 of the scene's diagonal, is behind
// it. Orthographic rays come from infinity.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "apps/csg/csg_model.h"
#include "apps/csg/render_csg.h"
#include "core/scene/view.h"
#include "validation/ray_caster.h"

namespace copeel::validation {

// What a ray sees first.
struct Seen {
  double depth = 0;             // along the view axis, model units
  std::uint32_t leaf = 0;       // index into the model's leaves; at and past their number: a section's cap
  std::uint32_t triangle = 0;   // of the ray caster, whose plane is seen
};

// A pixel for the comparison: what it shows and whether a small step could show something else.
struct Oracle {
  virtual ~Oracle() = default;
  virtual std::optional<Seen> see(const Ray& ray) const = 0;
  virtual const RayCaster& caster() const = 0;
  virtual double tolerance() const = 0;   // declared: faces closer than this are one (model units)
  virtual double diagonal() const = 0;    // of the scene, model units
};

struct CsgOracleOptions {
  double tolerance = -1;                         // model units; negative: the declared one; 0: exactly equal depths only
  csg::InsideRule inside = csg::InsideRule::NonZero;
  std::vector<csg::Section> sections;
};

class CsgOracle : public Oracle {
 public:
  CsgOracle(const csg::Model& model, const View& view, const CsgOracleOptions& options = {});

  std::optional<Seen> see(const Ray& ray) const override;
  const RayCaster& caster() const override { return *caster_; }
  double tolerance() const override { return tolerance_; }
  double diagonal() const override { return diagonal_; }

  // Every change of the solid along a ray, nearest first: entering and leaving in turn unless the eye is inside.
  struct Change {
    Seen seen;
    bool entering = true;
  };
  std::vector<Change> changes(const Ray& ray) const;

 private:
  // A node's state on both sides of a group, and the leaf whose face shows where they differ.
  struct NodeState {
    bool before = false, after = false;
    std::uint32_t face = 0;
  };

  void addSections(const std::vector<csg::Section>& sections);
  std::vector<int> windingAtStart(const std::vector<Crossing>& crossings) const;
  bool inside(int winding) const;
  NodeState evaluate(const std::vector<int>& before, const std::vector<int>& after) const;
  NodeState combine(const csg::Node& node, const std::vector<NodeState>& states) const;
  template <class Visit>
  void walk(const Ray& ray, Visit visit) const;

  csg::Model model_;
  CsgOracleOptions options_;
  std::vector<OracleMesh> leaves_;
  std::vector<bool> closed_;
  std::vector<int> openWindingAtEye_;
  std::unique_ptr<RayCaster> caster_;
  double tolerance_ = 0, diagonal_ = 0;
};

class MeshOracle : public Oracle {
 public:
  // The diagonal is that of the scene the mesh came from: tolerances are relative to it.
  MeshOracle(const OracleMesh& result, const View& view, double sceneDiagonal);

  std::optional<Seen> see(const Ray& ray) const override;
  const RayCaster& caster() const override { return caster_; }
  double tolerance() const override { return 0; }
  double diagonal() const override { return diagonal_; }

 private:
  RayCaster caster_;
  double diagonal_;
};

// What lies nearer before a perspective eye counts as behind it; of the scene's diagonal.
inline constexpr double kNearShare = 1e-10;

// The tolerance that the program declares for double input, in model units.
double declaredTolerance(const Box& bounds);

// Bounds of all leaves, used or not, in world units.
Box boundsOf(const csg::Model& model);

// The generalised winding number of a mesh at a point, not rounded.
double generalisedWinding(const OracleMesh& mesh, const glm::dvec3& point);

}  // namespace copeel::validation
