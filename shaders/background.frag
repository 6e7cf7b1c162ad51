// The sky: its colours are shown as they are given. ENVIRONMENT: the picture around in its place. TRANSPARENT: it takes
// nothing from what lies behind the picture.
#include "tone.glsl"
#ifdef ENVIRONMENT
#include "environment.glsl"
#endif
in vec3 way;
out vec4 colour;

void main() {
#ifdef TRANSPARENT
    colour = vec4(1.0, 1.0, 1.0, 0.0);
#elif defined ENVIRONMENT
    vec3 unit = normalize(way);
    colour = vec4(dithered(filmic(lightFrom(unit, length(dFdy(unit))))), 0.0);
#else
    float up = max(way.y, 0.0) * inversesqrt(dot(way, way));
    float part = up * up / (up * up + 0.0064);  // half way at five degrees
    colour = vec4(dithered(mix(backgroundHorizon.rgb, backgroundTop.rgb, part)), 0.0);
#endif
}
