/* paper_openmp_sheet.c - makes, fills and reads the peer's sheet, and computes derived
 * fields. */
#include "paper_openmp.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"

static int field_of(enum paper_peer_layer layer, int pigment)
{
    switch (layer) {
    case PAPER_PEER_HEIGHT:
        return F_HEIGHT;
    case PAPER_PEER_ABSORBENCY:
        return F_ABSORBENCY;
    case PAPER_PEER_CAPACITY:
        return F_CAPACITY;
    case PAPER_PEER_RESIST:
        return F_RESIST;
    case PAPER_PEER_SURFACE_WATER:
        return F_SURFACE_WATER;
    case PAPER_PEER_WATER:
        return F_WATER;
    case PAPER_PEER_DRIED:
        return F_DRIED;
    case PAPER_PEER_SIZING:
        return F_SIZING;
    case PAPER_PEER_CURRENT:
        return F_CURRENT;
    case PAPER_PEER_SURFACE:
    case PAPER_PEER_INFUSED:
    case PAPER_PEER_FIXED:
    default:
        return F_PIGMENTS + 3 * pigment + (int)(layer - PAPER_PEER_SURFACE);
    }
}

#define SIZED_MOST 0.12 /* the peer has no water that runs in paper without size */

struct paper_openmp *paper_openmp_create(const struct paper_peer_config *config)
{
    if (config->width < LANES || config->height < 3) {
        bench_fail("the paper's peer takes sheets of 16x3 and more (got %dx%d)", config->width,
                   config->height);
        return NULL;
    }
    if (config->absorbency > SIZED_MOST) {
        bench_fail("the paper's peer takes stocks of an absorbency of %g or less (got %g)",
                   SIZED_MOST, config->absorbency);
        return NULL;
    }
    struct paper_openmp *o = calloc(1, sizeof *o);
    if (!o) {
        bench_fail("no memory");
        return NULL;
    }
    o->config = *config;
    o->fields_count = F_PIGMENTS + 3 * config->pigments_count;
    o->flowing = 2 + 2 * config->pigments_count;
    o->pitch = ((size_t)config->width + 2 * MARGIN + LANES - 1) / LANES * LANES;
    if (o->pitch % 128 == 0) /* fields must not begin at the same place of a page */
        o->pitch += LANES;
    o->stride = (size_t)o->fields_count * o->pitch;
    size_t bytes = o->stride * (size_t)config->height * sizeof(float);
    o->memory = aligned_alloc(PAGE_BYTES, (bytes + PAGE_BYTES - 1) / PAGE_BYTES * PAGE_BYTES);
    if (!o->memory) {
        bench_fail("no memory for a sheet of %dx%d", config->width, config->height);
        free(o);
        return NULL;
    }
    o->wet_now = F_WET;
    o->wet_next = F_WET_OTHER;
    o->around_now = F_AROUND;
    o->around_next = F_AROUND_OTHER;
    o->terms_stride = (size_t)(T_UP + o->flowing) * o->pitch;
    bytes = o->terms_stride * (size_t)config->height * sizeof(float);
    o->terms = aligned_alloc(PAGE_BYTES, (bytes + PAGE_BYTES - 1) / PAGE_BYTES * PAGE_BYTES);
    if (!o->terms) {
        bench_fail("no memory for a sheet of %dx%d", config->width, config->height);
        paper_openmp_destroy(o);
        return NULL;
    }
#pragma omp parallel for schedule(static)
    for (int y = 0; y < config->height; y++) {
        memset(o->memory + (size_t)y * o->stride, 0, o->stride * sizeof(float));
        memset(o->terms + (size_t)y * o->terms_stride, 0, o->terms_stride * sizeof(float));
    }
    return o;
}

void paper_openmp_destroy(struct paper_openmp *o)
{
    if (o) {
        free(o->memory);
        free(o->terms);
    }
    free(o);
}

void paper_openmp_write(struct paper_openmp *o, enum paper_peer_layer layer, int pigment,
                        const float *values)
{
    int field = field_of(layer, pigment);
    size_t width = (size_t)o->config.width;
    for (int y = 0; y < o->config.height; y++)
        memcpy(field_row(o, field, y), values + (size_t)y * width, width * sizeof(float));
}

void paper_openmp_read(const struct paper_openmp *o, enum paper_peer_layer layer, int pigment,
                       float *values)
{
    int field = field_of(layer, pigment), width = o->config.width;
    for (int y = 0; y < o->config.height; y++) {
        const float *row = field_row(o, field, y);
        float *out = values + (size_t)y * (size_t)width;
        memcpy(out, row, (size_t)width * sizeof(float));
        for (int x = 0; x < width && field == F_DRIED; x++) {
            uint32_t count;
            memcpy(&count, row + x, sizeof count);
            out[x] = (float)count;
        }
    }
}

void paper_openmp_start(struct paper_openmp *o)
{
    int width = o->config.width, height = o->config.height;
    for (int axis = 0; axis < 2; axis++) {
        float along = (float)(o->config.absorbency_along[axis] / 2);
        for (int y = 0; y < height; y++)
            for (int x = 0; x < width; x++) {
                int x2 = axis == 0 ? (x + 1) % width : x;
                int y2 = axis == 1 ? (y + 1) % height : y;
                float face =
                    field_row(o, F_ABSORBENCY, y2)[x2] + field_row(o, F_ABSORBENCY, y)[x];
                face = fmaxf(face * along, 1e-6f);
                face *= fmaxf(1 - field_row(o, F_RESIST, y)[x], 0);
                face *= fmaxf(1 - field_row(o, F_RESIST, y2)[x2], 0);
                bool edge = axis == 0 ? x == width - 1 : y == height - 1;
                field_row(o, axis == 0 ? F_FACE_X : F_FACE_Y, y)[x] =
                    edge && !o->config.torus ? 0 : face;
            }
    }
    for (int y = 0; y < height; y++)
        margins_fill(field_row(o, F_FACE_X, y), width, 1);
    paper_openmp_flow_start(o);
}
