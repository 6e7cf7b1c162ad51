// Which part of the sky the columns around a place of the ground hide, weighted by the cosine: what lies between the
// elevations a and b hides (sin² b - sin² a) of its direction.
in vec2 place;
out vec4 hidden;
uniform sampler2D lowest, highest;  // 0 … 1 of the height that is looked at
uniform vec3 extent;                // [m] x, height, z
uniform float reach;                // [m]

void main() {
    float sum = 0.0;
    for (int way = 0; way < 64; ++way) {
        // Each way starts at another place in the four texels by four around, which softens the steps of the maps.
        int cell = 37 * way & 63;
        vec2 from = place + (vec2(cell & 7, cell >> 3) - 3.5) / vec2(2 * textureSize(lowest, 0));
        float angle = 0.09817477 * (float(way) + 0.5), low = 1.0, high = 0.0;  // sin²
        for (int i = 0; i < 12; ++i) {
            float part = (float(i) + 0.5) / 12.0, r = reach * part * part;
            vec2 there = from + vec2(cos(angle), sin(angle)) * r / extent.xz;
            float under = texture(lowest, there).r;
            if (under == 1.0 || any(lessThan(there, vec2(0.0))) || any(greaterThan(there, vec2(1.0)))) continue;
            vec2 heights = extent.y * vec2(under, 1.0 - texture(highest, there).r), squares = heights * heights;
            vec2 elevations = squares / (squares + r * r + 1e-6);
            low = min(low, elevations.x);
            high = max(high, elevations.y);
        }
        sum += max(high - low, 0.0) / 64.0;
    }
    hidden = vec4(sum);
}
