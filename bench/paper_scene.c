/* paper_scene.c - see paper_scene.h. */
#include "paper_scene.h"

#include <stdlib.h>
#include <string.h>

#include "harness.h"

static const struct {
    enum paper_layer layer;
    enum paper_peer_layer peer;
    bool each, amount;
} layers[] = {
    {PAPER_LAYER_HEIGHT, PAPER_PEER_HEIGHT, false, false},
    {PAPER_LAYER_ABSORBENCY, PAPER_PEER_ABSORBENCY, false, false},
    {PAPER_LAYER_CAPACITY, PAPER_PEER_CAPACITY, false, false},
    {PAPER_LAYER_RESIST, PAPER_PEER_RESIST, false, false},
    {PAPER_LAYER_INFUSED_WATER, PAPER_PEER_WATER, false, true},
    {PAPER_LAYER_SURFACE_WATER, PAPER_PEER_SURFACE_WATER, false, true},
    {PAPER_LAYER_SURFACE_PIGMENT, PAPER_PEER_SURFACE, true, true},
    {PAPER_LAYER_INFUSED_PIGMENT, PAPER_PEER_INFUSED, true, true},
    {PAPER_LAYER_FIXED_PIGMENT, PAPER_PEER_FIXED, true, true},
    {PAPER_LAYER_DRIED_WATER, PAPER_PEER_DRIED, false, true}, /* read only: the last of these */
    {PAPER_LAYER_SIZING, PAPER_PEER_SIZING, false, false},    /* where water flows */
    {PAPER_LAYER_CURRENT, PAPER_PEER_CURRENT, false, false},
};

enum { ALL_LAYERS = sizeof layers / sizeof *layers, LAYERS_COUNT = ALL_LAYERS - 2, BLOT = 48 };

static bool paper_said(enum paper_status status)
{
    return status == PAPER_OK || bench_fail("the paper: %s", paper_error());
}

static float noise(unsigned x, unsigned y, unsigned seed)
{
    unsigned z = x * 0x9e3779b9u + y * 0x7f4a7c15u + seed * 0x85ebca6bu;
    z = (z ^ z >> 16) * 0x85ebca6bu;
    z = (z ^ z >> 13) * 0xc2b2ae35u;
    return (float)((z ^ z >> 16) >> 8) * 0x1p-24f;
}

/* Squares of washes, every third dry; each fiber a little other. */
static void wash(float *values, int width, int height, unsigned seed)
{
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            unsigned u = (unsigned)x, v = (unsigned)y;
            float amount = noise(u / BLOT, v / BLOT, seed);
            bool dry = (u / BLOT + v / BLOT + seed) % 3 == 0;
            values[(size_t)y * (size_t)width + (size_t)x] =
                dry ? 0 : amount * (0.75f + 0.25f * noise(u, v, seed + 100));
        }
}

static float *values_get(const struct paper_scene *s)
{
    float *values = malloc((size_t)s->width * (size_t)s->height * sizeof *values);
    if (!values)
        bench_fail("no memory for a sheet of %dx%d", s->width, s->height);
    return values;
}

static bool sheet_create(struct paper_scene *s, const struct paper_sheet_config *config)
{
    s->width = config->width;
    s->height = config->height;
    s->pigments_count = config->pigments_count;
    return paper_said(paper_sheet_create(config, &s->sheet));
}

bool paper_scene_init(struct paper_scene *s, int width, int height, int pigments_count,
                      bool torus, const struct paper_air *air)
{
    struct paper_sheet_config config = paper_sheet_config_default();
    struct paper_peer_config peer = {.width = width,
                                     .height = height,
                                     .torus = torus,
                                     .pigments_count = pigments_count,
                                     .air = air ? *air : paper_air_default()};
    *s = (struct paper_scene){.sheet = NULL};
    config.width = width;
    config.height = height;
    config.torus = torus;
    peer.absorbency = config.stock.absorbency;
    config.pigments_count = pigments_count;
    for (int i = 0; i < pigments_count; i++)
        peer.pigments[i] = config.pigments[i] = *paper_pigment_number(i);
    memcpy(peer.absorbency_along, config.stock.absorbency_along, sizeof peer.absorbency_along);
    s->peer = paper_openmp_create(&peer);
    if (!s->peer || !sheet_create(s, &config))
        return false;
    float *values = values_get(s);
    size_t count = (size_t)width * (size_t)height;
    bool ok = values && paper_said(paper_sheet_air(s->sheet, &peer.air));
    for (int i = 0; i < ALL_LAYERS; i++)
        for (int k = 0; ok && k < (layers[i].each ? pigments_count : 1); k++) {
            if (i == LAYERS_COUNT - 1) /* the dried water */
                continue;
            if (layers[i].amount) {
                wash(values, width, height, (unsigned)(i * PAPER_PIGMENTS_MAX + k));
                ok = paper_said(paper_sheet_layer_write(s->sheet, layers[i].layer, k, values));
            }
            ok = ok && paper_said(paper_sheet_layer_read(s->sheet, layers[i].layer, k, values));
            for (size_t n = 0; ok && layers[i].amount && n < count; n++)
                values[n] *= PAPER_GRAINS;
            if (ok)
                paper_openmp_write(s->peer, layers[i].peer, k, values);
        }
    free(values);
    if (ok)
        paper_openmp_start(s->peer);
    return ok;
}

bool paper_scene_init_thesis(struct paper_scene *s, int width, int height)
{
    static const char *const names[3] = {"cyan", "magenta", "yellow"};
    struct paper_sheet_config config = paper_sheet_config_default();
    struct paper_air air = paper_air_default();
    *s = (struct paper_scene){.sheet = NULL};
    config.width = width;
    config.height = height;
    config.parts = 0;
    config.rule = PAPER_RULE_SUBTRACT;
    config.pigments_count = 3;
    struct diffusion_scene scene = {.width = width,
                                    .height = height,
                                    .x0 = 2,
                                    .y0 = 2,
                                    .x1 = width - 2,
                                    .y1 = height - 2,
                                    .gravity = (float)air.thesis.gravity_x,
                                    .humidity = (float)air.thesis.humidity};
    for (int i = 0; i < 3; i++) {
        config.pigments[i] = *paper_pigment_find(names[i]);
        config.pigments[i].weight[0] = air.thesis.molecular_weight[i];
        scene.molecular_weight[i] = (float)air.thesis.molecular_weight[i];
    }
    if (!sheet_create(s, &config))
        return false;
    bool ok = paper_said(paper_sheet_air(s->sheet, &air));
    float *arrays[1 + DIFFUSION_FIELDS_COUNT] = {NULL};
    for (int i = 0; ok && i <= DIFFUSION_FIELDS_COUNT; i++) {
        enum paper_layer layer = i == 0   ? PAPER_LAYER_ABSORBENCY
                                 : i == 1 ? PAPER_LAYER_INFUSED_WATER
                                          : PAPER_LAYER_INFUSED_PIGMENT;
        int pigment = i < 2 ? 0 : i - 2;
        arrays[i] = values_get(s);
        ok = arrays[i] != NULL;
        if (ok && i > 0) {
            wash(arrays[i], width, height, (unsigned)i);
            ok = paper_said(paper_sheet_layer_write(s->sheet, layer, pigment, arrays[i]));
        }
        ok = ok && paper_said(paper_sheet_layer_read(s->sheet, layer, pigment, arrays[i]));
        *(i == 0 ? &scene.absorbency : &scene.field[i - 1]) = arrays[i];
    }
    if (ok)
        s->thesis = diffusion_openmp_create(&scene);
    for (int i = 0; i <= DIFFUSION_FIELDS_COUNT; i++)
        free(arrays[i]);
    return s->thesis != NULL;
}

/* The two arrays hold the same. */
static bool same(const struct paper_scene *s, const char *of_case, const char *what,
                 int pigment, const float *ours, const float *theirs)
{
    size_t count = (size_t)s->width * (size_t)s->height, i = 0;
    while (i < count && ours[i] == theirs[i])
        i++;
    return i == count ||
           bench_fail("%s: the sheet differs from openmp in the %s of pigment %d at %zu, %zu "
                      "(%.9g, %.9g)",
                      of_case, what, pigment, i % (size_t)s->width, i / (size_t)s->width,
                      (double)ours[i], (double)theirs[i]);
}

static bool thesis_agrees(const struct paper_scene *s, const char *of_case, float *ours,
                          float *theirs)
{
    bool ok = true;
    for (int i = 0; ok && i < DIFFUSION_FIELDS_COUNT; i++) {
        enum paper_layer layer = i ? PAPER_LAYER_INFUSED_PIGMENT : PAPER_LAYER_INFUSED_WATER;
        ok = paper_said(paper_sheet_layer_read(s->sheet, layer, i ? i - 1 : 0, ours));
        diffusion_openmp_read(s->thesis, i, theirs);
        ok = ok && same(s, of_case, i ? "amount" : "water", i - 1, ours, theirs);
    }
    return ok;
}

bool paper_scene_agrees(const struct paper_scene *s, const char *of_case)
{
    static const char *const names[LAYERS_COUNT] = {
        "height",        "absorbency",     "capacity",       "resist",       "water",
        "surface water", "surface amount", "infused amount", "fixed amount", "dried water"};
    float *ours = values_get(s), *theirs = values_get(s);
    size_t count = (size_t)s->width * (size_t)s->height;
    bool ok = ours && theirs;
    if (ok && s->thesis)
        ok = thesis_agrees(s, of_case, ours, theirs);
    for (int i = 0; ok && !s->thesis && i < LAYERS_COUNT; i++)
        for (int k = 0; ok && k < (layers[i].each ? s->pigments_count : 1); k++) {
            ok = paper_said(paper_sheet_layer_read(s->sheet, layers[i].layer, k, ours));
            paper_openmp_read(s->peer, layers[i].peer, k, theirs);
            for (size_t n = 0; layers[i].amount && n < count; n++)
                theirs[n] /= PAPER_GRAINS;
            ok = ok && same(s, of_case, names[i], k, ours, theirs);
        }
    free(ours);
    free(theirs);
    return ok;
}

void paper_scene_finish(struct paper_scene *s)
{
    paper_sheet_destroy(s->sheet);
    paper_openmp_destroy(s->peer);
    diffusion_openmp_destroy(s->thesis);
    *s = (struct paper_scene){.sheet = NULL};
}
