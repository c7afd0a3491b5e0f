// Expressions over meshes: a shunting yard, so that no nesting of parentheses needs recursion.
#include <map>

#include <fmt/format.h>

#include "apps/csg/read_model.h"
#include "core/error.h"
#include "core/formats/read_mesh.h"

namespace copeel::csg {
namespace {

constexpr std::size_t kLetters = 26;

class Expression {
 public:
  Expression(const std::vector<std::string>& paths, const std::string& text, Model& model, std::vector<std::size_t>* fileOfLeaf)
      : paths_(paths), text_(text), model_(model), fileOfLeaf_(fileOfLeaf) {}

  void parse() {
    bool wantsOperand = true;
    for (skipSpace(); at_ < text_.size(); skipSpace()) {
      const char c = text_[at_];
      if (wantsOperand) {
        if (c == '(') {
          operators_.push_back('(');
          ++at_;
        } else {
          operands_.push_back(leafOf(readMeshIndex()));
          wantsOperand = false;
        }
        continue;
      }
      if (c == ')') {
        closeParenthesis();
      } else {
        pushOperator(c);
        wantsOperand = true;
      }
      ++at_;
    }
    if (wantsOperand) fail("a mesh is missing at the end");
    finish();
  }

 private:
  static Operation operationOf(char c) {
    if (c == '+' || c == '|') return Operation::Union;
    if (c == '-') return Operation::Difference;
    return c == '&' || c == '*' ? Operation::Intersection : Operation::Leaf;
  }

  static int strengthOf(Operation operation) { return operation == Operation::Intersection ? 2 : 1; }

  // All operators associate to the left: equal strength is applied first.
  void pushOperator(char c) {
    const Operation operation = operationOf(c);
    if (operation == Operation::Leaf) fail(fmt::format("expected an operator, found '{}'", printable(c)));
    while (!operators_.empty() && operators_.back() != '(' && strengthOf(operationOf(operators_.back())) >= strengthOf(operation)) apply();
    operators_.push_back(c);
  }

  void closeParenthesis() {
    while (!operators_.empty() && operators_.back() != '(') apply();
    if (operators_.empty()) fail("a ) without its (");
    operators_.pop_back();
  }

  void finish() {
    while (!operators_.empty()) {
      if (operators_.back() == '(') fail("a ( without its )");
      apply();
    }
    model_.root = operands_.back();
  }

  void apply() {
    const std::uint32_t right = operands_.back();
    operands_.pop_back();
    Node node;
    node.operation = operationOf(operators_.back());
    operators_.pop_back();
    node.firstChild = static_cast<std::uint32_t>(model_.childIndices.size());
    node.childCount = 2;
    model_.childIndices.insert(model_.childIndices.end(), {operands_.back(), right});
    model_.nodes.push_back(node);
    operands_.back() = static_cast<std::uint32_t>(model_.nodes.size() - 1);
  }

  // A letter, or M and a number counted from 1, which reaches beyond Z.
  std::size_t readMeshIndex() {
    const char c = text_[at_];
    if (c < 'A' || c > 'Z') fail(fmt::format("expected a mesh (A, B, …) or (, found '{}'", printable(c)));
    const std::size_t begin = at_++;
    std::size_t index = static_cast<std::size_t>(c - 'A');
    std::size_t number = 0;
    for (; c == 'M' && at_ < text_.size() && text_[at_] >= '0' && text_[at_] <= '9'; ++at_) {
      number = std::min<std::size_t>(10 * number + static_cast<std::size_t>(text_[at_] - '0'), 1'000'000'000);
      index = number - 1;
    }
    if (index < paths_.size()) return index;
    const std::string name = text_.substr(begin, at_ - begin);
    at_ = begin;
    fail(fmt::format("there is no mesh {}: {} given", name, paths_.size()));
  }

  // A file named twice is read once.
  std::uint32_t leafOf(std::size_t index) {
    std::shared_ptr<const Mesh>& mesh = meshes_[paths_[index]];
    if (!mesh) {
      mesh = std::make_shared<const Mesh>(readMesh(paths_[index]));
      const std::string found = statusOf(*mesh).summary();
      if (!found.empty()) model_.warnings.push_back(fmt::format("{}: {}", paths_[index], found));
    }
    Node node;
    node.operation = Operation::Leaf;
    node.leaf = static_cast<std::uint32_t>(model_.leaves.size());
    model_.leaves.push_back({mesh, glm::dmat4(1.0), std::nullopt});
    if (fileOfLeaf_) fileOfLeaf_->push_back(index);
    model_.nodes.push_back(node);
    return static_cast<std::uint32_t>(model_.nodes.size() - 1);
  }

  void skipSpace() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }

  static char printable(char c) { return c >= 0x20 && c < 0x7F ? c : '?'; }

  [[noreturn]] void fail(const std::string& cause) const { failUsage("expression: character {}: {}", at_ + 1, cause); }

  const std::vector<std::string>& paths_;
  const std::string& text_;
  Model& model_;
  std::vector<std::size_t>* fileOfLeaf_;   // null: not wanted
  std::size_t at_ = 0;
  std::vector<std::uint32_t> operands_;
  std::vector<char> operators_;
  std::map<std::string, std::shared_ptr<const Mesh>> meshes_;
};

std::string nameOf(std::size_t index) {
  return index < kLetters ? std::string(1, static_cast<char>('A' + index)) : fmt::format("M{}", index + 1);
}

}  // namespace

Model readMeshes(const std::vector<std::string>& paths, const std::string& expression, std::vector<std::size_t>* fileOfLeaf) {
  if (paths.empty()) failUsage("no mesh is given");
  Model model;
  std::string text = expression;
  if (text.find_first_not_of(" \t") == std::string::npos) {
    text.clear();
    for (std::size_t i = 0; i < paths.size(); ++i) {
      if (i > 0) text += '+';
      text += nameOf(i);
    }
  }
  Expression(paths, text, model, fileOfLeaf).parse();
  return model;
}

}  // namespace copeel::csg
