// The meaning of a tree is that of openscad 2021.01, found by experiment:
// - a node of no children is the empty set, also as an operand: difference() { group(); cube(); } is nothing;
// - of nested colours the outermost one that names red, green and blue shows, or the innermost; a % operand is taken out of its operation; a ! anywhere is the whole model, without
//   the matrices above it;
// - in a difference or an intersection the first child with a dimension decides whether 2D or 3D ones count; the others are left out;
// - a matrix with NaN or infinity, or a singular one, leaves the empty set and a warning.
#include "apps/csg/evaluate.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <glm/matrix.hpp>

#include "apps/csg/arguments.h"

namespace copeel::csg {
namespace {

bool isFinite(const glm::dmat4& m) {
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) {
      if (!std::isfinite(m[c][r])) return false;
    }
  }
  return true;
}

bool isWhole(const std::optional<glm::dvec4>& color) { return color && color->r >= 0 && color->g >= 0 && color->b >= 0; }

class Evaluator {
 public:
  Evaluator(const SyntaxTree& tree, Shapes& shapes) : tree_(tree), shapes_(shapes), dimensions_(dimensionsOf(tree)) {}

  Model run() {
    auto [at, end] = rootRange();
    open_.push_back(rootFrame(end));
    while (at < end || open_.size() > 1) {
      if (open_.size() > 1 && at == open_.back().end) {
        close();
      } else {
        at = visit(at);
      }
    }
    finishRoot();
    return std::move(model_);
  }

 private:
  struct Frame {
    Operation operation = Operation::Union;
    std::uint8_t modifiers = 0;
    std::uint8_t dimension = 0;
    std::uint32_t end = 0;               // index past the last descendant
    std::uint32_t firstPending = 0;      // its operands wait from here on
    std::uint32_t placementCount = 1;    // the last of so many placements holds here
  };

  // Kept beside the frames: most levels of a deep nesting place nothing anew.
  struct Placement {
    glm::dmat4 worldFromChild{1.0};
    std::optional<glm::dvec4> color;
  };

  // The whole text, or the first subtree that carries !.
  std::pair<std::uint32_t, std::uint32_t> rootRange() const {
    for (std::uint32_t i = 0; i < tree_.nodes.size(); ++i) {
      if (tree_.nodes[i].modifiers & kRoot) return {i, tree_.nodes[i].subtreeEnd};
    }
    return {0, static_cast<std::uint32_t>(tree_.nodes.size())};
  }

  static Frame rootFrame(std::uint32_t end) {
    Frame frame;
    frame.end = end;
    return frame;
  }

  // Opens a tree node or places a leaf; returns the index to go on with.
  std::uint32_t visit(std::uint32_t index) {
    const SyntaxNode& node = tree_.nodes[index];
    if (node.modifiers & kDisabled || isOfWrongDimension(index)) return node.subtreeEnd;
    if (!isTreeKeyword(node.keyword)) {
      placeLeaf(index);
      return node.subtreeEnd;
    }
    Frame frame = open_.back();
    frame.operation = operationOf(node.keyword);
    frame.modifiers = node.modifiers;
    frame.end = node.subtreeEnd;
    frame.dimension = dimensions_[index];
    frame.firstPending = static_cast<std::uint32_t>(pending_.size());
    if (node.keyword == Keyword::Color && !isWhole(placement().color)) pushPlacement(frame).color = colorOf(tree_, node);
    if (node.keyword == Keyword::Multmatrix && !multiply(pushPlacement(frame), node)) {
      placements_.pop_back();
      addOperand(addNode(Operation::Union, pending_.size()), node.modifiers);
      return node.subtreeEnd;
    }
    open_.push_back(frame);
    return index + 1;
  }

  bool isOfWrongDimension(std::uint32_t index) {
    const Frame& frame = open_.back();
    const bool counts = frame.operation != Operation::Union && !(tree_.nodes[index].modifiers & kBackground);
    if (!counts || dimensions_[index] == 0 || dimensions_[index] == frame.dimension) return false;
    warn(tree_.nodes[index], fmt::format("2D and 3D do not mix here: this {}D {} is left out", int{dimensions_[index]},
                                         tree_.nameOf(tree_.nodes[index])));
    return true;
  }

  const Placement& placement() const { return placements_.back(); }

  Placement& pushPlacement(Frame& frame) {
    placements_.push_back(Placement(placements_.back()));
    frame.placementCount = static_cast<std::uint32_t>(placements_.size());
    return placements_.back();
  }

  static Operation operationOf(Keyword keyword) {
    if (keyword == Keyword::Difference) return Operation::Difference;
    return keyword == Keyword::Intersection ? Operation::Intersection : Operation::Union;
  }

  // False: the subtree vanishes.
  bool multiply(Placement& inner, const SyntaxNode& node) {
    const glm::dmat4 matrix = matrixOf(tree_, node);
    const bool finite = isFinite(matrix);
    if (finite && glm::determinant(glm::dmat3(matrix)) != 0) {
      inner.worldFromChild = inner.worldFromChild * matrix;
      if (isFinite(inner.worldFromChild)) return true;
    }
    warn(node, finite ? "a singular matrix flattens its children: they are left out"
                      : "a matrix with NaN or infinity: its children are left out");
    return false;
  }

  void placeLeaf(std::uint32_t index) {
    const SyntaxNode& node = tree_.nodes[index];
    const MeshPointer mesh = shapes_.meshOf(index);
    std::uint32_t made;
    if (mesh) {
      made = addNode(Operation::Leaf, pending_.size());
      model_.nodes.back().leaf = static_cast<std::uint32_t>(model_.leaves.size());
      model_.leaves.push_back({mesh, placement().worldFromChild, placement().color});
    } else {
      made = addNode(Operation::Union, pending_.size());
    }
    addOperand(made, node.modifiers);
  }

  void close() {
    const Frame frame = open_.back();
    open_.pop_back();
    placements_.resize(open_.back().placementCount);
    const std::size_t count = pending_.size() - frame.firstPending;
    // A node over a single operand is that operand.
    const std::uint32_t made = count == 1 ? pending_.back() : addNode(frame.operation, frame.firstPending);
    pending_.resize(frame.firstPending);
    addOperand(made, frame.modifiers);
  }

  // A node over the operands that wait from `firstPending` on.
  std::uint32_t addNode(Operation operation, std::size_t firstPending) {
    Node node;
    node.operation = operation;
    node.firstChild = static_cast<std::uint32_t>(model_.childIndices.size());
    node.childCount = static_cast<std::uint32_t>(pending_.size() - firstPending);
    model_.childIndices.insert(model_.childIndices.end(), pending_.begin() + static_cast<std::ptrdiff_t>(firstPending), pending_.end());
    model_.nodes.push_back(node);
    return static_cast<std::uint32_t>(model_.nodes.size() - 1);
  }

  void addOperand(std::uint32_t node, std::uint8_t modifiers) {
    if (modifiers & kBackground) {
      model_.background.push_back(node);
      return;
    }
    if (modifiers & kHighlight) model_.highlight.push_back(node);
    pending_.push_back(node);
  }

  void finishRoot() {
    if (pending_.size() == 1) {
      model_.root = pending_.front();
    } else if (!pending_.empty()) {
      model_.root = addNode(Operation::Union, 0);
    }
  }

  void warn(const SyntaxNode& node, const std::string& cause) {
    model_.warnings.push_back(fmt::format("{}:{}: {}", tree_.name, tree_.lineAt(node.textBegin), cause));
  }

  const SyntaxTree& tree_;
  Shapes& shapes_;
  std::vector<std::uint8_t> dimensions_;
  Model model_;
  std::vector<Frame> open_;
  std::vector<Placement> placements_{Placement{}};
  std::vector<std::uint32_t> pending_;   // operands whose operation is still open
};

}  // namespace

Model evaluate(const SyntaxTree& tree, Shapes& shapes) { return Evaluator(tree, shapes).run(); }

}  // namespace copeel::csg
