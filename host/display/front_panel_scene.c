/* front_panel_scene.c - ray marching in a room with a cube of eight boxes with rounded
 * edges. The cube is symmetric, so a point is folded into one eighth, and its distance to
 * one box is its distance to all. Everything is black and polished: only reflections of two
 * soft lamps are visible, along edges and on the floor. */
#include "front_panel_scene.h"

#include <math.h>
#include <stdbool.h>

/* ---- vectors ---- */

static struct vec add(struct vec a, struct vec b)
{
    return (struct vec){a.x + b.x, a.y + b.y, a.z + b.z};
}

static struct vec times(struct vec a, float k)
{
    return (struct vec){a.x * k, a.y * k, a.z * k};
}

static float dot(struct vec a, struct vec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static struct vec cross(struct vec a, struct vec b)
{
    return (struct vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static struct vec unit(struct vec a)
{
    return times(a, 1 / sqrtf(dot(a, a)));
}

static float clamp(float x, float least, float most)
{
    return x < least ? least : x > most ? most : x;
}

static float step_smooth(float from, float to, float x)
{
    float t = clamp((x - from) / (to - from), 0, 1);
    return t * t * (3 - 2 * t);
}

/* ---- the camera ---- */

struct scene_camera scene_camera_make(const struct front_panel_config *config)
{
    struct vec eye = {3.3f, 2.15f, 6.5f}, target = {0.0f, -0.30f, 0.0f};
    float seen = 3.95f; /* height of the picture's section at the target's distance */
    if (config->view == FRONT_PANEL_FRONT) {
        eye = (struct vec){0, 0, 14};
        target = (struct vec){0, 0, 0};
        seen = 2.18f * (14 / 13.f);
    } else if (config->view == FRONT_PANEL_DOOR) {
        eye = (struct vec){-0.5f, 0.5f, 8};
        target = (struct vec){-0.5f, 0.5f, 0};
        seen = 1.05f * (8 / 7.f);
    }
    struct scene_camera c = {.eye = eye};
    struct vec way = add(target, times(eye, -1));
    c.forward = unit(way);
    c.right = unit(cross(c.forward, (struct vec){0, 1, 0}));
    c.up = cross(c.right, c.forward);
    float side =
        (float)(config->width_px < config->height_px ? config->width_px : config->height_px);
    c.scale = side * sqrtf(dot(way, way)) / seen;
    c.centre_x = 0.5f * (float)config->width_px;
    c.centre_y = 0.5f * (float)config->height_px;
    return c;
}

void scene_project(const struct scene_camera *c, struct vec p, float *x, float *y)
{
    struct vec d = add(p, times(c->eye, -1));
    float k = c->scale / dot(d, c->forward);
    *x = c->centre_x + k * dot(d, c->right);
    *y = c->centre_y - k * dot(d, c->up);
}

/* Doors are 0.5 from the middle, and their lights cover DOOR_LIGHTS of half a side. */
#define DOOR_LIGHTS 0.415f

struct vec scene_front_point(float column, float row)
{
    float right = column < 32 ? -0.5f : 0.5f, up = row < 32 ? 0.5f : -0.5f;
    float u = (column < 32 ? column : column - 32) / 16 - 1;
    float v = (row < 32 ? row : row - 32) / 16 - 1;
    return (struct vec){right + u * DOOR_LIGHTS, up - v * DOOR_LIGHTS, SCENE_LIGHTS_Z};
}

/* ---- the cube ---- */

#define BOX_HALF 0.488f
#define BOX_ROUND 0.022f
#define DOOR_HALF 0.448f
#define BASE_HALF 0.90f

static float box_distance(struct vec p, struct vec half, float rounding)
{
    struct vec q = {fabsf(p.x) - half.x + rounding, fabsf(p.y) - half.y + rounding,
                    fabsf(p.z) - half.z + rounding};
    struct vec out = {fmaxf(q.x, 0), fmaxf(q.y, 0), fmaxf(q.z, 0)};
    return sqrtf(dot(out, out)) + fminf(fmaxf(q.x, fmaxf(q.y, q.z)), 0) - rounding;
}

static float distance_to(struct vec p)
{
    struct vec eighth = {fabsf(p.x) - 0.5f, fabsf(p.y) - 0.5f, fabsf(p.z) - 0.5f};
    float boxes = box_distance(eighth, (struct vec){BOX_HALF, BOX_HALF, BOX_HALF}, BOX_ROUND);
    struct vec core = {0.96f, 0.96f, 0.96f}; /* the inner block that closes the grooves at
                                              * their bottom */
    float inside = box_distance(p, core, 0.01f);
    struct vec under = {p.x, p.y - (SCENE_FLOOR - 1) * 0.5f, p.z};
    float base = box_distance(
        under, (struct vec){BASE_HALF, (-1 - SCENE_FLOOR) * 0.5f + 0.02f, BASE_HALF}, 0.01f);
    return fminf(fminf(boxes, inside), base);
}

static struct vec normal_at(struct vec p)
{
    const float e = 0.0008f;
    struct vec n = {distance_to((struct vec){p.x + e, p.y, p.z}) -
                        distance_to((struct vec){p.x - e, p.y, p.z}),
                    distance_to((struct vec){p.x, p.y + e, p.z}) -
                        distance_to((struct vec){p.x, p.y - e, p.z}),
                    distance_to((struct vec){p.x, p.y, p.z + e}) -
                        distance_to((struct vec){p.x, p.y, p.z - e})};
    float length = dot(n, n);
    return length > 0 ? unit(n) : (struct vec){0, 1, 0};
}

/* The distance to the cube along a ray; negative if the ray misses it. */
static float cube_hit(struct vec from, struct vec way)
{
    float near = 0, far = 1e9f;
    const float *o = &from.x, *d = &way.x;
    const float low[3] = {-1, SCENE_FLOOR, -1};
    for (int i = 0; i < 3; i++) {
        float k = fabsf(d[i]) > 1e-9f ? 1 / d[i] : 1e9f;
        float a = (low[i] - o[i]) * k, b = (1 - o[i]) * k;
        near = fmaxf(near, fminf(a, b));
        far = fminf(far, fmaxf(a, b));
    }
    for (int i = 0; near <= far && i < 64; i++) {
        float left = distance_to(add(from, times(way, near)));
        if (left < 0.0006f)
            return near;
        near += left;
    }
    return -1;
}

/* ---- light ---- */

/* A lamp with soft edges: 1 in its middle. */
static float lamp(struct vec way, struct vec at, struct vec across, float width, float height)
{
    float forward = dot(way, at);
    if (forward <= 0)
        return 0;
    struct vec high = cross(at, across);
    float u = dot(way, across) / forward / width, v = dot(way, high) / forward / height;
    float r = u * u * u * u + v * v * v * v;
    return expf(-r * 0.9f);
}

/* The light that comes from the room in this direction. */
static void room(struct vec way, float *rgb)
{
    float up = clamp(way.y, -1, 1);
    float wall = 0.010f + 0.022f * expf(-fabsf(up) * 3.2f);
    static const struct vec above = {-0.36f, 0.85f, 0.38f}, aside = {0.93f, 0.30f, -0.21f};
    float key = lamp(way, unit(above), unit((struct vec){0.9f, 0.36f, 0.05f}), 0.55f, 0.30f);
    float rim = lamp(way, unit(aside), unit((struct vec){0.22f, 0, 0.97f}), 0.34f, 0.9f);
    /* Wide and dim: the sheen on the top, on the side, and on the doors. */
    static const struct vec behind = {0.30f, -0.02f, -0.95f}, window = {-0.62f, -0.10f, 0.78f};
    float wide = lamp(way, unit(behind), unit((struct vec){0.95f, 0, 0.30f}), 0.50f, 0.55f);
    float sheen =
        lamp(way, unit(window), unit((struct vec){0.78f, 0.30f, 0.62f}), 0.20f, 0.75f);
    rgb[0] = wall * 0.80f + key * 1.55f + rim * 0.46f + wide * 0.150f + sheen * 0.20f;
    rgb[1] = wall * 0.92f + key * 1.62f + rim * 0.56f + wide * 0.175f + sheen * 0.22f;
    rgb[2] = wall * 1.15f + key * 1.75f + rim * 0.74f + wide * 0.225f + sheen * 0.26f;
}

static float fresnel(float cosine, float straight)
{
    float k = 1 - clamp(cosine, 0, 1);
    return straight + (1 - straight) * k * k * k * k * k;
}

/* The cube's own surface: panels framed by a fine line, and doors with the boards' edges
 * behind them. */
static void cube_shade(struct vec p, struct vec way, float *rgb)
{
    struct vec n = normal_at(p);
    struct vec back = add(way, times(n, -2 * dot(way, n)));
    float light[3], u, v;
    struct vec q = {fabsf(p.x) - 0.5f, fabsf(p.y) - 0.5f, fabsf(p.z) - 0.5f};
    bool front = n.z > 0.99f;
    u = front || fabsf(n.y) > 0.99f ? q.x : q.z;
    v = fabsf(n.y) > 0.99f ? q.z : q.y;
    float edge = fmaxf(fabsf(u), fabsf(v));
    bool flat = fmaxf(fabsf(n.x), fmaxf(fabsf(n.y), n.z)) > 0.99f;
    bool door = flat && edge < DOOR_HALF;
    /* The frame is satin, the door is polished. */
    float straight = door ? 0.045f : 0.075f;
    float shine = fresnel(-dot(way, n), straight);
    room(back, light);
    float down = 1 - 0.5f * step_smooth(0, 0.5f, -back.y); /* the floor is darker than walls */
    float lit = clamp(0.25f + 0.55f * n.y - 0.25f * n.x + 0.25f * n.z, 0.05f, 1);
    float ground = door ? 0.0016f : 0.0075f;
    if (door && front) {
        float board = u * 16 / DOOR_LIGHTS; /* edges of the boards, hardly visible */
        float stripe = 0.5f + 0.5f * cosf(6.2831853f * board);
        bool behind = fabsf(u) < DOOR_LIGHTS + 0.008f && fabsf(v) < DOOR_LIGHTS + 0.008f;
        ground += behind ? 0.0014f + 0.0022f * stripe : 0;
    }
    float groove =
        flat ? 1 - 0.75f * (1 - step_smooth(0.001f, 0.005f, fabsf(edge - DOOR_HALF))) : 1;
    /* Little light reaches the bottom of the grooves between the boxes. */
    float outside = fmaxf(fabsf(p.x), fmaxf(fabsf(p.y), fabsf(p.z)));
    float depth = step_smooth(0.955f, 0.985f, outside);
    float low = p.y < -0.986f ? 0.12f : 1;
    for (int i = 0; i < 3; i++)
        rgb[i] = (ground * lit * (i == 2 ? 1.25f : 1) + shine * light[i] * down) * groove *
                 depth * low;
}

/* The floor at p: its own light, how much it mirrors, and what the doors' lights add to it. */
static struct scene_pixel floor_shade(struct vec p, struct vec way)
{
    struct scene_pixel out = {{0}, 0, {0}};
    float far = sqrtf(p.x * p.x + p.z * p.z);
    float pool = expf(-0.055f * far * far), fade = expf(-0.012f * far * far);
    float dx = fmaxf(fabsf(p.x) - 1, 0), dz = fmaxf(fabsf(p.z) - 1, 0);
    float beside = sqrtf(dx * dx + dz * dz);
    float open = 0.25f + 0.75f * step_smooth(0, 0.9f, beside);
    float shine = fresnel(-way.y, 0.10f);
    struct vec back = {way.x, -way.y, way.z};
    float seen[3], hit = cube_hit(p, back);
    if (hit >= 0)
        cube_shade(add(p, times(back, hit)), back, seen);
    else
        room(back, seen);
    for (int i = 0; i < 3; i++)
        out.rgb[i] = (0.028f + (i == 2 ? 0.004f : 0)) * pool * open +
                     shine * seen[i] * (hit >= 0 ? 1 : 0.55f * fade);
    float clear = expf(-0.02f * far * far);
    out.mirror = shine * 3.2f * clear;
    for (int door = 0; door < SCENE_GLOWS; door++)
        for (int part = 0; part < 9; part++) {
            struct vec c = {(door % 2 ? 0.5f : -0.5f) + (float)(part % 3 - 1) * 0.3f,
                            (door < 2 ? 0.5f : -0.5f) + (float)(part / 3 - 1) * 0.3f, 1};
            struct vec d = add(p, times(c, -1));
            if (d.z <= 0)
                continue;
            float r2 = dot(d, d);
            out.glow[door] += 0.013f * d.z * -d.y / (r2 * r2 + 0.02f);
        }
    return out;
}

static struct scene_pixel ray_trace(const struct scene_camera *c, enum front_panel_view view,
                                    float x, float y)
{
    struct scene_pixel out = {{0}, 0, {0}};
    struct vec way = unit(add(c->forward, add(times(c->right, (x - c->centre_x) / c->scale),
                                              times(c->up, (c->centre_y - y) / c->scale))));
    float hit = cube_hit(c->eye, way);
    if (hit >= 0) {
        cube_shade(add(c->eye, times(way, hit)), way, out.rgb);
        return out;
    }
    if (view != FRONT_PANEL_CUBE)
        return out;
    if (way.y < -1e-4f) {
        float k = (SCENE_FLOOR - c->eye.y) / way.y;
        struct vec p = add(c->eye, times(way, k));
        out = floor_shade(p, way);
        float far = fmaxf(sqrtf(p.x * p.x + p.z * p.z) - 2.2f, 0);
        float mist = 1 - expf(-0.022f * far * far);
        for (int i = 0; i < 3; i++)
            out.rgb[i] += (0.0105f - out.rgb[i]) * mist * (i == 2 ? 1 : 0.9f);
        out.mirror *= 1 - mist;
        return out;
    }
    float high = clamp(way.y * 2.2f, 0, 1);
    for (int i = 0; i < 3; i++)
        out.rgb[i] = 0.0105f * (i == 2 ? 1.1f : 0.92f) * (1 - 0.8f * high);
    return out;
}

struct scene_pixel scene_pixel_trace(const struct scene_camera *camera,
                                     enum front_panel_view view, int x, int y, int samples)
{
    struct scene_pixel sum = {{0}, 0, {0}};
    float share = 1 / (float)(samples * samples);
    for (int i = 0; i < samples * samples; i++) {
        struct scene_pixel one =
            ray_trace(camera, view, (float)x + ((float)(i % samples) + 0.5f) / (float)samples,
                      (float)y + ((float)(i / samples) + 0.5f) / (float)samples);
        for (int k = 0; k < 3; k++)
            sum.rgb[k] += fminf(one.rgb[k], 1.2f) * share; /* clamped, so that a lamp's edge
                                                            * is antialiased */
        sum.mirror += one.mirror * share;
        for (int k = 0; k < SCENE_GLOWS; k++)
            sum.glow[k] += one.glow[k] * share;
    }
    return sum;
}
