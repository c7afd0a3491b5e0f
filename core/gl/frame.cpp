#include "core/gl/frame.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <glm/geometric.hpp>

#include "core/error.h"
#include "core/gl/context.h"
#include "core/gl/depth_keys.h"
#include "core/gl/layout.h"

namespace copeel::gl {
namespace {

constexpr GLuint kDepthUnit = 8;

// What a pass wrote is there for the next one, for buffers that are cleared, and for us.
constexpr GLbitfield kAfterPass = GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT;

// The uniform block of project.comp.glsl, std140.
struct ProjectionBlock {
  glm::dvec4 eye, clipX, clipY, forward, depth;
  std::uint32_t perspective, objectCount, firstClip, clipCount;
};

// The uniform block of frame.glsl, std140.
struct FrameBlock {
  glm::dvec2 center;
  double depthOrigin;
  std::uint32_t depthNearest[2];
  std::int32_t depthShift, depthSign, size[2], depthHardware;
  std::uint32_t depthKeys, padding[2];
};
static_assert(sizeof(FrameBlock) == 64);

struct PlaneRecord {
  double a, b, c;
  float lo, hi;
};
static_assert(sizeof(PlaneRecord) == 32);

// The distances that the projection's depth runs between: the scene's, or the near distance where it is nearer.
std::pair<double, double> depthRange(const Scene& scene, const View& view) {
  const Box& box = scene.bounds();
  const double middle = glm::dot(view.forward, box.center() - view.eye), half = 0.5 * box.diagonal();
  const double margin = 1e-3 * half + 1e-6 * std::abs(middle);
  const double near = middle - half - margin, far = middle + half + margin;
  if (!view.perspective) return {near, std::max(far, near + 1e-30)};
  const double least = nearDistance(scene, view);
  return {std::max(near, least), std::max(far, 2 * least)};
}

ProjectionBlock projectionBlock(const Scene& scene, const View& view) {
  const auto [near, far] = depthRange(scene, view);
  const double halfWidth = 0.5 * view.width, halfHeight = 0.5 * view.height;
  ProjectionBlock block{};
  block.eye = {view.eye, 0};
  block.clipX = {view.right / (glm::dot(view.right, view.right) * halfWidth), view.offset.x / halfWidth};
  block.clipY = {view.down / (glm::dot(view.down, view.down) * halfHeight), view.offset.y / halfHeight};
  block.forward = {view.forward, 0};
  block.depth = view.perspective ? glm::dvec4((far + near) / (far - near), -2 * far * near / (far - near), 0, 0)
                                 : glm::dvec4(2 / (far - near), -(far + near) / (far - near), 0, 0);
  block.perspective = view.perspective;
  return block;
}

// What the buffer held is lost, so it goes before there is another.
void grow(Buffer& buffer, std::size_t bytes) {
  if (buffer.bytes() >= bytes) return;
  buffer = Buffer();
  buffer = Buffer(bytes);
}

std::size_t texelBytes(GLenum format) {
  switch (format) {
    case GL_R32UI: case GL_R32F: case GL_RGBA8: return 4;
    case GL_RG32UI: case GL_RG32F: return 8;
    case GL_RGB32UI: return 12;
    case GL_RGBA32UI: case GL_RGBA32F: return 16;
  }
  COPEEL_CHECK(false, "format {}", format);
  return 0;
}

}  // namespace

Frame::Frame(const SceneBuffers& scene, Programs& programs, DepthSource depthSource)
    : scene_(scene), programs_(programs), depthSource_(depthSource), clip_(std::size_t{scene.clipCount()} * 16), frameBlock_(sizeof(FrameBlock)) {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  noVertices_ = VertexArray(name);
  glCreateQueries(GL_ANY_SAMPLES_PASSED, 1, &name);
  query_ = Query(name);
}

void Frame::setView(const View& view, const DepthPlanes& depths) {
  view_ = view;
  depths_ = depths;
  culling_.reset();
  if (width_ != view.width || height_ != view.height) {
    width_ = view.width, height_ = view.height;
    makeTargets();
  }
  sceneBox_ = windowBox(scene_.scene().bounds(), glm::dmat4(1.0), view, nearDistance(scene_.scene(), view));
  project();
  writeFrameBlock(depths);
  checkErrors("setting up the view");
}

void Frame::makeTargets() {
  GLuint name = 0;
  depthShare_ = DeviceMemory(pixelCount() * sizeof(float));
  glCreateTextures(GL_TEXTURE_2D, 1, &name);
  depth_ = Texture(name);
  glTextureStorage2D(name, 1, GL_DEPTH_COMPONENT32F, width_, height_);
  glCreateFramebuffers(1, &name);
  framebuffer_ = Framebuffer(name);
  glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, depth_, 0);
  glNamedFramebufferDrawBuffer(name, GL_NONE);
  if (glCheckNamedFramebufferStatus(name, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) failMachine("gl: no framebuffer of {}×{}", width_, height_);
  glBindTextureUnit(kDepthUnit, depth_);
  // Pixel passes write buffers alone, so that they may read what geometry passes drew.
  glCreateFramebuffers(1, &name);
  noTargets_ = Framebuffer(name);
  glNamedFramebufferParameteri(name, GL_FRAMEBUFFER_DEFAULT_WIDTH, width_);
  glNamedFramebufferParameteri(name, GL_FRAMEBUFFER_DEFAULT_HEIGHT, height_);
  buffers_.clear();
  targets_.clear();
  look.reset();
  nodesInOneMemory = false;
  writtenBox_ = whole();
}

void Frame::project() {
  ProjectionBlock block = projectionBlock(scene_.scene(), view_);
  static constexpr std::uint32_t kGroupSize = 64, kVerticesPerDispatch = 32768 * kGroupSize;   // the least groups that drivers take is 65,535
  const Program& program = programs_.find("core/gl/project.comp.glsl", "", {});
  glUseProgram(program.name());
  scene_.vertices().bindStorage(COPEEL_BUFFER_VERTICES);
  scene_.placements().bindStorage(COPEEL_BUFFER_PLACEMENTS);
  clip_.bindStorage(COPEEL_BUFFER_CLIP);
  block.objectCount = static_cast<std::uint32_t>(scene_.scene().objects().size());
  for (std::uint32_t first = 0; first < scene_.clipCount(); first += kVerticesPerDispatch) {
    const std::uint32_t count = std::min(kVerticesPerDispatch, scene_.clipCount() - first);
    block.firstClip = first;
    block.clipCount = first + count;
    const Buffer uniforms(sizeof block, &block);
    uniforms.bindUniform(COPEEL_BLOCK_FRAME);
    glDispatchCompute((count + kGroupSize - 1) / kGroupSize, 1, 1);
  }
  glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
}

void Frame::writeFrameBlock(const DepthPlanes& depths) {
  const DepthScale scale = depthScale(depths, view_.perspective);
  FrameBlock block{};
  block.center = glm::dvec2(0.5 * width_, 0.5 * height_) - 0.5 - view_.offset;
  block.depthOrigin = scale.origin;
  block.depthNearest[0] = static_cast<std::uint32_t>(scale.nearest);
  block.depthNearest[1] = static_cast<std::uint32_t>(scale.nearest >> 32);
  block.depthShift = scale.shift;
  block.depthSign = scale.sign;
  block.size[0] = width_, block.size[1] = height_;
  block.depthKeys = scale.keys;
  block.depthHardware = depthSource_ == DepthSource::Hardware;
  frameBlock_.write(&block, sizeof block);

  std::vector<PlaneRecord> records;
  records.reserve(depths.size());
  for (const DepthPlane& plane : depths) {
    const bool holdsEye = std::isinf(plane.error());
    records.push_back({plane.a, plane.b, plane.c, holdsEye ? 1.0f : plane.lo, holdsEye ? 0.0f : plane.hi});
  }
  planes_ = Buffer(records);
  texels(planes_, COPEEL_TEXTURE_PLANES, GL_RGBA32UI);
  texels(scene_.primitives(), COPEEL_TEXTURE_PRIMITIVES, GL_RG32UI);
}

void Frame::setFold(const FoldSource& fold) {
  if (fold.resultWords != fold_.resultWords) writtenBox_ = whole();
  fold_ = fold;
  checkFoldBytes(resultBytes() + (fold.inMemory ? stateBytes() : 0));
  if (results_.bytes() < resultBytes()) writtenBox_ = whole();
  grow(results_, resultBytes());
  for (std::size_t i = 0; i < fold.tables.size(); ++i) {
    if (fold.tables[i].texels != GL_NONE) texels(*fold.tables[i].buffer, static_cast<int>(COPEEL_TEXTURE_FOLD_TABLE + i), fold.tables[i].texels);
  }
}

void Frame::checkFoldBytes(std::uint64_t bytes) const {
  if (bytes > kMostFoldBytes) failMachine("gl: {} MB for the state and results of {} pixels; use --backend cpu", bytes >> 20, pixelCount());
}

const Program& Frame::geometryProgram(const std::string& file, const std::string& pass, const Defines& defines) {
  Defines all = fold_.defines;
  all.insert(all.end(), defines.begin(), defines.end());
  all.emplace_back("PASS_" + pass, "1");
  return programs_.find("core/gl/geometry.vert.glsl", file, all);
}

const Program& Frame::pixelProgram(const std::string& file, const std::string& pass, const Defines& defines) {
  Defines all = fold_.defines;
  all.insert(all.end(), defines.begin(), defines.end());
  all.emplace_back("PASS_" + pass, "1");
  all.emplace_back("PIXEL_PASS", file);
  return programs_.find("core/gl/pixels.vert.glsl", "core/gl/pixels.glsl", all);
}

const Buffer& Frame::buffer(const std::string& name, int slot, std::size_t bytes) {
  Named& named = buffers_[name];
  grow(named.buffer, bytes);
  named.asked = bytes;
  named.usedIn = frames_;
  named.buffer.bindStorage(static_cast<GLuint>(COPEEL_BUFFER_METHOD + slot));
  return named.buffer;
}

void Frame::texels(const Buffer& buffer, int unit, GLenum format) {
  const std::size_t count = buffer.bytes() / texelBytes(format);
  if (count > DeviceMemory::mostTexels()) failMachine("gl: {} texels are more than the {} that the device reads of a buffer", count, DeviceMemory::mostTexels());
  GLuint texture = 0;
  glCreateTextures(GL_TEXTURE_BUFFER, 1, &texture);
  texels_[unit] = Texture(texture);
  glTextureBuffer(texture, format, buffer.name());
  glBindTextureUnit(static_cast<GLuint>(unit), texture);
}

const Buffer& Frame::pixelWords(const std::string& name, int slot, std::size_t wordsPerPixel) {
  return buffer(name, slot, pixelCount() * wordsPerPixel * sizeof(std::uint32_t));
}

std::size_t Frame::keptBytes(const std::string& name) const {
  const auto found = buffers_.find(name);
  return found == buffers_.end() ? 0 : found->second.buffer.bytes();
}

std::uint64_t Frame::heldBytes() const {
  std::uint64_t bytes = 0;
  for (const auto& [name, buffer] : buffers_) bytes += buffer.buffer.bytes();
  for (const auto& [name, target] : targets_) bytes += target.format ? pixelCount() * texelBytes(target.format) : 0;
  return bytes;
}

void Frame::releaseBuffers() {
  buffers_.clear();
  // Textures of them would hold their memory.
  std::erase_if(texels_, [](const auto& texture) { return texture.first >= COPEEL_TEXTURE_METHOD && texture.first < COPEEL_TEXTURE_FOLD_TABLE; });
}

std::uint64_t Frame::methodBytes() const {
  std::uint64_t bytes = depthUsedIn_ == frames_ ? pixelCount() * sizeof(float) : 0;
  for (const auto& [name, buffer] : buffers_) bytes += buffer.usedIn == frames_ ? buffer.asked : 0;
  for (const auto& [name, target] : targets_) bytes += target.usedIn == frames_ ? pixelCount() * texelBytes(target.format) : 0;
  return bytes;
}

void Frame::target(const std::string& name, int attachment, GLenum format) {
  Target& target = targets_[name];
  if (target.format != format) {
    GLuint texture = 0;
    target.share = DeviceMemory(pixelCount() * texelBytes(format));
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    target.texture = Texture(texture);
    glTextureStorage2D(texture, 1, format, width_, height_);
    // An integer texture that would be filtered reads as 0.
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    target.format = format;
  }
  target.usedIn = frames_;
  glNamedFramebufferTexture(framebuffer_, static_cast<GLenum>(GL_COLOR_ATTACHMENT0 + attachment), target.texture, 0);
  glBindTextureUnit(static_cast<GLuint>(attachment), target.texture);
}

void Frame::writeTargets(int count) {
  GLenum attachments[8];
  for (int i = 0; i < count; ++i) attachments[i] = static_cast<GLenum>(GL_COLOR_ATTACHMENT0 + i);
  if (count > 0) glNamedFramebufferDrawBuffers(framebuffer_, count, attachments);
  else glNamedFramebufferDrawBuffer(framebuffer_, GL_NONE);
  targetCount_ = count;
}

void Frame::clearTarget(int attachment, GLuint word) {
  const GLuint words[] = {word, word, word, word};
  glClearNamedFramebufferuiv(framebuffer_, GL_COLOR, attachment, words);
}

void Frame::clearTarget(int attachment, const glm::vec4& value) { glClearNamedFramebufferfv(framebuffer_, GL_COLOR, attachment, &value.x); }

void Frame::begin() {
  ++frames_;
  objectsDrawn_.clear();
  passBegan_.clear();
  culls_ = false;
  writeTargets(0);
  drawAtSize(width_, height_);
  glDisable(GL_CULL_FACE);
  // Rows run downwards here, which turns triangles about.
  glFrontFace(GL_CW);
  frameBlock_.bindUniform(COPEEL_BLOCK_FRAME);
  scene_.primitives().bindStorage(COPEEL_BUFFER_PRIMITIVES);
  results_.bindStorage(COPEEL_BUFFER_FOLD_RESULT);
  for (std::size_t i = 0; i < fold_.tables.size(); ++i) {
    if (fold_.tables[i].texels == GL_NONE) fold_.tables[i].buffer->bindStorage(static_cast<GLuint>(COPEEL_BUFFER_FOLD_TABLE + i));
  }
  emptyOutside();
  noDepthTest();
  usesStates_ = false;
  if (fold_.inMemory) beginStates();
}

// Results outside of the scene's box are those of pixels without fragments, which are zeros. They stay so while the box does.
void Frame::emptyOutside() {
  if (!contains(sceneBox_, writtenBox_)) results_.clear(0);
  writtenBox_ = sceneBox_;
}

void Frame::makeStates() {
  checkFoldBytes(stateBytes() + resultBytes());
  grow(states_, stateBytes());
  states_.bindStorage(COPEEL_BUFFER_FOLD_STATE);
}

void Frame::beginStates() {
  if (usesStates_) return;
  usesStates_ = true;
  makeStates();
  drawPixels(pixelProgram("core/gl/begin.glsl", "BEGIN"));
}

void Frame::finish() {
  noDepthTest();
  if (usesStates_) drawPixels(pixelProgram("core/gl/begin.glsl", "FINISH"));
  glFinish();
  passBegan_.push_back(std::chrono::steady_clock::now());
  checkErrors("drawing");
}

std::vector<double> Frame::passMs() const {
  std::vector<double> all;
  for (std::size_t i = 1; i < passBegan_.size(); ++i) all.push_back(std::chrono::duration<double, std::milli>(passBegan_[i] - passBegan_[i - 1]).count());
  return all;
}

void Frame::drawAtSize(int width, int height) { glViewport(0, 0, width, height); }

void Frame::drawObjects(const Program& program, std::uint32_t begin, std::uint32_t end) {
  // A pass without targets and depth test may read them all.
  glBindFramebuffer(GL_FRAMEBUFFER, targetCount_ > 0 || depthTested_ ? framebuffer_ : noTargets_);
  glUseProgram(program.name());
  std::uint32_t count = end - begin;
  if (culls_) count = culling_->draw(begin, end, [&](std::uint32_t first, std::uint32_t last) { scene_.draw(clip_, first, last); });
  else scene_.draw(clip_, begin, end);
  if (!objectsDrawn_.empty()) objectsDrawn_.back() += count;
  glMemoryBarrier(kAfterPass);
}

void Frame::hideBehind(const std::vector<std::uint8_t>& opaque) {
  grow(opaque_, pixelCount() * 4);
  opaque_.clear(COPEEL_KEY_NONE);
  opaque_.bindStorage(COPEEL_BUFFER_OPAQUE);
  const Program& program = geometryProgram("core/gl/opaque.glsl", "OPAQUE");
  beginPass();
  const auto count = static_cast<std::uint32_t>(opaque.size());
  for (std::uint32_t begin = 0, end = 0; begin < count; begin = end + 1) {
    for (end = begin; end < count && opaque[end];) ++end;
    if (begin < end) drawObjects(program, begin, end);
  }
}

void Frame::cullObjects(const Program& box) {
  if (!culling_) culling_ = std::make_unique<Culling>(objectBoxes(scene_.scene(), scene_.planes(), view_, depths_, depthSource_ == DepthSource::Hardware));
  if (!culls_) culling_->restart();
  culls_ = true;
  culling_->ask(box, [&](const PixelRect& pixels) { drawPixels(box, pixels); });
}

void Frame::drawPixels(const Program& program, const PixelRect& pixels) {
  glBindFramebuffer(GL_FRAMEBUFFER, noTargets_);
  glUseProgram(program.name());
  glBindVertexArray(noVertices_);
  glEnable(GL_SCISSOR_TEST);
  glScissor(pixels.x, pixels.y, pixels.width, pixels.height);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_SCISSOR_TEST);
  glMemoryBarrier(kAfterPass);
}

void Frame::clearDepth() {
  const GLfloat none = std::bit_cast<float>(COPEEL_KEY_NONE);
  glDepthMask(GL_TRUE);
  glClearNamedFramebufferfv(framebuffer_, GL_DEPTH, 0, &none);
}

void Frame::testDepth(GLenum function, bool write) {
  glEnable(GL_DEPTH_TEST);
  depthTested_ = true;
  glDepthFunc(function);
  glDepthMask(write ? GL_TRUE : GL_FALSE);
  depthUsedIn_ = frames_;
}

void Frame::noDepthTest() {
  glDisable(GL_DEPTH_TEST);
  depthTested_ = false;
}

bool Frame::anySamplesOf(const std::function<void()>& passes) {
  glBeginQuery(GL_ANY_SAMPLES_PASSED, query_);
  passes();
  glEndQuery(GL_ANY_SAMPLES_PASSED);
  GLuint any = 0;
  glGetQueryObjectuiv(query_, GL_QUERY_RESULT, &any);
  return any != 0;
}

std::vector<std::uint32_t> Frame::result() const {
  return results_.read<std::uint32_t>(pixelCount() * fold_.resultWords);
}

void Frame::visitResult(const std::function<void(int, std::span<const std::uint32_t>)>& visitor) const {
  const std::size_t rowWords = static_cast<std::size_t>(width_) * fold_.resultWords;
  const std::size_t first = static_cast<std::size_t>(sceneBox_.y) * rowWords, count = static_cast<std::size_t>(sceneBox_.height) * rowWords;
  results_.visit(first * sizeof(std::uint32_t), count * sizeof(std::uint32_t), [&](const void* bytes) {
    visitor(sceneBox_.y, {static_cast<const std::uint32_t*>(bytes), count});
  });
}

}  // namespace copeel::gl
