// Surfaces, lit as they are drawn: what surface.frag and light.frag do in two passes.
#include "lit.glsl"
#include "pattern.glsl"
#include "weave.glsl"
in vec3 upright;
in vec2 along;            // [m] along the material
uniform vec4 back, kind;  // as lit() has them
uniform vec2 strands;
out vec4 colour;

void main() {
    bool isBack = false;
#ifdef TWO_SIDED
    isBack = !gl_FrontFacing;
#endif
    vec3 normal = normalize(isBack ? -upright : upright), smoothNormal = normal, fibres = vec3(0.0);
    vec2 over = fwidth(along);
    vec4 front = vec4(patternColour(along, over), 1.0);
#if PATTERN == 4
    front.rgb = decoded(front.rgb);  // whose bytes three.js hands on as they are
#endif
    front.rgb = threadColour(along, over, front.rgb);
#ifdef FIBRES
    fibres = warpOn(along, normal);
#endif
#ifdef WEAVE
    front.a = weaveRelief(along, over, normal);
#endif
    float pixel = sqrt(length(cross(dFdx(place), dFdy(place))));
    vec3 light = lit(place, normalize(eye.xyz - place), smoothNormal, normal, fibres, pixel, isBack, front, back, kind,
                     strands);
    colour = vec4(filmic(light), 1.0);
}
