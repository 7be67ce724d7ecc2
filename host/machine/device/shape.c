/* shape.c - see shape.h. */
#include <string.h>

#include "device/device.h"

/* Tiles: as many work-items as a unit of a GPU has lanes for a few times over, and local memory as GPUs have it (a
 * CPU says how large a cache is). */
enum { GROUP_USUAL = 256, GROUP_LEAST = 32, LOCAL_BYTES_CPU = 48 << 10 };

static void shape_tiles(const struct device *d, const struct settings *s,
                        struct device_shape *shape)
{
    size_t items = 0, sides[16] = {0};
    cl_ulong local = 0;
    cl_device_local_mem_type kind = CL_NONE;
    clGetDeviceInfo(d->id, CL_DEVICE_MAX_WORK_GROUP_SIZE, sizeof items, &items, NULL);
    clGetDeviceInfo(d->id, CL_DEVICE_MAX_WORK_ITEM_SIZES, sizeof sides, sides, NULL);
    items = sides[0] < items ? sides[0] : items;
    clGetDeviceInfo(d->id, CL_DEVICE_LOCAL_MEM_SIZE, sizeof local, &local, NULL);
    clGetDeviceInfo(d->id, CL_DEVICE_LOCAL_MEM_TYPE, sizeof kind, &kind, NULL);
    shape->units = d->units;
    shape->group = GROUP_USUAL;
    while (shape->group > GROUP_LEAST && (size_t)shape->group > items)
        shape->group /= 2;
    if (d->is_cpu && local > LOCAL_BYTES_CPU)
        local = LOCAL_BYTES_CPU;
    shape->local_bytes = local < (cl_ulong)INT32_MAX ? (int)local : INT32_MAX;
    /* CPUs have vectors, which are several times as fast: there tiles are for tests. So are tiles in what is called
     * local and is not. */
    bool wanted = d->is_cpu ? shape->always_strips : kind == CL_LOCAL || shape->always_strips;
    if (shape->vector > 1 || (size_t)shape->group > items || !wanted)
        shape->group = 0;
    if (s->tile != SETTING_FREE) {
        shape->tile_width = (int)(s->tile >> 16);
        shape->tile_height = (int)(s->tile & 0xffff);
    }
}

/* ---- the table ---- */

/* What all rows have. Processors first compare only the low 12 bits of addresses, and delay a load that seems to read what a
 * slightly earlier store writes (4K aliasing): hence the skews. The front end's costs were measured on one core with AVX-512,
 * the compiler's with PoCL's clang. To wake a thread takes some microseconds, and where other programs are at work, it may not run
 * at once: hence share_ns and part_ns. */
#define ROW_USUAL                                                                              \
    .large_page_bytes = 2 << 20, .skew_bytes = 7 * 128, .skew_page_bytes = 4096,               \
    .skew_large_bytes = 64 << 10, .pool_bytes = 1 << 30, .kernels_ahead = 256,                 \
    .kernels_ahead_building = 16, .move_ns = 0.06, .reduce_ns = 0.1, .rank_ns = 8,             \
    .send_ns = 1.2, .scan_ns = 0.6, .fill_ns = 0.2, .wait_ns = 12e3, .text_ns = 1e6,           \
    .compile_ns = 1e8, .compile_op_ns = 2e6, .kernel_part = 0.4, .turns_from_ns = 4e3,         \
    .scan_run_least = 65536, .sort_short = 64, .near_rank_most = 1 << 17, .share_ns = 150e3,   \
    .part_ns = 40e3, .loop_ns = 0.04, .loop_cost_ns = 0.01, .gather_ns = 0.5,                  \
    .each_math_ns = 15, .each_ns = 8, .short_ns = 10e3
/* ... and all of CPUs, whose units are few and have long work-items. */
#define ROW_CPU                                                                                \
    ROW_USUAL, .call_columns = 4096, .call_processors = 512, .scatter_units = 8,               \
               .fill_run = 1 << 16, .sort_long = 1 << 15

/* Each row is of a kind of device, and of a driver (its OpenCL platform; NULL: any). The first that fits is taken. */
static const struct shape_row {
    bool is_cpu;
    const char *platform;
    double
        instruction_ns; /* one vector instruction, of however many lanes; 0: op_ns says what an element's takes */
    struct device_shape shape;
} rows[] = {
    {.is_cpu = true,
     .platform = "Portable Computing Language",
     .instruction_ns = 0.064,
     .shape = {ROW_CPU, .byte_ns = 0.022, .near_byte_ns = 0.004, .launch_ns = 3000,
               .run_columns = 4096, .strips_each = 3,
               .strip_columns = 4096, /* a few rows of many arrays are in the caches */
               .strip_least = 128, .near_bytes = 512 << 10, /* half of a second-level cache */
               .pass_cost = 600, .turns = 8, .arrays_foreseen = 16, .fetch_bytes = 4 << 20,
               .stream_bytes = 48 << 20, .in_place_bytes = 12 << 20, .streams = true,
               .from = "measured with PoCL on two cores with AVX-512"}},
    {.is_cpu = true,
     .instruction_ns = 0.064,
     .shape = {ROW_CPU, .byte_ns = 0.022, .near_byte_ns = 0.004, .launch_ns = 3000,
               .run_columns = 4096, .strips_each = 3, .strip_columns = 4096, .strip_least = 128,
               .near_bytes = 512 << 10, .pass_cost = 600, .turns = 8, .arrays_foreseen = 16,
               .fetch_bytes = 4 << 20, .stream_bytes = 48 << 20, .in_place_bytes = 12 << 20,
               .streams = true,
               .from = "PoCL's on another CPU; not measured with this driver"}},
    {.is_cpu =
         false, /* 1e13 operations a second, 1 TB/s, 15 TB/s to and from local memory: plans follow from the ratios */
     .shape = {ROW_USUAL,
               .call_columns = 1,
               .call_processors = 1,
               .send_shares = 4096,
               .scan_run = 256,
               .fill_run = 256,
               .sort_chunk = 2048,
               .sort_long =
                   INT32_MAX, /* counters of 11 bits are more than local memory holds */
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

static const struct shape_row *row_of(bool is_cpu, const char *platform)
{
    const struct shape_row *row = rows;
    while (row->is_cpu != is_cpu || (row->platform && !strstr(platform, row->platform)))
        row++; /* the last of each kind fits any driver */
    return row;
}

struct device_shape shape_gpu(void)
{
    return row_of(false, "")->shape;
}

/* What generated code should look like there, where nobody says. */
static struct device_shape shape_usual(const struct device *d)
{
    char platform[256] = "";
    cl_platform_id id = NULL;
    clGetDeviceInfo(d->id, CL_DEVICE_PLATFORM, sizeof id, &id, NULL);
    if (id)
        clGetPlatformInfo(id, CL_PLATFORM_NAME, sizeof platform - 1, platform, NULL);
    const struct shape_row *row = row_of(d->is_cpu, platform);
    struct device_shape shape = row->shape;
    if (d->is_cpu) {
        cl_uint width = 0;
        clGetDeviceInfo(d->id, CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT, sizeof width, &width, NULL);
        shape.vector = width >= 16 ? 16 : width >= 8 ? 8 : width >= 4 ? 4 : 1;
        shape.op_ns = row->instruction_ns;
    }
    return shape;
}

int shape_sort_digit(const struct device_shape *shape, int length)
{
    return length <= shape->sort_short ? 4 : length < shape->sort_long ? 8 : 11;
}

static int said(const struct settings *s, enum machine_knob knob, int usual)
{
    return s->knob[knob] == SETTING_FREE ? usual : (int)s->knob[knob];
}

/* For a CPU, op_ns is what an instruction of all lanes takes, until shape_of() knows how many there are. */
static double *cost_in(struct device_shape *shape, enum machine_cost cost)
{
    switch (cost) {
    case MACHINE_COST_OP:
        return &shape->op_ns;
    case MACHINE_COST_BYTE:
        return &shape->byte_ns;
    case MACHINE_COST_NEAR_BYTE:
        return &shape->near_byte_ns;
    case MACHINE_COST_LAUNCH:
    case MACHINE_COSTS:
        break;
    }
    return &shape->launch_ns;
}

double shape_cost_ns(const struct device_shape *shape, enum machine_cost cost)
{
    struct device_shape copy = *shape;
    return *cost_in(&copy, cost) * (cost == MACHINE_COST_OP ? shape->vector : 1);
}

struct device_shape shape_of(const struct device *d, const struct settings *s)
{
    struct device_shape shape = shape_usual(d);
    shape.run_columns = said(s, MACHINE_RUN, shape.run_columns);
    shape.strip_columns = said(s, MACHINE_COLUMNS, shape.strip_columns);
    shape.strips_each = said(s, MACHINE_STRIPS_EACH, shape.strips_each);
    shape.turns = said(s, MACHINE_TURNS, shape.turns);
    shape.streams = said(s, MACHINE_STREAMS, shape.streams) != 0;
    shape.no_strips = s->strips == 0;
    shape.always_strips = s->strips == 1;
    bool measured = false;
    for (int i = 0; i < MACHINE_COSTS; i++)
        if (s->cost_ns[i] > 0) {
            *cost_in(&shape, (enum machine_cost)i) = s->cost_ns[i];
            measured = true;
        }
    if (measured)
        shape.from = "measured on this device by lutetia tune";
    if (d->is_cpu) {
        shape.vector = said(s, MACHINE_VECTOR, shape.vector);
        shape.halo = shape.vector > 1 ? shape.vector : 0;
        shape.narrow = shape.vector > 1 && s->narrow;
#ifdef __x86_64__ /* 0/0 is *the* NaN, and an operand that is it is the result */
        shape.keeps_nan = s->keeps_nan != 0;
#endif
        shape.op_ns /= shape.vector;
    }
    shape_tiles(d, s, &shape);
    return shape;
}
