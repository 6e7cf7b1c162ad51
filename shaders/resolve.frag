// The picture with smooth edges: each sample takes its colour from the shaded picture: from the pixel itself if the
// sample shows the same surface at about the same depth, else from the neighbour that fits best. In the middle of
// surfaces nothing changes. Colours are bytes of the sRGB curve; as light they are close to their squares.
uniform sampler2D picture;       // a: which surface a pixel shows
uniform sampler2D pictureDepth;
uniform sampler2DMS covering;
out vec4 colour;

const vec3 unpack = vec3(1.0, 1.0 / 255.0, 1.0 / 65025.0);

// How badly a pixel fits each of the four samples.
vec4 misfit(vec4 marks, vec4 depths, float mark, float depth) {
    vec4 other = step(0.5 / 255.0, abs(marks - mark));
    return 10.0 * other + abs(depths - depth) * step(0.5 / 255.0, marks);
}

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy);
    vec4 middle = texelFetch(picture, here, 0);
    float depth = texelFetch(pictureDepth, here, 0).r;
    vec4 a = texelFetch(covering, here, 0);
    vec4 b = texelFetch(covering, here, 1);
    vec4 c = texelFetch(covering, here, 2);
    vec4 d = texelFetch(covering, here, 3);
    vec4 marks = vec4(a.x, b.x, c.x, d.x);
    vec4 depths = vec4(dot(a.yzw, unpack), dot(b.yzw, unpack), dot(c.yzw, unpack), dot(d.yzw, unpack));

    vec4 error = misfit(marks, depths, middle.a, depth);
    vec3 square = middle.rgb * middle.rgb;
    mat4x3 lights = mat4x3(square, square, square, square);
    int neighbours = max(max(error.x, error.y), max(error.z, error.w)) > 0.0008 * (1.0 - depth) + 1e-6 ? 9 : 0;
    ivec2 last = textureSize(picture, 0) - 1;
    for (int i = 0; i < neighbours; ++i) {
        ivec2 at = clamp(here + ivec2(i % 3, i / 3) - 1, ivec2(0), last);
        vec4 beside = texelFetch(picture, at, 0);
        vec4 badness = misfit(marks, depths, beside.a, texelFetch(pictureDepth, at, 0).r);
        square = beside.rgb * beside.rgb;
        if (badness.x < error.x) lights[0] = square;
        if (badness.y < error.y) lights[1] = square;
        if (badness.z < error.z) lights[2] = square;
        if (badness.w < error.w) lights[3] = square;
        error = min(error, badness);
    }
    colour = vec4(sqrt(0.25 * (lights[0] + lights[1] + lights[2] + lights[3])), 1.0);
}
