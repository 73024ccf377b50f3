// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// GLSL of the clay. Frames: the eye's is Lens::view (x right, y up, z back). Colours are linear
// until `encoded`.
namespace argil::viewer {

/// What every fragment shader may use.
inline constexpr const char* kColorFunctions = R"(
// As sRGB, to a hundredth, by roots: powers are dear where shaders run on the processor. Source: I.
// Taylor, "Simple and fast sRGB approximation" (2013).
vec3 encoded(vec3 color) {
  vec3 c = clamp(color, 0.0, 1.0);
  vec3 root = sqrt(c);
  vec3 fourth = sqrt(root);
  vec3 eighth = sqrt(fourth);
  return max(0.662002687 * root + 0.684122060 * fourth - 0.323583601 * eighth - 0.0225411470 * c, 0.0);
}
)";

inline constexpr const char* kClayVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in float mask;
uniform mat4 view;
uniform mat4 view_projection;
uniform vec4 cut;  // what is on its negative side is cut away
out vec3 eye_normal;
out float masked_fraction;
void main() {
  gl_Position = view_projection * vec4(position, 1.0);
  gl_ClipDistance[0] = dot(cut, vec4(position, 1.0));
  eye_normal = mat3(view) * normal;
  masked_fraction = mask;
}
)";

/// `toward`: the direction from the fragment to the eye, in the eye's frame. `shade` comes after.
inline constexpr const char* kClayFragmentHead = R"(
in vec3 eye_normal;
in float masked_fraction;
uniform vec4 ray;  // scale and offset from a pixel to its ray's slope; zero in a parallel lens
uniform vec3 level_color;
uniform vec3 base_color;  // of the clay, or of the piece where it has its own
out vec4 picture;

const vec3 kKeyLight = normalize(vec3(-0.48, 0.66, 0.58));
const vec3 kFillLight = normalize(vec3(0.80, -0.10, 0.45));
)";

/// Modelling clay: a soft key light from the upper left, a cool one from the right, light that
/// scatters red where the key fades, a broad sheen and a rim.
inline constexpr const char* kMatcapShade = R"(
vec4 shade(vec3 n, vec3 toward) {
  // The normal as seen along this pixel's ray, so that a ball looks the same off the centre.
  vec3 x = normalize(cross(vec3(0.0, 1.0, 0.0), toward));
  vec3 m = vec3(dot(n, x), dot(n, cross(toward, x)), dot(n, toward));
  float key = dot(m, kKeyLight);
  float lit = clamp((key + 0.22) / 1.22, 0.0, 1.0);
  float sky = 0.5 + 0.5 * m.y;
  vec3 light = 1.12 * lit * lit * vec3(1.0, 0.955, 0.885);
  light += mix(vec3(0.070, 0.048, 0.044), vec3(0.175, 0.180, 0.200), sky);
  light += 0.17 * max(dot(m, kFillLight), 0.0) * vec3(0.66, 0.84, 1.0);
  vec3 color = base_color * light;
  float fading = smoothstep(-0.35, 0.10, key) * (1.0 - smoothstep(0.10, 0.65, key));
  color += fading * base_color * vec3(0.0769, 0.0267, 0.0078);
  vec3 between = normalize(kKeyLight + vec3(0.0, 0.0, 1.0));
  float sheen = max(dot(m, between), 0.0);
  // Its 16th and 64th power: pow is dear where shaders run on the processor.
  float broad = sheen * sheen;
  broad *= broad;
  broad *= broad;
  broad *= broad;
  float narrow = broad * broad;
  narrow *= narrow;
  color += 0.050 * broad * vec3(1.0, 0.90, 0.80) + 0.060 * narrow * vec3(1.0, 0.96, 0.92);
  float edge = 1.0 - clamp(m.z, 0.0, 1.0);
  edge *= edge;
  color *= 1.0 - 0.50 * edge;
  color += edge * edge * (0.015 + 0.17 * sky) * vec3(1.0, 0.88, 0.80);
  return vec4(color, 1.0);
}
)";

inline constexpr const char* kPlainShade = R"(
vec4 shade(vec3 n, vec3 toward) {
  vec3 light = 0.84 * max(dot(n, kKeyLight), 0.0) * vec3(1.0, 0.98, 0.95);
  light += 0.14 * max(dot(n, kFillLight), 0.0) * vec3(0.85, 0.93, 1.0);
  light += mix(0.10, 0.26, 0.5 + 0.5 * n.y);
  return vec4(base_color * light, 1.0);
}
)";

/// How fast the normal turns over so many pixels, -1 (valley) to 1 (ridge), in alpha; what it does
/// to the colour comes later (kContrastFragment).
inline constexpr const char* kCurvatureShade = R"(
vec4 shade(vec3 n, vec3 toward) {
  const float kPixels = 16.0;
  float bend = kPixels * (dFdx(n).x + dFdy(n).y);
  float fraction = bend / (1.0 + abs(bend));
  const vec3 chalk = vec3(0.98, 0.96, 0.92);
  return vec4(chalk * (0.66 + 0.34 * max(dot(n, kKeyLight), 0.0)), 0.5 + 0.5 * fraction);
}
)";

inline constexpr const char* kLevelShade = R"(
vec4 shade(vec3 n, vec3 toward) {
  float key = 0.5 + 0.5 * dot(n, kKeyLight);
  return vec4(level_color * (0.25 + 0.90 * key * key), 1.0);
}
)";

inline constexpr const char* kClayFragmentMain = R"(
void main() {
  vec3 toward = normalize(vec3(-(gl_FragCoord.xy * ray.xy + ray.zw), 1.0));
  vec3 n = normalize(eye_normal);
  // Only a cut shows the inside.
  vec4 color = shade(gl_FrontFacing ? n : -n, toward);
  // What is masked is dark and without colour, which shadows are not.
  vec3 grey = vec3(dot(color.rgb, vec3(0.30, 0.59, 0.11)));
  vec3 seen = mix(color.rgb, grey, 0.75 * masked_fraction);
  float light = (gl_FrontFacing ? 1.0 : 0.35) * (1.0 - 0.82 * masked_fraction);
  picture = vec4(encoded(seen * light), color.a);
}
)";

inline constexpr const char* kWireFragment = R"(
uniform vec4 wire;  // colour and how much of it
out vec4 picture;
void main() { picture = vec4(encoded(wire.rgb), wire.a); }
)";

}  // namespace argil::viewer
