// Least and largest depth of one block of the shadow map. Every second texel of every second row will do: what
// throws a shadow is wider, and the bounds are spread over the blocks around.
uniform sampler2D shadowBounds;
out vec4 bounds;

void main() {
    ivec2 first = ivec2(gl_FragCoord.xy) * BLOCK;
    float least = 1.0;
    float largest = 0.0;
    for (int y = 0; y < BLOCK; y += 2) {
        for (int x = 0; x < BLOCK; x += 2) {
            float depth = texelFetch(shadowBounds, first + ivec2(x, y), 0).r;
            least = min(least, depth);
            largest = max(largest, depth);
        }
    }
    bounds = vec4(least, largest, 0.0, 0.0);
}
