// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// GLSL of what covers the whole picture: the background and ambient occlusion.
namespace argil::viewer {

/// One triangle over the viewport, of three vertices without attributes.
inline constexpr const char* kScreenVertex = R"(
out vec2 fraction;  // of the viewport, 0 to 1
void main() {
  fraction = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);
  gl_Position = vec4(2.0 * fraction - 1.0, 1.0, 1.0);
}
)";

inline constexpr const char* kBackgroundFragment = R"(
in vec2 fraction;
uniform vec2 rows;  // where the viewport begins in the whole, and its share of that
out vec4 picture;
uniform vec3 low;
uniform vec3 high;
void main() {
  vec3 color = mix(low, high, rows.x + rows.y * fraction.y);
  // Half a step of 8 bits to and fro, so that the gradient has no bands.
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  picture = vec4(color + (noise - 0.5) / 255.0, 1.0);
}
)";

/// Where a pixel's clay is in the eye's frame. `part` is the lens's part of the picture in pixels
/// (corner, size), `lens` (near, far, tan_x, tan_y).
inline constexpr const char* kPositionFunctions = R"(
uniform sampler2D depth;
uniform vec4 part;
uniform vec4 lens;
uniform vec2 shift;  // of the picture's middle, as tan_x and tan_y
uniform bool is_parallel;
float distance_at(float d) {
  return is_parallel ? mix(lens.x, lens.y, d)
                     : lens.x * lens.y / (lens.y - d * (lens.y - lens.x));
}
float depth_at(vec2 pixel) {
  vec2 kept = clamp(pixel, part.xy + 0.5, part.xy + part.zw - 0.5);
  return texelFetch(depth, ivec2(kept), 0).r;
}
vec3 position_at(vec2 pixel, float d) {
  float away = distance_at(d);
  vec2 slope = (2.0 * (pixel - part.xy) / part.zw - 1.0) * lens.zw + shift;
  return vec3(slope * (is_parallel ? 1.0 : away), -away);
}
float pixel_mm_at(float away) { return 2.0 * lens.w * (is_parallel ? 1.0 : away) / part.w; }
vec3 position_at(vec2 pixel) { return position_at(pixel, depth_at(pixel)); }
)";

/// How open the sky is over each point: scalable ambient obscurance (M. McGuire, M. Mara and D.
/// Luebke, HPG 2012), from one level of depth, at half the picture's size.
inline constexpr const char* kOcclusionFragment = R"(
out vec4 picture;
const int kTaps = 16;
const float kTurns = 7.0;         // of the spiral of taps
const float kRadiusFraction = 0.075;  // of the picture's height
vec3 nearer(vec3 a, vec3 b) { return dot(a, a) < dot(b, b) ? a : b; }
void main() {
  vec2 pixel = 2.0 * floor(gl_FragCoord.xy) + 0.5;
  float d = depth_at(pixel);
  if (d >= 1.0) {
    picture = vec4(1.0);
    return;
  }
  vec3 position = position_at(pixel, d);
  vec3 x = nearer(position_at(pixel + vec2(1.0, 0.0)) - position, position - position_at(pixel - vec2(1.0, 0.0)));
  vec3 y = nearer(position_at(pixel + vec2(0.0, 1.0)) - position, position - position_at(pixel - vec2(0.0, 1.0)));
  vec3 normal = normalize(cross(x, y));
  float radius_pixels = kRadiusFraction * part.w;
  float radius = radius_pixels * pixel_mm_at(-position.z);
  ivec2 cell = ivec2(gl_FragCoord.xy) & 3;
  float turn = 6.2831853 * float((cell.x * 4 + cell.y * 7 + cell.x * cell.y * 5) & 15) / 16.0;
  float closed = 0.0;
  for (int i = 0; i < kTaps; ++i) {
    float out_fraction = (float(i) + 0.5) / float(kTaps);
    float angle = turn + 6.2831853 * kTurns * out_fraction;
    vec3 to = position_at(floor(pixel + out_fraction * radius_pixels * vec2(cos(angle), sin(angle))) + 0.5) - position;
    float near = max(1.0 - dot(to, to) / (radius * radius), 0.0);
    float rise = dot(to, normal) - 0.04 * radius;
    closed += near * near * near * max(rise, 0.0) / (dot(to, to) / radius + 0.04 * radius);
  }
  float open = max(1.0 - 6.4 * closed / float(kTaps), 0.0);
  picture = vec4(open);
}
)";

/// The mean bend of 2 x 2 pixels (kCurvatureShade).
inline constexpr const char* kBendFragment = R"(
uniform sampler2D values;
out vec4 picture;
void main() {
  ivec2 at = 2 * ivec2(gl_FragCoord.xy);
  ivec2 last = textureSize(values, 0) - 1;
  float sum = texelFetch(values, min(at, last), 0).a;
  sum += texelFetch(values, min(at + ivec2(1, 0), last), 0).a;
  sum += texelFetch(values, min(at + ivec2(0, 1), last), 0).a;
  sum += texelFetch(values, min(at + ivec2(1, 1), last), 0).a;
  picture = vec4(0.25 * sum);
}
)";

/// The mean over 4 x 4 values, the cell of the occlusion's noise, of pixels about as far away.
inline constexpr const char* kSmoothingFragment = R"(
uniform sampler2D values;
const float kAlikePixels = 25.0;  // how far apart in depth pixels may be that are smoothed together
uniform float nothing;            // where there is no clay: what changes nothing beside it
out vec4 picture;
void main() {
  ivec2 here = ivec2(gl_FragCoord.xy);
  float d = depth_at(2.0 * vec2(here) + 0.5);
  if (d >= 1.0) {
    picture = vec4(nothing);
    return;
  }
  float away = distance_at(d);
  float step_mm = lens.y - lens.x;  // of distance for one of depth
  if (!is_parallel) step_mm *= away * away / (lens.x * lens.y);
  float alike = step_mm / (kAlikePixels * pixel_mm_at(away));
  ivec2 first = ivec2(part.xy) / 2;
  ivec2 last = ivec2(part.xy + part.zw) / 2 - 1;
  float sum = 0.0;
  float weight = 0.0;
  for (int j = -2; j < 2; ++j) {
    for (int i = -2; i < 2; ++i) {
      ivec2 at = clamp(here + ivec2(i, j), first, last);
      float w = 1e-4 + max(1.0 - alike * abs(texelFetch(depth, 2 * at, 0).r - d), 0.0);
      sum += w * texelFetch(values, at, 0).r;
      weight += w;
    }
  }
  picture = vec4(sum / weight);
}
)";

/// Multiplies the picture, which is sRGB: a power of a product is the product of powers.
inline constexpr const char* kDarkenFragment = R"(
uniform sampler2D values;
out vec4 picture;
void main() {
  if (depth_at(gl_FragCoord.xy) >= 1.0) discard;
  float open = texture(values, 0.5 * gl_FragCoord.xy / vec2(textureSize(values, 0))).r;
  picture = vec4(vec3(pow(mix(0.10, 1.0, open), 1.0 / 2.2)), 1.0);
}
)";

/// Ridges stay light, flats become grey and valleys dark.
inline constexpr const char* kContrastFragment = R"(
uniform sampler2D values;
out vec4 picture;
void main() {
  vec3 color = vec3(1.0);
  if (depth_at(gl_FragCoord.xy) < 1.0) {
    float mean = texture(values, 0.5 * gl_FragCoord.xy / vec2(textureSize(values, 0))).r;
    float bend = clamp(1.6 * (2.0 * mean - 1.0), -1.0, 1.0);
    color = bend > 0.0 ? mix(vec3(0.24), vec3(1.0, 0.97, 0.92), bend)
                       : mix(vec3(0.24), vec3(0.012, 0.014, 0.026), -bend);
  }
  picture = vec4(pow(color, vec3(1.0 / 2.2)), 1.0);
}
)";

}  // namespace argil::viewer
