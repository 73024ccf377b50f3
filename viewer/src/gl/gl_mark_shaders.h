// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// GLSL of the marks over the clay. Frames and colours as in gl_clay_shaders.h.
namespace argil::viewer {

/// A line of so many pixels across: strips of vertices on both sides of it, that know the points
/// before and after their own.
inline constexpr const char* kLineVertex = R"(
layout(location = 0) in vec3 before;
layout(location = 1) in vec3 at;
layout(location = 2) in vec3 after;
layout(location = 3) in vec4 color;
layout(location = 4) in float side;  // -1 or 1
uniform mat4 view;
uniform mat4 projection;
uniform vec2 half_size;    // of the viewport in pixels
uniform float half_width;  // of the line in pixels
uniform bool is_parallel;
uniform float nearer_mm;   // how much nearer a parallel lens sees lines than they are
out vec4 line_color;
noperspective out float across;  // pixels from the middle

// On a surface a line must not flicker: it is seen a little nearer, at the same pixel.
vec4 seen(vec3 position) {
  vec4 p = view * vec4(position, 1.0);
  if (is_parallel) p.z += nearer_mm;
  else p.xyz *= 0.997;
  return projection * p;
}
vec2 pixel(vec4 clip) { return half_size * clip.xy / max(clip.w, 1e-6); }
vec2 along(vec2 a, vec2 b) {
  vec2 d = b - a;
  return dot(d, d) > 1e-8 ? normalize(d) : vec2(0.0);
}
void main() {
  vec4 middle = seen(at);
  vec2 p = pixel(middle);
  vec2 come = along(pixel(seen(before)), p);
  vec2 go = along(p, pixel(seen(after)));
  vec2 direction = dot(come + go, come + go) > 1e-6 ? normalize(come + go) : vec2(1.0, 0.0);
  vec2 outward = vec2(-direction.y, direction.x);
  float reach = half_width + 1.0;
  // A corner reaches farther, or the line would be thinner there.
  float bend = max(abs(dot(direction, dot(go, go) > 0.0 ? go : come)), 0.5);
  across = side * reach;
  line_color = color;
  gl_Position = middle;
  gl_Position.xy += middle.w * side * reach / bend * outward / half_size;
}
)";

inline constexpr const char* kLineFragment = R"(
in vec4 line_color;
noperspective in float across;
uniform float half_width;
uniform vec4 tint;  // times the line's own colour
out vec4 picture;
void main() {
  float covered = clamp(half_width + 0.5 - abs(across), 0.0, 1.0);
  vec4 color = line_color * tint;
  picture = vec4(encoded(color.rgb), color.a * covered);
}
)";

/// Triangles in mm, lit where they have a normal.
inline constexpr const char* kSolidVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 color;
uniform mat4 view;
uniform mat4 projection;
uniform bool is_parallel;
uniform float nearer_mm;
out vec3 eye_normal;
out vec4 solid_color;
void main() {
  vec4 p = view * vec4(position, 1.0);
  if (is_parallel) p.z += nearer_mm;
  else p.xyz *= 0.997;
  gl_Position = projection * p;
  eye_normal = mat3(view) * normal;
  solid_color = color;
}
)";

inline constexpr const char* kSolidFragment = R"(
in vec3 eye_normal;
in vec4 solid_color;
out vec4 picture;
void main() {
  vec3 color = solid_color.rgb;
  if (dot(eye_normal, eye_normal) > 0.25) {
    vec3 n = normalize(eye_normal);
    color *= 0.35 + 0.75 * max(dot(n, normalize(vec3(-0.4, 0.6, 0.7))), 0.0);
  }
  picture = vec4(encoded(color), solid_color.a);
}
)";

/// A drop with its tip at the point, of the same size on the screen everywhere; fainter where clay
/// is before the point.
inline constexpr const char* kPinVertex = R"(
layout(location = 0) in vec3 at;
layout(location = 1) in vec2 corner;  // pixels from the tip
layout(location = 2) in vec3 color;
uniform mat4 view_projection;
uniform vec2 half_size;
uniform vec4 part;  // of the picture in pixels: corner, size
uniform sampler2D depth;
noperspective out vec2 pixel;
flat out vec3 pin_color;
flat out float strength;
void main() {
  vec4 clip = view_projection * vec4(at, 1.0);
  vec3 ndc = clip.xyz / max(clip.w, 1e-6);
  ivec2 under = ivec2(part.xy + part.zw * (0.5 + 0.5 * clamp(ndc.xy, -1.0, 1.0)));
  under = min(under, ivec2(part.xy + part.zw) - 1);
  float clay = texelFetch(depth, under, 0).r;
  strength = 0.5 + 0.5 * ndc.z <= clay + 0.004 * (1.0 - clay) + 1e-5 ? 1.0 : 0.55;
  pixel = corner;
  pin_color = color;
  gl_Position = clip;
  gl_Position.xy += clip.w * corner / half_size;
}
)";

inline constexpr const char* kPinFragment = R"(
noperspective in vec2 pixel;
flat in vec3 pin_color;
flat in float strength;
out vec4 picture;
const float kHead = 9.0;    // radius in pixels
const float kHeight = 21.0;  // of its middle over the tip
// Distance to the hull of the head and the tip (I. Quilez, "uneven capsule", one radius 0).
float drop(vec2 p) {
  p.x = abs(p.x);
  float b = kHead / kHeight;
  float a = sqrt(1.0 - b * b);
  vec2 from_head = p - vec2(0.0, kHeight);
  float k = dot(vec2(from_head.x, -from_head.y), vec2(-b, a));
  if (k < 0.0) return length(from_head) - kHead;
  if (k > a * kHeight) return length(p);
  return dot(vec2(from_head.x, -from_head.y), vec2(a, b)) - kHead;
}
void main() {
  float d = drop(pixel);
  float hole = length(pixel - vec2(0.0, kHeight)) - 3.5;
  vec3 color = mix(pin_color, vec3(1.0), clamp(0.5 - hole, 0.0, 1.0));
  color = mix(vec3(0.006), color, clamp(0.5 - (d + 1.2), 0.0, 1.0));
  picture = vec4(encoded(color), strength * clamp(0.5 - d, 0.0, 1.0));
}
)";

/// A cut: the material hatched as in an engineer's drawing, and the surface as a line.
inline constexpr const char* kSliceVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 texel;
uniform mat4 view_projection;
out vec2 uv;
void main() {
  gl_Position = view_projection * vec4(position, 1.0);
  uv = texel;
}
)";

inline constexpr const char* kSliceFragment = R"(
in vec2 uv;
uniform sampler2D distance_mm;
uniform float hatch_pixels;  // from line to line
out vec4 picture;
void main() {
  float mm = texture(distance_mm, uv).r;
  float covered = mm < 0.0 ? 1.0 : 0.0;
  float across = mod((gl_FragCoord.x + gl_FragCoord.y) / 1.41421356, hatch_pixels);
  float on_hatch = clamp(1.3 - min(across, hatch_pixels - across), 0.0, 1.0);
  vec3 color = mix(vec3(0.30, 0.125, 0.070), vec3(0.055, 0.022, 0.013), 0.8 * on_hatch);
  float pixels = abs(mm) / max(fwidth(mm), 1e-9);
  float on_line = clamp(1.7 - pixels, 0.0, 1.0);
  color = mix(color, vec3(0.004), on_line);
  covered = max(covered, on_line);
  // A frame, so that the cut is seen where nothing is.
  vec2 size = vec2(textureSize(distance_mm, 0));
  vec2 inside = min(uv * size - 0.5, size - 0.5 - uv * size) / max(fwidth(uv * size), 1e-9);
  float frame = 0.45 * clamp(1.5 - min(inside.x, inside.y), 0.0, 1.0);
  color = mix(color, vec3(0.55), max(frame - covered, 0.0));
  covered = max(covered, frame);
  if (covered <= 0.0) discard;  // it must not hide marks behind it
  picture = vec4(encoded(color), covered);
}
)";

}  // namespace argil::viewer
