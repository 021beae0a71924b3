// SPDX-License-Identifier: MIT
// Light reaching the eye from a point of a particle: the equation of core/scene/scene.hpp, in view
// space. Specialization constants leave out what a scene does not need.
#ifndef MOTE_SHADING_GLSL
#define MOTE_SHADING_GLSL

// How much of light i arrives past what casts shadows: a shader that knows defines it before it includes this.
#ifndef LIGHT_VISIBILITY
#define LIGHT_VISIBILITY(i) 1.0
#endif

// Light i of the frame and its ambient light; an includer that has taken them into variables says so.
#ifndef FRAME_LIGHT
#define FRAME_LIGHT(i) frame.lights[i]
#define FRAME_AMBIENT frame.ambient.rgb
#endif

struct Surface {
  vec3 position; // view space
  vec3 normal;   // unit, turned to the eye
  vec3 to_eye;   // unit
};

// x^e with x in [0, 1], e >= 0 and x^0 = 1; pow(0, 0) is undefined in GLSL.
float power(float x, float e) { return e == 0.0 ? 1.0 : pow(max(x, 1e-30), e); }

void light_at(int i, vec3 position, out vec3 to_light, out float strength) {
  Light light = FRAME_LIGHT(i);
  to_light = light.position.xyz;
  strength = 1.0;
  if (local_lights) {
    vec3 v = light.position.xyz - position * light.position.w;
    float d = length(v);
    to_light = v / max(d, 1e-30);
    float a = light.attenuation.x + light.attenuation.y * d + light.attenuation.z * d * d;
    float x = clamp((dot(-to_light, light.axis.xyz) - light.cone.x) * light.cone.y, 0.0, 1.0);
    strength = x * x * (3.0 - 2.0 * x) / a;
  }
}

// material: ambient, diffuse, specular, exponent.
vec3 shade(Surface at, vec3 color, vec4 material) {
  vec3 diffuse = material.x * FRAME_AMBIENT;
  vec3 specular = vec3(0.0);
  for (int i = 0; i < light_count; ++i) {
    vec3 to_light;
    float strength;
    light_at(i, at.position, to_light, strength);
    vec3 light = FRAME_LIGHT(i).strength.rgb * (strength * LIGHT_VISIBILITY(i));
    float cosine = dot(at.normal, to_light);
    diffuse += material.y * max(cosine, 0.0) * light;
    if (specular_model != 0) {
      float x = specular_model == 1 ? dot(2.0 * cosine * at.normal - to_light, at.to_eye)
                                    : dot(at.normal, normalize(to_light + at.to_eye));
      specular += (cosine > 0.0 ? power(max(x, 0.0), material.w) : 0.0) * light;
    }
  }
  return color * diffuse + material.z * specular;
}

#endif
