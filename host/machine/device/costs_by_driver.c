/* costs_by_driver.c - the numbers of each kind of device and driver that nobody has measured
 * here: see shape.h. */
#include <string.h>

#include "base/errors.h"
#include "device/shape.h"

/* What all rows have. Processors first compare only the low 12 bits of addresses, and delay a
 * load that seems to read what a slightly earlier store writes (4K aliasing): hence the skews.
 * The front end's costs were measured on one core with AVX-512, the compiler's with PoCL's
 * clang. To wake a thread takes some microseconds, and where other programs are at work, it may
 * not run at once: hence share. */
#define ROW_USUAL                                                                              \
    .large_page_bytes = 2 << 20, .skew_bytes = 7 * 128, .skew_page_bytes = 4096,               \
    .skew_large_bytes = 64 << 10, .pool_bytes = 1 << 30, .kernels_ahead = 256,                 \
    .kernels_ahead_building = 16, .move_ns = 0.06, .reduce_ns = 0.1, .rank_ns = 8,             \
    .send_ns = 1.2, .reshape_ns = 2, .scan_ns = 0.6, .scan_vector_ns = 0.12,                   \
    .scan_cut_ns = 1e6, .fill_ns = 0.2, .wait_ns = 12e3, .text_ns = 1e6, .compile_ns = 1e8,    \
    .compile_op_ns = 2e6, .kernel_part = 0.4, .turns_from_ns = 4e3, .scan_run_least = 65536,   \
    .sort_short = 64, .rank_alone_most = 1 << 14,                                              \
    .share = {.awake = 5e3,                                                                    \
              .asleep = 30e3,                                                                  \
              .late = 150e3,                                                                   \
              .apart = 150e3,                                                                  \
              .part = 2e3,                                                                     \
              .trip = 260},                                                                    \
    .loop_ns = 0.04, .loop_cost_ns = 0.01, .gather_ns = 0.5, .pick_ns = 0.4,                   \
    .ahead_from = 1 << 18, .each_math_ns = 15, .each_ns = 8, .short_ns = 10e3,                 \
    .at_once_lanes = 4096, .work_least = 8192, .load_aside_bytes = 64 << 10,                   \
    .choose_aside = 1 << 14, .stream_lanes_bytes = 24 << 20
/* ... and all of CPUs, whose units are few and have long work-items. */
#define ROW_CPU                                                                                \
    ROW_USUAL, .call_columns = 4096, .call_processors = 512, .scatter_units = 8,               \
               .fill_run = 1 << 16, .sort_long = 1 << 15, .step_ns = 20

/* Each row is of a kind of device, and of a driver (its OpenCL platform; NULL: any). The first
 * that fits is taken: a driver's row stands above the row for any driver. */
static const struct driver_row {
    bool is_cpu;
    const char *platform;
    struct device_shape shape;
} rows[] = {
    {.is_cpu = true,
     .platform = "Portable Computing Language",
     .shape = {ROW_CPU, .op_ns = 0.064, .byte_ns = 0.022, .near_byte_ns = 0.004,
               .launch_ns = 3000, .run_columns = 4096, .strips_each = 3,
               .strip_columns = 4096, /* a few rows of many arrays are in the caches */
               .strip_least = 128, .near_bytes = 512 << 10, /* half of a second-level cache */
               .pass_cost = 600, .turns = 8, .arrays_foreseen = 16, .fetch_bytes = 4 << 20,
               .stream_bytes = 48 << 20, .in_place_bytes = 12 << 20, .streams = true,
               .from = "measured with PoCL on two cores with AVX-512"}},
    {.is_cpu = true,
     .shape = {ROW_CPU, .op_ns = 0.064, .byte_ns = 0.022, .near_byte_ns = 0.004,
               .launch_ns = 3000, .run_columns = 4096, .strips_each = 3, .strip_columns = 4096,
               .strip_least = 128, .near_bytes = 512 << 10, .pass_cost = 600, .turns = 8,
               .arrays_foreseen = 16, .fetch_bytes = 4 << 20, .stream_bytes = 48 << 20,
               .in_place_bytes = 12 << 20, .streams = true,
               .from = "PoCL's on another CPU; not measured with this driver"}},
    /* 1e13 operations a second, 1 TB/s, 15 TB/s to and from local memory: plans follow from the
     * ratios */
    {.is_cpu = false,
     .shape = {ROW_USUAL,
               .call_columns = 1,
               .call_processors = 1,
               .send_shares = 4096,
               .scan_run = 256,
               .fill_run = 256,
               .sort_chunk = 2048,
               .sort_long =
                   INT32_MAX,   /* counters of 11 bits are more than local memory holds */
               .step_ns = 0.01, /* a hundred instructions */
               .vector = 1,
               .op_ns = 1e-4,
               .byte_ns = 1e-3,
               .near_byte_ns = 6e-5,
               .launch_ns = 5000,
               .run_columns = 1,
               .strips_each = 3,
               .strip_columns = 256,
               .strip_least = 128,
               .pass_cost = 600,
               .turns = 8,
               .arrays_foreseen = 16,
               .fetch_bytes = 4 << 20,
               .stream_bytes = 48 << 20,
               .in_place_bytes = 12 << 20,
               .streams = true,
               .from = "public figures of large GPUs; not measured"}},
};

/* A number that a row forgets is 0: a division by it, or work that costs nothing. */
static bool row_is_whole(const struct driver_row *row)
{
    const struct device_shape *s = &row->shape;
    return (row->is_cpu || s->vector > 0) && s->op_ns > 0 && s->byte_ns > 0 &&
           s->near_byte_ns > 0 && s->launch_ns > 0 && s->call_columns > 0 &&
           s->call_processors > 0 && s->run_columns > 0 && s->strips_each > 0 &&
           s->strip_columns > 0 && s->strip_least > 0 && s->pass_cost > 0 && s->turns > 0 &&
           s->arrays_foreseen > 0 && s->fetch_bytes > 0 && s->stream_bytes > 0 &&
           s->in_place_bytes > 0 && s->fill_run > 0 && s->sort_long > 0 && s->step_ns > 0 &&
           s->from;
}

struct device_shape shape_by_driver(bool is_cpu, const char *platform)
{
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        INVARIANT(row_is_whole(&rows[i]));
    const struct driver_row *row = rows;
    while (row->is_cpu != is_cpu || (row->platform && !strstr(platform, row->platform)))
        row++; /* the last of each kind fits any driver */
    return row->shape;
}
