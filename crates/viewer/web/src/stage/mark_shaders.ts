/** Color of what is chosen in the list, with a dark rim: no surface and no other mark has it. */
const CHOSEN = 'vec3(1.0, 0.88, 0.0)'

/** Outside of everything that is drawn. */
const NOWHERE = 'vec4(2.0, 2.0, 2.0, 1.0)'

export const MARK_AREA_VERTEX = `
in vec3 position, tint;
in float mark;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform float lift, selected;
uniform bool only;
flat out vec3 vTint;
void main() {
  vec4 place = modelViewMatrix * vec4(position, 1.0);
  place.z += lift;
  vTint = mark == selected ? ${CHOSEN} : tint;
  gl_Position = only && mark != selected ? ${NOWHERE} : projectionMatrix * place;
}`

export const MARK_AREA = `
precision highp float;
flat in vec3 vTint;
uniform float opacity;
out vec4 color;
void main() { color = vec4(vTint, opacity); }`

/** The strip around a line in pixels of the screen: `vPlace` runs along and across it, the line from 0 to `vLength`. */
const STRIP = `
in vec2 corner;
in vec3 a, b;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform vec2 viewport;
out vec2 vPlace;
flat out float vLength, vRadius;
/* From the ends of the line as the eye has them; cap beyond each. */
vec4 strip(vec4 p, vec4 q, float radius, float cap) {
  p = projectionMatrix * p;
  q = projectionMatrix * q;
  vec2 along = (q.xy / q.w - p.xy / p.w) * 0.5 * viewport;
  vLength = length(along);
  vRadius = radius;
  along = vLength > 1e-3 ? along / vLength : vec2(1.0, 0.0);
  bool start = corner.x < 0.5;
  vPlace = vec2(start ? -cap : vLength + cap, corner.y * radius);
  vec2 shift = along * (start ? -cap : cap) + vec2(-along.y, along.x) * vPlace.y;
  vec4 place = start ? p : q;
  place.xy += 2.0 * shift / viewport * place.w;
  return place;
}`

/** How much of a pixel the line covers. */
const COVER = `
in vec2 vPlace;
flat in float vLength, vRadius;
float off() { return distance(vPlace, vec2(clamp(vPlace.x, 0.0, vLength), 0.0)); }
float cover() { return clamp(vRadius - off(), 0.0, 1.0); }`

export const MARK_LINE_VERTEX = `
${STRIP}
in vec3 tint;
in float wide, mark;
uniform float ratio, lift, selected, pulse;
uniform bool only;
flat out float vRim;
flat out vec3 vTint;
void main() {
  vec4 p = modelViewMatrix * vec4(a, 1.0);
  vec4 q = modelViewMatrix * vec4(b, 1.0);
  bool chosen = mark == selected;
  float nearer = chosen ? 2.0 * lift : lift;
  p.z += nearer;
  q.z += nearer;
  float radius = 0.5 * wide * ratio * (chosen ? 2.0 + 2.0 * pulse : 1.0) + 0.5;
  vRim = chosen ? 1.4 * ratio : 0.0;
  vTint = chosen ? ${CHOSEN} : tint;
  gl_Position = strip(p, q, radius, radius);
  if (only && !chosen) gl_Position = ${NOWHERE};
}`

export const MARK_LINE = `
precision highp float;
${COVER}
flat in float vRim;
flat in vec3 vTint;
uniform float opacity;
out vec4 color;
void main() {
  float covered = cover();
  if (covered <= 0.0) discard;
  float rim = clamp(off() - (vRadius - vRim) + 0.5, 0.0, 1.0) * step(0.01, vRim);
  color = vec4(mix(vTint, vec3(0.08), rim), covered * opacity);
}`

/** A line of the part itself: thin and dark, whatever colors lie beside it. */
export const EDGE_VERTEX = `
${STRIP}
in float room;
/* The room that an edge needs beside it, as its own is given. */
uniform float wide, lift, needed;
flat out float vShare;
void main() {
  float share = min(1.0, room / needed);
  vShare = share * share;
  vec4 p = modelViewMatrix * vec4(a, 1.0);
  vec4 q = modelViewMatrix * vec4(b, 1.0);
  p.z += lift;
  q.z += lift;
  /* Without round ends: where they overlap a row of edges would be dotted. */
  gl_Position = vShare < 0.02 ? ${NOWHERE} : strip(p, q, 0.5 * wide + 0.5, 0.0);
}`

export const EDGE = `
precision highp float;
${COVER}
flat in float vShare;
uniform float opacity;
out vec4 color;
void main() {
  float covered = cover() * vShare;
  if (covered <= 0.0) discard;
  color = vec4(vec3(0.06, 0.08, 0.1), covered * opacity);
}`
