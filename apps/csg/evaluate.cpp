// The meaning of a tree is that of openscad 2021.01, found by experiment:
// - a node of no children is the empty set, also as an operand: difference() { group(); cube(); } is nothing;
// - of nested colours the outermost one that names red, green and blue shows, or the innermost; a % operand is taken out of its operation; a ! anywhere is the whole model, without
//   the matrices above it;
// - an operand that carries # is seen through where a union holds it among others (so is the whole of a difference whose first operand carries
//   it), and lies over the solid elsewhere; what carries % or # within hull, minkowski or resize shows beside the one shape that these are;
// - in a difference or an intersection the first child with a dimension decides whether 2D or 3D ones count; the others are left out;
// - a matrix with NaN or infinity, or a singular one, leaves the empty set and a warning.
#include "apps/csg/evaluate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

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

constexpr std::uint8_t kShownMarks = kBackground | kHighlight;

// Of each node: whether one below it carries % or # and is shown.
std::vector<std::uint8_t> marksBelow(const SyntaxTree& tree) {
  std::vector<std::uint8_t> result(tree.nodes.size(), 0);
  const auto isMarked = [](const SyntaxNode& node) { return (node.modifiers & kShownMarks) != 0; };
  if (std::none_of(tree.nodes.begin(), tree.nodes.end(), isMarked)) return result;
  for (std::size_t i = result.size(); i-- > 0;) {
    if (!isTreeKeyword(tree.nodes[i].keyword) && !showsMarksWithin(tree.nodes[i].keyword)) continue;
    for (std::size_t child = i + 1; child < tree.nodes[i].subtreeEnd && !result[i]; child = tree.nodes[child].subtreeEnd) {
      result[i] = !(tree.nodes[child].modifiers & kDisabled) && (isMarked(tree.nodes[child]) || result[child]);
    }
  }
  return result;
}

bool isWhole(const std::optional<glm::dvec4>& color) { return color && color->r >= 0 && color->g >= 0 && color->b >= 0; }

class Evaluator {
 public:
  Evaluator(const SyntaxTree& tree, Shapes& shapes) : tree_(tree), shapes_(shapes), dimensions_(dimensionsOf(tree)), marksBelow_(marksBelow(tree)) {}

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
    bool isRender = false;
    std::uint8_t shapesAround = 0;
    bool marksOnly = false;              // within a shape: only what carries % or # is placed
    // The operands of a union below it are not seen by themselves.
    bool hidesUnions() const { return operation != Operation::Union || isRender || marksOnly; }
  };

  struct Operand {
    std::uint32_t node;
    bool marked;                         // with #
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
    const bool passedOver = open_.back().marksOnly && !(node.modifiers & kShownMarks);
    if (passedOver && !marksBelow_[index]) return node.subtreeEnd;
    const bool isShape = !isTreeKeyword(node.keyword);
    if (isShape && !passedOver) placeLeaf(index);
    if (isShape && (!marksBelow_[index] || open_.back().shapesAround == kMostShapesWithinShapes)) return node.subtreeEnd;
    Frame frame = frameOf(index);
    frame.marksOnly = isShape || passedOver;
    frame.shapesAround += isShape;
    if (node.keyword == Keyword::Color && !isWhole(placement().color)) pushPlacement(frame).color = colorOf(tree_, node);
    if (node.keyword == Keyword::Multmatrix && !multiply(pushPlacement(frame), node)) {
      placements_.pop_back();
      addOperand(addNode(Operation::Union, pending_.size()), node.modifiers);
      return node.subtreeEnd;
    }
    open_.push_back(frame);
    hidingFrames_ += frame.hidesUnions();
    return index + 1;
  }

  Frame frameOf(std::uint32_t index) const {
    const SyntaxNode& node = tree_.nodes[index];
    Frame frame = open_.back();
    frame.operation = operationOf(node.keyword);
    frame.modifiers = node.modifiers;
    frame.end = node.subtreeEnd;
    frame.dimension = dimensions_[index];
    frame.firstPending = static_cast<std::uint32_t>(pending_.size());
    frame.isRender = node.keyword == Keyword::Render;
    return frame;
  }

  bool isOfWrongDimension(std::uint32_t index) {
    const Frame& frame = open_.back();
    const bool counts = frame.operation != Operation::Union && !frame.marksOnly && !(tree_.nodes[index].modifiers & kBackground);
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
      model_.leaves.push_back({mesh, placement().worldFromChild, placement().color, dimensions_[index] == 2});
    } else {
      made = addNode(Operation::Union, pending_.size());
    }
    addOperand(made, node.modifiers);
  }

  void close() {
    const Frame frame = open_.back();
    open_.pop_back();
    hidingFrames_ -= frame.hidesUnions();
    placements_.resize(open_.back().placementCount);
    if (frame.marksOnly) return;
    const bool marked = settleMarks(frame);
    const std::size_t count = pending_.size() - frame.firstPending;
    // A node over a single operand is that operand.
    const std::uint32_t made = count == 1 ? pending_.back().node : addNode(frame.operation, frame.firstPending);
    pending_.resize(frame.firstPending);
    addOperand(made, static_cast<std::uint8_t>(frame.modifiers | (marked ? kHighlight : 0)));
  }

  // True where the operation carries # itself, by its operands; else those that do are shown.
  bool settleMarks(const Frame& frame) {
    const auto isMarked = [](const Operand& operand) { return operand.marked; };
    const std::span<const Operand> operands = std::span(pending_).subspan(frame.firstPending);
    if (std::none_of(operands.begin(), operands.end(), isMarked)) return false;
    const bool isDifference = frame.operation == Operation::Difference;
    if (!frame.isRender && (isDifference ? operands.front().marked : std::all_of(operands.begin(), operands.end(), isMarked))) return true;
    for (const Operand& operand : operands) {
      if (!operand.marked) continue;
      if (hidingFrames_ > 0 || frame.hidesUnions()) model_.highlight.push_back(operand.node);
      else makeTransparent(operand.node);
    }
    return false;
  }

  void makeTransparent(std::uint32_t root) {
    std::vector<std::uint32_t> nodes{root};
    while (!nodes.empty()) {
      const Node& node = model_.nodes[nodes.back()];
      nodes.pop_back();
      if (node.operation == Operation::Leaf) model_.leaves[node.leaf].color = kHighlightColor;
      const auto children = model_.childIndices.begin() + node.firstChild;
      nodes.insert(nodes.end(), children, children + node.childCount);
    }
  }

  // A node over the operands that wait from `firstPending` on.
  std::uint32_t addNode(Operation operation, std::size_t firstPending) {
    Node node;
    node.operation = operation;
    node.firstChild = static_cast<std::uint32_t>(model_.childIndices.size());
    node.childCount = static_cast<std::uint32_t>(pending_.size() - firstPending);
    for (std::size_t i = firstPending; i < pending_.size(); ++i) model_.childIndices.push_back(pending_[i].node);
    model_.nodes.push_back(node);
    return static_cast<std::uint32_t>(model_.nodes.size() - 1);
  }

  void addOperand(std::uint32_t node, std::uint8_t modifiers) {
    const bool marked = (modifiers & kHighlight) != 0;
    if (modifiers & kBackground) {
      model_.background.push_back(node);
    } else if (!open_.back().marksOnly) {
      pending_.push_back({node, marked});
    } else if (marked) {
      model_.highlight.push_back(node);
    }
  }

  void finishRoot() {
    const bool marked = settleMarks(open_.front());
    if (pending_.size() == 1) {
      model_.root = pending_.front().node;
    } else if (!pending_.empty()) {
      model_.root = addNode(Operation::Union, 0);
    }
    if (marked) model_.highlight.push_back(model_.root);
  }

  void warn(const SyntaxNode& node, const std::string& cause) {
    model_.warnings.push_back(fmt::format("{}:{}: {}", tree_.name, tree_.lineAt(node.textBegin), cause));
  }

  const SyntaxTree& tree_;
  Shapes& shapes_;
  std::vector<std::uint8_t> dimensions_, marksBelow_;
  Model model_;
  std::vector<Frame> open_;
  std::vector<Placement> placements_{Placement{}};
  std::vector<Operand> pending_;         // those whose operation is still open
  std::size_t hidingFrames_ = 0;         // open frames that hide unions
};

}  // namespace

Model evaluate(const SyntaxTree& tree, Shapes& shapes) { return Evaluator(tree, shapes).run(); }

}  // namespace copeel::csg
