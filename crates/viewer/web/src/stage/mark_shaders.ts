/** Colour of what is chosen in the list, with a dark rim: no surface and no other mark has it. */
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

/** The strip around a line in pixels of the screen: \`vPlace\` runs along and across it, the line from 0 to \`vLength\`. */
export const MARK_LINE_VERTEX = `
in vec2 corner;
in vec3 a, b, tint;
in float wide, mark;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform vec2 viewport;
uniform float ratio, lift, selected, pulse;
uniform bool only;
out vec2 vPlace;
flat out float vLength, vRadius, vRim;
flat out vec3 vTint;
void main() {
  vec4 p = modelViewMatrix * vec4(a, 1.0);
  vec4 q = modelViewMatrix * vec4(b, 1.0);
  bool chosen = mark == selected;
  float nearer = chosen ? 2.0 * lift : lift;
  p.z += nearer;
  q.z += nearer;
  p = projectionMatrix * p;
  q = projectionMatrix * q;
  vec2 along = (q.xy / q.w - p.xy / p.w) * 0.5 * viewport;
  vLength = length(along);
  along = vLength > 1e-3 ? along / vLength : vec2(1.0, 0.0);
  vRadius = 0.5 * wide * ratio * (chosen ? 2.0 + 2.0 * pulse : 1.0) + 0.5;
  vRim = chosen ? 1.4 * ratio : 0.0;
  vTint = chosen ? ${CHOSEN} : tint;
  bool start = corner.x < 0.5;
  vPlace = vec2(start ? -vRadius : vLength + vRadius, corner.y * vRadius);
  vec2 shift = along * (start ? -vRadius : vRadius) + vec2(-along.y, along.x) * vPlace.y;
  gl_Position = start ? p : q;
  gl_Position.xy += 2.0 * shift / viewport * gl_Position.w;
  if (only && !chosen) gl_Position = ${NOWHERE};
}`

export const MARK_LINE = `
precision highp float;
in vec2 vPlace;
flat in float vLength, vRadius, vRim;
flat in vec3 vTint;
uniform float opacity;
out vec4 color;
void main() {
  float off = distance(vPlace, vec2(clamp(vPlace.x, 0.0, vLength), 0.0));
  float cover = clamp(vRadius - off, 0.0, 1.0);
  if (cover <= 0.0) discard;
  float rim = clamp(off - (vRadius - vRim) + 0.5, 0.0, 1.0) * step(0.01, vRim);
  color = vec4(mix(vTint, vec3(0.08), rim), cover * opacity);
}`
