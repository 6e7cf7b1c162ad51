// Cloth, ropes, blocks and colliders in sun and sky. Variants: PATTERN 0 … 4, WEAVE, TWO_SIDED.
#include "tone.glsl"
#include "shadow.glsl"
#include "pattern.glsl"
uniform vec3 backColour;
uniform float weave;
uniform float thread;  // [m]
uniform float roughness;
uniform float sheen;
uniform float dulled;  // 0 … 1
uniform float mark;    // which surface, 1/255 … 1
in vec3 place;
in vec3 upright;
in vec2 material;
out vec4 colour;

#ifdef WEAVE
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
    vec3 along = placeX * uvY.y - placeY * uvX.y;
    vec3 across = placeY * uvX.x - placeX * uvY.x;
    along *= inversesqrt(max(dot(along, along), 1e-20));
    across *= inversesqrt(max(dot(across, across), 1e-20));
    float turned = uvX.x * uvY.y - uvX.y * uvY.x < 0.0 ? -1.0 : 1.0;
    normal = normalize(normal + turned * (tilt.x * along + tilt.y * across));
    return 1.0 - 0.55 * weave * max(gap.x, gap.y);
}
#endif

void main() {
    vec3 toEye = normalize(eye.xyz - place);
    vec3 normal = normalize(upright);
#ifdef TWO_SIDED
    if (!gl_FrontFacing) normal = -normal;
#endif
    vec2 pixel = fwidth(material);
    vec3 albedo = patternColour(material, pixel);
#ifdef TWO_SIDED
    vec3 through = gl_FrontFacing ? backColour : albedo;
    if (!gl_FrontFacing) albedo = mix(backColour, albedo, 0.12);
#endif
    albedo = mix(albedo, vec3(0.16, 0.022, 0.016) + vec3(0.2, 0.055, 0.045) * dot(albedo, vec3(0.3, 0.6, 0.1)), dulled);
    vec3 smoothNormal = normal;
    float open = 1.0;
#ifdef WEAVE
    open = weaveRelief(material, pixel, normal);
#endif

    float lightSide = dot(smoothNormal, lightWay.xyz);
    float sun = sunlight(place, lightSide < 0.0 ? -smoothNormal : smoothNormal, true);
    float facing = dot(normal, lightWay.xyz);
    float direct = max(facing, 0.0) * sun;
#ifdef WEAVE
    direct *= smoothstep(-0.02, 0.12, lightSide);  // threads on the far side of the light stay dark
#endif

    vec3 diffuse = lightColour.rgb * direct + hemisphere(normal) * open;
    vec3 light = albedo * open * diffuse;
#ifdef TWO_SIDED
    light += 0.18 * albedo * through * lightColour.rgb * (max(-lightSide, 0.0) * sun);
#endif

    // Gloss of a dielectric, and the bright rim of fibres.
    vec3 halfWay = normalize(lightWay.xyz + toEye);
    float alpha = mix(0.04, 1.0, roughness * roughness);
    float exponent = 2.0 / (alpha * alpha);
    float rim = 1.0 - clamp(dot(normal, toEye), 0.0, 1.0);
    float rim2 = rim * rim;
    float gloss = pow(max(dot(normal, halfWay), 0.0), exponent) * (exponent + 8.0) * 0.125;
    float fresnel = 0.04 + 0.96 * rim2 * rim2 * rim;
    light += lightColour.rgb * (0.04 * gloss * direct * open);
    vec3 mirrored = reflect(-toEye, normal);
    light += hemisphere(mirrored) * (fresnel * (1.0 - roughness) * 0.6 * open);
    light += sheen * rim2 * rim * mix(albedo, vec3(0.5), 0.3) * (diffuse + 0.3 * skyLight.rgb);

    if (debug.x > 0.0) {
        float grey = dot(light, vec3(0.3, 0.6, 0.1));
        light = mix(light, vec3(0.4 * grey + 0.06), 0.85);
    }
    colour = vec4(filmic(light), mark);
}
