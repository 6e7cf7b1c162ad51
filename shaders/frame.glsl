// What all shaders know of the picture. The order is that of FrameBlock in engine/taut/render/private/frame_block.h.
// A further light, with what the sun has below.
struct Lamp {
    mat4 toMap;
    mat4 toLight;
    vec4 way;
    vec4 colour;
    vec4 mapSize;
};

#ifndef GL_ES  // a page sets them one by one
layout(std140) uniform Frame {
#endif
    uniform mat4 viewProjection;
    uniform mat4 toMap;         // world to shadow map coordinates, 0 … 1
    uniform mat4 toLight;       // world directions to (right, up, towards the light), in metres
    uniform vec4 eye;           // xyz
    uniform vec4 lightWay;      // xyz: unit, towards the light; w: its apparent size [rad]
    uniform vec4 lightColour;   // what a white surface facing it sends back; w: reach of its wide bounds [blocks]
    uniform vec4 skyLight;
    uniform vec4 groundLight;
    uniform vec4 backgroundTop;
    uniform vec4 backgroundHorizon;
    uniform vec4 fade;          // xy: place [m] around which the ground fades; z, w: where that begins and ends [m]
    uniform vec4 mapSize;       // xyz: extent of the shadow map [m]; w: a texel [m]
    uniform vec4 occlusionArea; // xy: corner of the occlusion map [m]; zw: 1 / its extent
    uniform vec4 groundColour;  // w: distance of its lines [m]
    uniform vec4 debug;         // x: 1 in the debug view, else 0
    uniform vec4 around;        // the picture around: cosine and sine of its turn, strength, texels a radian
    uniform vec4 ambient[9];    // light of it, as factors of spherical harmonics
    uniform Lamp lamps[2];      // those that throw shadows first
#ifndef GL_ES
};
#endif
