// Colours along the material. Each is the mean over the pixel, so that nothing flickers from afar.
uniform vec3 frontColour;
uniform vec3 accentColour;
uniform float repeat;  // [m]

// The part of an interval of width w around x in which the fraction of x lies between a and b.
float band(float x, float w, float a, float b) {
    vec2 ends = vec2(x - 0.5 * w, x + 0.5 * w);
    vec2 sum = floor(ends) * (b - a) + clamp(fract(ends) - a, 0.0, b - a);
    return (sum.y - sum.x) / w;
}

#if PATTERN == 0
vec3 patternColour(vec2 uv, vec2 pixel) { return frontColour; }
#elif PATTERN == 1
vec3 patternColour(vec2 uv, vec2 pixel) {
    vec2 x = uv / repeat;
    vec2 w = max(pixel / repeat, 1e-4);
    vec2 other = vec2(band(x.x, w.x, 0.0, 0.5), band(x.y, w.y, 0.0, 0.5));
    return mix(frontColour, accentColour, other.x + other.y - 2.0 * other.x * other.y);
}
#elif PATTERN == 2
vec3 patternColour(vec2 uv, vec2 pixel) {
    return mix(frontColour, accentColour, band(uv.x / repeat, max(pixel.x / repeat, 1e-4), 0.5, 1.0));
}
#elif PATTERN == 3
// Broad bands of both colours woven through each other, with pairs of thin white lines and a golden one.
vec3 patternColour(vec2 uv, vec2 pixel) {
    vec2 x = uv / repeat;
    vec2 w = max(pixel / repeat, 1e-4);
    vec2 broad = vec2(band(x.x, w.x, 0.24, 0.76), band(x.y, w.y, 0.24, 0.76));
    vec2 gold = vec2(band(x.x, w.x, 0.475, 0.525), band(x.y, w.y, 0.475, 0.525));
    vec2 white = vec2(band(x.x, w.x, 0.145, 0.18) + band(x.x, w.x, 0.82, 0.855),
                      band(x.y, w.y, 0.145, 0.18) + band(x.y, w.y, 0.82, 0.855));
    vec3 colour = mix(accentColour, frontColour, 0.5 * (broad.x + broad.y));
    colour = mix(colour, vec3(0.80, 0.50, 0.10), max(gold.x, gold.y));
    return mix(colour, vec3(0.78, 0.76, 0.74), max(white.x, white.y));
}
#else
uniform sampler2D picture;
vec3 patternColour(vec2 uv, vec2 pixel) { return texture(picture, vec2(uv.x, -uv.y) / repeat).rgb; }
#endif
