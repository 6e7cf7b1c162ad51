// The floor with its lines, fading into the horizon, or into the picture around with ENVIRONMENT. SHADED where shadows
// may fall, DARKENED where things hide the sky.
// PATTERN 1 … 4: a pattern in place of the lines.
// TRANSPARENT: without lines, and only what shadows leave of its colour, 0 … 1. LAMPS further lights shine on it.
#include "tone.glsl"
#ifdef SHADED
#include "shadow.glsl"
#if LAMPS > 0
#include "lamps.glsl"
#endif
#endif
#ifdef DARKENED
uniform sampler2D occlusion;
#endif
#ifdef ENVIRONMENT
#include "environment.glsl"
#endif
#ifdef PATTERN
#include "pattern.glsl"
#endif
in vec3 place;
out vec4 colour;

// How much of a pixel lines of a width cover that run at every whole number of x.
float lines(float x, float width) {
    float pixel = max(fwidth(x), 1e-5);
    float drawn = max(width, pixel);
    float off = abs(fract(x + 0.5) - 0.5);
    float cover = clamp((0.5 * drawn - off) / pixel + 0.5, 0.0, 1.0) * width / drawn;
    return mix(cover, width, clamp(2.0 * pixel - 0.5, 0.0, 1.0));
}

// Of a light that reaches it unhindered.
vec3 onGround(vec4 colour, vec4 way) { return colour.rgb * max(way.y, 0.0); }

void main() {
    vec3 albedo = groundColour.rgb;
#ifdef PATTERN
    albedo = patternColour(place.xz, fwidth(place.xz));
#elif !defined TRANSPARENT
    if (groundColour.w > 0.0) {
        vec2 cell = place.xz / groundColour.w;
        float width = 0.012;
        float cover = max(lines(cell.x, width), lines(cell.y, width));
        albedo *= 1.0 - 0.3 * cover;
    }
#endif
    vec3 direct = onGround(lightColour, lightWay);
    vec3 whole = direct;  // of all lights, in the open
#if LAMPS > 0
    whole += onGround(lamps[0].colour, lamps[0].way);
#endif
#if LAMPS > 1
    whole += onGround(lamps[1].colour, lamps[1].way);
#endif
    vec3 ambient = skyLight.rgb;
#ifdef SHADED
    vec3 right = dFdx(place);
    vec3 below = dFdy(place);
    float pixel = sqrt(sqrt(dot(right, right) * dot(below, below)));
    const vec3 up = vec3(0.0, 1.0, 0.0);
    direct *= sunlight(place, up, pixel, false);
#if LAMPS > 0
    direct += onGround(lamps[0].colour, lamps[0].way) * lamplight(0, place, up, pixel, false);
#endif
#if LAMPS > 1
    direct += onGround(lamps[1].colour, lamps[1].way) * lamplight(1, place, up, pixel, false);
#endif
#else
    direct = whole;
#endif
#ifdef DARKENED
    ambient *= 1.0 - 0.9 * texture(occlusion, (place.xz - occlusionArea.xy) * occlusionArea.zw).r;
#endif
    vec3 shown = filmic(albedo * (direct + ambient));
#ifdef TRANSPARENT
    vec3 lit = filmic(albedo * (whole + skyLight.rgb));
    float noise = (pixelNoise() - 0.5) * (0.98 / 255.0);  // which changes no whole byte
    shown = decoded(clamp(encoded(shown) / max(encoded(lit), 1e-3) + noise, 0.0, 1.0));
#endif
    // Even over the rows of the picture, which go with one over the distance.
    float far = max(length(place.xz - fade.xy), fade.z);
    float away = smoothstep(0.0, 1.0, (1.0 - fade.z / far) / max(1.0 - fade.z / fade.w, 1e-3));
#ifdef TRANSPARENT
    colour = vec4(mix(shown, vec3(1.0), away), 0.0);
#else
#ifdef ENVIRONMENT
    vec3 way = normalize(place - eye.xyz);
    vec3 behind = filmic(lightFrom(way, length(dFdy(way))));
#else
    vec3 behind = backgroundHorizon.rgb;
#endif
    colour = vec4(dithered(mix(shown, behind, away)), 0.0);
#endif
}
