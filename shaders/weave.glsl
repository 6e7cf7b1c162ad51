// Threads: how they tilt the surface, with WEAVE, and which way they run, with FIBRES.
uniform float weave;
uniform float thread;  // [m]
uniform float slub;
uniform float fuzz;
uniform vec3 weftColour;
in vec3 place;

#ifdef WEAVE
#define BINDING WEAVE
#else
#define BINDING 0  // browsers refuse to compare what is not defined
#endif

// The bindings: along a thread of the warp, one crossing of binding.x shows the weft, and that place moves by binding.y
// from thread to thread.
#if BINDING == 1
const vec2 binding = vec2(4.0, 1.0);  // twill
#elif BINDING == 2
const vec2 binding = vec2(5.0, 2.0);  // satin
#else
const vec2 binding = vec2(2.0, 1.0);  // plain
#endif

#if defined SLUB || defined FUZZ
// Two numbers between -1 and 1 for each whole place.
vec2 scattered(vec2 at) {
    uvec2 bits = uvec2(ivec2(at) + 32768) * uvec2(2654435769u, 2246822519u);
    uint mixed = (bits.x ^ (bits.y >> 15) ^ bits.y) * 3266489917u;
    mixed = (mixed ^ (mixed >> 16)) * 668265263u;
    mixed ^= mixed >> 13;
    return vec2(mixed >> 16, mixed & 65535u) / 32767.5 - 1.0;
}

// The same in between, of things `size` threads large; 0 where they are smaller than pixels.
vec2 unevenness(vec2 cell, vec2 fine, vec2 size) {
    vec2 at = cell / size, low = floor(at), part = smoothstep(0.0, 1.0, at - low);
    vec2 uneven = mix(mix(scattered(low), scattered(low + vec2(1.0, 0.0)), part.x),
                      mix(scattered(low + vec2(0.0, 1.0)), scattered(low + 1.0), part.x), part.y);
    vec2 seen = clamp(1.5 - fine / size, 0.0, 1.0);
    return uneven * (seen.x * seen.y);
}
#endif

// The colour as threads vary it.
vec3 threadColour(vec2 uv, vec2 pixel, vec3 colour) {
    vec2 cell = uv / thread, fine = pixel / thread;
#if BINDING == 1
    float across = dot(cell, binding.yx) / binding.x, wide = max(dot(fine, binding.yx) / binding.x, 1e-3);
    colour = mix(colour, weftColour, band(across, wide, 0.0, 1.0 / binding.x));
#endif
#ifdef SLUB
    // Single threads, and bundles of them, which are seen from farther away.
    float warp = unevenness(cell, fine, vec2(1.0, 40.0)).x + unevenness(cell, fine, vec2(5.0, 150.0)).x;
    float weft = unevenness(cell, fine, vec2(40.0, 1.0)).x + unevenness(cell, fine, vec2(150.0, 5.0)).x;
    colour *= 1.0 + 0.3 * slub * mix(warp, weft, 1.0 / binding.x);
#endif
#ifdef FUZZ
    colour *= 1.0 + 0.12 * fuzz * (unevenness(cell, fine, vec2(2.0)).x + unevenness(cell, fine, vec2(9.0)).x);
#endif
    return colour;
}

#ifdef WEAVE
// Over and under: each crossing is a pillow, stretched along the thread that lies on top. Tilts the normal and returns
// how open the place is, 0 … 1. Fades, along either thread, where threads become smaller than pixels.
float weaveRelief(vec2 uv, vec2 pixel, inout vec3 normal) {
    vec2 cell = uv / thread;
    vec2 fine = pixel / thread;  // threads a pixel; gaps are finer than threads and fade first, into their mean
#if BINDING == 4
    float lean = 2.0 * mod(floor(cell.x), 2.0) - 1.0;  // of a leg of a loop
    cell.y += lean * fract(cell.x);
#endif
    vec2 middle = fract(cell) - 0.5;
#if BINDING == 4
    vec2 rise = vec2(0.8 * middle.x + 2.0 * lean * middle.y, 2.0 * middle.y);
#elif BINDING == 3
    vec2 rise = vec2(2.0 * middle.x, 0.0);
    middle.y = 0.0;
#else
    vec2 index = floor(cell);
    float warp = mod(binding.y * index.x + index.y, binding.x);  // 0: the weft lies on top
    vec2 bent = middle;  // a thread that crosses several is bent at its ends
    if (warp > 1.0) bent.y = max(bent.y, 0.0);
    if (warp > 0.0 && warp < binding.x - 1.0) bent.y = min(bent.y, 0.0);
    vec2 rise = bent * (warp > 0.0 ? vec2(2.0, 0.8) : vec2(0.8, 2.0));
    if (warp > 0.0) middle.y = bent.y;
#endif
    vec2 tilt = weave * clamp(1.5 - 3.1 * fine, 0.0, 1.0) * rise;
    vec2 square = 4.0 * middle * middle;
    vec2 gap = mix(vec2(0.25), square * square, clamp(1.3 - 3.0 * fine, 0.0, 1.0));
#ifdef FUZZ
    tilt += 0.3 * fuzz * (unevenness(cell, fine, vec2(3.0)) + unevenness(cell, fine, vec2(9.0)));
#endif

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

#ifdef FIBRES
// The way of the warp, unit. On a triangle v stays along it; with the normal it turns from that of the triangle to that
// of the surface.
vec3 warpOn(vec2 uv, vec3 normal) {
    vec3 placeX = dFdx(place);
    vec3 placeY = dFdy(place);
    vec3 warp = placeX * dFdy(uv).y - placeY * dFdx(uv).y;
    warp *= inversesqrt(max(dot(warp, warp), 1e-20));
    vec3 flatNormal = cross(placeX, placeY);
    flatNormal *= inversesqrt(max(dot(flatNormal, flatNormal), 1e-30));
    flatNormal = dot(flatNormal, normal) < 0.0 ? -flatNormal : flatNormal;
    return warp - (flatNormal + normal) * (dot(normal, warp) / (1.0 + dot(flatNormal, normal)));
}
#endif
