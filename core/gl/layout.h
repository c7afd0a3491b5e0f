// What C++ and GLSL agree on: buffer bindings, record layouts, depth keys. Read by both, so it holds preprocessor lines alone; the records'
// C++ twins are in scene.h with their sizes asserted.
//
// A depth key is a 32-bit number that grows with distance. Keys lie in [COPEEL_KEY_LEAST, COPEEL_KEY_NONE): read as floats they are normal, positive,
// below 1 and in the same order, so that a 32-bit float depth buffer compares them without loss.
#ifndef COPEEL_GL_LAYOUT_H
#define COPEEL_GL_LAYOUT_H

#define COPEEL_KEY_LEAST 0x00800000u
#define COPEEL_KEY_NONE 0x3F800000u     // 1.0f: behind everything, "no fragment"
#define COPEEL_KEY_DONE 0xFFFFFFFFu     // the pixel has had enough

// A fragment's id: its primitive, and whether it is left there (back-facing) rather than entered.
#define COPEEL_ID_BACK 0x80000000u
#define COPEEL_ID_PRIMITIVE 0x7FFFFFFFu
#define COPEEL_ID_NONE 0xFFFFFFFFu

// The sides a pixel's groups are delivered from.
#define COPEEL_FRONT 0u
#define COPEEL_BACK 1u

// Vertex attributes.
#define COPEEL_ATTRIBUTE_CLIP 0
#define COPEEL_ATTRIBUTE_FIRST_PRIMITIVE 1

// Uniform blocks.
#define COPEEL_BLOCK_FRAME 0

// Storage buffers. From COPEEL_BUFFER_METHOD on they are the method's own.
#define COPEEL_BUFFER_PLANES 0
#define COPEEL_BUFFER_PRIMITIVES 1
#define COPEEL_BUFFER_FOLD_STATE 2
#define COPEEL_BUFFER_FOLD_RESULT 3
#define COPEEL_BUFFER_FOLD_TABLE 4      // and 5, 6
#define COPEEL_BUFFER_OPAQUE 7
#define COPEEL_BUFFER_METHOD 8          // to 15

// Texture units: 0 to 7 are the method's targets, 8 the depth buffer, from COPEEL_TEXTURE_METHOD on the method's buffers as texels, then the fold's tables.
#define COPEEL_TEXTURE_PLANES 9
#define COPEEL_TEXTURE_PRIMITIVES 10
#define COPEEL_TEXTURE_METHOD 11        // and 12
#define COPEEL_TEXTURE_FOLD_TABLE 13    // to 15

// The compute shader that projects vertices uses bindings of its own.
#define COPEEL_BUFFER_VERTICES 0
#define COPEEL_BUFFER_PLACEMENTS 1
#define COPEEL_BUFFER_CLIP 2

#endif
