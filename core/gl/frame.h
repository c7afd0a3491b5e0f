// One view of a scene on the device, and the passes a method is made of: geometry passes, which gather fragments, and pixel passes, which
// resolve them. A method asks for programs and buffers by name; both are kept between frames.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include <glm/vec4.hpp>

#include "core/coplanarity/depth_planes.h"
#include "core/gl/culling.h"
#include "core/gl/program.h"
#include "core/gl/scene.h"
#include "core/image/image.h"

namespace copeel::gl {

// Where depth keys come from: plane classes (the default), or the rasterizer, as in the papers.
enum class DepthSource { Planes, Hardware };

// What a fold reads: as storage, or as texels of a format.
struct FoldTable {
  const Buffer* buffer = nullptr;
  GLenum texels = GL_NONE;
};

// What an application wants of each pixel: GLSL functions (core/gl/fold.glsl says which) and the tables they read.
struct FoldSource {
  Defines defines;                                   // FOLD: its file; and what the file wants
  std::uint32_t stateWords = 0;                      // per pixel and side (front, back), 32-bit words
  std::uint32_t resultWords = 0;                     // per pixel
  bool inMemory = false;                             // it has no state but that in memory: foldReset() and foldFinishFront() are missing
  std::vector<FoldTable> tables;                     // bound from COPEEL_BUFFER_FOLD_TABLE on, or from COPEEL_TEXTURE_FOLD_TABLE on
};

// What a pass that only counts has seen of the scene.
struct Look {
  std::uint64_t fragments = 0;
  std::uint32_t deepest = 0;        // fragments of a pixel
  bool wasTooLittle = false;        // a method met more: the next look is at all pixels
};

// Of states and results together, which are per pixel: a model of a thousand leaves is one for the cpu back end.
inline constexpr std::uint64_t kMostFoldBytes = std::uint64_t{9} << 28;

class Frame {
 public:
  // Throws Error{Machine}: no memory on the device.
  Frame(const SceneBuffers& scene, Programs& programs, DepthSource depthSource);

  // Projects the scene. `depths` are those of the view.
  void setView(const View& view, const DepthPlanes& depths);
  void setFold(const FoldSource& fold);   // throws Error{Machine} when its results, and its states where it has them in memory alone, outgrow kMostFoldBytes

  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t pixelCount() const { return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_); }
  const SceneBuffers& scene() const { return scene_; }

  // A program of a method's file for geometry or pixel passes; the fold's defines are added. `pass` becomes `#define PASS_<pass> 1`.
  const Program& geometryProgram(const std::string& file, const std::string& pass, const Defines& defines = {});
  const Program& pixelProgram(const std::string& file, const std::string& pass, const Defines& defines = {});

  // A buffer of the method's, of at least so many bytes; the same name gives the same buffer. `slot` 0 … 7 is where shaders find it:
  // binding = COPEEL_BUFFER_METHOD + slot. Its contents are those of the last use.
  const Buffer& buffer(const std::string& name, int slot, std::size_t bytes);
  // Pixel passes read the buffer as texels of `format` too, as texture `unit` (from COPEEL_TEXTURE_METHOD on): some devices fetch texels faster than words of storage.
  void texels(const Buffer& buffer, int unit, GLenum format);
  const Buffer& pixelWords(const std::string& name, int slot, std::size_t wordsPerPixel = 1);

  std::size_t keptBytes(const std::string& name) const;   // of a buffer asked for before, else 0

  std::uint64_t heldBytes() const;                        // of all buffers and targets, asked for in this frame or an earlier one

  void releaseBuffers();   // all of them: what they held is lost, and none is counted any more

  // Of an earlier frame of this size, for the method that keeps it.
  std::optional<Look> look;
  bool nodesInOneMemory = false;   // ll.cpp: eight memories did not fit. Forgotten with the size of the picture, as the look is

  // A colour target of the method's for geometry passes: attachments 0 … count-1 are written, pixel passes read them as textures of the same units.
  void target(const std::string& name, int attachment, GLenum format);
  void writeTargets(int count);
  void clearTarget(int attachment, GLuint word);      // of an integer format
  void clearTarget(int attachment, const glm::vec4& value);

  // All objects, or some; a pass over the geometry is counted once for each call of beginPass().
  void beginPass() {
    objectsDrawn_.push_back(0);
    passBegan_.push_back(std::chrono::steady_clock::now());
  }
  void drawGeometry(const Program& program) { beginPass(); drawObjects(program, 0, static_cast<std::uint32_t>(scene_.scene().objects().size())); }
  void drawObjects(const Program& program, std::uint32_t begin, std::uint32_t end);
  // Geometry passes draw the view as an image of this size, until the next call or frame.
  void drawAtSize(int width, int height);
  // The pixels that the scene may cover, or some.
  void drawPixels(const Program& program) { drawPixels(program, sceneBox_); }
  void drawPixels(const Program& program, const PixelRect& pixels);
  // Before a method's passes, for a fold with the define HIDE_BEHIND_OPAQUE: finds the nearest fragment of the marked objects in each pixel; passes then leave out
  // what lies behind it. One pass over those objects, 4 bytes a pixel.
  void hideBehind(const std::vector<std::uint8_t>& opaque);

  // From now on, until the frame's end, passes leave out objects whose boxes (culling.h) pass no sample of `box`, a pixel program; again when
  // pixels have less left.
  void cullObjects(const Program& box);

  // Hardware depth test of keys: off, or writing, or comparing only. The buffer starts as COPEEL_KEY_NONE; pixel passes read it as texture 8.
  void clearDepth();
  void testDepth(GLenum function, bool write);
  void noDepthTest();

  // True when `passes` let any fragment through: an occlusion query around them.
  bool anySamplesOf(const std::function<void()>& passes);

  // Results, after a method has drawn.
  std::vector<std::uint32_t> result() const;          // resultWords per pixel, row by row from the upper left
  // The same of the rows that the scene may cover, where the device has them, or a GPU's copy; all words of the others are zero.
  void visitResult(const std::function<void(int firstRow, std::span<const std::uint32_t> words)>& visitor) const;
  std::uint64_t passes() const { return objectsDrawn_.size(); }
  const std::vector<std::uint32_t>& objectsDrawn() const { return objectsDrawn_; }   // in each pass
  // From each pass to the next, the last to finish(): what a pass took where something waits for its end, as peeling's queries do.
  std::vector<double> passMs() const;
  std::uint64_t methodBytes() const;   // of the buffers, targets and depth asked for since begin()
  std::uint64_t foldBytes() const { return states_.bytes() + results_.bytes(); }

  void begin();   // of a method: binds what all passes read, counts anew
  // Sets the fold's states to their beginning, once a frame: for methods that come to a pixel in several passes, before their first one. Those that
  // deliver a pixel in one invocation spare the memory its states take (192 bytes for transparency), unless the fold has no others.
  void beginStates();
  bool usesStates() const { return usesStates_; }
  // What a method's resolve pass is given where it may spare them: RESOLVE then writes results itself.
  Defines wholeDefines() const { return usesStates_ ? Defines{} : Defines{{"FOLD_WHOLE", "1"}}; }
  bool statesFit() const { return stateBytes() + resultBytes() <= kMostFoldBytes; }
  void makeStates();   // the memory alone, which beginStates() makes too; throws Error{Machine} when states and results outgrow kMostFoldBytes
  void finish();  // joins the fold's sides into its results where there are states, and waits for the device

 private:
  PixelRect whole() const { return {0, 0, width_, height_}; }
  std::uint64_t resultBytes() const { return std::uint64_t{pixelCount()} * fold_.resultWords * sizeof(std::uint32_t); }
  std::uint64_t stateBytes() const { return std::uint64_t{pixelCount()} * fold_.stateWords * 2 * sizeof(std::uint32_t); }
  void checkFoldBytes(std::uint64_t bytes) const;
  void makeTargets();
  void emptyOutside();
  void project();
  void writeFrameBlock(const DepthPlanes& depths);

  const SceneBuffers& scene_;
  Programs& programs_;
  DepthSource depthSource_;
  View view_;
  DepthPlanes depths_;
  FoldSource fold_;
  int width_ = 0, height_ = 0;
  PixelRect sceneBox_{};
  PixelRect writtenBox_{};    // results are zeros outside
  Buffer clip_, frameBlock_, planes_, states_, results_, opaque_;
  struct Named {
    Buffer buffer;
    std::size_t asked = 0;         // bytes
    std::uint64_t usedIn = 0;
  };
  std::map<std::string, Named> buffers_;
  struct Target {
    Texture texture;
    DeviceMemory share;
    GLenum format = 0;
    std::uint64_t usedIn = 0;
  };
  std::map<std::string, Target> targets_;
  Texture depth_;
  DeviceMemory depthShare_;
  std::map<int, Texture> texels_;
  Framebuffer framebuffer_, noTargets_;
  VertexArray noVertices_;
  Query query_;
  int targetCount_ = 0;
  bool usesStates_ = false;
  bool depthTested_ = false;
  std::unique_ptr<Culling> culling_;   // of this view, once it was asked for
  bool culls_ = false;
  std::vector<std::uint32_t> objectsDrawn_;
  std::vector<std::chrono::steady_clock::time_point> passBegan_;   // and finish()'s end
  std::uint64_t frames_ = 0, depthUsedIn_ = 0;
};

}  // namespace copeel::gl
