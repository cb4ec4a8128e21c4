// The test of a point against a map, as text for shaders: see `visibility-map.ts`.

export const GLSL = `uniform highp sampler2D hprDepths;
uniform highp vec3 hprViewpoint;
uniform highp vec4 hprMargins;
highp float hprDepth(int i) {
  return texelFetch(hprDepths, ivec2(i & 255, i >> 8), 0).r;
}
bool hidden(highp vec3 position) {
  highp vec3 v = position - hprViewpoint;
  highp vec3 a = abs(v);
  int side = a.z >= a.x && a.z >= a.y ? 0 : a.x >= a.y ? 2 : 4;
  v = side == 0 ? v : side == 2 ? v.yzx : v.zxy;
  int window = 8 * (v.z < 0.0 ? side + 1 : side);
  highp float inverse = 1.0 / abs(v.z);
  highp vec2 place = v.xy * inverse;
  highp vec2 cell = (place - vec2(hprDepth(window), hprDepth(window + 1))) * hprMargins.x;
  highp vec2 size = vec2(hprDepth(window + 2), hprDepth(window + 3));
  highp vec2 corner = floor(cell);
  highp vec2 t = cell - corner;
  highp float border = hprMargins.y + hprMargins.z * inverse;
  bool known = all(greaterThanEqual(corner, vec2(0.0))) && all(lessThan(corner, size))
    && all(greaterThan(t, vec2(border))) && all(lessThan(t, vec2(1.0 - border)));
  if (!known) return false;
  int across = int(size.x) + 1;
  int low = int(hprDepth(window + 4)) + int(corner.y) * across + int(corner.x);
  highp vec4 d = vec4(hprDepth(low), hprDepth(low + 1), hprDepth(low + across), hprDepth(low + across + 1));
  highp vec2 sides = d.xz * (1.0 - t.x) + d.yw * t.x;
  highp float most = max(max(d.x, d.y), max(d.z, d.w));
  highp float least = min(min(d.x, d.y), min(d.z, d.w));
  highp float limit = sides.x * (1.0 - t.y) + sides.y * t.y + (most - least) * (2.0 * border) + most * 4e-6;
  highp float range = abs(v.z) * sqrt(place.x * place.x + place.y * place.y + 1.0);
  return most < 1e30 && range * (1.0 - 8e-6) - hprMargins.w > limit;
}
`;

export const WGSL = `fn hprDepth(i: i32) -> f32 {
  return textureLoad(hprDepths, vec2i(i & 255, i >> 8u), 0).r;
}
fn hidden(position: vec3f) -> bool {
  var v = position - hprViewpoint;
  let a = abs(v);
  let side = select(select(4, 2, a.x >= a.y), 0, a.z >= a.x && a.z >= a.y);
  v = select(select(v.zxy, v.yzx, side == 2), v, side == 0);
  let window = 8 * select(side, side + 1, v.z < 0.0);
  let inverse = 1.0 / abs(v.z);
  let place = v.xy * inverse;
  let cell = (place - vec2f(hprDepth(window), hprDepth(window + 1))) * hprMargins.x;
  let size = vec2f(hprDepth(window + 2), hprDepth(window + 3));
  let corner = floor(cell);
  let t = cell - corner;
  let border = hprMargins.y + hprMargins.z * inverse;
  let known = all(corner >= vec2f(0.0)) && all(corner < size) && all(t > vec2f(border)) && all(t < vec2f(1.0 - border));
  if (!known) { return false; }
  let across = i32(size.x) + 1;
  let low = i32(hprDepth(window + 4)) + i32(corner.y) * across + i32(corner.x);
  let d = vec4f(hprDepth(low), hprDepth(low + 1), hprDepth(low + across), hprDepth(low + across + 1));
  let sides = d.xz * (1.0 - t.x) + d.yw * t.x;
  let most = max(max(d.x, d.y), max(d.z, d.w));
  let least = min(min(d.x, d.y), min(d.z, d.w));
  let limit = sides.x * (1.0 - t.y) + sides.y * t.y + (most - least) * (2.0 * border) + most * 4e-6;
  let range = abs(v.z) * sqrt(place.x * place.x + place.y * place.y + 1.0);
  return most < 1e30 && range * (1.0 - 8e-6) - hprMargins.w > limit;
}
`;
