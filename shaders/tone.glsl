// What the fragment shaders share: noise, tone, the curve of displays, ambient light.
#include "frame.glsl"

// Between 0 and 1, different from pixel to pixel: interleaved gradient noise (Jimenez 2014).
float pixelNoise() { return fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))); }

// Scene light to what a display shows: Narkowicz's fit of the ACES curve (2015).
vec3 filmic(vec3 light) {
    vec3 x = 0.75 * light;
    return clamp((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

// Hides the steps of eight bits in slow gradients; the step is one of the sRGB curve.
vec3 dithered(vec3 colour) { return colour + (pixelNoise() - 0.5) / 255.0 * (1.8 * sqrt(max(colour, 0.0)) + 0.08); }

// The sRGB curve (IEC 61966-2-1).
vec3 encoded(vec3 light) {
    return mix(1.055 * pow(max(light, 1e-6), vec3(1.0 / 2.4)) - 0.055, 12.92 * light, lessThan(light, vec3(0.0031308)));
}
vec3 decoded(vec3 bytes) {
    return mix(pow((bytes + 0.055) / 1.055, vec3(2.4)), bytes / 12.92, lessThan(bytes, vec3(0.04045)));
}

vec3 hemisphere(vec3 normal) { return mix(groundLight.rgb, skyLight.rgb, 0.5 + 0.5 * normal.y); }

// The colour of the side that is seen, without light; `dulled` below 0: greyed.
vec3 albedoOf(bool isBack, vec3 front, vec3 back, float dulled) {
    vec3 albedo = isBack ? mix(back, front, 0.12) : front;
    float lightness = dot(albedo, vec3(0.3, 0.6, 0.1));
    albedo = mix(albedo, vec3(0.16, 0.022, 0.016) + vec3(0.2, 0.055, 0.045) * lightness, max(dulled, 0.0));
    return mix(albedo, vec3(0.12 + 0.2 * lightness), max(-dulled, 0.0));
}
