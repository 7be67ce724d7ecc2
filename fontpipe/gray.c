/* gray.c - where a picture lies, and its bands: see gray.h and gray_kernel.h.
 *
 * The first column is left of all ink by the filter's radius: left = floor(x0 + 1/2 - radius).
 * With a = x - left + 1/2 - radius, floor(a) is the first column that a point at x reaches, and
 * a - floor(a) its phase in the tables. Rows are the same. Pictures whose sums would not stay
 * in the cache are drawn in bands. */
#include "gray.h"
#include "edges_internal.h"
#include "gray_internal.h"
#include "internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- instruction sets ---- */

typedef void gray_kernel(const struct font_gray_job *job);

typedef enum font_status edges_kernel(const struct font_edges_job *job);

static gray_kernel *kernel;
static edges_kernel *kernel_of_edges;
static _Thread_local bool plain_here;

void font_simd_plain_here(bool plain)
{
    plain_here = plain;
}

enum font_status font_edges_kernel(const struct font_edges_job *job)
{
    return plain_here ? font_edges_kernel_plain(job) : kernel_of_edges(job);
}

enum font_simd font_simd_use(enum font_simd most)
{
    enum font_simd used = FONT_SIMD_PLAIN;
    kernel = font_gray_kernel_plain;
    kernel_of_edges = font_edges_kernel_plain;
#ifdef FONT_X86
    __builtin_cpu_init();
    if (most >= FONT_SIMD_AVX2 && __builtin_cpu_supports("avx2") &&
        __builtin_cpu_supports("fma")) {
        used = FONT_SIMD_AVX2;
        kernel = font_gray_kernel_avx2;
        kernel_of_edges = font_edges_kernel_avx2;
    }
    if (most >= FONT_SIMD_AVX512 && used == FONT_SIMD_AVX2 &&
        __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq")) {
        used = FONT_SIMD_AVX512;
        kernel = font_gray_kernel_avx512;
        kernel_of_edges = font_edges_kernel_avx512;
    }
#else
    (void)most;
#endif
    return used;
}

const char *font_simd_name(enum font_simd simd)
{
    static const char *const names[] = {"plain C", "AVX2", "AVX-512"};
    return names[simd];
}

__attribute__((constructor)) static void simd_begin(void)
{
    font_simd_use(FONT_SIMD_AVX512);
}

/* ---- drawing ---- */

void font_gray_finish(struct font_gray *gray)
{
    free(gray->memory);
    free(gray->work);
    *gray = (struct font_gray){0};
}

static bool room(void **memory, size_t *have, size_t bytes)
{
    if (bytes <= *have)
        return true;
    bytes = (bytes + bytes / 2 + 4095) / 4096 * 4096;
    free(*memory);
    *memory = aligned_alloc(64, bytes);
    *have = *memory ? bytes : 0;
    return *memory != NULL;
}

static void empty(struct font_gray *gray)
{
    gray->left_px = gray->top_px = gray->width_px = gray->height_px = gray->pitch = 0;
    gray->pixels = NULL;
    gray->exact = NULL;
}

static enum font_status place(struct font_gray *gray, const struct font_edges *e,
                              const struct font_filter *f, double x_px, double y_px,
                              struct font_gray_job *job)
{
    empty(gray);
    if (!(fabs(x_px) <= FONT_SIDE_MAX && fabs(y_px) <= FONT_SIDE_MAX))
        return font_fail(FONT_BAD_ARGUMENT, "a glyph cannot be drawn at (%g, %g)", x_px, y_px);
    if (e->nodes_count + e->lines_count + e->arcs_count == 0)
        return FONT_OK;
    float radius = (float)f->radius, x = (float)x_px, y = (float)y_px;
    int left = (int)floorf(e->x0 + x + 0.5f - radius);
    int top = (int)floorf(e->y0 + y + 0.5f - radius);
    job->ax = x - (float)left + 0.5f - radius;
    job->ay = y - (float)top + 0.5f - radius;
    if (e->x0 + job->ax < 0) { /* by rounding */
        left--;
        job->ax += 1;
    }
    if (e->y0 + job->ay < 0) {
        top--;
        job->ay += 1;
    }
    int width = (int)(e->x1 + job->ax) + f->taps, height = (int)(e->y1 + job->ay) + f->taps + 1;
    if (width > FONT_SIDE_MAX || height > FONT_SIDE_MAX)
        return font_fail(FONT_TOO_LARGE, "a glyph of %dx%d pixels is larger than %d a side",
                         width, height, FONT_SIDE_MAX);
    gray->left_px = left;
    gray->top_px = top;
    gray->width_px = width;
    gray->height_px = height;
    gray->pitch = (width + 15) & ~15;
    return FONT_OK;
}

enum font_status font_gray_place_at(struct font_gray *gray, const struct font_edges *edges,
                                    const struct font_filter *filter, double x_px, double y_px,
                                    float *ax, float *ay)
{
    struct font_gray_job job = {0};
    enum font_status status = place(gray, edges, filter, x_px, y_px, &job);
    *ax = job.ax;
    *ay = job.ay;
    return status;
}

enum font_status font_gray_place(struct font_gray *gray, const struct font_edges *edges,
                                 const struct font_filter *filter, double x_px, double y_px)
{
    struct font_gray_job job;
    return place(gray, edges, filter, x_px, y_px, &job);
}

static enum font_status draw(struct font_gray *gray, const struct font_edges *e,
                             const struct font_filter *f, double x_px, double y_px, bool exact)
{
    struct font_gray_job job = {.filter = f,
                                .node_x = e->node_x,
                                .node_y = e->node_y,
                                .node_weight = e->node_weight,
                                .line_x0 = e->line_x0,
                                .line_x1 = e->line_x1,
                                .line_y = e->line_y,
                                .nodes_count = e->nodes_count,
                                .lines_count = e->lines_count,
                                .arcs = e->arcs,
                                .arcs_count = e->arcs_count};
    enum font_status status = place(gray, e, f, x_px, y_px, &job);
    if (status != FONT_OK || !gray->width_px)
        return status;
    if (e->arcs_count && f->way == FONT_BY_TABLES) {
        empty(gray);
        return font_fail(FONT_BAD_ARGUMENT,
                         "edges are drawn with the filter they were made for");
    }

    int pitch = gray->pitch, height = gray->height_px;
    job.width = gray->width_px;
    job.pitch = pitch;
    /* Blocks end up to 8 floats past the width. */
    if (!e->arcs_count && f->taps <= 5 && f->way != FONT_BY_PATCHES && pitch == 16 &&
        height <= FONT_NARROW_ROWS) {
        job.odd = FONT_NARROW_ODD;
        job.stride = FONT_NARROW_STRIDE;
    } else {
        job.stride = e->arcs_count && f->way == FONT_BY_AREAS ? pitch : pitch + 16;
    }
    int rows = FONT_SUMS_FLOATS / job.stride - 2 * FONT_MARGIN_ROWS;
    rows = rows < 32 ? 32 : rows;
    rows = rows > height ? height : rows;
    size_t pixels = (size_t)pitch * (size_t)height;
    size_t floats = (size_t)job.stride * (size_t)(rows + 2 * FONT_MARGIN_ROWS);
    if (!room(&gray->memory, &gray->memory_bytes, pixels * (exact ? 5 : 1)) ||
        !room(&gray->work, &gray->work_bytes, sizeof(float) * (floats + (size_t)pitch))) {
        empty(gray);
        return font_fail(FONT_NO_MEMORY, "no memory for a picture of %dx%d pixels", job.width,
                         height);
    }
    gray->exact = exact ? gray->memory : NULL;
    gray->pixels = (uint8_t *)gray->memory + (exact ? 4 * pixels : 0);
    job.carry = gray->work;
    job.sums = job.carry + pitch;
    for (int k = 0; k < pitch; k++)
        job.carry[k] = 0;
    job.banded = rows < height;
    for (job.row = 0; job.row < height; job.row += rows) {
        job.rows = height - job.row < rows ? height - job.row : rows;
        job.out = gray->pixels + (size_t)job.row * (size_t)pitch;
        job.exact = exact ? gray->exact + (size_t)job.row * (size_t)pitch : NULL;
        if (plain_here)
            font_gray_kernel_plain(&job);
        else
            kernel(&job);
    }
    return FONT_OK;
}

enum font_status font_gray_draw(struct font_gray *gray, const struct font_edges *edges,
                                const struct font_filter *filter, double x_px, double y_px)
{
    return draw(gray, edges, filter, x_px, y_px, false);
}

enum font_status font_gray_draw_exact(struct font_gray *gray, const struct font_edges *edges,
                                      const struct font_filter *filter, double x_px,
                                      double y_px)
{
    return draw(gray, edges, filter, x_px, y_px, true);
}
