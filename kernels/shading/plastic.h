// Plastic: BRL-CAD's shader of this name at a first hit: ambient light from the eye, diffuse and specular light from
// each light, no shadows.
//
//   colour * (ambient cos(n, eye))
//   + sum over lights: colour * light * diffuse cos(n, l) + light * specular cos(r, eye)^shine
//
// A light that is infinitely far away comes from one direction; a light with a beam lights the points in its cone. A
// surface that glows adds colour * glow (SHAPED_LIGHTS).
//
// The power is computed by squaring: multiplications only, so every device gives the same bits.
#ifndef CSGRT_SHADING_PLASTIC_H
#define CSGRT_SHADING_PLASTIC_H

#include "../shared/layout.h"

typedef struct {
    real r, g, b;
} rgb;

// The finish of a surface, in the numbers of the formula above.
typedef struct {
    rgb color;
    real specular, diffuse, ambient, glow;
    tag shine;
} finish;

FN real whole_power(real x, tag n) {
    real result = REAL(1);
    while (!no_lane(n != 0)) {
        result = (n & 1u) != 0 ? result * x : result;
        x = x * x;
        n >>= 1;
    }
    return result;
}

// n: unit normal towards the viewer's side of the surface; d: direction of the ray, any length.
FN rgb plastic(GLOBAL const Frame* f, GLOBAL const LightRecord* lights, finish m, wide3 at, vec3 n, vec3 d) {
    const vec3 view = scale(normalize3(d), REAL(-1));
    const real facing = dot3(n, view);
    real ambient = facing > 0 ? facing * REAL(f->ambient) * m.ambient : REAL(0);
    rgb c;
    u32 i;
#if SHAPED_LIGHTS
    ambient = ambient + m.glow;
#endif
    c.r = ambient * m.color.r;
    c.g = ambient * m.color.g;
    c.b = ambient * m.color.b;
    for (i = 0; i < f->light_count; ++i) {
        const LightRecord light = lights[i];
#if SHAPED_LIGHTS
        const wide3 from = wide_scale(at, light.w);
#else
        const wide3 from = at;
#endif
        const vec3 to_light = normalize3(narrow(wide_subtract(make_wide3(light.x, light.y, light.z), from)));
        const real cosine = dot3(n, to_light), diffuse = cosine * m.diffuse;
        const real mirrored = dot3(subtract(scale(n, REAL(2) * cosine), to_light), view);
        lane_mask lit = cosine > 0, shines;
        real specular = REAL(0);
#if SHAPED_LIGHTS
        if (light.beam)
            lit =
                lit && dot3(to_light, make_vec3(REAL(light.bx), REAL(light.by), REAL(light.bz))) <= REAL(-light.cosine);
#endif
        shines = lit && mirrored > 0;
        if (no_lane(lit)) continue;
        if (!no_lane(shines)) specular = shines ? whole_power(mirrored, m.shine) * m.specular : specular;
        c.r = lit ? c.r + REAL(light.r) * (diffuse * m.color.r + specular) : c.r;
        c.g = lit ? c.g + REAL(light.g) * (diffuse * m.color.g + specular) : c.g;
        c.b = lit ? c.b + REAL(light.b) * (diffuse * m.color.b + specular) : c.b;
    }
    return c;
}

// The visible values of a surface with the outward unit normal n that is hit at t.
typedef struct {
    real t;
    vec3 n;
    rgb color;
} sight;

// Shades a hit. If the ray starts inside (t < t_min), the hit is moved to t_min, and its normal points to the eye.
FN sight shade_plastic(GLOBAL const Frame* f, GLOBAL const LightRecord* lights, finish m, ray3 r, real t, vec3 n,
                       real t_min) {
    const lane_mask inside = t < t_min;
    sight seen;
    if (!no_lane(inside)) {
        const vec3 face_on = scale(normalize3(r.d), REAL(-1));
        t = inside ? t_min : t;
        n.x = inside ? face_on.x : n.x;
        n.y = inside ? face_on.y : n.y;
        n.z = inside ? face_on.z : n.z;
    }
    seen.t = t;
    seen.n = n;
    seen.color = plastic(f, lights, m, wide_add_scaled(r.o, t, widen(r.d)), n, r.d);
    return seen;
}

#endif
