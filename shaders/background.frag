// The sky: its colours are shown as they are given. TRANSPARENT: it takes nothing from what lies behind the picture.
#include "tone.glsl"
in vec3 way;
out vec4 colour;

void main() {
#ifdef TRANSPARENT
    colour = vec4(1.0, 1.0, 1.0, 0.0);
#else
    float up = max(way.y, 0.0) * inversesqrt(dot(way, way));
    float part = up * up / (up * up + 0.0064);  // half way at five degrees
    colour = vec4(dithered(mix(backgroundHorizon.rgb, backgroundTop.rgb, part)), 0.0);
#endif
}
