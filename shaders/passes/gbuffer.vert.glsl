// Transforms world-space triangles into the view.
#include "shared/bindings.h"

layout(location = kPositionAttribute) in vec3 inPosition;
layout(location = kNormalAttribute) in vec3 inNormal;
layout(location = kColorAttribute) in vec4 inColor;
layout(location = kFirstIndexAttribute) in uint inFirstIndex;
#ifdef TEXTURED
layout(location = kTangentAttribute) in vec4 inTangent;
layout(location = kUv0Attribute) in vec2 inUv0;
layout(location = kUv1Attribute) in vec2 inUv1;
layout(location = 4) out vec2 vUv0;
layout(location = 5) out vec2 vUv1;
layout(location = 6) out vec4 vTangent;
#endif

layout(location = 0) uniform mat4 uWorldToClip;

layout(location = 0) out vec3 vPosition;
layout(location = 1) out vec3 vNormal;
layout(location = 2) out vec4 vColor;
layout(location = 3) flat out uint vFirstIndex;

void main() {
  gl_Position = uWorldToClip * vec4(inPosition, 1.0);
  vPosition = inPosition;
  vNormal = inNormal;
  vColor = inColor;
  vFirstIndex = inFirstIndex;
#ifdef TEXTURED
  vUv0 = inUv0;
  vUv1 = inUv1;
  vTangent = inTangent;
#endif
}
