// Least and largest depth of a block and the two blocks to each side: wide enough that the filtered value still
// bounds everything within one and a half blocks.
uniform sampler2D shadowBounds;
out vec4 bounds;

void main() {
    ivec2 last = textureSize(shadowBounds, 0) - 1;
    vec2 found = vec2(1.0, 0.0);
    for (int y = -2; y <= 2; ++y) {
        for (int x = -2; x <= 2; ++x) {
            ivec2 at = ivec2(gl_FragCoord.xy) + ivec2(x, y);
            vec2 block = texelFetch(shadowBounds, clamp(at, ivec2(0), last), 0).rg;
            if (at != clamp(at, ivec2(0), last)) block.g = 1.0;  // outside everything is lit
            found = vec2(min(found.r, block.r), max(found.g, block.g));
        }
    }
    bounds = vec4(found, 0.0, 0.0);
}
