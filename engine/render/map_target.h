// A texture that passes draw into and later passes read: the small maps of shadow and occlusion.
#pragma once

#include "taut/render/gl.h"

namespace taut::render {

struct MapTarget {
    GlObject texture;
    GlObject target;
    int size = 0;  // [texels] edge

    // `format` is a sized colour format, or GL_DEPTH_COMPONENT32F. Outside the texture reads as `border`.
    MapTarget(const Gl& gl, int edge, GLenum format, GLenum filter, float border);

    void bind(const Gl& gl) const;  // to draw into; sets the viewport
};

}  // namespace taut::render
