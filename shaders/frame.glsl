// What all shaders know of the picture. The order is that of FrameBlock in engine/taut/render/private/frame_block.h.
// A further light, with what the sun has below.
struct Lamp {
    mat4 toMap;
    mat4 toLight;
    vec4 way;
    vec4 colour;
    vec4 mapSize;
};

layout(std140) uniform Frame {
    mat4 viewProjection;
    mat4 toMap;         // world to shadow map coordinates, 0 … 1
    mat4 toLight;       // world directions to (right, up, towards the light), in metres
    vec4 eye;           // xyz
    vec4 lightWay;      // xyz: unit, towards the light; w: its apparent size [rad]
    vec4 lightColour;   // what a white surface facing the light sends back; w: reach of its wide bounds [blocks]
    vec4 skyLight;
    vec4 groundLight;
    vec4 backgroundTop;
    vec4 backgroundHorizon;
    vec4 fade;          // xy: place [m] around which the ground fades; z, w: distances where that begins and ends
    vec4 mapSize;       // xyz: extent of the shadow map [m]; w: a texel [m]
    vec4 occlusionArea; // xy: corner of the occlusion map [m]; zw: 1 / its extent
    vec4 groundColour;  // w: distance of its lines [m]
    vec4 debug;         // x: 1 in the debug view, else 0
    vec4 around;        // the picture around: cosine and sine of its turn, strength, texels a radian
    vec4 ambient[9];    // light of it, as factors of spherical harmonics
    Lamp lamps[2];      // those that throw shadows first
};
