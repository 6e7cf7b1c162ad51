// Seen from above, for the occlusion of the ground.
layout(location = 0) in vec3 position;
uniform mat4 transform;
uniform vec4 area;  // xy: corner [m], zw: extent [m]
uniform float groundHeight;
out float height;

void main() {
    vec3 place = (transform * vec4(position, 1.0)).xyz;
    height = place.y - groundHeight;
    gl_Position = vec4(2.0 * (place.xz - area.xy) / area.zw - 1.0, 0.0, 1.0);
}
