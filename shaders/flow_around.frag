// Motion of ground and sky, by that of the camera.
#include "frame.glsl"
#include "flow.glsl"
uniform mat4 nextProjection;
uniform vec3 firstWay;  // as in light.frag
uniform vec3 rightWay;
uniform vec3 upWay;
uniform float groundHeight;  // [m]; the eye's where there is no ground
out vec4 colour;

void main() {
    vec3 way = firstWay + gl_FragCoord.x * rightWay + gl_FragCoord.y * upWay;
    float ahead = (groundHeight - eye.y) / way.y;
    colour = motion(nextProjection * (ahead > 0.0 ? vec4(eye.xyz + ahead * way, 1.0) : vec4(way, 0.0)));
}
