// The light of taut's own pictures, as shaders for WebGL 2.
'use strict';

const shadowTexels = 2048, skyTexels = 128;

const common = `#version 300 es
precision highp float;
precision highp int;
uniform mat4 modelMatrix, viewMatrix, projectionMatrix;
uniform vec3 cameraPosition;
`;

const tone = `
out vec4 colour;
uniform vec3 lightWay, lightColour, skyLight, groundLight;

// Between 0 and 1, different from pixel to pixel: interleaved gradient noise (Jimenez 2014).
float pixelNoise() { return fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))); }

// Scene light to what a display shows: Narkowicz's fit of the ACES curve (2015).
vec3 filmic(vec3 light) {
  vec3 x = 0.75 * light;
  return clamp((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

// The sRGB curve (IEC 61966-2-1), and noise that hides the steps of eight bits.
vec4 shown(vec3 light) {
  vec3 curve = 1.055 * pow(max(light, 1e-6), vec3(1.0 / 2.4)) - 0.055;
  vec3 bytes = mix(curve, 12.92 * light, lessThan(light, vec3(0.0031308)));
  return vec4(bytes + (pixelNoise() - 0.5) / 255.0, 1.0);
}

vec3 hemisphere(vec3 normal) { return mix(groundLight, skyLight, 0.5 + 0.5 * normal.y); }
`;

const packed = `
float depthIn(vec3 bytes) { return dot(bytes, vec3(1.0, 1.0 / 255.0, 1.0 / 65025.0)); }
`;

// Penumbras as wide as the distance to what throws the shadow makes them (percentage-closer soft shadows, Fernando
// 2005).
const shadow = packed + `
uniform sampler2D shadowMap;  // depth in three bytes
uniform mat4 toMap;           // world to map, 0 … 1
uniform mat3 toLight;         // world directions to (right, up, towards the light)
uniform vec3 mapSize;         // [m]
uniform float softness;       // [rad] apparent size of the light

const mat2 goldenTurn = mat2(-0.7373688, 0.6754903, -0.6754903, -0.7373688);

float depthAt(vec2 at) { return depthIn(texture(shadowMap, at).rgb); }

float texelAt(ivec2 at) { return depthIn(texelFetch(shadowMap, at, 0).rgb); }

// How much of the four texels around lies behind a depth.
float reachedAt(vec2 at, float depth) {
  vec2 texel = at * ${shadowTexels}.0 - 0.5, part = fract(texel);
  ivec2 low = clamp(ivec2(floor(texel)), ivec2(0), ivec2(${shadowTexels - 2}));
  vec4 lies = vec4(texelAt(low), texelAt(low + ivec2(1, 0)), texelAt(low + ivec2(0, 1)), texelAt(low + ivec2(1, 1)));
  vec4 lit = step(vec4(depth), lies);
  return mix(mix(lit.x, lit.y, part.x), mix(lit.z, lit.w, part.x), part.y);
}

// How much of the light reaches a place, 0 … 1. facing: its normal on the side of the light; pixel: its size there [m].
float sunlight(vec3 place, vec3 facing, float pixel) {
  float texel = max(mapSize.x, mapSize.y) / ${shadowTexels}.0;
  float grain = max(1.5 * texel, 0.7 * pixel);
  vec3 at = (toMap * vec4(place + facing * grain, 1.0)).xyz;
  if (any(lessThan(at.xy, vec2(0.0))) || any(greaterThan(at.xy, vec2(1.0)))) return 1.0;
  vec3 n = toLight * facing;
  vec2 rising = n.xy / max(n.z, 0.15) / mapSize.z;  // depth along the surface's own plane
  float ref = at.z - 0.5 * grain / mapSize.z;
  float angle = 6.2831853 * pixelNoise();
  vec2 way = vec2(cos(angle), sin(angle));
  float least = max(1.2 * texel, 0.7 * pixel), widest = 0.02 * min(mapSize.x, mapSize.y);
  widest = max(widest, least);

  float search = clamp(0.5 * softness * at.z * mapSize.z, least, widest);
  vec2 found = vec2(0.0);  // sum of distances, number
  for (int i = 0; i < 12; ++i) {
    vec2 off = way * (search * sqrt((float(i) + 0.5) / 12.0));
    float between = ref + dot(rising, off) - depthAt(at.xy + off / mapSize.xy);
    if (between > 0.0) found += vec2(between, 1.0);
    way = goldenTurn * way;
  }
  if (found.y == 0.0) return 1.0;
  float radius = clamp(0.5 * softness * found.x / found.y * mapSize.z, least, widest);
  float reached = 0.0;
  for (int i = 0; i < 20; ++i) {
    vec2 off = way * (radius * sqrt((float(i) + 0.5) / 20.0));
    reached += reachedAt(at.xy + off / mapSize.xy, min(ref + dot(rising, off), 1.0));
    way = goldenTurn * way;
  }
  return reached / 20.0;
}
`;

const surfaceVertex = common + `
in vec3 position, normal;
in vec2 uv;
out vec3 place, upright;
out vec2 along;  // [m] along the material
uniform float repeat;
void main() {
  vec4 there = modelMatrix * vec4(position, 1.0);
  place = there.xyz;
  upright = mat3(modelMatrix) * normal;
  along = vec2(uv.x, -uv.y) * repeat;
  gl_Position = projectionMatrix * viewMatrix * there;
}`;

const surfaceFragment = common + tone + shadow + `
in vec3 place, upright;
in vec2 along;
uniform int pattern;  // 0 plain, 1 checker, 2 stripes, 3 tartan, 4 picture
uniform bool isTwoSided;
uniform vec3 front, back, accent;
uniform float repeat, weave, thread, sheen, roughness, translucency, anisotropy;
uniform sampler2D picture;

// The part of an interval of width w around x in which the fraction of x lies between a and b.
float band(float x, float w, float a, float b) {
  vec2 ends = vec2(x - 0.5 * w, x + 0.5 * w);
  vec2 sum = floor(ends) * (b - a) + clamp(fract(ends) - a, 0.0, b - a);
  return (sum.y - sum.x) / w;
}
vec2 bands(vec2 x, vec2 w, float a, float b) { return vec2(band(x.x, w.x, a, b), band(x.y, w.y, a, b)); }

// The mean over the pixel, so that nothing flickers from afar.
vec3 patternColour(vec2 uv, vec2 pixel) {
  vec2 x = uv / repeat, w = max(pixel / repeat, 1e-4);
  if (pattern == 1) {
    vec2 other = bands(x, w, 0.0, 0.5);
    return mix(front, accent, other.x + other.y - 2.0 * other.x * other.y);
  }
  if (pattern == 2) return mix(front, accent, band(x.x, w.x, 0.5, 1.0));
  if (pattern == 3) {
    vec2 broad = bands(x, w, 0.24, 0.76), gold = bands(x, w, 0.475, 0.525);
    vec2 white = bands(x, w, 0.145, 0.18) + bands(x, w, 0.82, 0.855);
    vec3 cloth = mix(accent, front, 0.5 * (broad.x + broad.y));
    cloth = mix(cloth, vec3(0.80, 0.50, 0.10), max(gold.x, gold.y));
    return mix(cloth, vec3(0.78, 0.76, 0.74), max(white.x, white.y));
  }
  if (pattern == 4) {
    vec3 bytes = texture(picture, vec2(uv.x, -uv.y) / repeat).rgb;
    return mix(pow((bytes + 0.055) / 1.055, vec3(2.4)), bytes / 12.92, lessThan(bytes, vec3(0.04045)));
  }
  return front;
}

// Over and under: each cell of the weave is a pillow, stretched along the thread that lies on top. Tilts the normal and
// returns how open the place is, 0 … 1. Fades where threads become smaller than pixels.
float weaveRelief(vec2 uv, vec2 pixel, inout vec3 normal) {
  vec2 cell = uv / thread, middle = fract(cell) - 0.5, index = floor(cell), fine = pixel / thread;
  float warp = mod(index.x + index.y, 2.0);
  vec2 tilt = weave * clamp(1.5 - 3.1 * fine, 0.0, 1.0) * middle * mix(vec2(0.8, 2.0), vec2(2.0, 0.8), warp);
  vec2 square = 4.0 * middle * middle;
  vec2 gap = mix(vec2(0.25), square * square, clamp(1.3 - 3.0 * fine, 0.0, 1.0));
  vec3 placeX = dFdx(place), placeY = dFdy(place);
  vec2 uvX = dFdx(uv), uvY = dFdy(uv);
  vec3 down = placeX * uvY.y - placeY * uvX.y, across = placeY * uvX.x - placeX * uvY.x;
  down *= inversesqrt(max(dot(down, down), 1e-20));
  across *= inversesqrt(max(dot(across, across), 1e-20));
  float turned = uvX.x * uvY.y - uvX.y * uvY.x < 0.0 ? -1.0 : 1.0;
  normal = normalize(normal + turned * (tilt.x * down + tilt.y * across));
  return 1.0 - 0.55 * weave * max(gap.x, gap.y);
}

// The gloss around a normal of what stands between light and eye, of exponent.x along the fibres and exponent.y across
// (Ashikhmin and Shirley 2000).
float glossOf(vec3 normal, vec3 fibres, vec3 halfWay, vec2 exponent) {
  float even = max(dot(normal, halfWay), 0.0);
  if (exponent.x == exponent.y) return pow(even, exponent.x) * (exponent.x + 8.0) * 0.125;
  float along = dot(fibres, halfWay), part = along * along / max(1.0 - even * even, 1e-5);
  vec2 sides = exponent + 8.0;
  return pow(even, mix(exponent.y, exponent.x, min(part, 1.0))) * sqrt(sides.x * sides.y) * 0.125;
}

void main() {
  bool isBack = isTwoSided && !gl_FrontFacing;
  vec3 smoothNormal = normalize(upright) * (isBack ? -1.0 : 1.0), normal = smoothNormal;
  vec2 pixel = fwidth(along);
  vec3 cloth = patternColour(along, pixel);
  float open = weave > 0.0 ? weaveRelief(along, pixel, normal) : 1.0;
  vec3 albedo = isBack ? mix(back, cloth, 0.12) : cloth, through = isBack ? cloth : back;
  vec3 toEye = normalize(cameraPosition - place);

  float lightSide = dot(smoothNormal, lightWay);
  float size = sqrt(length(cross(dFdx(place), dFdy(place))));
  float sun = sunlight(place, lightSide < 0.0 ? -smoothNormal : smoothNormal, size);
  float direct = max(dot(normal, lightWay), 0.0) * sun;
  if (weave > 0.0) direct *= smoothstep(-0.02, 0.12, lightSide);  // threads on the far side stay dark
  vec3 diffuse = lightColour * direct + hemisphere(normal) * open;
  vec3 light = albedo * open * diffuse;
  light += translucency * sqrt(albedo * through) * lightColour * (max(-lightSide, 0.0) * sun);

  // Gloss of a dielectric, and the bright rim of fibres.
  vec3 halfWay = normalize(lightWay + toEye);
  float alpha = mix(0.04, 1.0, roughness * roughness);
  vec2 exponent = vec2(2.0 / (alpha * alpha));
  // Threads that lie side by side, as in satin, are round: they spread the gloss across them. What goes through them
  // takes their colour (Sadeghi and others 2013).
  vec3 fibres = vec3(0.0), glossColour = vec3(0.04);
  if (anisotropy > 0.0) {
    vec3 warp = dFdx(place) * dFdy(along.y) - dFdy(place) * dFdx(along.y);
    warp *= inversesqrt(max(dot(warp, warp), 1e-20));
    vec3 flatNormal = normalize(cross(dFdx(place), dFdy(place)));
    flatNormal *= sign(dot(flatNormal, normal));
    fibres = warp - (flatNormal + normal) * (dot(normal, warp) / (1.0 + dot(flatNormal, normal)));
    float across = 1.0 - anisotropy;
    exponent.y = max(exponent.y * across * across * across, 1.0);
    glossColour += 0.5 * anisotropy * albedo;
  }
  float rim = 1.0 - clamp(dot(normal, toEye), 0.0, 1.0), rim2 = rim * rim;
  float gloss = glossOf(normal, fibres, halfWay, exponent);
  float fresnel = 0.04 + 0.96 * rim2 * rim2 * rim;
  light += lightColour * (glossColour * gloss * direct * open);
  light += hemisphere(reflect(-toEye, normal)) * (fresnel * (1.0 - roughness) * 0.6 * open);
  light += sheen * rim2 * rim * mix(albedo, vec3(0.5), 0.3) * (diffuse + 0.3 * skyLight);
  colour = shown(filmic(light));
}`;

const groundVertex = common + `
in vec3 position;
out vec3 place;
void main() {
  vec4 there = modelMatrix * vec4(position, 1.0);
  place = there.xyz;
  gl_Position = projectionMatrix * viewMatrix * there;
}`;

const groundFragment = common + tone + shadow + `
in vec3 place;
uniform vec3 groundColour, horizon;
uniform float gridSpacing;  // [m]
uniform sampler2D hidden;   // part of the sky
uniform vec4 hiddenArea;    // [m] corner of that map; 1 / its extent
uniform vec4 fade;          // [m] place around which it fades into the horizon; distances where that begins and ends

// How much of a pixel lines of a width cover that run at every whole number of x.
float lines(float x, float width) {
  float pixel = max(fwidth(x), 1e-5), drawn = max(width, pixel), off = abs(fract(x + 0.5) - 0.5);
  float cover = clamp((0.5 * drawn - off) / pixel + 0.5, 0.0, 1.0) * width / drawn;
  return mix(cover, width, clamp(2.0 * pixel - 0.5, 0.0, 1.0));
}

void main() {
  vec3 albedo = groundColour;
  if (gridSpacing > 0.0) {
    vec2 cell = place.xz / gridSpacing;
    albedo *= 1.0 - 0.3 * max(lines(cell.x, 0.012), lines(cell.y, 0.012));
  }
  float size = sqrt(length(cross(dFdx(place), dFdy(place))));
  float direct = max(lightWay.y, 0.0) * sunlight(place, vec3(0.0, 1.0, 0.0), size);
  vec2 at = (place.xz - hiddenArea.xy) * hiddenArea.zw;
  float covered = 0.0;
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j) covered += texture(hidden, at + 1.2 * vec2(i, j) / ${skyTexels}.0).r / 9.0;
  if (any(lessThan(at, vec2(0.0))) || any(greaterThan(at, vec2(1.0)))) covered = 0.0;
  vec3 seen = filmic(albedo * (lightColour * direct + skyLight * (1.0 - 0.9 * covered)));
  // Even over the rows of the picture, which go with one over the distance.
  float far = max(length(place.xz - fade.xy), fade.z);
  float away = smoothstep(0.0, 1.0, (1.0 - fade.z / far) / max(1.0 - fade.z / fade.w, 1e-3));
  colour = shown(mix(seen, horizon, away));
}`;

// Which part of the sky the columns around a place of the ground hide, weighted by the cosine: what lies between the
// elevations a and b hides (sin² b - sin² a) of its direction.
const hiddenFragment = common + packed + `
in vec2 at;
out vec4 hidden;
uniform sampler2D lowest, highest;  // 0 … 1 of the height that is looked at
uniform vec3 extent;                // [m] x, height, z
uniform float reach;                // [m]
void main() {
  float sum = 0.0;
  for (int way = 0; way < 16; ++way) {
    float angle = 0.3926991 * (float(way) + 0.5), low = 1.0, high = 0.0;  // sin²
    for (int i = 0; i < 12; ++i) {
      float part = (float(i) + 0.5) / 12.0, r = reach * part * part;
      vec2 there = at + vec2(cos(angle), sin(angle)) * r / extent.xz;
      float under = depthIn(texture(lowest, there).rgb);
      if (under > 0.999 || any(lessThan(there, vec2(0.0))) || any(greaterThan(there, vec2(1.0)))) continue;
      vec2 heights = extent.y * vec2(under, 1.0 - depthIn(texture(highest, there).rgb)), squares = heights * heights;
      vec2 elevations = squares / (squares + r * r + 1e-6);
      low = min(low, elevations.x);
      high = max(high, elevations.y);
    }
    sum += max(high - low, 0.0) / 16.0;
  }
  hidden = vec4(sum);
}`;
const wholeVertex = common + `
in vec3 position;
out vec2 at;
void main() { at = 0.5 + 0.5 * position.xy; gl_Position = vec4(position.xy, 0.0, 1.0); }`;

const skyVertex = common + `
in vec3 position;
out vec3 way;
void main() {
  vec4 far = inverse(projectionMatrix * viewMatrix) * vec4(position.xy, 1.0, 1.0);
  way = far.xyz / far.w - cameraPosition;
  gl_Position = vec4(position.xy, 1.0, 1.0);
}`;

const skyFragment = common + tone + `
in vec3 way;
uniform vec3 top, horizon;
void main() {
  float up = max(way.y, 0.0) * inversesqrt(dot(way, way));
  colour = shown(mix(horizon, top, up * up / (up * up + 0.0064)));  // half way at five degrees
}`;

const depthVertex = common + `
in vec3 position;
void main() { gl_Position = projectionMatrix * viewMatrix * modelMatrix * vec4(position, 1.0); }`;

const depthFragment = common + `
out vec4 bytes;
void main() {
  vec3 parts = fract(min(gl_FragCoord.z, 0.999999) * vec3(1.0, 255.0, 65025.0));
  bytes = vec4(parts.x - parts.y / 255.0, parts.y - parts.z / 255.0, parts.z, 1.0);
}`;
