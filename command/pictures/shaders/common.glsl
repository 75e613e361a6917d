#version 330 core

// Of one picture; PictureUniforms in C++.
layout(std140) uniform Picture {
  mat4 clipFromWorld;
  mat4 shadowFromWorld;  // coordinates of the shadow map, [0, 1]
  vec4 eye;              // [m]
  vec4 towardsLamp;      // of length 1
  vec4 up;               // of length 1; w: size of what there is to see [m]
  vec4 right;            // of the camera; w: tangent of half its angle
  vec4 above;            // of the camera; w: tangent of half its angle
  vec4 forward;          // of the camera; w: simulated time [s]
  vec4 shadow;           // of its soft edge, x: the width [m], y: the same over the shadow map's size
};
