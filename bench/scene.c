/* scene.c - the initial sheet of all implementations. */
#include "scene.h"

#include <stdint.h>
#include <stdlib.h>

#include "harness.h"

enum { RIM = 2, BLOT_FIBERS = 64 };

/* splitmix64: a number in [0, 1) for each index, the same everywhere. */
static float noise(uint64_t index)
{
    uint64_t z = (index + 1) * 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (float)(z >> 40) * 0x1p-24f;
}

bool diffusion_scene_init(struct diffusion_scene *s, int width, int height)
{
    size_t count = (size_t)width * (size_t)height;
    *s = (struct diffusion_scene){
        .width = width,
        .height = height,
        .x0 = RIM,
        .y0 = RIM,
        .x1 = width - RIM,
        .y1 = height - RIM,
        .gravity = 1.25f,
        .molecular_weight = {0.9f, 0.5f, 0.2f},
    };
    bool ok = (s->absorbency = malloc(count * sizeof(float))) != NULL;
    for (int i = 0; i < DIFFUSION_FIELDS_COUNT; i++)
        ok = (s->field[i] = malloc(count * sizeof(float))) != NULL && ok;
    if (!ok) {
        diffusion_scene_finish(s);
        return bench_fail("no memory for a sheet of %dx%d", width, height);
    }
    /* Nowhere exactly dry, so that denormal numbers do not affect the times. */
    for (size_t k = 0; k < count; k++) {
        size_t blot = k % (size_t)width / BLOT_FIBERS + k / (size_t)width / BLOT_FIBERS * 1021;
        s->absorbency[k] = 0.05f + 0.15f * noise(k);
        for (int i = 0; i < DIFFUSION_FIELDS_COUNT; i++) {
            float blotted = noise(~(uint64_t)(blot * DIFFUSION_FIELDS_COUNT + (size_t)i));
            s->field[i][k] = 0.02f + 0.5f * blotted + 0.45f * noise(k * 7 + (uint64_t)i + 3);
        }
    }
    return true;
}

void diffusion_scene_finish(struct diffusion_scene *s)
{
    free(s->absorbency);
    s->absorbency = NULL;
    for (int i = 0; i < DIFFUSION_FIELDS_COUNT; i++) {
        free(s->field[i]);
        s->field[i] = NULL;
    }
}
