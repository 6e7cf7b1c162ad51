// What of cloth, ropes, blocks and colliders can be seen: kept for light.frag, so that each pixel is lit once and small
// triangles cost little. Variants: PATTERN 0 … 4, WEAVE, TWO_SIDED, FIBRES.
#include "pattern.glsl"
uniform float weave;
uniform float thread;  // [m]
uniform int material;  // row of its table
uniform int mark;      // which surface, 1 … 255
in vec3 upright;
in vec2 along;  // [m] along the material
layout(location = 0) out vec4 tint;    // rgb: square root of the colour, finer where it is dark; a: openness, 0 … 1
layout(location = 1) out uvec4 shape;  // normal of the surface, of the threads, bits of 1 / distance, marks

// A unit vector as a place on an octahedron, 16 bits a coordinate.
uint octahedral(vec3 n) {
    n *= 1.0 / (abs(n.x) + abs(n.y) + abs(n.z));
    vec2 folded = (1.0 - abs(n.yx)) * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
    uvec2 steps = uvec2((n.z < 0.0 ? folded : n.xy) * 32767.0 + 32767.5);
    return steps.x | steps.y << 16;
}

#ifdef WEAVE
in vec3 place;

// Over and under: each cell of the weave is a pillow, stretched along the thread that lies on top. Tilts the normal
// and returns how open the place is, 0 … 1. Fades, along either thread, where threads become smaller than pixels.
float weaveRelief(vec2 uv, vec2 pixel, inout vec3 normal) {
    vec2 cell = uv / thread;
    vec2 middle = fract(cell) - 0.5;
    vec2 index = floor(cell);
    float warp = mod(index.x + index.y, 2.0);
    vec2 fine = pixel / thread;  // threads a pixel; gaps are finer than threads and fade first, into their mean
    vec2 tilt = weave * clamp(1.5 - 3.1 * fine, 0.0, 1.0) * middle * mix(vec2(0.8, 2.0), vec2(2.0, 0.8), warp);
    vec2 square = 4.0 * middle * middle;
    vec2 gap = mix(vec2(0.25), square * square, clamp(1.3 - 3.0 * fine, 0.0, 1.0));

    // Directions of the material on the surface, from how place and uv change over the screen.
    vec3 placeX = dFdx(place);
    vec3 placeY = dFdy(place);
    vec2 uvX = dFdx(uv);
    vec2 uvY = dFdy(uv);
    vec3 down = placeX * uvY.y - placeY * uvX.y;
    vec3 across = placeY * uvX.x - placeX * uvY.x;
    down *= inversesqrt(max(dot(down, down), 1e-20));
    across *= inversesqrt(max(dot(across, across), 1e-20));
    float turned = uvX.x * uvY.y - uvX.y * uvY.x < 0.0 ? -1.0 : 1.0;
    normal = normalize(normal + turned * (tilt.x * down + tilt.y * across));
    return 1.0 - 0.55 * weave * max(gap.x, gap.y);
}
#endif

void main() {
    vec3 normal = normalize(upright);
    uint side = 0u;  // 1: the back
#ifdef TWO_SIDED
    if (!gl_FrontFacing) {
        normal = -normal;
        side = 1u;
    }
#endif
    vec2 pixel = fwidth(along);
    vec3 colour = patternColour(along, pixel);
    uint smoothNormal = octahedral(normal);
    float open = 1.0;
#ifdef WEAVE
    open = weaveRelief(along, pixel, normal);
    shape.y = octahedral(normal);
#else
    shape.y = smoothNormal;
#endif
    tint = vec4(sqrt(colour), open);
    uint warp = 0u;
#ifdef FIBRES
    // The way of the warp over the picture, where v stays: 128 steps of half a turn.
    vec2 warpWay = vec2(dFdy(along.y), -dFdx(along.y));
    warp = uint(atan(warpWay.y, warpWay.x) * 40.743665 + 256.5) & 127u;
#endif
    uint marks = uint(material) | side << 16 | warp << 17 | uint(mark) << 24;
    shape.xzw = uvec3(smoothNormal, floatBitsToUint(gl_FragCoord.w), marks);
}
