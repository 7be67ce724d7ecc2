/* shape.c - see shape.h. */
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

/* From public figures of large GPUs, and not measured: 1e13 operations a second, 1 TB/s, and 15 TB/s to and from local memory.
 * It is the ratios that plans follow from. */
struct device_shape shape_gpu(void)
{
    return (struct device_shape){.vector = 1,
                                 .op_ns = 1e-4,
                                 .byte_ns = 1e-3,
                                 .near_byte_ns = 6e-5,
                                 .launch_ns = 5000,
                                 .run_columns = 1,
                                 .strip_columns = 256,
                                 .strips_each = 3,
                                 .turns = 8,
                                 .streams = true};
}

/* What generated code should look like there, where nobody says. Costs measured with PoCL on two cores with AVX-512:
 * see docs/engine.md. A strip is so wide that a few rows of many arrays are in the caches. */
static struct device_shape shape_usual(const struct device *d)
{
    if (!d->is_cpu)
        return shape_gpu();
    cl_uint width = 0;
    clGetDeviceInfo(d->id, CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT, sizeof width, &width, NULL);
    return (struct device_shape){.vector = width >= 16  ? 16
                                           : width >= 8 ? 8
                                           : width >= 4 ? 4
                                                        : 1,
                                 .byte_ns = 0.022,
                                 .near_byte_ns = 0.004,
                                 .near_bytes = 512 << 10,
                                 .launch_ns = 3000,
                                 .run_columns = 4096,
                                 .strip_columns = 4096,
                                 .strips_each = 3,
                                 .turns = 8,
                                 .streams = true};
}

static int said(const struct settings *s, enum machine_knob knob, int usual)
{
    return s->knob[knob] == SETTING_FREE ? usual : (int)s->knob[knob];
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
    if (d->is_cpu) {
        shape.vector = said(s, MACHINE_VECTOR, shape.vector);
        shape.halo = shape.vector > 1 ? shape.vector : 0;
        shape.narrow = shape.vector > 1 && s->narrow;
#ifdef __x86_64__ /* 0/0 is *the* NaN, and an operand that is it is the result */
        shape.keeps_nan = s->keeps_nan != 0;
#endif
        shape.op_ns = 0.064 / shape.vector;
    }
    shape_tiles(d, s, &shape);
    return shape;
}
