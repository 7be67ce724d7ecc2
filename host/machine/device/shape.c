/* shape.c - see shape.h. */
#include <string.h>

#include "device/device.h"

/* Tiles: as many work-items as a unit of a GPU has lanes for a few times over, and local memory
 * as GPUs have it (a CPU says how large a cache is). */
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
    /* CPUs have vectors, which are several times as fast: there tiles are for tests. So are
     * tiles in what is called local and is not. */
    bool wanted = d->is_cpu ? shape->always_strips : kind == CL_LOCAL || shape->always_strips;
    if (shape->vector > 1 || (size_t)shape->group > items || !wanted)
        shape->group = 0;
    if (s->tile != SETTING_FREE) {
        shape->tile_width = (int)(s->tile >> 16);
        shape->tile_height = (int)(s->tile & 0xffff);
    }
}

/* What generated code should look like there, where nobody says. */
static struct device_shape shape_usual(const struct device *d)
{
    char platform[256] = "";
    cl_platform_id id = NULL;
    clGetDeviceInfo(d->id, CL_DEVICE_PLATFORM, sizeof id, &id, NULL);
    if (id)
        clGetPlatformInfo(id, CL_PLATFORM_NAME, sizeof platform - 1, platform, NULL);
    struct device_shape shape = shape_by_driver(d->is_cpu, platform);
    if (d->is_cpu) {
        cl_uint width = 0;
        clGetDeviceInfo(d->id, CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT, sizeof width, &width, NULL);
        shape.vector = width >= 16 ? 16 : width >= 8 ? 8 : width >= 4 ? 4 : 1;
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

/* For a CPU, op_ns is what an instruction of all lanes takes, until shape_of() knows how many
 * there are. */
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

bool shape_streams_lanes(const struct device_shape *shape, double bytes)
{
    return shape->streams && bytes > shape->stream_lanes_bytes;
}

uint64_t shape_work(const struct device_shape *shape, uint64_t processors)
{
    return processors > shape->work_least ? processors : shape->work_least;
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
    if (s->near > 1)
        shape.stream_lanes_bytes = 0;
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
        shape.narrow = shape.vector > 1;
#ifdef __x86_64__ /* 0/0 is *the* NaN, and an operand that is it is the result */
        shape.keeps_nan = s->keeps_nan != 0;
#endif
        shape.op_ns /= shape.vector;
        shape.claims = shape.vector > 1 && d->units > 1 && d->is_pocl && s->claims;
    }
    shape_tiles(d, s, &shape);
    return shape;
}
