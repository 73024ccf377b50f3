// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// GLSL of the clay. Frames: the eye's is Lens::view (x right, y up, z back). Colours are linear
// until `encoded`.
namespace argil::viewer {

/// What every fragment shader may use.
inline constexpr const char* kColorFunctions = R"(
vec3 encoded(vec3 color) {  // as sRGB
  vec3 c = clamp(color, 0.0, 1.0);
  return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, vec3(lessThan(c, vec3(0.0031308))));
}
)";

inline constexpr const char* kClayVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in float held;
uniform mat4 view;
uniform mat4 view_projection;
uniform vec4 cut;  // what is on its negative side is cut away
out vec3 eye_normal;
out float held_share;
void main() {
  gl_Position = view_projection * vec4(position, 1.0);
  gl_ClipDistance[0] = dot(cut, vec4(position, 1.0));
  eye_normal = mat3(view) * normal;
  held_share = held;
}
)";

/// `toward`: the direction from the fragment to the eye, in the eye's frame. `shade` comes after.
inline constexpr const char* kClayFragmentHead = R"(
in vec3 eye_normal;
in float held_share;
uniform vec4 ray;  // scale and offset from a pixel to its ray's slope; zero in a parallel lens
uniform vec3 level_color;
out vec4 picture;

const vec3 kKeyLight = normalize(vec3(-0.48, 0.66, 0.58));
const vec3 kFillLight = normalize(vec3(0.80, -0.10, 0.45));
)";

/// Modelling clay: a soft key light from the upper left, a cool one from the right, light that
/// scatters red where the key fades, a broad sheen and a rim.
inline constexpr const char* kMatcapShade = R"(
vec3 shade(vec3 n, vec3 toward) {
  // The normal as seen along this pixel's ray, so that a ball looks the same off the centre.
  vec3 x = normalize(cross(vec3(0.0, 1.0, 0.0), toward));
  vec3 m = vec3(dot(n, x), dot(n, cross(toward, x)), dot(n, toward));
  const vec3 clay = vec3(0.50, 0.245, 0.150);
  float key = dot(m, kKeyLight);
  float lit = clamp((key + 0.30) / 1.30, 0.0, 1.0);
  float sky = 0.5 + 0.5 * m.y;
  vec3 light = 1.18 * lit * lit * vec3(1.0, 0.965, 0.91);
  light += mix(vec3(0.105, 0.085, 0.080), vec3(0.235, 0.245, 0.270), sky);
  light += 0.20 * max(dot(m, kFillLight), 0.0) * vec3(0.72, 0.86, 1.0);
  vec3 color = clay * light;
  float fading = smoothstep(-0.40, 0.05, key) * (1.0 - smoothstep(0.05, 0.60, key));
  color += fading * vec3(0.050, 0.010, 0.003);
  vec3 between = normalize(kKeyLight + vec3(0.0, 0.0, 1.0));
  float sheen = max(dot(m, between), 0.0);
  color += 0.085 * pow(sheen, 16.0) * vec3(1.0, 0.93, 0.86);
  color += 0.050 * pow(sheen, 70.0) * vec3(1.0, 0.97, 0.94);
  float edge = 1.0 - clamp(m.z, 0.0, 1.0);
  color *= 1.0 - 0.45 * edge * edge;
  color += pow(edge, 3.5) * (0.02 + 0.16 * sky) * vec3(0.95, 0.90, 0.88);
  return color;
}
)";

inline constexpr const char* kPlainShade = R"(
vec3 shade(vec3 n, vec3 toward) {
  const vec3 chalk = vec3(0.58, 0.565, 0.54);
  float key = max(dot(n, kKeyLight), 0.0);
  return chalk * (0.92 * key * vec3(1.0, 0.98, 0.95) + mix(0.16, 0.30, 0.5 + 0.5 * n.y));
}
)";

/// Ridges light, valleys dark: how fast the normal turns over so many pixels.
inline constexpr const char* kCurvatureShade = R"(
vec3 shade(vec3 n, vec3 toward) {
  const float kPixels = 14.0;
  float bend = kPixels * (dFdx(n).x + dFdy(n).y);
  float share = bend / (1.0 + abs(bend));  // -1 to 1
  vec3 color = share > 0.0 ? mix(vec3(0.26), vec3(1.0, 0.93, 0.80), share)
                           : mix(vec3(0.26), vec3(0.010, 0.012, 0.030), -share);
  return color * (0.72 + 0.28 * max(dot(n, kKeyLight), 0.0));
}
)";

inline constexpr const char* kLevelShade = R"(
vec3 shade(vec3 n, vec3 toward) {
  float key = 0.5 + 0.5 * dot(n, kKeyLight);
  return level_color * (0.30 + 0.85 * key * key);
}
)";

inline constexpr const char* kClayFragmentMain = R"(
void main() {
  vec3 toward = normalize(vec3(-(gl_FragCoord.xy * ray.xy + ray.zw), 1.0));
  vec3 n = normalize(eye_normal);
  // Only a cut shows the inside.
  vec3 color = gl_FrontFacing ? shade(n, toward) : 0.35 * shade(-n, toward);
  picture = vec4(encoded(color * (1.0 - 0.72 * held_share)), 1.0);
}
)";

inline constexpr const char* kWireFragment = R"(
uniform vec4 wire;  // colour and how much of it
out vec4 picture;
void main() { picture = vec4(encoded(wire.rgb), wire.a); }
)";

}  // namespace argil::viewer
