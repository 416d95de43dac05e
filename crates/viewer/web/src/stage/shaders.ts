/** Numbers of objects in the value buffer: what is beyond is the number of a face. */
export const OBJECTS = 256
/** Faces in a row of the texture of their colors. */
export const FACE_COLUMNS = 256

/** A way through a surface, seen obliquely, is up to this much longer than straight. */
export const OBLIQUE = 3

/**
 * How far a point comes forward. Where discs overlap, one out of tolerance lies over those within it that are up to a disc's
 * radius nearer, and the farther beyond the higher. Where material is missing, points lie under the surface that they are
 * of, and discs beside them close over a narrow place: they come up to that surface, if they are of the one that is seen:
 * where they lie as deep under it as they measure. What lies far deeper is of a far side, and stays hidden. Of a chosen
 * range all come forward before what is gray.
 */
const FORWARD = `
#ifdef POINTS
#define OBLIQUE ${OBLIQUE.toFixed(1)}
uniform bool map, covered;
uniform vec2 range, zone, only;
uniform float rise, slack;
/* What is nearest at each pixel: how squarely it is seen, which discs are not, and its depth. */
uniform highp sampler2D cover;
flat out float vForward;
float forward(float v, vec4 at, float depth) {
  bool chosen = only.x > -1e38 || only.y < 1e38;
  if (!map || v > 5e29 || v < only.x || v > only.y) return 0.0;
  float beyond = zone.x <= zone.y ? max(v - zone.y, zone.x - v) - slack : 0.0;
  if (beyond <= 0.0) return chosen ? 0.5 * rise : 0.0;
  float room = max(range.y - zone.y, zone.x - range.x);
  float up = mix(0.8, 1.0, clamp(beyond / max(room, 1e-30), 0.0, 1.0)) * rise;
  if (!covered) return up;
  ivec2 size = textureSize(cover, 0);
  ivec2 pixel = ivec2(floor((at.xy / at.w * 0.5 + 0.5) * vec2(size)));
  vec4 front = texelFetch(cover, clamp(pixel, ivec2(0), size - 1), 0);
  if (front.z < 0.5 || front.x <= 0.0) return up;
  float under = front.y - depth;
  if (abs(under * front.x + v) < 1.5 * rise) return up + max(under, 0.0);
  return under * front.x > OBLIQUE * abs(v) + 1.5 * rise ? 0.0 : up;
}
#endif`

/** Shared by picture and value buffer: place, normal and value of a vertex. */
export const VERTEX = `
in vec4 position;
in float value;
#ifdef FACES
in float face;
flat out float vFace;
#endif
uniform mat4 modelViewMatrix, projectionMatrix;
uniform float pointSize, sink;
out vec3 vPlace;
out vec3 vNormal;
/* Above 0 on every facet with a corner on a crease. */
out float vCrease;
out float vValue;
/* Share of corners without a value, and their reason weighted by it. */
out vec2 vMissing;

${FORWARD}
vec3 unfold(float packed) {
  vec2 e = vec2(floor(packed / 256.0), mod(packed, 256.0)) / 127.5 - 1.0;
  vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
  float t = max(-n.z, 0.0);
  n.x += n.x >= 0.0 ? -t : t;
  n.y += n.y >= 0.0 ? -t : t;
  return normalize(n);
}

void main() {
#ifdef FACES
  vFace = face;
#endif
  vec4 place = modelViewMatrix * vec4(position.xyz, 1.0);
  vPlace = place.xyz;
  vCrease = position.w < 0.5 ? 1.0 : 0.0;
  vNormal = mat3(modelViewMatrix) * unfold(position.w);
  bool missing = value > 5e29;
  vValue = missing ? 0.0 : value;
  vMissing = missing ? vec2(1.0, floor(value / 1e30 + 0.5)) : vec2(0.0);
  place.z -= sink;
  gl_Position = projectionMatrix * place;
  gl_PointSize = pointSize;
#ifdef POINTS
  vForward = forward(value, gl_Position, vPlace.z);
#endif
}`

/**
 * A point is a disc, and lies in the depths as a cone with its tip to the eye: where discs overlap each pixel belongs to
 * the point whose middle is nearest, so that they close a surface and none is lost under its neighbors; but what matters
 * more comes forward.
 * Only for points: a shader that may discard keeps the GPU from leaving out what is hidden.
 */
const DISC = `
#ifdef POINTS
#define OBLIQUE ${OBLIQUE.toFixed(1)}
#define RIM 0.2
#define RIM_LIT 0.06
uniform mat4 projectionMatrix;
uniform float sink, lift;
flat in float vForward;
void disc() {
  float off = length(2.0 * gl_PointCoord - 1.0);
  if (off > 1.0) discard;
  vec4 tip = projectionMatrix * vec4(vPlace.xy, vPlace.z - sink + lift * (1.0 - off) + vForward, 1.0);
  gl_FragDepth = clamp(0.5 * tip.z / tip.w + 0.5, 0.0, 1.0);
}
#endif`

/** The picture. The color is found at the pixel from the interpolated value, so band edges are iso-lines. */
export const FRAGMENT = `
precision highp float;
precision highp int;
in vec3 vPlace;
in vec3 vNormal;
in float vCrease;
in float vValue;
in vec2 vMissing;
uniform bool map, flatColors, perspective, continuous, hatch, backfaces, back;
uniform float opacity;
uniform vec3 base;
uniform float limits[34];
uniform int limitCount;
uniform float slack;
uniform vec2 range, zone, only;
uniform sampler2D slots, ramp;
#ifdef FACES
flat in float vFace;
uniform bool modelColors;
uniform sampler2D faceColors;
#endif
out vec4 color;

#ifdef POINTS
const bool isPoints = true;
#else
const bool isPoints = false;
#endif
${DISC}

/* 0 is the low cap; a limit belongs to the band nearer the middle. Values are rounded to steps: half a step is still on it. */
int slotOf(float v) {
  int middle = limitCount / 2;
  int slot = middle;
  for (int i = 0; i < 34; i++) {
    if (i >= limitCount) break;
    if (i >= middle && v > limits[i] + slack) slot++;
    if (i < middle && v < limits[i] - slack) slot--;
  }
  return slot;
}

vec3 colorOf(float v, int slot) {
  bool zoned = zone.x <= zone.y;
  if (continuous && slot > 0 && slot < limitCount && !(zoned && slot == limitCount / 2)) {
    float t = (v - range.x) / (range.y - range.x);
    /* Half of the ramp lies below the zone and half above. */
    if (zoned) t = v > zone.y ? 0.5 + 0.5 * (v - zone.y) / (range.y - zone.y) : 0.5 * (v - range.x) / (zone.x - range.x);
    return texture(ramp, vec2(t, 0.5)).rgb;
  }
  return texelFetch(slots, ivec2(slot, 0), 0).rgb;
}

/*
  Diffuse light from the eye. A facet with a corner on a crease has its own normal throughout, so that it is as flat in the
  picture as it is; a choice pixel by pixel would draw curves on it that are not there.
*/
float light(float darkest) {
  vec3 eye = perspective ? normalize(-vPlace) : vec3(0.0, 0.0, 1.0);
  vec3 facet = normalize(cross(dFdx(vPlace), dFdy(vPlace)));
  vec3 smooth_ = normalize(vNormal);
  if (dot(smooth_, facet) < 0.0) smooth_ = -smooth_;
  vec3 n = vCrease > 1e-4 || isnan(smooth_.x) ? facet : smooth_;
  return mix(darkest, 1.0, abs(dot(n, eye)));
}

#ifdef POINTS
/* Likewise for a point, which has the normal of its surroundings. */
float pointLight(float darkest) {
  vec3 eye = perspective ? normalize(-vPlace) : vec3(0.0, 0.0, 1.0);
  return mix(darkest, 1.0, abs(dot(normalize(vNormal), eye)));
}
#endif

bool line(float along) { return mod(along, 7.0) < 1.6; }

void main() {
#ifdef POINTS
  disc();
#endif
  float up = gl_FragCoord.x + gl_FragCoord.y;
  bool inner = backfaces && !isPoints && !gl_FrontFacing;
#ifdef POINTS
  // Where no surface is known that the light could fall on, a darker rim tells points apart, and near from far.
  float lit = vCrease < 0.5 ? pointLight(map ? 0.6 : 0.45) : 1.0;
  float rim = (vCrease < 0.5 ? RIM_LIT : RIM) * dot(2.0 * gl_PointCoord - 1.0, 2.0 * gl_PointCoord - 1.0);
  float shade = flatColors ? 1.0 : lit * (1.0 - rim);
#else
  float shade = flatColors && map && !inner ? 1.0 : light(inner ? 0.55 : map ? 0.72 : 0.45);
#endif
  if (inner) {
    color = vec4((line(up) ? vec3(0.62, 0.42, 0.58) : vec3(0.74, 0.58, 0.71)) * shade, opacity);
    return;
  }
  if (!map) {
    vec3 own = base;
#ifdef FACES
    int number = int(vFace + 0.5);
    vec4 given = texelFetch(faceColors, ivec2(number % ${FACE_COLUMNS}, number / ${FACE_COLUMNS}), 0);
    if (modelColors && given.a > 0.5) own = given.rgb;
#endif
    if (back) own = mix(own, vec3(0.72, 0.74, 0.76), 0.8);
    color = vec4(own * shade, opacity);
    return;
  }
  float down = gl_FragCoord.x - gl_FragCoord.y;
  vec3 c;
  if (vMissing.x > 1e-4) {
    c = line(up) ? vec3(0.40, 0.43, 0.46) : vec3(0.604, 0.627, 0.651);
  } else {
    int slot = slotOf(vValue);
    c = colorOf(vValue, slot);
    if (hatch && slot > limitCount / 2 && line(up)) c = vec3(0.0);
    if (hatch && slot < limitCount / 2 && line(down)) c = vec3(1.0);
    if (vValue < only.x || vValue > only.y) c = vec3(0.72, 0.74, 0.76);
  }
  color = vec4(c * shade, opacity);
}`

/**
 * The value buffer: value, distance before the eye, object, reason why there is no value (0: there is one). As the cover: how
 * squarely the surface is seen in place of its value.
 */
export const VALUES = `
precision highp float;
in vec3 vPlace;
in vec3 vNormal;
in float vValue;
in vec2 vMissing;
uniform float objectId;
#ifdef FACES
flat in float vFace;
#endif
/* What is nearest at each pixel: the surface that hides points. */
uniform highp sampler2D cover;
uniform bool covered, asCover, perspective;
/* How far behind it a point without a deviation of its own still lies on it. */
uniform float near;
out vec4 color;
${DISC}
void main() {
  bool missing = vMissing.x > 1e-4;
#ifdef POINTS
  disc();
  vec4 front = covered ? texelFetch(cover, ivec2(gl_FragCoord.xy), 0) : vec4(0.0);
  if (front.z > 0.5 && front.y - vPlace.z > max(near, missing ? 0.0 : OBLIQUE * abs(vValue))) discard;
#endif
  vec3 eye = perspective ? normalize(-vPlace) : vec3(0.0, 0.0, 1.0);
#ifdef POINTS
  float square = 0.0;
#else
  float square = abs(dot(normalize(cross(dFdx(vPlace), dFdy(vPlace))), eye));
#endif
  float number = objectId;
#ifdef FACES
  number += ${OBJECTS.toFixed(1)} * (vFace + 1.0);
#endif
  color = vec4(asCover ? square : vValue, vPlace.z, number, missing ? floor(vMissing.y / vMissing.x + 0.5) : 0.0);
}`
